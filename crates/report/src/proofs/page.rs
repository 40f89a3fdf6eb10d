//! Proofs as a page: of one kernel the sentences that people ask for first, then its gates; of several a table.

use super::record::{GatePart, KernelPart, ProofResult, Report};
use crate::arith::ScalarName;
use crate::page::{Block, Cell, Command, Head, Item, Items, Page, Paged, Row, Table, Tone};
use crate::prove::{USELESS, above, units};

impl Paged for Report {
    fn page(&self) -> Page {
        if self.is_of_one {
            of_one(self)
        } else {
            of_all(self)
        }
    }
}

/// All kernels: a row a gate.
fn of_all(report: &Report) -> Page {
    let record = &report.record.result;
    let mut blocks = vec![Block::Text(domain(report))];
    let mut details = Vec::new();
    for scalar in ScalarName::ALL {
        let kernels = record
            .kernels
            .iter()
            .filter(|kernel| kernel.scalar == scalar);
        let verdicts: Vec<Row> = kernels
            .filter_map(|kernel| Some(kernel.verdicts.as_ref()?.row(&kernel.kernel)))
            .collect();
        if !verdicts.is_empty() {
            let heads = [
                scalar.name(),
                "miss inside",
                "known",
                "factor",
                "hit outside",
                "known",
                "factor",
            ];
            blocks.push(Block::Table(Table::new(
                heads.map(Head::of).to_vec(),
                verdicts,
            )));
        }
        let gates: Vec<&GatePart> = record
            .gates
            .iter()
            .filter(|gate| gate.scalar == scalar)
            .collect();
        if gates.is_empty() {
            continue;
        }
        let mut heads = vec![
            Head::of(format!("{scalar}, u = {}", unit(scalar))),
            Head::text("gate"),
        ];
        heads.extend(numbers());
        heads.push(Head::text("supposes a bound of").optional());
        let row = |gate: &&GatePart| {
            let [bound, known, factor] = cells(gate);
            let cells = [
                Cell::words(&gate.gate),
                bound,
                known,
                factor,
                Cell::words(gate.supposes.join(", ")),
            ];
            let why = gate.why.as_ref().map(|why| format!("no bound: {why}"));
            Row {
                below: why.into_iter().collect(),
                ..Row::new(&gate.kernel, cells)
            }
        };
        details.push(Block::Table(Table::new(
            heads,
            gates.iter().map(row).collect(),
        )));
    }
    blocks.push(Block::text(
        "In longest edges of the triangle; e as the sources have it.",
    ));
    blocks.push(Block::Details(
        "How wrong each gate's numbers can be".to_owned(),
        details,
    ));
    let watertight = record.kernels.iter().filter(|kernel| kernel.watertight);
    let watertight: Vec<String> = watertight
        .map(|kernel| format!("{} ({})", kernel.kernel, kernel.scalar))
        .collect();
    if !watertight.is_empty() {
        let names = watertight.join(", ");
        blocks.push(Block::Text(String::new()));
        blocks.push(Block::Text(format!(
            "Watertight at edges, at an epsilon of 0, proved: {names}"
        )));
    }
    let line = "hairline prove --kernel NAME".to_owned();
    blocks.push(Block::Commands(
        "next",
        vec![Command {
            line,
            what: "what follows for epsilons",
        }],
    ));
    let title = "No float of the domain makes a verdict wrong farther from the edges than this";
    Page {
        command: "prove",
        title: title.to_owned(),
        tone: Tone::Plain,
        blocks,
    }
}

/// One kernel: its sentences.
fn of_one(report: &Report) -> Page {
    let record = &report.record.result;
    let name = record.kernels.first().map_or("K", |kernel| &kernel.kernel);
    let mut blocks: Vec<Block> = record
        .kernels
        .iter()
        .filter_map(conclusion)
        .map(Block::Text)
        .collect();
    blocks.push(Block::Text(domain(report)));
    if report.scene.is_none() {
        let text = "That is not your scene: --scene room, or --mesh FILE --distance LENGTH, says the same in lengths.";
        blocks.push(Block::Text(text.to_owned()));
    }
    for kernel in &record.kernels {
        let gates: Vec<&GatePart> = record
            .gates
            .iter()
            .filter(|gate| gate.scalar == kernel.scalar)
            .collect();
        blocks.push(Block::Heading(format!(
            "{} in {}",
            kernel.kernel, kernel.scalar
        )));
        let sentences = kernel.verdicts.iter().flat_map(|it| &it.sentences);
        let mut notes: Vec<String> = sentences.cloned().collect();
        notes.push(match &kernel.leak {
            Some(leak) => format!(
                "edges: Not watertight: at an edge epsilon of 0 both triangles of an edge refuse the ray of {}, which crosses it.",
                leak.case
            ),
            None => format!("edges: {}", kernel.edges),
        });
        blocks.push(Block::Notes(notes));
        blocks.push(Block::Table(table(kernel, &gates)));
        let all = gates.iter().flat_map(|gate| {
            let texts = gate.statements.iter().cloned();
            let title = format!("{}: {}", gate.gate, gate.compares);
            [
                Block::Text(String::new()),
                Block::Text(title),
                Block::Notes(texts.collect()),
            ]
        });
        let title = format!("Everything about {} in {}", kernel.kernel, kernel.scalar);
        blocks.push(Block::Details(title, all.collect()));
    }
    blocks.push(Block::Details(
        "What is supposed".to_owned(),
        vec![Block::text(SUPPOSED)],
    ));
    let scalar = match &record.kernels[..] {
        [only] => format!(" --scalar {}", only.scalar),
        _ => String::new(),
    };
    let line = format!("hairline epsilon --kernel {name} {}{scalar}", report.rays);
    let mut items = Vec::new();
    let mut shown = |kernel: &KernelPart, what: &str, command: &str| {
        let text = format!("The ray of {what} in {}:", kernel.scalar);
        items.push(Item::shown_by(text, command.to_owned()));
    };
    for kernel in &record.kernels {
        if let Some(verdicts) = &kernel.verdicts {
            let known = [
                (&verdicts.misses, "the deepest known false miss"),
                (&verdicts.hits, "the farthest known false hit"),
            ];
            let known = known
                .into_iter()
                .filter_map(|(depth, what)| Some((what, depth.known.as_ref()?)));
            known.for_each(|(what, known)| shown(kernel, what, &known.command));
        }
        if let Some(leak) = &kernel.leak {
            shown(kernel, "the leak at an edge epsilon of 0", &leak.command);
        }
    }
    if !items.is_empty() {
        blocks.push(Block::Text(String::new()));
        blocks.push(Block::Items(Items {
            most: items.len(),
            items,
        }));
    }
    // Without a scene `repair` takes the families.
    let rays = report
        .scene
        .as_ref()
        .map_or(String::new(), |_| format!(" {}", report.rays));
    let repair = format!("hairline repair --kernel {name}{rays}{scalar}");
    let commands = vec![
        Command {
            line,
            what: "which epsilons cost least",
        },
        Command {
            line: repair,
            what: "what mends it",
        },
    ];
    blocks.push(Block::Commands("next", commands));
    let title = format!("{name}: what holds for every float");
    Page {
        command: "prove",
        title,
        tone: Tone::Plain,
        blocks,
    }
}

/// The conclusion of a kernel, in a sentence.
fn conclusion(kernel: &KernelPart) -> Option<String> {
    let verdicts = kernel.verdicts.as_ref()?;
    let all = [
        verdicts.misses.share?,
        verdicts.hits.apart.or(verdicts.hits.share)?,
    ];
    let most = all.into_iter().fold(0.0, f64::max);
    let others = match verdicts.others.iter().any(|other| !other.is_never) {
        true => ", but where another gate decides (below)",
        false => "",
    };
    let limits = match verdicts.limits() {
        Some(limits) => format!(" where {limits}"),
        None => String::new(),
    };
    (most < USELESS).then(|| {
        format!(
            "In {}, for all floats of the domain below{limits}, an answer can be wrong only where the ray passes within {} of the triangle's \
             longest edge of its boundary, in the triangle's plane{others}.",
            kernel.scalar,
            above(most)
        )
    })
}

/// The gates of a kernel: how wrong what each compares can be.
fn table(kernel: &KernelPart, gates: &[&GatePart]) -> Table {
    let mut heads = vec![Head::of(format!("u = {}", unit(kernel.scalar)))];
    heads.extend(numbers());
    heads.push(Head::text("refuses where").optional());
    let row = |gate: &&GatePart| {
        let [bound, known, factor] = cells(gate);
        Row::new(
            &gate.gate,
            [bound, known, factor, Cell::words(&gate.compares)],
        )
    };
    Table::new(heads, gates.iter().map(row).collect())
}

fn numbers() -> [Head; 3] {
    ["wrong by at most, u", "known, u", "factor"].map(Head::of)
}

/// The bound, the witness and their ratio.
fn cells(gate: &GatePart) -> [Cell; 3] {
    let known = gate.witness.as_ref().map(|witness| witness.units);
    [
        Cell::optional(gate.bound_units, |bound| units(bound, true)),
        Cell::optional(known, |known| units(known, false)),
        Cell::optional(gate.factor, |factor| format!("{factor:.2}")),
    ]
}

fn unit(scalar: ScalarName) -> &'static str {
    if scalar == ScalarName::F32 {
        "2^-24"
    } else {
        "2^-53"
    }
}

const SUPPOSED: &str = "A bound supposes, and its witness keeps, only what the gate's numbers use. Powers of two scale \
                        it: lengths by s scale det by s^2.";

fn domain(Report { record, scene, .. }: &Report) -> String {
    let ProofResult { domain, .. } = &record.result;
    let least = domain.divisor_at_least;
    match scene {
        Some(scene) => format!("Scene: {scene}"),
        None => format!(
            "Unit domain: each coordinate of points and of their differences up to 1 - 2^-10, of d up to {}. Where a kernel \
             divides, divisors of {least} and more (the largest coordinate of d too), quotients up to {}, barycentric ones \
             from 0 but for false hits. Known rays lie in it, with |N·d| of {least} and more and t_max = {}; the known errors of \
             gates keep only what their numbers use of it.",
            domain.direction, domain.quotient_at_most, domain.extent
        ),
    }
}

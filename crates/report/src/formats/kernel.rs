//! One row of a record, folded: what it promises, its gates and what is proved of them, its rates, why it is wrong, drawings of
//! the worst, and every class of its findings.

use super::columns::kinds;
use super::pool::{Pool, counted};
use super::row_view::{COUNTED, RowView, WRONG};
use super::why::{causes_text, of_kind, short};
use super::worst::{findings, severity};
use crate::audit;
use crate::case::Case;
use crate::judge::Class;
use crate::kernel::{self, Gate, Scalar, Tunable};
use crate::map;
use crate::page::{Block, Cell, Drawing, Head, Picture, Row, Table};
use crate::prove::units;
use hairline_record::counts_alone;
use hairline_record::*;
use hairline_record::{ProofPart, ProvedGate};
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A row with its views in each scalar.
pub(super) fn blocks(record: &Record, part: &RowPart, views: &[&RowView]) -> Vec<Block> {
    let mut blocks = vec![Block::terms(facts(record, part, views))];
    blocks.extend(gates(record, part));
    blocks.push(Block::Table(rates(record, part, views)));
    blocks.extend(quantiles_of(views));
    blocks.extend(pictures(record, part, views));
    let families = Block::Table(by_family(record, views));
    blocks.push(Block::Details(
        "Family by family".to_owned(),
        vec![families],
    ));
    let items: Vec<_> = views.iter().flat_map(|view| findings(view)).collect();
    match items.is_empty() {
        true => blocks.push(Block::text("No findings.")),
        false => blocks.extend(Block::items("The worst of each class", usize::MAX, items)),
    }
    blocks
}

/// The promise, where it comes from, what is proved of its edges, and how it runs again.
fn facts(record: &Record, part: &RowPart, views: &[&RowView]) -> Vec<(&'static str, String)> {
    let plan_flags = record.provenance.plan_flags.clone().unwrap_or_default();
    let mut facts = vec![("contract", part.contract.clone())];
    facts.extend(info(part).map(|info| ("source", info.source.to_owned())));
    let notes = record
        .provenance
        .kernel_notes
        .get(&part.kernel)
        .into_iter()
        .flatten();
    facts.extend(notes.map(|note| ("note", note.clone())));
    let proofs = proofs(record, part);
    for alike in proofs.chunk_by(|one, other| one.edges == other.edges) {
        let of = if alike.len() < proofs.len() {
            format!("{}: ", alike[0].scalar)
        } else {
            String::new()
        };
        facts.push(("edges", format!("{of}{}", alike[0].edges)));
    }
    for view in views {
        for (kind, what) in [
            (FindingKind::FalseMiss, "misses"),
            (FindingKind::FalseHit, "hits"),
        ] {
            let causes = causes_text(of_kind(&view.results, kind));
            facts.extend(
                causes.map(|causes| ("why", format!("{} false {what}: {causes}", view.scalar))),
            );
        }
    }
    if !part.selector.is_empty() {
        facts.push(("run again", plan_flags.command(&part.flags())));
        if part.is_tunable() {
            let command = format!(
                "hairline epsilon {} --format html -o epsilon.html",
                part.selector
            );
            facts.push(("every epsilon", command));
        }
    }
    facts
}

/// The kernel, if it runs here: answers from elsewhere have no selector, whatever their product is called.
fn info(part: &RowPart) -> Option<&'static kernel::KernelInfo> {
    let entry = kernel::find(&part.kernel).filter(|_| !part.selector.is_empty())?;
    Some(entry.info)
}

fn proofs<'a>(record: &'a Record, part: &RowPart) -> Vec<&'a ProofPart> {
    let all = record.illustrations.iter().flat_map(|all| &all.proofs);
    all.filter(|proof| proof.kernel == part.kernel).collect()
}

/// The gates in the order of the test, with what is proved of each.
fn gates(record: &Record, part: &RowPart) -> Vec<Block> {
    let gates: &[Gate] = info(part).map_or(&[], |info| info.gates);
    let proofs = proofs(record, part);
    let mut heads = vec![
        Head::of("gate"),
        Head::text("refuses where"),
        Head::of("epsilon e"),
        Head::of("dimension").optional(),
    ];
    heads.extend(
        proofs
            .iter()
            .map(|proof| Head::of(format!("proved, {} (known)", proof.scalar)).optional()),
    );
    let row = |gate: &Gate| {
        let epsilon = match (gate.epsilon, part.epsilons.get(gate.name)) {
            (Tunable::Fixed, _) => "takes none".to_owned(),
            (_, Some(value)) => value.clone(),
            (_, None) => "-".to_owned(),
        };
        let dimension = format!(
            "length^{} |d|^{}",
            gate.dimension.length, gate.dimension.direction
        );
        let mut cells = vec![gate.refuses.to_owned(), epsilon, dimension];
        cells.extend(proofs.iter().map(|proof| proved(proof, gate.name)));
        Row::new(gate.name, cells.into_iter().map(Cell::words))
    };
    let mut rows: Vec<Row> = gates.iter().map(row).collect();
    let is_unknown = |name: &String| gates.iter().all(|gate| gate.name != name.as_str());
    for (name, value) in part.epsilons.iter().filter(|(name, _)| is_unknown(name)) {
        let mut cells = vec![Cell::none(), Cell::words(value)];
        cells.resize_with(heads.len() - 1, Cell::none);
        rows.push(Row::new(name, cells));
    }
    if rows.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![Block::Table(Table::new(heads, rows))];
    if !proofs.is_empty() {
        blocks.push(Block::text(
            "Proved: in the unit domain (every number at most 1, divisors at least 1/2) what the gate compares is never \
             wrong by more; u is 2^-24 in f32 and 2^-53 in f64. Known: the worst case found. `hairline prove` says what \
             each bound supposes.",
        ));
    }
    blocks
}

/// How wrong at most what a gate compares is, and the worst that is known.
fn proved(proof: &ProofPart, gate: &str) -> String {
    let units = |error: f64, up: bool| format!("{} u", units(error, up));
    match proof.gates.get(gate) {
        None => "-".to_owned(),
        Some(ProvedGate { bound: None, .. }) => "no bound".to_owned(),
        Some(ProvedGate {
            bound: Some(bound),
            known: None,
        }) => units(*bound, true),
        Some(ProvedGate {
            bound: Some(bound),
            known: Some(known),
        }) => {
            format!("{} ({})", units(*bound, true), units(*known, false))
        }
    }
}

/// The sums over all sources, scalar by scalar.
fn rates(record: &Record, part: &RowPart, views: &[&RowView]) -> Table {
    let all = match kinds(record).len() {
        1 => "all families".to_owned(),
        several => format!("all families in {several} kinds of planes and rays"),
    };
    let heads = [all]
        .into_iter()
        .chain(views.iter().map(|view| view.scalar.to_string()));
    let mut rows = Vec::new();
    for (name, get) in COUNTED {
        let pools: Vec<Pool> = views.iter().map(|view| view.total(get)).collect();
        if pools.iter().any(|pool| 0 < pool.counts()[1]) {
            let cell = |pool: &Pool| Cell::rate(pool.rate(), pool.to_string());
            rows.push(Row::new(name, pools.iter().map(cell)));
        }
    }
    if views.iter().any(|view| 0 < view.hits_on_invalid()) {
        let hits = views.iter().map(|view| Cell::count(view.hits_on_invalid()));
        rows.push(Row::new("hits on NaN, infinities, …", hits));
    }
    let label = part.label();
    let time = |view: &RowView| {
        let times = record.provenance.kernel_nanoseconds.get(&view.scalar)?;
        let time = times.get(&label)?;
        Some(Cell::number(*time, format!("{time:.1}")))
    };
    let is_emulated = part.kernel.contains('+');
    let name = if is_emulated {
        "ns a ray, emulated"
    } else {
        "ns a ray"
    };
    rows.push(Row::new(
        name,
        views
            .iter()
            .map(|view| time(view).unwrap_or_else(Cell::none)),
    ));
    Table::new(heads.map(Head::of).collect(), rows)
}

/// How far off findings are, and the errors of right hits.
fn quantiles_of(views: &[&RowView]) -> Vec<Block> {
    let heads = |first: &str| -> Vec<Head> {
        [first, "half within", "90 %", "99 %", "all"]
            .map(Head::of)
            .into()
    };
    let quantiles = |part: &Distribution| {
        [part.median, part.percent_90, part.percent_99, part.worst].map(short)
    };
    let (mut severities, mut accuracies) = (Vec::new(), Vec::new());
    for view in views {
        let Some(total) = view.total else { continue };
        for (kind, words) in [
            (FindingKind::FalseMiss, "false misses"),
            (FindingKind::FalseHit, "false hits"),
        ] {
            if let Some(part) = total.severity.get(&kind) {
                let pairs = quantiles(&part.edges)
                    .into_iter()
                    .zip(quantiles(&part.ulps));
                let cells = pairs.map(|(edges, ulps)| Cell::words(format!("{edges} ({ulps})")));
                severities.push(Row::new(format!("{} {words}", view.scalar), cells));
            }
        }
        for (key, name) in [("t", "t"), ("uv", "u and v"), ("point", "o + t*d")] {
            if let Some(part) = total.accuracy.get(key) {
                let cells = quantiles(part).map(Cell::words);
                accuracies.push(Row::new(format!("{} {name}", view.scalar), cells));
            }
        }
    }
    let tables = [
        ("off by, in longest edges (ulps)", severities),
        ("errors of right hits, in ulps", accuracies),
    ];
    let tables = tables.into_iter().filter(|(_, rows)| !rows.is_empty());
    tables
        .map(|(title, rows)| Block::Table(Table::new(heads(title), rows)))
        .collect()
}

/// Every source with its counts and intervals.
fn by_family(record: &Record, views: &[&RowView]) -> Table {
    let mut heads = vec![Head::of("family")];
    for view in views {
        heads.extend(
            ["misses", "hits"].map(|what| Head::of(format!("{} false {what}", view.scalar))),
        );
    }
    let results: Vec<HashMap<&str, &KernelResult>> = views
        .iter()
        .map(|view| {
            view.results
                .iter()
                .map(|result| (&*result.family, *result))
                .collect()
        })
        .collect();
    let row = |source: &PlannedSource| {
        let cells = results.iter().flat_map(|results| {
            let result = results.get(&*source.family);
            WRONG.map(|(kind, rate)| {
                let alone = result.filter(|result| counts_alone(result, kind));
                let rate = alone
                    .map(|result| rate(&result.total))
                    .filter(|rate| 0 < rate.of);
                rate.map_or(Cell::none(), |rate| Cell::rate(rate, counted(rate)))
            })
        });
        Row::new(&source.family, cells.collect::<Vec<_>>())
    };
    Table::new(heads, record.result.plan.sources.iter().map(row).collect())
}

/// Families whose sizes span the scalar's range.
const SPANNING: [&str; 6] = [
    "tiny",
    "huge",
    "direction-length",
    "mixed-scale",
    "range-ends",
    "invalid",
];

/// Where pictures were asked for: in each scalar the worst false miss and false hit that can be drawn, if the kernel is
/// known here.
fn pictures(record: &Record, part: &RowPart, views: &[&RowView]) -> Vec<Block> {
    if record.illustrations.is_none() {
        return Vec::new();
    }
    let Ok(run) = part.spec().row() else {
        return Vec::new();
    };
    let mut all = Vec::new();
    for view in views {
        for (kind, _) in WRONG {
            let Some((family, part)) = worst(view, kind) else {
                continue;
            };
            // A drawing does not know that its ray starts at the kernel's own hit.
            let is_secondary = family == "secondary-ray" || family.starts_with("corpus-secondary:");
            if run.contract.no_self_hit && is_secondary {
                continue;
            }
            let svg = in_named_scalar!(view.scalar, F => drawn::<F>(&run, &part.worst.bits));
            all.extend(svg.map(|svg| {
                Block::Picture(Picture {
                    about: format!("Drawing of the worst {}", part.finding),
                    caption: format!(
                        "{} {} of {} in {family}: {}",
                        view.scalar, part.finding, part.class, part.worst.command
                    ),
                    drawing: Drawing::Svg(svg),
                })
            }));
        }
    }
    all
}

/// The worst finding of a kind that has a place to show: of a ray that crosses the plane, in a family of
/// moderate sizes if there is one.
fn worst<'a>(scalar: &RowView<'a>, kind: FindingKind) -> Option<(&'a str, &'a FindingPart)> {
    let all = scalar.results.iter().flat_map(|result| {
        result
            .findings
            .iter()
            .map(move |part| (result.family.as_str(), part))
    });
    let all = all
        .filter(|(_, part)| part.finding == kind && part.class.truth().is_some_and(Class::crosses));
    let moderate = |family: &str| !SPANNING.contains(&family);
    all.filter(|(_, part)| severity(part).is_finite())
        .max_by(|(f, a), (g, b)| {
            moderate(f)
                .cmp(&moderate(g))
                .then(severity(a).total_cmp(&severity(b)))
        })
}

fn drawn<F: Scalar>(row: &audit::Row, bits: &str) -> Option<String> {
    let case = Case::<F>::from_hex(bits)?;
    catch_unwind(AssertUnwindSafe(|| map::drawing(&case, row).ok()))
        .ok()
        .flatten()
}

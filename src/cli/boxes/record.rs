//! The findings of an audit of slab tests, and their page.

mod sum;

use crate::arith::ScalarName;
use crate::audit::Trials;
use crate::record::{Comparable, NamedRate, Rate, Study, number_of};
use crate::report::alike;
use crate::report::page::{Block, Command, Head, Page, Paged, Row as TableRow, Table, Tone};
use hairline_boxes::{FamilyScalar, Row, Setup, Source, Wrong};
use hairline_core::kernel::Scalar;
use std::collections::BTreeSet;
use sum::Sum;

/// The counts of slab tests on boxes.
#[apply(part!)]
pub struct BoxesResult {
    /// How many cases of each source in each scalar.
    pub count: u64,
    /// The seed of their draws.
    pub seed: u64,
    /// The families, or the scene.
    pub sources: Vec<String>,
    /// An entry for each source, scalar and slab test.
    pub rows: Vec<BoxesRow>,
}

/// A slab test on one source in one scalar.
#[apply(part!)]
pub struct BoxesRow {
    /// The slab test.
    test: String,
    /// The flag that brings it along, if it is not built in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    flag: Option<String>,
    /// Its name with that of its epsilons, if they are not its only published ones.
    label: String,
    /// Its epsilons, by gate.
    epsilons: Vec<(String, String)>,
    /// `f32` or `f64`.
    scalar: ScalarName,
    /// The family, or the scene.
    source: String,
    /// Misses of boxes that it must hit.
    lost: Rate,
    /// Hits of boxes that it must miss.
    false_hits: Rate,
    /// Cases on which it gave no verdict.
    failed: u64,
    /// Pairs of neighbours of which it lost a ray in both, among those of which it must hit one at least.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lost_in_both: Option<Rate>,
    /// The first case that it lost.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    first_lost: Option<String>,
    /// The false hit that passes its box by most, by the largest coordinate of the case.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    farthest: Option<Farthest>,
}

/// A false hit.
#[apply(part!)]
struct Farthest {
    /// How far the line passes outside, by the largest coordinate of the case.
    share: f64,
    /// The case.
    case: String,
}

impl BoxesRow {
    /// From a row of an audit.
    pub fn new<F: FamilyScalar + Scalar>(row: &Row, source: &Source, seed: u64) -> BoxesRow {
        let Row { setup, tally, .. } = row;
        let name = |index: u64| super::case::name::<F>(source, seed, index);
        let gates = setup.gates().iter().map(|gate| gate.name.to_owned());
        let values = setup.values.iter().map(ToString::to_string);
        let rate = |wrong: &Wrong, of| Rate::new(Trials::independent(wrong.count, of), true);
        let worst = tally.false_hits.worst;
        BoxesRow {
            test: setup.entry.info.name.to_owned(),
            flag: (!setup.is_built_in()).then(|| setup.entry.selector()),
            label: label(setup),
            epsilons: gates.zip(values).collect(),
            scalar: row.scalar,
            source: row.source.clone(),
            lost: rate(&tally.false_misses, tally.must_hit),
            false_hits: rate(&tally.false_hits, tally.must_miss),
            failed: tally.failed.count,
            lost_in_both: source.is_of_pairs().then(|| {
                let trials = Trials::independent(tally.lost_pairs, tally.owed_pairs);
                Rate::new(trials, true)
            }),
            first_lost: tally.false_misses.first.map(name),
            farthest: worst.map(|worst| Farthest {
                share: worst.severity,
                case: name(worst.index),
            }),
        }
    }

    /// True if it lost a ray, or gave no verdict.
    fn is_losing(&self) -> bool {
        0 < self.lost.count + self.failed
    }

    fn is_wrong(&self) -> bool {
        self.is_losing() || 0 < self.false_hits.count
    }

    /// Shows the first lost case, or else the farthest false hit.
    fn command(&self) -> Option<String> {
        let farthest = self.farthest.as_ref().map(|farthest| &farthest.case);
        let case = self.first_lost.as_ref().or(farthest)?;
        Some(self.explain(case))
    }

    /// The command that shows a case, at the epsilons of this row.
    fn explain(&self, case: &str) -> String {
        let named = || format!("--kernel {}", self.test);
        let selector = self.flag.clone().unwrap_or_else(named);
        let mut command = format!("hairline boxes explain '{case}' {selector}");
        if self.label != self.test {
            for (gate, value) in &self.epsilons {
                command += &format!(" --epsilon '{gate}={value}'");
            }
        }
        command
    }
}

/// The name of a slab test, with that of its epsilons if they are not its only published ones.
pub fn label(setup: &Setup) -> String {
    let info = setup.entry.info;
    let is_only = info.epsilon_sets.len() == 1 && info.epsilon_sets[0].name == setup.set;
    match setup.set {
        _ if is_only => info.name.to_owned(),
        "source" => info.name.to_owned(),
        "given" => format!("{} (as given)", info.name),
        set => format!("{} ({set})", info.name),
    }
}

impl BoxesResult {
    /// True if any slab test lost a ray, or gave no verdict.
    pub fn is_losing(&self) -> bool {
        self.rows.iter().any(BoxesRow::is_losing)
    }

    /// True if no slab test had a ray to hit.
    fn asks_nothing(&self) -> bool {
        self.rows.iter().all(|row| row.lost.of == 0)
    }

    /// The scalars that were run.
    fn scalars(&self) -> Vec<ScalarName> {
        let is_run = |scalar: &ScalarName| self.rows.iter().any(|row| row.scalar == *scalar);
        ScalarName::ALL.into_iter().filter(is_run).collect()
    }

    /// The rows of each slab test, those that lose least first.
    fn sums(&self) -> Vec<Sum<'_>> {
        let mut sums = Vec::new();
        for (first, others) in alike(&self.rows, |one, other| one.label == other.label) {
            let mut rows = vec![first];
            rows.extend(others);
            let label = first.label.clone();
            sums.push(Sum { label, rows });
        }
        sums.sort_by(|one, other| one.order().total_cmp(&other.order()));
        sums
    }

    fn table(&self, sums: &[Sum]) -> Table {
        let scalars = self.scalars();
        let tells_sources = 1 < self.sources.len();
        let about = "the share of the rays that a test has to hit, by its own promise about the ends of a ray";
        let mut heads = vec![Head::of("lost in").about(about)];
        heads.extend(scalars.iter().map(|scalar| Head::of(scalar.name())));
        if tells_sources {
            heads.push(Head::text("most of these families").optional());
        }
        let rows = sums
            .iter()
            .map(|sum| TableRow::new(sum.label.clone(), sum.cells(&scalars, tells_sources)))
            .collect();
        Table::new(heads, rows)
    }

    /// The row with the largest share of lost rays on a source.
    fn worst(&self) -> Option<&BoxesRow> {
        let losing = self.rows.iter().filter(|row| row.is_wrong());
        let share = |row: &BoxesRow| row.lost.rate.unwrap_or(0.0);
        losing.max_by(|a, b| share(a).total_cmp(&share(b)))
    }

    fn title(&self, sums: &[Sum]) -> String {
        let tests = |sums: &mut dyn Iterator<Item = &Sum>| {
            let names: BTreeSet<&str> = sums.map(|sum| sum.rows[0].test.as_str()).collect();
            names.len()
        };
        let losing = tests(&mut sums.iter().filter(|sum| sum.is_losing()));
        let all = number_of(tests(&mut sums.iter()) as u64, "slab test", "slab tests");
        let rays = number_of(self.count, "ray", "rays");
        let sources = match self.sources.as_slice() {
            [source] => source.clone(),
            many => format!("each of {} families", many.len()),
        };
        let scalars: Vec<&str> = self.scalars().into_iter().map(ScalarName::name).collect();
        let drawn = format!("{rays} of {sources} in {}", scalars.join(" and "));
        if self.asks_nothing() {
            return format!("No ray has to be hit, so nothing is said of {all}: {drawn}");
        }
        match losing {
            0 => format!("No ray that has to be hit is lost by {all}: {drawn}"),
            some => format!("Rays that have to be hit are lost by {some} of {all}: {drawn}"),
        }
    }

    /// Sentences on what the table does not show.
    fn notes(&self, sums: &[Sum]) -> Vec<String> {
        let mut notes: Vec<String> = sums.iter().filter_map(Sum::failures).collect();
        let lost: Vec<String> = sums.iter().filter_map(Sum::lost_in_both).collect();
        if !lost.is_empty() {
            notes.push(format!(
                "Rays that a traversal loses at a wall of two neighbours, because neither is hit: {}",
                lost.join(", ")
            ));
        }
        for sum in sums {
            if let Some((row, farthest)) = sum.far() {
                let (label, share) = (&sum.label, farthest.share);
                let command = row.explain(&farthest.case);
                notes.push(format!(
                    "{label} hits boxes far from the ray, by {share:.0e} of the largest coordinate: {command}"
                ));
            }
        }
        notes.push(
            "A lost box loses everything in it; a box that is hit too often only costs time."
                .to_owned(),
        );
        let drawn = if 1 < self.sources.len() {
            "The families are rays at corners, edges and faces, and boxes that are flat or a point. The shares compare \
             tests on them; they are not rates in a program, whose rays are rarely so near an edge."
        } else {
            "All rays are aimed at a box: most at a corner, an edge or a face, where rounding decides. The shares compare tests \
             there; they are not rates in a program, whose rays are rarely so near an edge."
        };
        notes.push(drawn.to_owned());
        notes
    }
}

impl Paged for BoxesResult {
    fn page(&self) -> Page {
        let sums = self.sums();
        let mut blocks = vec![
            Block::Table(self.table(&sums)),
            Block::Notes(self.notes(&sums)),
        ];
        let mut commands = Vec::new();
        if let Some(line) = self.worst().and_then(BoxesRow::command) {
            commands.push(Command {
                line,
                what: "the first ray that it loses",
            });
        }
        commands.push(Command {
            line: "hairline boxes epsilon --extent 100 --size 1".to_owned(),
            what: "which growth or padding loses none",
        });
        blocks.push(Block::Commands("next", commands));
        let details: Vec<Block> = self
            .rows
            .iter()
            .filter(|row| row.is_wrong())
            .map(detail)
            .collect();
        if !details.is_empty() {
            blocks.push(Block::Details("Every family".to_owned(), details));
        }
        Page {
            command: "boxes",
            title: self.title(&sums),
            tone: if self.is_losing() {
                Tone::Bad
            } else {
                Tone::Good
            },
            blocks,
        }
    }
}

/// One line on a slab test and a family.
fn detail(row: &BoxesRow) -> Block {
    let command = row.command().unwrap_or_default();
    let false_hits = match row.false_hits.count {
        0 => String::new(),
        _ => format!("; {} false hits", row.false_hits.counts()),
    };
    let failed = match row.failed {
        0 => String::new(),
        count => format!("; {count} without a verdict"),
    };
    let (label, scalar, source) = (&row.label, row.scalar, &row.source);
    let lost = row.lost.counts();
    Block::text(format!(
        "{label}, {scalar}, {source}: {lost} lost{false_hits}{failed}: {command}"
    ))
}

impl Comparable for BoxesResult {
    const STUDY: Study = Study::Boxes;

    fn question(&self) -> String {
        self.sources.join(", ")
    }

    fn cases(&self) -> String {
        format!("{} of seed {}", self.count, self.seed)
    }

    fn counted(&self) -> Vec<NamedRate> {
        let mut counted = Vec::new();
        for row in &self.rows {
            let (label, scalar, source) = (&row.label, row.scalar, &row.source);
            let named = |what: &str, rate: &Rate| NamedRate {
                what: format!("{label}, {scalar}, {source}: {what}"),
                rate: rate.clone(),
                command: row.command(),
            };
            counted.push(named("lost", &row.lost));
            counted.push(named("false hits", &row.false_hits));
            if let Some(rate) = &row.lost_in_both {
                counted.push(named("lost in both neighbours", rate));
            }
            let failed = Trials::independent(row.failed, self.count);
            counted.push(named("no verdict", &Rate::new(failed, 0 < row.failed)));
        }
        counted
    }
}

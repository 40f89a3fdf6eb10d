//! The findings of an audit of slab tests, and their page.

use crate::audit::Trials;
use crate::report::page::{Block, Cell, Command, Head, Page, Paged, Row as TableRow, Table, Tone};
use crate::report::{
    Comparable, NamedRate, Rate, Study, alike, group_digits, listed, number_of, percent,
};
use hairline_boxes::{Made, Row, Source, Wrong};
use hairline_core::kernel::Scalar;

/// How many sources of lost rays a line names.
const NAMED: usize = 3;

/// What slab tests did on boxes.
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
    /// The name of its epsilons.
    set: String,
    /// Its epsilons, by gate.
    epsilons: Vec<(String, String)>,
    /// `f32` or `f64`.
    scalar: String,
    /// The family, or the scene.
    source: String,
    /// Misses of boxes that it must hit.
    lost: Rate,
    /// Hits of boxes that it must miss.
    false_hits: Rate,
    /// Cases on which it gave no verdict.
    failed: u64,
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
    pub fn new<F: Made + Scalar>(row: &Row, source: &Source, seed: u64) -> BoxesRow {
        let Row { setup, tally, .. } = row;
        let name = |index: u64| super::case::name::<F>(source, seed, index);
        let gates = setup.gates().iter().map(|gate| gate.name.to_owned());
        let values = setup.values.iter().map(ToString::to_string);
        let rate = |wrong: &Wrong, of| Rate::new(Trials::independent(wrong.count, of), true);
        let worst = tally.false_hits.worst;
        BoxesRow {
            test: setup.entry.info.name.to_owned(),
            set: setup.set.to_owned(),
            epsilons: gates.zip(values).collect(),
            scalar: row.scalar.to_owned(),
            source: row.source.clone(),
            lost: rate(&tally.false_misses, tally.must_hit),
            false_hits: rate(&tally.false_hits, tally.must_miss),
            failed: tally.failed.count,
            first_lost: tally.false_misses.first.map(name),
            farthest: worst.map(|worst| Farthest {
                share: worst.severity,
                case: name(worst.index),
            }),
        }
    }

    fn label(&self) -> String {
        if self.set == "source" {
            return self.test.clone();
        }
        format!("{} ({})", self.test, self.set)
    }

    fn is_wrong(&self) -> bool {
        0 < self.lost.count + self.false_hits.count + self.failed
    }

    /// Shows the first lost case, or else the farthest false hit.
    fn command(&self) -> Option<String> {
        let farthest = self.farthest.as_ref().map(|farthest| &farthest.case);
        let case = self.first_lost.as_ref().or(farthest)?;
        Some(format!("hairline boxes explain '{case}' --kernel {}", self.test))
    }
}

/// A slab test in one scalar on all sources.
struct Sum<'a> {
    lost: Rate,
    false_hits: Rate,
    failed: u64,
    /// The rows with lost rays, those with the largest share first.
    losing: Vec<&'a BoxesRow>,
    farthest: Option<f64>,
}

impl<'a> Sum<'a> {
    fn of(rows: &[&'a BoxesRow]) -> Sum<'a> {
        let mut losing: Vec<&BoxesRow> = Vec::new();
        losing.extend(rows.iter().filter(|row| 0 < row.lost.count));
        let share = |row: &BoxesRow| row.lost.rate.unwrap_or(0.0);
        losing.sort_by(|a, b| share(b).total_cmp(&share(a)));
        let farthest = rows.iter().filter_map(|row| Some(row.farthest.as_ref()?.share));
        Sum {
            lost: Rate::sum(rows.iter().map(|row| &row.lost)),
            false_hits: Rate::sum(rows.iter().map(|row| &row.false_hits)),
            failed: rows.iter().map(|row| row.failed).sum(),
            losing,
            farthest: farthest.reduce(f64::max),
        }
    }

    fn cells(&self) -> [Cell; 3] {
        let lost = Cell {
            text: counted(&self.lost),
            is_broken: 0 < self.lost.count + self.failed,
            share: self.lost.rate,
        };
        let farthest = self.farthest.map_or(String::new(), |share| format!("{share:.0e}"));
        let where_lost = self.losing.iter().map(|row| {
            let share = row.lost.rate.unwrap_or(0.0);
            format!("{} {}", row.source, percent(share))
        });
        let where_lost: Vec<String> = where_lost.collect();
        let named = listed(&where_lost, NAMED);
        [lost, farthest.into(), named.into()]
    }
}

/// `0`, or a count with its share.
fn counted(rate: &Rate) -> String {
    match (rate.count, rate.rate) {
        (0, _) | (_, None) => "0".to_owned(),
        (count, Some(share)) => format!("{} ({})", group_digits(count), percent(share)),
    }
}

impl BoxesResult {
    /// True if any slab test broke its promise.
    pub fn is_wrong(&self) -> bool {
        self.rows.iter().any(BoxesRow::is_wrong)
    }

    /// The rows of each slab test in a scalar, those that lose least first.
    fn sums(&self, scalar: &str) -> Vec<(String, Sum<'_>)> {
        let rows = self.rows.iter().filter(|row| row.scalar == scalar);
        let mut sums = Vec::new();
        for (first, others) in alike(rows, |one, other| one.label() == other.label()) {
            let mut all = vec![first];
            all.extend(others);
            sums.push((first.label(), Sum::of(&all)));
        }
        sums.sort_by_key(|(_, sum)| (sum.lost.count + sum.failed, sum.false_hits.count));
        sums
    }

    fn table(&self, scalar: &str) -> Vec<Block> {
        let sums = self.sums(scalar);
        if sums.is_empty() {
            return Vec::new();
        }
        let heads = vec![
            Head::of(scalar),
            Head::of("lost").about("rays that meet the box and are not reported"),
            Head::of("passes by").about(
                "the farthest false hit: how far the ray passes outside, by the largest coordinate",
            ),
            Head::text("of these families").optional(),
        ];
        let rows = sums
            .iter()
            .map(|(label, sum)| TableRow::new(label.clone(), sum.cells()))
            .collect();
        vec![Block::Table(Table::new(heads, rows))]
    }

    /// The row with the largest share of lost rays on a source.
    fn worst(&self) -> Option<&BoxesRow> {
        let losing = self.rows.iter().filter(|row| row.is_wrong());
        let share = |row: &BoxesRow| row.lost.rate.unwrap_or(0.0);
        losing.max_by(|a, b| share(a).total_cmp(&share(b)))
    }

    fn title(&self) -> String {
        let mut tests: Vec<String> = Vec::new();
        let mut losing: Vec<String> = Vec::new();
        for row in &self.rows {
            let label = row.label();
            if !tests.contains(&label) {
                tests.push(label.clone());
            }
            if 0 < row.lost.count + row.failed && !losing.contains(&label) {
                losing.push(label);
            }
        }
        let all = number_of(tests.len() as u64, "slab test", "slab tests");
        let rays = number_of(self.count, "ray", "rays");
        match losing.len() {
            0 => format!("No ray is lost by {all}, of {rays} a family and scalar"),
            some => format!("{some} of {all} lose rays that meet the box, of {rays} a family and scalar"),
        }
    }
}

impl Paged for BoxesResult {
    fn page(&self) -> Page {
        let mut blocks = Vec::new();
        for scalar in ["f32", "f64"] {
            blocks.extend(self.table(scalar));
        }
        let text = "A lost box loses everything in it; a box that is hit too often only costs time. The default families \
                    are rays at corners, edges and faces: their shares are not those of a program (--extent and --size \
                    draw rays of a program's sizes).";
        blocks.push(Block::text(text));
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
        let details = self.rows.iter().filter(|row| row.is_wrong());
        let details: Vec<Block> = details.map(detail).collect();
        if !details.is_empty() {
            blocks.push(Block::Details("Every family".to_owned(), details));
        }
        Page {
            command: "boxes audit",
            title: self.title(),
            tone: if self.is_wrong() { Tone::Bad } else { Tone::Good },
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
    let (label, scalar, source) = (row.label(), &row.scalar, &row.source);
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
            let (label, scalar, source) = (row.label(), &row.scalar, &row.source);
            let named = |what: &str, rate: &Rate| NamedRate {
                what: format!("{label}, {scalar}, {source}: {what}"),
                rate: rate.clone(),
                command: row.command(),
            };
            counted.push(named("lost", &row.lost));
            counted.push(named("false hits", &row.false_hits));
        }
        counted
    }
}

//! Orientation predicates as a page: which are right, one table a dimension and scalar, the first findings; and single cases.

use crate::orientation::{AnswerPart, CasePart, Rate, Record, RowResult};
use crate::report::page::{Block, Cell, Head, Item, Page, Paged, Row, Table, Tone};
use crate::report::{group_digits, percent};
use serde::Serialize;
use std::collections::BTreeSet;

/// Single cases.
#[derive(Serialize)]
pub(super) struct Cases {
    /// As of a record.
    pub schema: &'static str,
    /// The cases.
    pub cases: Vec<CasePart>,
    /// A sentence before each; may be empty.
    #[serde(skip)]
    pub notes: Vec<&'static str>,
}

/// So many first findings stand on the screen.
const MOST: usize = 2;

impl Paged for Record {
    fn page(&self) -> Page {
        let (result, provenance) = (&self.result, &self.provenance);
        let mut blocks = vec![Block::Text(format!(
            "{}, {} cases of each family, seed {}, {} threads, {:.1} s",
            provenance.tool,
            group_digits(result.count),
            result.seed,
            provenance.threads,
            provenance.seconds
        ))];
        let heads: BTreeSet<(usize, &str)> =
            result.results.iter().map(|row| (row.dimension, row.scalar)).collect();
        for head in &heads {
            blocks.push(Block::Table(table(self, *head)));
        }
        blocks.push(Block::text(
            "% of cases with a wrong answer; in brackets of these the opposite sign: the others are 0 where it is not, or \
             not 0 where it is. near: a point about 1 ulp off; range-low and range-high: products that underflow and \
             overflow",
        ));
        // Of the adaptive predicates first: these are thought to be right.
        let mut examples: Vec<_> = result.examples.iter().collect();
        examples.sort_by_key(|example| example.epsilon.is_some());
        let item = |example: &crate::orientation::ExamplePart| Item {
            text: format!(
                "{}, {}: {} ({})",
                label(example.predicate, example.epsilon.as_deref()),
                example.case.scalar,
                example.finding,
                example.case.id
            ),
            lines: vec![command(&example.case.id, example.epsilon.as_deref())],
            ..Item::default()
        };
        let items = examples.into_iter().map(item).collect();
        blocks.extend(Block::items("First findings", MOST, items));
        for head in &heads {
            let title = format!("orient{}d, {}: each finding", head.0, head.1);
            blocks.push(Block::Details(title, vec![Block::Table(everything(self, *head))]));
        }
        let (title, is_right) = answer(self);
        let tone = if is_right { Tone::Good } else { Tone::Plain };
        Page { command: "orient", title, tone, blocks }
    }
}

/// The predicates that are never wrong, and where.
fn answer(record: &Record) -> (String, bool) {
    let is_wrong = |row: &&RowResult| 0 < wrong(row)[0];
    let is_of_range = |row: &&RowResult| row.family.starts_with("range-");
    let name = |row: &RowResult| label(row.predicate, row.epsilon.as_deref());
    let all: BTreeSet<String> = record.result.results.iter().map(name).collect();
    let faulty: BTreeSet<String> =
        record.result.results.iter().filter(is_wrong).map(name).collect();
    let faulty_in_range: BTreeSet<String> = record
        .result
        .results
        .iter()
        .filter(|row| !is_of_range(row))
        .filter(is_wrong)
        .map(name)
        .collect();
    let listed = |names: Vec<&String>| -> String {
        names.into_iter().map(String::as_str).collect::<Vec<_>>().join(", ")
    };
    let right = listed(all.difference(&faulty).collect());
    let in_range = listed(faulty.difference(&faulty_in_range).collect());
    let text = match (right.as_str(), in_range.as_str()) {
        (right, _) if faulty.is_empty() => format!("Right on every case: {right}."),
        ("", "") => "Every predicate is wrong on some ordinary cases.".to_owned(),
        ("", names) => {
            format!(
                "Right wherever products neither overflow nor underflow: {names}; the others are not."
            )
        }
        (right, "") => format!("Right on every case: {right}; the others are not."),
        (right, names) => format!(
            "Right on every case: {right}; wherever products neither overflow nor underflow: {names}."
        ),
    };
    (text, faulty.is_empty())
}

/// Wrong answers of any kind, and cases.
fn wrong(row: &RowResult) -> [u64; 2] {
    let RowResult { wrong_sign, false_zero, missed_zero, .. } = row;
    [wrong_sign.count + false_zero.count + missed_zero.count, wrong_sign.of]
}

/// The rows and nanoseconds of a dimension in a scalar.
fn rows_of<'a>(
    record: &'a Record,
    (dimension, scalar): (usize, &'a str),
) -> impl Iterator<Item = (&'a RowResult, f64)> {
    let times = record.provenance.timings.iter().map(|timing| timing.nanoseconds_per_call);
    let rows = record.result.results.iter().zip(times);
    rows.filter(move |(row, _)| (row.dimension, row.scalar) == (dimension, scalar))
}

/// Predicates in rows, families in columns.
fn table(record: &Record, head: (usize, &str)) -> Table {
    let mut heads = vec![Head::of(format!("orient{}d, {}", head.0, head.1))];
    let mut rows: Vec<Row> = Vec::new();
    for (result, _) in rows_of(record, head) {
        if heads.iter().all(|head| head.head != result.family) {
            let head = Head::of(result.family);
            // Seldom met.
            let is_of_range = result.family.starts_with("range-");
            heads.push(if is_of_range { head.optional() } else { head });
        }
        let label = label(result.predicate, result.epsilon.as_deref());
        let place = rows.iter().position(|row| row.label == label).unwrap_or(rows.len());
        if place == rows.len() {
            rows.push(Row::new::<Cell>(label, []));
        }
        let [count, of] = wrong(result);
        let share = |count: u64| count as f64 / of.max(1) as f64;
        let number = |count: u64| percent(share(count)).trim_end_matches('%').to_owned();
        let opposite = result.wrong_sign.count;
        let bracket =
            if opposite == 0 { String::new() } else { format!(" ({})", number(opposite)) };
        let (text, share) = (number(count) + &bracket, share(count));
        rows[place].cells.push(Cell { text, share: Some(share), ..Cell::default() });
    }
    Table::new(heads, rows)
}

/// Each kind of finding with its interval.
fn everything(record: &Record, head: (usize, &str)) -> Table {
    let heads = [
        "predicate, family",
        "wrong-sign, of all",
        "false-zero, of nonzero",
        "missed-zero, of zeros",
        "ns a call",
    ];
    let row = |(result, time): (&RowResult, f64)| {
        let label = label(result.predicate, result.epsilon.as_deref());
        let rates = [&result.wrong_sign, &result.false_zero, &result.missed_zero].map(rate);
        let cells = rates.into_iter().chain([format!("{time:.1}")]);
        Row::new(format!("{label}, {}", result.family), cells)
    };
    Table::new(heads.map(Head::of).into(), rows_of(record, head).map(row).collect())
}

fn label(predicate: &str, epsilon: Option<&str>) -> String {
    epsilon.map_or_else(|| predicate.to_owned(), |epsilon| format!("{predicate} ({epsilon})"))
}

/// `1,234 of 20,000: 6.2 [5.8, 6.5]`, `-` without a trial.
fn rate(rate: &Rate) -> String {
    let (Some(share), Some([low, high])) = (rate.rate, rate.interval) else {
        return "-".to_owned();
    };
    let (count, of) = (group_digits(rate.count), group_digits(rate.of));
    let [share, low, high] = [share, low, high].map(|x| 100.0 * x);
    format!("{count} of {of}: {share:.2} [{low:.2}, {high:.2}]")
}

/// The command that shows a case again with the epsilon of its row.
fn command(id: &str, epsilon: Option<&str>) -> String {
    let epsilon = epsilon.map_or_else(String::new, |epsilon| format!(" --epsilon {epsilon}"));
    format!("hairline orient --case '{id}'{epsilon}")
}

impl Paged for Cases {
    fn page(&self) -> Page {
        let mut blocks = Vec::new();
        for (case, note) in self.cases.iter().zip(&self.notes) {
            if 1 < self.cases.len() {
                blocks.push(Block::Heading(case.id.clone()));
            }
            if !note.is_empty() {
                blocks.push(Block::text(*note));
            }
            blocks.extend(of_case(case));
        }
        let title = match &self.cases[..] {
            [case] => {
                let wrong = case.answers.iter().filter(|answer| answer.finding.is_some()).count();
                let count = case.answers.len();
                format!("{}: {wrong} of {count} predicates are wrong", case.id)
            }
            all => format!("{} known cases on which predicates are wrong", all.len()),
        };
        Page { command: "orient", title, blocks, ..Page::default() }
    }
}

/// Its points with their bits, the truth, and every answer that it has.
fn of_case(case: &CasePart) -> Vec<Block> {
    let point = |((name, point), bits): ((&&str, &Vec<f64>), &Vec<String>)| {
        let numbers: Vec<String> = point.iter().map(|&x| number(x, case.scalar)).collect();
        format!("{name} = ({})  {}", numbers.join(", "), bits.join(","))
    };
    let points = ["a", "b", "c", "d"].iter().zip(&case.points).zip(&case.bits).map(point);
    let answer = |answer: &AnswerPart| {
        let verdict = answer.finding.unwrap_or("right").to_owned();
        let cells: [Cell; 3] = [
            format!("says {}", answer.answer).into(),
            Cell { text: verdict, is_broken: answer.finding.is_some(), share: None },
            answer.determinant.clone().into(),
        ];
        Row::new(label(answer.predicate, answer.epsilon.as_deref()), cells)
    };
    let heads =
        vec![Head::of("predicate"), Head::text("sign"), Head::text("is"), Head::text("det")];
    vec![
        Block::Listing(points.collect::<Vec<_>>().join("\n")),
        Block::Text(format!("exact: {}  det = {}", case.sign, case.determinant)),
        Block::Table(Table::new(heads, case.answers.iter().map(answer).collect())),
    ]
}

/// The shortest text that reads back as the number in its scalar.
fn number(value: f64, scalar: &str) -> String {
    if scalar == "f32" { format!("{:?}", value as f32) } else { format!("{value:?}") }
}

//! Every row on one line, the one that is visibly wrong least often first: the table of the screen, and its answer.

use super::columns::{Column, short_percent};
use super::lines::RowLine;
use super::standing::{Standing, share, standings};
use crate::arith::ScalarName;
use crate::audit::Trials;
use crate::lists::{alike, listed};
use crate::page::{Block, Cell, Head, Row, Table};
use hairline_record::group_digits;
use hairline_record::*;
use std::collections::BTreeSet;

/// The most rows; more do not fit on a screen.
const MOST: usize = 13;

/// The most names in a sentence.
const MOST_NAMES: usize = 4;

/// The questions in the order in which they have room.
const ORDER: [&str; 10] = [
    "mesh", "stored", "sizes", "flat", "ends", "edges", "vertex", "inside", "grid", "lattice",
];

/// A row's name: its author's epsilons have none.
fn label(part: &RowPart) -> String {
    let RowPart { kernel, set, .. } = part;
    match set.as_str() {
        "source" | "own" => kernel.clone(),
        "zero" => format!("{kernel} e=0"),
        set if set.parse::<f64>().is_ok() => format!("{kernel} e={set}"),
        set => format!("{kernel} ({set})"),
    }
}

/// The rows, each with those that answer alike; the best first: without leaks, seldom visibly wrong, few leaks, few wrong
/// answers.
fn ranked<'a>(standings: &'a [Standing<'a>]) -> Vec<(&'a Standing<'a>, Vec<&'a Standing<'a>>)> {
    let mut sorted: Vec<&Standing> = standings.iter().collect();
    let leaks = |standing: &Standing| standing.leaks().map_or(0.0, share);
    let mean = |standing: &Standing| standing.share.unwrap_or(0.0);
    sorted.sort_by(|a, b| {
        let by_leak = (0.0 < leaks(a)).cmp(&(0.0 < leaks(b)));
        let by_far = by_leak.then(a.all_far().cmp(&b.all_far()));
        by_far
            .then(leaks(a).total_cmp(&leaks(b)))
            .then(mean(a).total_cmp(&mean(b)))
    });
    alike(sorted, |one, other| one.is_like(other))
}

/// The row to look at first.
pub(super) fn best<'a>(standings: &'a [Standing<'a>]) -> Option<&'a RowPart> {
    ranked(standings).first().map(|(standing, _)| standing.part)
}

/// The names of some rows in a sentence; none without a row.
fn names<'a>(all: impl Iterator<Item = &'a Standing<'a>>) -> Option<String> {
    let names: Vec<String> = all.map(|standing| label(standing.part)).collect();
    (!names.is_empty()).then(|| listed(&names, MOST_NAMES))
}

/// The names of some rows with the rays that leak, and of how many; none without a row.
fn counted<'a>(
    all: impl Iterator<Item = &'a Standing<'a>>,
    count: impl Fn(&Standing<'a>) -> [u64; 2],
) -> Option<String> {
    let counted = |standing: &'a Standing| {
        let [count, of] = count(standing).map(group_digits);
        format!("{} ({count} of {of} rays)", label(standing.part))
    };
    let counts: Vec<String> = all.map(counted).collect();
    (!counts.is_empty()).then(|| listed(&counts, MOST_NAMES))
}

/// The answer, a sentence each.
pub(super) fn answer(standings: &[Standing], cases: u64, place: &str) -> Vec<String> {
    let rows = ranked(standings);
    let sorted = || rows.iter().map(|(standing, _)| *standing);
    let mut text = Vec::new();
    let is_right = |it: &&Standing| it.wrong == 0 && it.others.is_empty() && it.share.is_some();
    if let Some(names) = names(sorted().filter(is_right)) {
        text.push(format!("Right on every case{place}: {names}."));
    }
    if standings.iter().any(|it| it.leaks().is_some()) {
        let is_tight = |it: &&Standing| it.leaks().is_some_and(|[count, _]| count == 0);
        text.push(
            match counted(sorted().filter(is_tight), |it| [0, it.crossings()]) {
                Some(counts) => {
                    format!("No leak seen at shared edges and vertices{place}: {counts}.")
                }
                None => format!("Every kernel leaks at shared edges or vertices{place}."),
            },
        );
        let is_extreme = |it: &&Standing| is_tight(it) && 0 < it.extreme_leaks()[0];
        let extreme = counted(sorted().filter(is_extreme), Standing::extreme_leaks);
        text.extend(
            extreme.map(|counts| format!("Next to noise or at extreme exponents: {counts}.")),
        );
    }
    if let Some(names) = names(sorted().filter(|it| it.breaks_promise())) {
        text.push(format!(
            "Breaks what its documentation promises there: {names}."
        ));
    }
    let counts = |it: &Standing| (label(it.part), group_digits(it.all_far()));
    let best = sorted().min_by_key(|it| it.all_far());
    match (best, sorted().max_by_key(|it| it.all_far())) {
        (Some(_), Some(worst)) if worst.all_far() == 0 => {
            text.push(format!(
                "None is visibly wrong (by over 1/1000 of an edge){place}."
            ));
        }
        (Some(best), Some(worst)) => {
            let ((best, least), (worst, most)) = (counts(best), counts(worst));
            let cases = group_digits(cases);
            text.push(format!(
                "Visibly wrong (by over 1/1000 of an edge){place} least often: {best}, {least} of {cases} answers; \
                 most often: {worst}, {most}."
            ));
        }
        _ => {}
    }
    let failing = standings.iter().filter_map(|it| {
        let (kind, count) = it.others.iter().find(|(kind, _)| kind.is_failure())?;
        Some(format!(
            "{}: {kind} {}",
            label(it.part),
            group_digits(*count)
        ))
    });
    let failing: Vec<String> = failing.take(MOST_NAMES).collect();
    if !failing.is_empty() {
        text.push(format!("{}.", failing.join(", ")));
    }
    let contracts: BTreeSet<&str> = standings.iter().map(|it| &*it.part.contract).collect();
    if 1 < contracts.len() {
        text.push(
            "Each is judged by its own promises (all by one: --contract closed-ray).".to_owned(),
        );
    }
    text
}

/// The table, and what its columns hold.
pub(super) fn blocks(record: &Record, columns: &[Column], standings: &[Standing]) -> Vec<Block> {
    let scalars = &record.result.plan.scalars;
    let worse = match scalars.len() {
        1 => "",
        _ => " in the worse of the scalars",
    };
    let others =
        format!("Other cells: % wrong{worse} on rays aimed at hard places, not of your pixels.");
    let table = table(record, "kernel", columns, standings, scalars);
    vec![Block::Table(table.at_most(MOST)), Block::Text(others)]
}

/// The same of one scalar alone.
pub(super) fn of_scalar(record: &Record, columns: &[Column], lines: &[RowLine]) -> Block {
    let scalar = lines[0].row.scalar;
    let standings = standings(record, columns, lines);
    let head = format!("{scalar} kernel");
    let mut table = table(record, &head, columns, &standings, &[scalar]);
    table
        .heads
        .iter_mut()
        .for_each(|head| head.is_optional = false);
    Block::Table(table)
}

/// The wrong answers of a sample, in percent.
fn percent_of(wrong: Trials) -> Cell {
    let text = short_percent([wrong.count, wrong.of]);
    wrong
        .share()
        .map_or(Cell::none(), |share| Cell::share(share, text))
}

/// The wrong answers of a whole set: `3/57`.
fn counts_of(wrong: Trials) -> Cell {
    let [count, of] = [wrong.count, wrong.of].map(group_digits);
    wrong.share().map_or(Cell::none(), |share| {
        Cell::share(share, format!("{count}/{of}"))
    })
}

fn table(
    record: &Record,
    head: &str,
    columns: &[Column],
    standings: &[Standing],
    scalars: &[ScalarName],
) -> Table {
    let place = |column: &Column| ORDER.iter().position(|name| *name == column.label());
    let mut order: Vec<usize> = (0..columns.len()).collect();
    order.sort_by_key(|i| {
        (
            !columns[*i].is_ordinary(),
            place(&columns[*i]).unwrap_or(ORDER.len()),
        )
    });
    let has_leaks = standings.iter().any(|it| it.leaks().is_some());
    let mut table = Table::default();
    table.heads.push(Head::of(head));
    let mut about = "% of rays at shared edges and vertices that hit nothing".to_owned();
    if standings.iter().any(Standing::breaks_promise) {
        about += " (!: its documentation rules that out)";
    }
    let leaks = Head::of("leaks").about(about);
    table.heads.extend(has_leaks.then_some(leaks));
    table
        .heads
        .push(Head::of("visible").about("answers off by over 1/1000 of an edge"));
    table
        .heads
        .push(Head::of("values").about("% of right hits with a wrong t, u or v"));
    let question = |i: &usize| {
        Head::of(columns[*i].label())
            .about(columns[*i].about())
            .optional()
    };
    table.heads.extend(order.iter().map(question));
    table.heads.extend(
        scalars
            .iter()
            .map(|scalar| Head::of(format!("ns {scalar}"))),
    );
    let rows = ranked(standings);
    for (standing, alike) in rows {
        let mut cells: Vec<Cell> = Vec::new();
        if has_leaks {
            let is_broken = standing.breaks_promise();
            let mark = if is_broken { "!" } else { "" };
            let leaks = standing.leaks().map_or(Cell::none(), |[count, of]| {
                let text = format!("{}{mark}", short_percent([count, of]));
                Cell::share(share([count, of]), text)
            });
            cells.push(leaks.broken_if(is_broken));
        }
        cells.push(Cell::count(standing.all_far()));
        cells.push(percent_of(standing.worse(|line| line.values).wrong));
        for &i in &order {
            let wrong = standing.worse(|line| line.cells[i]).wrong;
            cells.push(if columns[i].complete {
                counts_of(wrong)
            } else {
                percent_of(wrong)
            });
        }
        for scalar in scalars {
            let time = record
                .provenance
                .nanoseconds(*scalar, &standing.part.label());
            cells.push(Cell::optional(time, |time| format!("{time:.0}")));
        }
        let alike: Vec<String> = alike.iter().map(|other| label(other.part)).collect();
        let alike = (!alike.is_empty()).then(|| format!("same answers: {}", alike.join(", ")));
        table.rows.push(Row {
            label: label(standing.part),
            cells,
            below: alike.into_iter().collect(),
            about: Some(standing.part.label()),
        });
    }
    table
}

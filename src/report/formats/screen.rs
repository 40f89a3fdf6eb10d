//! The screen of `hairline audit`: the answer, one table with the best row first, the worst finding, and what to do next.
//! Everything else is behind `--details`.

use super::columns::{Column, ColumnCell, kinds, shared_in_scenes, short_percent};
use super::disagreement::family_of;
use super::lines::{RowLine, notes};
use super::record::*;
use super::row_view::{ALL_INVALID, RowView, cases_in, failures, is_all_invalid};
use super::standing::{Standing, standings};
use super::{close_up, extremes, next, number_of, ranking};
use crate::case::SceneKind;
use crate::report::elsewhere::{self, ComparedRates};
use crate::report::page::Block;
use crate::report::percent;

use std::collections::{BTreeMap, BTreeSet};

/// The most rows that the screen shows each by itself.
const MOST_CLOSE_UPS: usize = 2;

/// The answer, and everything below it on the screen.
pub(super) fn blocks(
    record: &Record,
    columns: &[Column],
    lines: &[RowLine],
) -> (String, Vec<Block>) {
    let standings = standings(record, columns, lines);
    let (title, rest) = answer(record, columns, &standings);
    let mut blocks = vec![Block::Text(rest), Block::Text(head(record))];
    blocks.extend(notes(record));
    blocks.extend(shared_in_scenes(record).map(Block::text));
    for scalar in &record.result.plan.scalars {
        let cases = cases_in(record, scalar);
        if 0 < cases && is_all_invalid(&RowView::all(record, scalar), cases) {
            blocks.push(Block::Text(format!("{scalar}: {ALL_INVALID}")));
        }
    }
    blocks.extend(match is_close_up(record) {
        true => close_up::blocks(record, columns, lines),
        false => ranking::blocks(record, columns, &standings),
    });
    blocks.extend(of_elsewhere(record, columns, lines));
    let rows: Vec<&RowView> = lines.iter().map(|line| &line.row).collect();
    blocks.extend(failures(&rows).into_iter().map(Block::Text));
    let worst = if is_close_up(record) { 2 } else { 1 };
    blocks.extend(extremes::blocks(columns, lines, worst));
    let next = next::commands(record, ranking::best(&standings), lines);
    if !next.is_empty() {
        blocks.push(Block::Commands("next", next));
    }
    (title, blocks)
}

/// Which kernels ran, and on how many cases.
fn head(record: &Record) -> String {
    let (result, provenance) = (&record.result, &record.provenance);
    let cases = |scalar: &String| cases_in(record, scalar);
    // Usually as many in each scalar.
    let mut counts: Vec<(u64, Vec<&str>)> = Vec::new();
    for scalar in &result.plan.scalars {
        match counts.last_mut() {
            Some((count, names)) if *count == cases(scalar) => names.push(scalar),
            _ => counts.push((cases(scalar), vec![scalar])),
        }
    }
    let counts = counts.iter().map(|(count, names)| {
        format!("{} in {}", number_of(*count, "case", "cases"), names.join(" and in "))
    });
    let sources = &result.plan.sources;
    let families: BTreeSet<Option<&str>> =
        sources.iter().map(|source| Some(family_of(&source.family)?.name)).collect();
    let sources = match families.contains(&None) {
        false => number_of(families.len() as u64, "family", "families"),
        true => number_of(sources.len() as u64, "source of cases", "sources of cases"),
    };
    let kinds = match kinds(record).len() {
        1 => String::new(),
        several => format!(" in {several} kinds of planes and rays"),
    };
    let placed = if result.is_placed() { " in an instance" } else { "" };
    let kernels: BTreeSet<&str> = result.plan.rows.iter().map(|row| &*row.kernel).collect();
    format!(
        "{}: {} ({}) on {sources}{kinds}{placed}, {}, {:.1} s, plan {}",
        provenance.tool,
        number_of(result.plan.rows.len() as u64, "row", "rows"),
        number_of(kernels.len() as u64, "kernel", "kernels"),
        counts.collect::<Vec<_>>().join(", "),
        provenance.seconds,
        result.plan.hash,
    )
}

/// True if there are so few kernels that each has a table of its own.
fn is_close_up(record: &Record) -> bool {
    record.result.plan.rows.len() <= MOST_CLOSE_UPS
}

/// The answer in words: its first sentence, and the others.
fn answer(record: &Record, columns: &[Column], standings: &[Standing]) -> (String, String) {
    let special: Vec<&str> = columns
        .iter()
        .filter(|column| !column.is_ordinary())
        .map(|column| column.label())
        .collect();
    let place = match &special[..] {
        [] => String::new(),
        // Each is a row of a close-up.
        special if is_close_up(record) => {
            format!(" in ordinary sizes (all rows but {})", special.join(" and "))
        }
        _ => " in ordinary sizes".to_owned(),
    };
    let meant = columns.iter().filter(|column| column.is_ordinary() && !column.complete).count();
    let mean = if 1 < meant { ", the mean of the rows" } else { "" };
    let percent = |share: f64| short_percent([(share * 1e9) as u64, 1_000_000_000]);
    let label = |standing: &Standing| format!("{} ({})", standing.part.kernel, standing.part.set);
    let text = match standings {
        _ if columns.is_empty() => {
            "No case has both a verdict and a contract that demands one.".to_owned()
        }
        all if all.iter().all(|row| row.share.is_none()) => {
            "No case is of ordinary size.".to_owned()
        }
        [only] if only.wrong == 0 && only.others.is_empty() => {
            format!("{}: every verdict is right{place}.", label(only))
        }
        [only] if only.wrong == 0 => {
            format!("{}: no false miss and no false hit{place}.", label(only))
        }
        [only] => format!(
            "{} is wrong on {} % of the cases{place}{mean}, {} by over 1/1000 of an edge.",
            label(only),
            percent(only.share.unwrap_or_default()),
            number_of(only.far, "time", "times"),
        ),
        all => ranking::answer(all, judged(record), &place),
    };
    // Of several the table tells.
    let broken = match standings {
        [only] => only.others.clone(),
        _ => BTreeMap::new(),
    };
    let is_across = |kind: &FindingKind| {
        matches!(kind, FindingKind::Crack | FindingKind::Double | FindingKind::OddFold)
    };
    let told = |lead: &str, of_across: bool| {
        let chosen = broken.iter().filter(|(kind, _)| is_across(kind) == of_across);
        let counts = chosen.map(|(finding, count)| {
            let ending = if finding.name().ends_with(['s', 'h']) { "es" } else { "s" };
            number_of(*count, finding.name(), &format!("{finding}{ending}"))
        });
        let counts: Vec<String> = counts.collect();
        match counts.is_empty() {
            true => String::new(),
            false => format!(" {lead}: {}.", counts.join(", ")),
        }
    };
    let others = told("Breaks its promise across triangles", true) + &told("Besides", false);
    let mut text = text + &others;
    if let Some(partial) = &record.result.partial {
        text += &format!(" A part of a run: {}; all numbers are of this part.", partial.in_words());
    }
    match text.split_once(". ") {
        Some((first, rest)) => (format!("{first}."), rest.to_owned()),
        None => (text, String::new()),
    }
}

/// The cases of a record, in all scalars.
fn judged(record: &Record) -> u64 {
    record.result.sources.iter().map(|source| source.cases).sum()
}

/// Which rows are more often wrong on planes, or with rays, of other kinds than the table's, and where most.
fn of_elsewhere(record: &Record, columns: &[Column], lines: &[RowLine]) -> Vec<Block> {
    let kinds = kinds(record);
    let compared = |line: &RowLine, column: &Column| ComparedRates {
        label: format!("{}, {}: {}", line.label(), line.row.scalar, column.label()),
        rates: (kinds.iter())
            .map(|kind| ColumnCell::sum(&column.of_kind(*kind).results(&line.row)))
            .map(|cell| Rate::new(cell.wrong, true))
            .collect(),
    };
    let rows = lines.iter().flat_map(|line| columns.iter().map(|column| compared(line, column)));
    let names: Vec<String> = kinds.iter().map(SceneKind::to_string).collect();
    let share = |rate: &Rate| rate.rate.map_or("-".to_owned(), percent);
    let mut blocks =
        elsewhere::blocks("Clearly more often wrong", &names, &rows.collect::<Vec<_>>(), share);
    if !blocks.is_empty() {
        let words = kinds[1..].iter().map(|kind| format!("{kind}: {}", kind.in_words()));
        let of = "Shares are of all verdicts that are demanded, misses and hits together.";
        blocks.push(Block::Text(format!("{}. {of}", words.collect::<Vec<_>>().join("; "))));
    }
    blocks
}

//! The screen of `hairline audit`: the answer, one table with the best row first, the worst finding, and what to do next.
//! Everything else is behind `--details`.

use super::columns::{Cell, Column, kinds, shared_in_scenes, short_percent};
use super::disagreement::family_of;
use super::lines::{Line, lines, write_notes};
use super::record::*;
use super::row_view::{ALL_INVALID, RowView, is_all_invalid, write_failures};
use super::standing::{Standing, other_findings, standings};
use super::{Style, close_up, extremes, group_digits, next, number_of, ranking};
use crate::case::SceneKind;
use crate::report::elsewhere::is_worse;
use crate::report::page::write_wrapped;
use crate::report::percent;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};

/// The most rows that the screen shows each by itself.
const MOST_CLOSE_UPS: usize = 2;

/// Writes the screen.
pub(super) fn write(record: &Record, style: Style, out: &mut dyn Write) -> io::Result<()> {
    let columns = Column::all(record);
    let lines = lines(record, &columns);
    let standings = standings(record, &columns, &lines);
    write_head(record, style, out)?;
    write_notes(record, style, out)?;
    write_answer(record, &columns, &standings, style, out)?;
    if let Some(note) = shared_in_scenes(record) {
        write_wrapped(note, style.width, out)?;
    }
    for scalar in &record.result.plan.scalars {
        let cases = record.result.sources.iter().filter(|source| source.scalar == *scalar);
        let cases = cases.map(|source| source.cases).sum();
        if 0 < cases && is_all_invalid(&RowView::all(record, scalar), cases) {
            writeln!(out, "{scalar}: {ALL_INVALID}")?;
        }
    }
    if is_close_up(record) {
        close_up::write(record, &columns, &lines, style, out)?;
    } else {
        writeln!(out)?;
        ranking::write(record, &columns, &standings, style, out)?;
    }
    write_elsewhere(record, &columns, &lines, style, out)?;
    for scalar in &record.result.plan.scalars {
        let rows = lines.iter().filter(|line| line.row.scalar == scalar).map(|line| &line.row);
        write_failures(&rows.collect::<Vec<_>>(), out)?;
    }
    writeln!(out)?;
    let worst = if is_close_up(record) { 3 } else { 1 };
    extremes::write(&columns, &lines, worst, style, out)?;
    next::write(record, ranking::best(&standings), &lines, style, out)
}

/// Writes which kernels ran, and on how many cases.
fn write_head(record: &Record, style: Style, out: &mut dyn Write) -> io::Result<()> {
    let (result, provenance) = (&record.result, &record.provenance);
    let cases = |scalar: &String| {
        let sources = result.sources.iter().filter(|source| source.scalar == *scalar);
        sources.map(|source| source.cases).sum::<u64>()
    };
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
    let kernels: BTreeSet<&str> = result.plan.rows.iter().map(|row| &*row.kernel).collect();
    let text = format!(
        "{}: {} ({}) on {sources}{kinds}, {}, {:.1} s, plan {}",
        provenance.tool,
        number_of(result.plan.rows.len() as u64, "row", "rows"),
        number_of(kernels.len() as u64, "kernel", "kernels"),
        counts.collect::<Vec<_>>().join(", "),
        provenance.seconds,
        result.plan.hash,
    );
    write_wrapped(&text, style.width, out)
}

/// True if there are so few kernels that each has a table of its own.
fn is_close_up(record: &Record) -> bool {
    record.result.plan.rows.len() <= MOST_CLOSE_UPS
}

/// The answer in words.
fn write_answer(
    record: &Record,
    columns: &[Column],
    standings: &[Standing],
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let special: Vec<&str> = columns
        .iter()
        .filter(|column| !column.is_ordinary())
        .map(|column| column.label())
        .collect();
    let place = match (&special[..], is_close_up(record)) {
        ([], _) => String::new(),
        // Each is a row of a close-up.
        (special, true) => {
            format!(" in ordinary sizes (all rows but {})", special.join(" and "))
        }
        (_, false) => " in ordinary sizes".to_owned(),
    };
    let meant = columns.iter().filter(|column| column.is_ordinary() && !column.complete).count();
    let mean = match &special[..] {
        _ if meant <= 1 => place.clone(),
        [] => " (the mean of the rows)".to_owned(),
        special => {
            format!(" in ordinary sizes (the mean of all rows but {})", special.join(" and "))
        }
    };
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
            "{} is wrong on {} % of the cases{mean}, {} times by over 1/1000 of the triangle's longest edge.",
            label(only),
            percent(only.share.unwrap_or_default()),
            group_digits(only.far),
        ),
        all => ranking::answer(all, judged(record), &place),
    };
    let broken: BTreeMap<FindingKind, u64> =
        record.result.plan.rows.iter().flat_map(|part| other_findings(record, part)).fold(
            BTreeMap::new(),
            |mut sums, (finding, count)| {
                *sums.entry(finding).or_default() += count;
                sums
            },
        );
    let others = match (standings.len(), broken.is_empty()) {
        (2.., _) | (_, true) => String::new(),
        _ => {
            let counts =
                broken.iter().map(|(finding, count)| format!("{finding} {}", group_digits(*count)));
            format!(" Other broken promises: {}.", counts.collect::<Vec<_>>().join(", "))
        }
    };
    write_wrapped(&(text + &others), style.width, out)?;
    if let Some(partial) = &record.result.partial {
        let text =
            format!("A part of a run: {}; all numbers are of this part.", partial.in_words());
        write_wrapped(&text, style.width, out)?;
    }
    Ok(())
}

/// The cases of a record, in all scalars.
fn judged(record: &Record) -> u64 {
    record.result.sources.iter().map(|source| source.cases).sum()
}

/// The most rows of what is more often wrong on planes, or with rays, of other kinds.
const MOST_ELSEWHERE: usize = 10;

/// Writes which rows are more often wrong on planes, or with rays, of other kinds than the table's, and where most.
fn write_elsewhere(
    record: &Record,
    columns: &[Column],
    lines: &[Line],
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let kinds = kinds(record);
    let [own_kind, others @ ..] = &kinds[..] else { return Ok(()) };
    if others.is_empty() {
        return Ok(());
    }
    let rate = |cell: &Cell| Rate::new(cell.wrong, true);
    let mut rows: Vec<(String, Rate, Rate, SceneKind)> = Vec::new();
    for line in lines {
        for (column, cell) in columns.iter().zip(&line.cells) {
            let own = rate(cell);
            let of = |kind: &SceneKind| {
                (rate(&Cell::sum(&column.of_kind(*kind).results(&line.row))), *kind)
            };
            let worse = others.iter().map(of).filter(|(other, _)| is_worse(&own, other));
            let most = worse
                .max_by(|(a, _), (b, _)| a.rate.unwrap_or(0.0).total_cmp(&b.rate.unwrap_or(0.0)));
            if let Some((other, kind)) = most {
                let label = format!("{}, {}: {}", line.label(), line.row.scalar, column.label());
                rows.push((label, own, other, kind));
            }
        }
    }
    let names: Vec<String> =
        others.iter().map(|kind| format!("{kind} ({})", kind.in_words())).collect();
    writeln!(out)?;
    if rows.is_empty() {
        let text = format!(
            "On no other planes or rays is a row clearly more often wrong: {}",
            names.join(", ")
        );
        return write_wrapped(&text, style.width, out);
    }
    let excess = |(_, own, other, _): &(String, Rate, Rate, SceneKind)| {
        other.rate.unwrap_or(0.0) - own.rate.unwrap_or(0.0)
    };
    rows.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    let more = rows.len().saturating_sub(MOST_ELSEWHERE);
    rows.truncate(MOST_ELSEWHERE);
    let first = rows.iter().map(|(label, ..)| label.chars().count()).max().unwrap_or(0);
    let title = "Clearly more often wrong on other planes or rays";
    let first = first.max(title.len());
    writeln!(out, "{title:<first$}{:>10}{:>10}", own_kind.to_string(), "most")?;
    for (label, own, other, kind) in &rows {
        let [own, other] = [own, other].map(|rate| rate.rate.map_or("-".to_owned(), percent));
        writeln!(out, "{label:<first$}{own:>10}{other:>10} on {kind}")?;
    }
    if 0 < more {
        writeln!(out, "and {more} more (--details)")?;
    }
    write_wrapped(&names.join(", "), style.width, out)
}

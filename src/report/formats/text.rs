//! The record as text for people: the screen, or with `--details` everything: one table a scalar, then
//! the worst findings with the commands that show them again.

use super::columns::Column;
use super::lines::{lines, write_notes};
use super::rate::{interval_of, percent};
use super::record::*;
use super::row_view::{ALL_INVALID, RowView, is_all_invalid, write_failures};
use super::why::{accuracy_text, causes_text};
use super::worst::write_worst;
use super::{Style, group_digits, number_of};
use crate::audit::Trials;
use std::io::{self, Write};

/// Writes the record. The layout is for people and not stable.
pub(super) fn write(record: &Record, style: Style, out: &mut dyn Write) -> io::Result<()> {
    if let Some(conformance) = &record.conformance {
        super::verdict::write(record, conformance, style, out)?;
        if !style.details {
            return Ok(());
        }
        writeln!(out)?;
    }
    if style.details {
        write_details(record, style, out)?;
    } else {
        super::screen::write(record, style, out)?;
    }
    let broken: Vec<&SourcePart> =
        record.result.sources.iter().filter(|source| source.promise_broken > 0).collect();
    if !broken.is_empty() {
        writeln!(out)?;
    }
    for source in broken {
        let (scalar, family) = (&source.scalar, &source.family);
        let (n, of) = (group_digits(source.promise_broken), group_digits(source.indices));
        let first = source.first_broken.as_deref().unwrap_or("-");
        writeln!(
            out,
            "{scalar} {family}: {n} of {of} indices are not what the family's promise says, first {first}"
        )?;
    }
    Ok(())
}

/// Everything, for `--details`.
fn write_details(record: &Record, style: Style, out: &mut dyn Write) -> io::Result<()> {
    let result = &record.result;
    writeln!(
        out,
        "{}, plan {}: {}, {}, {}, {:.1} s",
        record.provenance.tool,
        result.plan.hash,
        number_of(result.plan.rows.len() as u64, "kernel row", "kernel rows"),
        number_of(result.plan.sources.len() as u64, "family", "families"),
        number_of(record.provenance.threads as u64, "thread", "threads"),
        record.provenance.seconds
    )?;
    if let Some(partial) = &result.partial {
        writeln!(
            out,
            "a part of a run: {}; every count and share is of it alone",
            partial.in_words()
        )?;
    }
    write_notes(record, style, out)?;
    let columns = Column::all(record);
    let all = lines(record, &columns);
    super::questions::write(&result.plan.scalars, &columns, &all, style, out)?;
    for scalar in &result.plan.scalars {
        write_scalar(record, scalar, style, out)?;
    }
    Ok(())
}

fn write_scalar(
    record: &Record,
    scalar: &str,
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let rows = RowView::all(record, scalar);
    let cases: u64 =
        record.result.sources.iter().filter(|s| s.scalar == scalar).map(|s| s.cases).sum();
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    let of_cases = number_of(cases, "case", "cases");
    writeln!(out, "\n{bold}{scalar}{plain}, {of_cases} for each kernel")?;
    if cases == 0 {
        return Ok(());
    }
    if is_all_invalid(&rows, cases) {
        writeln!(out, "{ALL_INVALID}")?;
    }
    writeln!(
        out,
        "{bold}{:<37} {:>20} {:<16} {:>20} {:<16} {:>6} {:>6} {:>6} {:>6} {:>6}{plain}",
        "kernel (epsilons)",
        "false misses, %",
        "most in",
        "false hits, %",
        "most in",
        "bad",
        "values",
        "on NaN",
        "cracks",
        "ns/ray"
    )?;
    let times = record.provenance.kernel_nanoseconds.get(scalar);
    for row in &rows {
        let misses = row.total(|result| Some(&result.total.false_misses));
        let hits = row.total(|result| Some(&result.total.false_hits));
        let bad = row.total(|result| Some(&result.total.bad_values));
        let wrong = row.total(|result| Some(&result.total.wrong_values));
        let cracks = row.total(|result| result.across.as_ref().map(|across| &across.cracks));
        let label = format!("{} ({})", row.part.kernel, row.part.set);
        let time = times.and_then(|times| times.get(&label)).copied().unwrap_or(f64::NAN);
        writeln!(
            out,
            "{label:<37} {} {:<16} {} {:<16} {:>6} {:>6} {:>6} {:>6} {time:>6.1}",
            share_column(misses.rate(), style),
            fitted(row.worst_family(|result| &result.total.false_misses), 16),
            share_column(hits.rate(), style),
            fitted(row.worst_family(|result| &result.total.false_hits), 16),
            short_count(bad.counts()[0]),
            short_count(wrong.counts()[0]),
            short_count(row.hits_on_invalid()),
            match cracks.counts() {
                [_, 0] => "-".to_owned(),
                [count, _] => short_count(count),
            },
        )?;
        for (pool, what) in [(&misses, "misses"), (&hits, "hits")] {
            if let Some(apart) = pool.apart() {
                writeln!(out, "    stored or exhaustive cases, apart: false {what} {apart}")?;
            }
        }
        for (kind, what) in [(FindingKind::FalseMiss, "misses"), (FindingKind::FalseHit, "hits")] {
            if let Some(causes) = causes_text(&row.results, kind, "") {
                writeln!(out, "    false {what}: {causes}")?;
            }
        }
        if let Some(errors) = row.total.and_then(|total| accuracy_text(&total.accuracy)) {
            writeln!(out, "    values in ulps: {errors}")?;
        }
    }
    if rows.iter().any(|row| row.part.kernel.contains('+')) {
        writeln!(
            out,
            "ns/ray of a kernel in another arithmetic (NAME+fma) is the time of its emulation"
        )?;
    }
    write_failures(&rows.iter().collect::<Vec<_>>(), out)?;
    write_exact_shares(record, scalar, &rows, out)?;
    write_worst(&rows, style, out)
}

/// For each mesh the share of its rays that meet an edge or a vertex exactly.
fn write_exact_shares(
    record: &Record,
    scalar: &str,
    rows: &[RowView],
    out: &mut dyn Write,
) -> io::Result<()> {
    let Some(row) = rows.first() else { return Ok(()) };
    let meshes = record
        .result
        .sources
        .iter()
        .filter(|s| s.scalar == scalar && s.family.starts_with("mesh:"));
    for source in meshes {
        let Some(result) = row.results.iter().find(|r| r.family == source.family) else { continue };
        let of_part = |part: &str| -> u64 {
            let named = result.classes.iter().filter(|(name, _)| name.starts_with(part));
            named.map(|(_, counts)| counts.cases).sum()
        };
        let (edges, vertices) = (of_part("edge/"), of_part("vertex/"));
        let met = Trials::independent(edges + vertices, source.cases);
        let share = interval_of(&Rate::new(met, true));
        writeln!(
            out,
            "{}: {} rays meet an edge and {} a vertex exactly{share}",
            source.family,
            group_digits(edges),
            group_digits(vertices)
        )?;
    }
    Ok(())
}

/// A source's name in so many columns: of a long one the end, which is a file's name.
fn fitted(name: &str, columns: usize) -> String {
    match name.chars().count().saturating_sub(columns) {
        0 => name.to_owned(),
        more => std::iter::once('…').chain(name.chars().skip(more + 1)).collect(),
    }
}

/// A count in at most six columns: 1,234 or 1.2M.
pub(in crate::report) fn short_count(count: u64) -> String {
    match count {
        0..100_000 => group_digits(count),
        100_000..1_000_000 => format!("{}k", count / 1000),
        _ => format!("{:.1}M", count as f64 / 1e6),
    }
}

/// A share and its interval in percent, right-aligned in 20 columns; red where it is not zero.
pub(in crate::report) fn share_column(rate: &Rate, style: Style) -> String {
    let number = |share: f64| percent(share).trim_end_matches('%').to_owned();
    let text = match (rate.rate, rate.interval) {
        (None, _) => "-".to_owned(),
        (Some(share), None) => number(share),
        (Some(share), Some([low, high])) => {
            format!("{} [{}, {}]", number(share), number(low), number(high))
        }
    };
    let padded = format!("{text:>20}");
    match (style.color, rate.count) {
        (true, 1..) => format!("\x1b[31m{padded}\x1b[0m"),
        (true, 0) => format!("\x1b[32m{padded}\x1b[0m"),
        _ => padded,
    }
}

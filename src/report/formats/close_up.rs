//! A few rows, each by itself: its contract and gates, and for each question its false misses, its false
//! hits and what most of them come from.

use super::columns::{Column, far, short_percent};
use super::disagreement::is_shared_in_scene;
use super::lines::{Line, column_legend};
use super::pool::Pool;
use super::rate::percent;
use super::record::*;
use super::text::share_column;
use super::why::cause_shares;
use super::{Style, group_digits};
use crate::audit::Attribution;
use crate::kernel;
use crate::report::page::write_wrapped;
use std::io::{self, Write};

/// Writes each row in each scalar.
pub(super) fn write(
    record: &Record,
    columns: &[Column],
    lines: &[Line],
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut part: Option<&RowPart> = None;
    let mut sorted: Vec<&Line> = lines.iter().collect();
    sorted.sort_by_key(|line| {
        record.result.plan.rows.iter().position(|row| std::ptr::eq(row, line.row.part))
    });
    for line in sorted {
        if !part.is_some_and(|part| std::ptr::eq(part, line.row.part)) {
            part = Some(line.row.part);
            write_promise(line, out)?;
        }
        write_line(columns, line, style, out)?;
    }
    write_wrapped(
        "Shares of the cases that must be hit, and that must be missed, with 95 % intervals, on cases chosen to be \
         hard; far off: a verdict wrong by over 1/1000 of the longest edge.",
        style.width,
        out,
    )?;
    let has_other_causes = |line: &Line| {
        let mut shares = [FindingKind::FalseMiss, FindingKind::FalseHit]
            .into_iter()
            .filter_map(|kind| cause_shares(&line.row.results, kind, ""));
        shares.any(|shares| shares.iter().any(|(cause, ..)| *cause == Attribution::NotEpsilon))
    };
    if lines.iter().any(has_other_causes) {
        write_wrapped(
            "not-epsilon: with every epsilon 0 it is wrong too; runs cannot tell rounding from the formula itself",
            style.width,
            out,
        )?;
    }
    write_wrapped(&column_legend(columns, &[]), style.width, out)
}

/// The contract and the gates.
fn write_promise(line: &Line, out: &mut dyn Write) -> io::Result<()> {
    let part = line.row.part;
    writeln!(out, "\n{}, contract: {}", line.label(), part.contract)?;
    let gates = kernel::find(&part.kernel).map_or(&[][..], |entry| entry.info.gates);
    for (name, value) in &part.epsilons {
        let gate = gates.iter().find(|gate| gate.name == name);
        let refuses =
            gate.map_or(String::new(), |gate| format!(" refuses where {},", gate.refuses));
        writeln!(out, "  gate {name}{refuses} e = {value}")?;
    }
    Ok(())
}

fn write_line(
    columns: &[Column],
    line: &Line,
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    let first = columns.iter().map(|column| column.label().len()).max().unwrap_or(0).max(4);
    writeln!(
        out,
        "{bold}{:<first$} {:>20}  {:<18} {:>20}  {:<18} {:>10}{plain}",
        line.row.scalar,
        "false misses, %",
        "cause of most",
        "false hits, %",
        "cause of most",
        "far off, %"
    )?;
    for (column, cell) in columns.iter().zip(&line.cells) {
        if cell.wrong.of == 0 {
            continue;
        }
        let results = column.results(&line.row);
        write!(out, "{:<first$}", column.label())?;
        // There a neighbour may take a ray that a triangle leaves, so only cracks are wrong.
        if results.iter().all(|result| is_shared_in_scene(&result.family)) {
            let across = results.iter().filter_map(|result| result.across.as_ref());
            let cracks = Pool::of(across.map(|across| &across.cracks));
            let rate = cracks.rate();
            let words = if rate.count == 0 { "no cracks" } else { "cracks" };
            writeln!(out, " {}  {words}", share_column(rate, style))?;
            continue;
        }
        for (kind, rate) in [
            (FindingKind::FalseMiss, (|total| &total.false_misses) as fn(&Counts) -> &Rate),
            (FindingKind::FalseHit, |total| &total.false_hits),
        ] {
            let pool = Pool::of(results.iter().map(|result| rate(&result.total)));
            let share = match column.complete {
                true => format!("{:>20}", count_of(pool.counts())),
                false => share_column(pool.rate(), style),
            };
            write!(out, " {share}  {:<18}", cause(&results, kind))?;
        }
        let far: u64 = results
            .iter()
            .map(|r| far(r, FindingKind::FalseMiss) + far(r, FindingKind::FalseHit))
            .sum();
        writeln!(out, " {:>10}", short_percent([far, cell.wrong.of]))?;
    }
    write_untold(line, out)?;
    write_others(line, style, out)
}

/// Why there are no causes, if findings were examined and none can be told.
fn write_untold(line: &Line, out: &mut dyn Write) -> io::Result<()> {
    let parts = line.row.results.iter().flat_map(|result| &result.findings);
    let mut causes = parts.filter_map(|part| part.causes.as_ref()).peekable();
    let is_untold = causes.peek().is_some()
        && causes.all(|part| 0 < part.untold && part.by.values().all(|rate| rate.of == 0));
    if !is_untold {
        return Ok(());
    }
    writeln!(
        out,
        "  no causes: it does not show its formula, and has no epsilons at which it could be run otherwise"
    )
}

/// Cracks and doubles, whole polygons, bad and wrong values, where there are any to count.
fn write_others(line: &Line, style: Style, out: &mut dyn Write) -> io::Result<()> {
    if let Some(across) = &line.across {
        let [cracks, doubles] = [across.cracks, across.doubles].map(short_percent);
        let of = group_digits(across.cracks[1]);
        let words = across.words();
        writeln!(
            out,
            "  of {of} crossings {cracks} % cracks and {doubles} % doubles; promised across triangles: {words}"
        )?;
    }
    let polygons = |rate: fn(&PolygonPart) -> &Rate| {
        Pool::of(line.row.results.iter().filter_map(|result| result.polygons.as_ref()).map(rate))
            .counts()
    };
    let [misses, hits] = [polygons(|part| &part.false_misses), polygons(|part| &part.false_hits)];
    if 0 < misses[1] + hits[1] {
        let [misses, hits] = [misses, hits].map(count_of);
        writeln!(out, "  whole polygons: false misses {misses}, false hits {hits}")?;
    }
    let bad = line.row.total(|result| Some(&result.total.bad_values)).counts();
    if 0 < bad[0] {
        let bad = count_of(bad);
        writeln!(out, "  bad values: {bad} other hits, not finite or of the wrong side")?;
    }
    let values = &line.values.wrong;
    if 0 < values.count {
        let text = format!(
            "  wrong values in ordinary sizes: the t, u or v of {} hits that are not false is off by more than rounding \
             explains, of {} by over 1/1000 of the longest edge; most: {}",
            count_of([values.count, values.of]),
            group_digits(line.values.far),
            cause(&line.row.results, FindingKind::WrongValue).trim_end(),
        );
        write_wrapped(text.trim_end_matches("; most: "), style.width, out)?;
    }
    Ok(())
}

/// `3 of 57`.
fn count_of(rate: [u64; 2]) -> String {
    let [count, of] = rate.map(group_digits);
    format!("{count} of {of}")
}

/// The cause of most findings of a kind: `epsilon 93%`.
fn cause(results: &[&KernelResult], kind: FindingKind) -> String {
    let shares = cause_shares(results, kind, "").unwrap_or_default();
    let most = shares.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    most.map_or(String::new(), |(cause, share, _)| format!("{} {}", cause.name(), percent(share)))
}

//! A few rows, each by itself: its contract and gates, and for each question its false misses, its false
//! hits and what most of them come from.

use super::columns::{Column, far, short_percent};
use super::details::share_cell;
use super::disagreement::is_shared_in_scene;
use super::group_digits;
use super::lines::{Line, column_legend};
use super::pool::Pool;
use super::rate::percent;
use super::record::*;
use super::why::{cause_shares, of_kind};
use crate::audit::Attribution;
use crate::kernel;
use crate::report::page::{Block, Cell, Head, Row, Table};

/// Each row in each scalar.
pub(super) fn blocks(record: &Record, columns: &[Column], lines: &[Line]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut part: Option<&RowPart> = None;
    let mut sorted: Vec<&Line> = lines.iter().collect();
    sorted.sort_by_key(|line| {
        record.result.plan.rows.iter().position(|row| std::ptr::eq(row, line.row.part))
    });
    for line in sorted {
        if !part.is_some_and(|part| std::ptr::eq(part, line.row.part)) {
            part = Some(line.row.part);
            blocks.push(Block::Heading(format!(
                "{}, contract: {}",
                line.label(),
                line.row.part.contract
            )));
            blocks.push(Block::Notes(gates(line)));
        }
        blocks.push(Block::Table(table(columns, line)));
        blocks.push(Block::Notes(others(line)));
    }
    blocks.push(Block::text(
        "Shares of the cases that must be hit, and that must be missed, with 95 % intervals, on cases chosen to be hard; \
         far off: a verdict wrong by over 1/1000 of the longest edge.",
    ));
    let has_other_causes = |line: &Line| {
        let mut shares = [FindingKind::FalseMiss, FindingKind::FalseHit]
            .into_iter()
            .filter_map(|kind| cause_shares(of_kind(&line.row.results, kind)));
        shares.any(|shares| shares.iter().any(|(cause, ..)| *cause == Attribution::NotEpsilon))
    };
    if lines.iter().any(has_other_causes) {
        blocks.push(Block::text(
            "not-epsilon: with every epsilon 0 it is wrong too; runs cannot tell rounding from the formula itself",
        ));
    }
    blocks.push(Block::Text(column_legend(columns, &[])));
    blocks
}

/// The gates, a line each.
fn gates(line: &Line) -> Vec<String> {
    let part = line.row.part;
    let gates = kernel::find(&part.kernel).map_or(&[][..], |entry| entry.info.gates);
    let gate = |(name, value): (&String, &String)| {
        let gate = gates.iter().find(|gate| gate.name == name);
        let refuses =
            gate.map_or(String::new(), |gate| format!(" refuses where {},", gate.refuses));
        format!("gate {name}{refuses} e = {value}")
    };
    part.epsilons.iter().map(gate).collect()
}

/// A row of the table for each question.
fn table(columns: &[Column], line: &Line) -> Table {
    let heads = vec![
        Head::of(line.row.scalar),
        Head::of("false misses, %"),
        Head::text("cause of most").optional(),
        Head::of("false hits, %"),
        Head::text("cause of most").optional(),
        Head::of("far off, %").optional(),
    ];
    let mut rows = Vec::new();
    for (column, cell) in columns.iter().zip(&line.cells) {
        if cell.wrong.of == 0 {
            continue;
        }
        let results = column.results(&line.row);
        // There a neighbour may take a ray that a triangle leaves, so only cracks are wrong.
        if results.iter().all(|result| is_shared_in_scene(&result.family)) {
            let across = results.iter().filter_map(|result| result.across.as_ref());
            let cracks = Pool::of(across.map(|across| &across.cracks));
            let words = if cracks.rate().count == 0 { "no cracks" } else { "cracks" };
            let cells = [share_cell(cracks.rate()), words.to_owned().into()];
            let empty = [(); 3].map(|()| Cell::default());
            rows.push(Row::new(column.label(), cells.into_iter().chain(empty)));
            continue;
        }
        let mut cells: Vec<Cell> = Vec::new();
        for (kind, rate) in [
            (FindingKind::FalseMiss, (|total| &total.false_misses) as fn(&Counts) -> &Rate),
            (FindingKind::FalseHit, |total| &total.false_hits),
        ] {
            let pool = Pool::of(results.iter().map(|result| rate(&result.total)));
            cells.push(match column.complete {
                true => count_of(pool.counts()).into(),
                false => share_cell(pool.rate()),
            });
            cells.push(cause(&results, kind).into());
        }
        let far: u64 = results
            .iter()
            .map(|r| far(r, FindingKind::FalseMiss) + far(r, FindingKind::FalseHit))
            .sum();
        cells.push(short_percent([far, cell.wrong.of]).into());
        rows.push(Row::new(column.label(), cells));
    }
    Table { heads, rows }
}

/// Cracks and doubles, whole polygons, bad and wrong values, where there are any to count; and why no causes are told.
fn others(line: &Line) -> Vec<String> {
    let mut all = Vec::new();
    let parts = line.row.results.iter().flat_map(|result| &result.findings);
    let mut causes = parts.filter_map(|part| part.causes.as_ref()).peekable();
    let is_untold = causes.peek().is_some()
        && causes.all(|part| 0 < part.untold && part.by.values().all(|rate| rate.of == 0));
    if is_untold {
        let why = "no causes: it does not show its formula, and has no epsilons at which it could be run otherwise";
        all.push(why.to_owned());
    }
    if let Some(across) = &line.across {
        let [cracks, doubles] = [across.cracks, across.doubles].map(short_percent);
        let of = group_digits(across.cracks[1]);
        let words = across.words();
        all.push(format!(
            "of {of} crossings {cracks} % cracks and {doubles} % doubles; promised across triangles: {words}"
        ));
    }
    let polygons = |rate: fn(&PolygonPart) -> &Rate| {
        Pool::of(line.row.results.iter().filter_map(|result| result.polygons.as_ref()).map(rate))
            .counts()
    };
    let [misses, hits] = [polygons(|part| &part.false_misses), polygons(|part| &part.false_hits)];
    if 0 < misses[1] + hits[1] {
        let [misses, hits] = [misses, hits].map(count_of);
        all.push(format!("whole polygons: false misses {misses}, false hits {hits}"));
    }
    let bad = line.row.total(|result| Some(&result.total.bad_values)).counts();
    if 0 < bad[0] {
        let bad = count_of(bad);
        all.push(format!("bad values: {bad} other hits, not finite or of the wrong side"));
    }
    let values = &line.values.wrong;
    if 0 < values.count {
        let text = format!(
            "wrong values in ordinary sizes: the t, u or v of {} hits that are not false is off by more than rounding \
             explains, of {} by over 1/1000 of the longest edge; most: {}",
            count_of([values.count, values.of]),
            group_digits(line.values.far),
            cause(&line.row.results, FindingKind::WrongValue).trim_end(),
        );
        all.push(text.trim_end_matches("; most: ").to_owned());
    }
    all
}

/// `3 of 57`.
fn count_of(rate: [u64; 2]) -> String {
    let [count, of] = rate.map(group_digits);
    format!("{count} of {of}")
}

/// The cause of most findings of a kind: `epsilon 93%`.
fn cause(results: &[&KernelResult], kind: FindingKind) -> String {
    let shares = cause_shares(of_kind(results, kind)).unwrap_or_default();
    let most = shares.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    most.map_or(String::new(), |(cause, share, _)| format!("{} {}", cause.name(), percent(share)))
}

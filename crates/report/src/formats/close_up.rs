//! A few rows, each by itself: its contract and gates, and for each question its false misses, its false
//! hits and what most of them come from.

use super::columns::{AcrossColumn, Column, kinds, visible};
use super::lines::{RowLine, column_legend};
use super::pool::Pool;
use super::row_view::{COUNTED, WRONG};
use super::why::{cause_shares, of_kind};
use crate::audit::{Attribution, kind_of};
use crate::kernel::{self, Role};
use crate::page::{Block, Cell, Head, Row, Table};
use hairline_record::group_digits;
use hairline_record::is_at_shared;
use hairline_record::percent;
use hairline_record::*;

/// Each row in all scalars.
pub(super) fn blocks(record: &Record, columns: &[Column], lines: &[RowLine]) -> Vec<Block> {
    let mut blocks = Vec::new();
    for part in &record.result.plan.rows {
        let of_part = lines
            .iter()
            .filter(|line| std::ptr::eq(line.row.part, part));
        let of_part: Vec<&RowLine> = of_part.collect();
        let Some(first) = of_part.first() else {
            continue;
        };
        blocks.push(Block::Heading(format!(
            "{}, contract: {}",
            first.label(),
            part.contract
        )));
        blocks.push(Block::Notes(gates(first)));
        blocks.push(Block::Table(table(columns, &of_part)));
        blocks.push(Block::Notes(others(record, columns, &of_part)));
    }
    let intervals = match record.result.plan.scalars.len() {
        1 => ", with 95 % intervals",
        _ => "",
    };
    blocks.push(Block::Text(format!(
        "On cases chosen to be hard, % of those that must be hit, and missed{intervals}."
    )));
    let has_other_causes = |line: &RowLine| {
        let mut shares = WRONG
            .iter()
            .filter_map(|(kind, _)| cause_shares(of_kind(&line.row.results, *kind)));
        shares.any(|shares| {
            shares
                .iter()
                .any(|(cause, ..)| *cause == Attribution::NotEpsilon)
        })
    };
    if lines.iter().any(has_other_causes) {
        blocks.push(Block::text(
            "not-epsilon: with every epsilon 0 it is wrong too; runs cannot tell rounding from the formula itself",
        ));
    }
    blocks.push(Block::Text(column_legend(columns)));
    blocks
}

/// The gates, a line each.
fn gates(line: &RowLine) -> Vec<String> {
    let part = line.row.part;
    let gates = kernel::find(&part.kernel).map_or(&[][..], |entry| entry.info.gates);
    let gate = |(name, value): (&String, &String)| {
        let gate = gates.iter().find(|gate| gate.name == name);
        let refuses = gate.map_or(String::new(), |gate| {
            format!(" refuses where {},", gate.refuses)
        });
        let is_tolerant =
            gate.is_some_and(|gate| gate.role == Role::Edge) && value.starts_with('-');
        let beside = if is_tolerant {
            "; the hits beside it that this asks for count as false"
        } else {
            ""
        };
        format!("gate {name}{refuses} e = {value}{beside}")
    };
    part.epsilons.iter().map(gate).collect()
}

/// A row of the table for each question, and a column for each scalar.
fn table(columns: &[Column], lines: &[&RowLine]) -> Table {
    let scalars = || lines.iter().map(|line| line.row.scalar);
    let mut heads = vec![Head::of(if lines.len() == 1 {
        lines[0].row.scalar.name()
    } else {
        "cases"
    })];
    for what in ["false misses", "false hits"] {
        match lines.len() {
            1 => heads.push(Head::of(format!("{what}, %"))),
            _ => heads.extend(scalars().map(|scalar| Head::of(format!("{what}, % {scalar}")))),
        }
        heads.push(Head::text("cause of most").optional());
    }
    heads.push(Head::of("visible").about("answers off by over 1/1000 of an edge, values included"));
    let rows = columns
        .iter()
        .enumerate()
        .filter_map(|(i, column)| row(column, i, lines));
    Table::new(heads, rows.collect())
}

/// The row of a question; none if it demands nothing.
fn row(column: &Column, place: usize, lines: &[&RowLine]) -> Option<Row> {
    let cells: Vec<&super::columns::ColumnCell> =
        lines.iter().map(|line| &line.cells[place]).collect();
    if cells.iter().all(|cell| cell.wrong.of == 0) {
        return None;
    }
    let results: Vec<Vec<&KernelResult>> =
        lines.iter().map(|line| column.results(&line.row)).collect();
    let mut row = Row::new(column.label(), []);
    // There is no room for the intervals of several.
    let share = |rate: &Rate| match lines.len() {
        1 => share_cell(rate),
        _ => share_cell(&Rate {
            interval: None,
            ..rate.clone()
        }),
    };
    // There a neighbour may take a ray that a triangle leaves, so only cracks are wrong.
    if results
        .iter()
        .flatten()
        .all(|result| is_at_shared(&result.family))
    {
        let cracks = results.iter().map(|results| {
            let across = results.iter().filter_map(|result| result.across.as_ref());
            Pool::of(across.map(|across| &across.cracks))
        });
        let cracks: Vec<Pool> = cracks.collect();
        let has_cracks = cracks.iter().any(|pool| 0 < pool.rate().count);
        row.cells
            .extend(cracks.iter().map(|pool| share(pool.rate())));
        row.cells
            .push(Cell::words(if has_cracks { "cracks" } else { "no cracks" }));
        row.cells.resize_with(2 * lines.len() + 2, Cell::default);
        row.cells.push(Cell::count(visible(&results.concat())));
        return Some(row);
    }
    for (kind, rate) in WRONG {
        let pools = results
            .iter()
            .map(|results| Pool::of(results.iter().map(|result| rate(&result.total))));
        row.cells.extend(pools.map(|pool| match column.complete {
            true => {
                let [count, of] = pool.counts();
                Cell::share(count as f64 / of as f64, count_of([count, of]))
            }
            false => share(pool.rate()),
        }));
        row.cells.push(Cell::words(cause(&results.concat(), kind)));
    }
    row.cells.push(Cell::count(visible(&results.concat())));
    Some(row)
}

/// The counts besides false misses and false hits on planes of the own kind, a line each; why no causes are told, and if the promise across triangles
/// is kept.
fn others(record: &Record, columns: &[Column], lines: &[&RowLine]) -> Vec<String> {
    let own = kinds(record)[0];
    let has_extremes = columns.iter().any(|column| !column.is_ordinary());
    let scope = if has_extremes {
        ", extreme exponents included"
    } else {
        ""
    };
    let is_alone = lines.len() == 1;
    let mut all = Vec::new();
    if lines.iter().any(|line| is_untold(line)) {
        let why = "no causes: it does not show its formula, and declares no epsilons at which it could be run otherwise (docs/guide/own-kernel.md)";
        all.push(why.to_owned());
    }
    // Hits of the triangle that a ray leaves are no promise's, unless they are false hits.
    for (name, get) in COUNTED[2..].iter().filter(|(name, _)| *name != "self-hits") {
        let pools = lines.iter().map(|line| {
            let results = line.row.results.iter();
            let own = results
                .copied()
                .filter(|result| kind_of(&result.family) == own);
            (line.row.scalar, Pool::of(own.filter_map(get)))
        });
        let counts = pools
            .filter(|(_, pool)| 0 < pool.counts()[0])
            .map(|(scalar, pool)| {
                if is_alone {
                    pool.to_string()
                } else {
                    format!("{scalar} {}", count_of(pool.counts()))
                }
            });
        let counts: Vec<String> = counts.collect();
        let is_of_values = name.ends_with("values");
        let scope = if is_of_values { scope } else { "" };
        if !counts.is_empty() {
            all.push(format!("{name}: {}{scope}", counts.join(", ")));
        }
    }
    for line in lines {
        let lead = if is_alone {
            String::new()
        } else {
            format!("{}: ", line.row.scalar)
        };
        let promised = line.across.as_ref().and_then(AcrossColumn::promise);
        all.extend(promised.map(|words| format!("{lead}promised across triangles: {words}")));
    }
    all
}

/// True if no cause of any finding could be told.
fn is_untold(line: &RowLine) -> bool {
    let parts = line.row.results.iter().flat_map(|result| &result.findings);
    let mut causes = parts.filter_map(|part| part.causes.as_ref()).peekable();
    causes.peek().is_some()
        && causes.all(|part| 0 < part.untold && part.by.values().all(|rate| rate.of == 0))
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
    most.map_or(String::new(), |(cause, share, _)| {
        format!("{} {}", cause.name(), percent(share))
    })
}

/// A share and its interval in percent.
fn share_cell(rate: &Rate) -> Cell {
    let number = |share: f64| percent(share).trim_end_matches('%').to_owned();
    let text = match (rate.rate, rate.interval) {
        (None, _) => "-".to_owned(),
        (Some(share), None) => number(share),
        (Some(share), Some([low, high])) => {
            format!("{} [{}, {}]", number(share), number(low), number(high))
        }
    };
    Cell::rate(rate, text).broken_if(0 < rate.count)
}

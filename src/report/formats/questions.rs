//! Every question in a column, row by row in the order of the plan: the first table of `--details`.

use super::columns::{Cell, Column, short_percent};
use super::group_digits;
use super::lines::{Line, column_legend};
use crate::report::page::{self, Block, Head, Row, Table};
use std::collections::BTreeSet;

/// A table for each scalar, and what stands in it.
pub(super) fn blocks(scalars: &[String], columns: &[Column], lines: &[Line]) -> Vec<Block> {
    let has_groups = lines.iter().any(|line| line.across.is_some());
    let groups = if has_groups { &["cracks ", "doubles ", "promised"][..] } else { &[] };
    let mut blocks = Vec::new();
    for scalar in scalars {
        let mut heads = vec![format!("{scalar} kernel (epsilons)")];
        heads.extend(columns.iter().map(|column| format!("{} ", column.label())));
        heads.push("values ".to_owned());
        heads.extend(groups.iter().map(|head| (*head).to_owned()));
        let of_scalar = lines.iter().filter(|line| line.row.scalar == scalar);
        let rows: Vec<Row> = of_scalar.map(|line| row(columns, line, has_groups)).collect();
        let heads = heads.into_iter().map(Head::of).collect();
        if !rows.is_empty() {
            blocks.push(Block::Table(Table::new(heads, rows)));
        }
    }
    blocks.push(Block::Text(cell_legend(columns, lines)));
    blocks.push(Block::Text(column_legend(columns, lines)));
    blocks
}

fn row(columns: &[Column], line: &Line, has_groups: bool) -> Row {
    let text =
        |share: String, cell: &Cell| format!("{share}{}", if cell.is_far() { '*' } else { ' ' });
    let share = |cell: &Cell| page::Cell {
        text: text(short_percent([cell.wrong.count, cell.wrong.of]), cell),
        share: cell.wrong.share(),
        ..page::Cell::default()
    };
    let mut cells: Vec<page::Cell> = Vec::new();
    for (column, cell) in columns.iter().zip(&line.cells) {
        let [count, of] = [cell.wrong.count, cell.wrong.of].map(group_digits);
        cells.push(match column.complete && 0 < cell.wrong.of {
            true => text(format!("{count}/{of}"), cell).into(),
            false => share(cell),
        });
    }
    cells.push(share(&line.values));
    if let Some(across) = line.across.as_ref().filter(|_| has_groups) {
        let [cracks, doubles] = [across.cracks, across.doubles].map(short_percent);
        cells.extend([format!("{cracks} "), format!("{doubles} ")].map(page::Cell::from));
        cells.push(page::Cell { text: across.words(), is_broken: across.is_broken(), share: None });
    } else if has_groups {
        cells.extend(["- ", "- ", "-"].map(|text| page::Cell::from(text.to_owned())));
    }
    Row::new(line.label(), cells)
}

/// The legend of a cell.
fn cell_legend(columns: &[Column], lines: &[Line]) -> String {
    let sampled = lines.iter().flat_map(|line| columns.iter().zip(&line.cells));
    let wide = sampled
        .filter(|(column, cell)| !column.complete && 0 < cell.wrong.of)
        .map(|(_, cell)| cell.wrong.interval())
        .map(|interval| (interval.high - interval.low) / 2.0)
        .fold(0.0, f64::max);
    let contracts: BTreeSet<&str> = lines.iter().map(|line| &*line.row.part.contract).collect();
    let contract = match contracts.len() {
        1 => "the contract given",
        _ => "what the row's source promises",
    };
    let within = match wide {
        0.0 => String::new(),
        wide => format!(" (95 % intervals: ±{:.1} at most)", wide * 100.0 + 0.05),
    };
    let free = lines.iter().flat_map(|line| &line.cells).any(|cell| cell.wrong.of == 0);
    let free = if free { "; - nothing demanded" } else { "" };
    let stored = columns.iter().any(|column| column.complete);
    let stored = if stored { "; of whole sets: wrong/all" } else { "" };
    format!(
        "Cells: % of wrong verdicts, false misses and false hits, by {contract}, on cases chosen to be \
         hard{within}; * over 0.1 % are wrong by over 1/1000 of the longest edge{stored}{free}."
    )
}

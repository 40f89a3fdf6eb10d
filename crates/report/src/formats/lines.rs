//! The lines of the tables: rows with their cells; and notes on kernels.

use super::columns::{AcrossColumn, Column, ColumnCell, kinds};
use super::row_view::{RateOf, RowView, cases_in};
use crate::arith::ScalarName;
use crate::page::Block;
use hairline_record::group_digits;
use hairline_record::*;

/// One row in one scalar.
pub(super) struct RowLine<'a> {
    pub(super) row: RowView<'a>,
    /// One a column.
    pub(super) cells: Vec<ColumnCell>,
    /// The values of hits, in the columns of ordinary sizes.
    pub(super) values: ColumnCell,
    pub(super) across: Option<AcrossColumn>,
}

impl RowLine<'_> {
    /// `kernel (epsilons)`.
    pub(super) fn label(&self) -> String {
        self.row.part.label()
    }
}

/// Every row in every scalar that has cases.
pub(super) fn lines<'a>(record: &'a Record, columns: &[Column]) -> Vec<RowLine<'a>> {
    let own = kinds(record)[0];
    let in_scalar = |scalar: ScalarName| {
        let rows = RowView::all(record, scalar).into_iter();
        rows.map(move |row| RowLine {
            cells: columns
                .iter()
                .map(|column| ColumnCell::sum(&column.results(&row)))
                .collect(),
            values: ColumnCell::of_values(columns, &row),
            across: AcrossColumn::of(&row, own),
            row,
        })
    };
    let scalars = record.result.plan.scalars.iter().copied();
    scalars
        .filter(|scalar| 0 < cases_in(record, *scalar))
        .flat_map(in_scalar)
        .collect()
}

/// The contents of the columns.
pub(super) fn column_legend(columns: &[Column]) -> String {
    let told = columns.iter().filter(|column| !column.about().is_empty());
    let told = told.map(|column| format!("{}: {}", column.label(), column.about()));
    told.collect::<Vec<_>>().join("; ")
}

/// How to read a run in an instance.
const OF_INSTANCE: &str = "In an instance rays are rounded once more in the world, so fewer of them meet an edge exactly, and a \
                           total may even fall. What the matrix costs are the findings whose cause is transform: the kernel \
                           is right on the ray that it got. t, u and v are not judged.";

/// Notes on the kernels besides their verdicts, and on values that are good for nothing.
pub(super) fn notes(record: &Record) -> Vec<Block> {
    let of_kernels = record.provenance.kernel_notes.iter();
    let of_kernels = of_kernels
        .flat_map(|(kernel, notes)| notes.iter().map(move |note| format!("{kernel}: {note}.")));
    let mut all: Vec<String> = of_kernels.collect();
    if record.result.is_placed() {
        all.push(OF_INSTANCE.to_owned());
    }
    let values: [(RateOf, &str); 2] = [
        (
            |total| &total.bad_values,
            "a t, u or v that is not finite, or with the wrong side (bad-value). Does it write all that it says that it \
             gives?",
        ),
        (
            |total| &total.wrong_values,
            "a t, u or v that is not the exact one, by more than rounding explains (wrong-value). t is in units of the \
             direction as given, u is the weight of b, v that of c.",
        ),
    ];
    let scalars = record.result.plan.scalars.iter().copied();
    for row in scalars.flat_map(|scalar| RowView::all(record, scalar)) {
        let label = format!("{}, {}", row.part.label(), row.scalar);
        for (rate, with) in values {
            let [count, of] = row.total(|result| Some(rate(&result.total))).counts();
            // Of more than half of them something is wrong with the adapter, not with the arithmetic.
            if of < count.saturating_mul(2) {
                let [count, of] = [count, of].map(group_digits);
                all.push(format!(
                    "{label}: of {of} hits that are not false {count} come with {with}"
                ));
            }
        }
    }
    all.into_iter().map(Block::Text).collect()
}

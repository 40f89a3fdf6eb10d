//! A record by kernel row, as the report walks through it.

use crate::report::disagreement::{across, polygons};
use crate::report::formats::columns::{Across, Column};
use crate::report::formats::lines::{Line, lines};
use crate::report::formats::pool::Pool;
use crate::report::formats::row_view::RowView;
use crate::report::record::*;

/// The record by row.
pub(super) struct View<'a> {
    pub record: &'a Record,
    /// In the order of the plan; without those that ran in no scalar.
    pub rows: Vec<Row<'a>>,
    /// The names of sources, in the order of the plan.
    pub families: Vec<&'a str>,
    /// The questions that the sources ask.
    pub columns: Vec<Column>,
    /// Each row in each scalar, by question.
    pub lines: Vec<Line<'a>>,
}

/// A kernel with its epsilons.
pub(super) struct Row<'a> {
    pub part: &'a RowPart,
    /// The fragment that leads to it.
    pub anchor: String,
    /// In each scalar that it ran in.
    pub scalars: Vec<RowView<'a>>,
}

/// Which of the two ways to be wrong.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Miss,
    Hit,
}

impl Kind {
    pub const ALL: [Kind; 2] = [Kind::Miss, Kind::Hit];

    /// The name in records.
    pub fn finding(self) -> FindingKind {
        match self {
            Kind::Miss => FindingKind::FalseMiss,
            Kind::Hit => FindingKind::FalseHit,
        }
    }

    /// For readers.
    pub fn words(self) -> &'static str {
        match self {
            Kind::Miss => "false misses",
            Kind::Hit => "false hits",
        }
    }

    pub fn rate(self, counts: &Counts) -> &Rate {
        match self {
            Kind::Miss => &counts.false_misses,
            Kind::Hit => &counts.false_hits,
        }
    }

    /// The sum over the sources of a row in a scalar.
    pub fn pool(self, row: &RowView) -> Pool {
        row.total(|result| Some(self.rate(&result.total)))
    }
}

impl<'a> View<'a> {
    pub fn new(record: &'a Record) -> View<'a> {
        let plan = &record.result.plan;
        let anchored = plan.rows.iter().enumerate();
        let mut rows: Vec<Row> = anchored
            .map(|(i, part)| Row { part, anchor: format!("k{i}"), scalars: Vec::new() })
            .collect();
        for scalar in &plan.scalars {
            // In the order of the plan, some left out.
            let mut views = RowView::all(record, scalar).into_iter().peekable();
            for row in &mut rows {
                row.scalars.extend(views.next_if(|view| std::ptr::eq(view.part, row.part)));
            }
        }
        rows.retain(|row| !row.scalars.is_empty());
        let families = plan.sources.iter().map(|source| source.family.as_str()).collect();
        let columns = Column::all(record);
        let lines = lines(record, &columns);
        View { record, rows, families, columns, lines }
    }
}

impl View<'_> {
    /// The outcomes of groups of triangles, for a row in a scalar.
    pub fn across(&self, row: &Row, scalar: &str) -> Option<&Across> {
        let is_of =
            |line: &&Line| line.row.scalar == scalar && std::ptr::eq(line.row.part, row.part);
        self.lines.iter().find(is_of)?.across.as_ref()
    }
}

impl Row<'_> {
    /// How many findings of all kinds, of single triangles and of what is promised across several.
    pub fn findings(&self) -> u64 {
        let of = |counts: &Counts| {
            [&counts.false_misses, &counts.false_hits, &counts.bad_values, &counts.wrong_values]
                .map(|rate| rate.count)
                .iter()
                .sum::<u64>()
                + counts.panics
                + counts.crashes
                + counts.timeouts
        };
        let together = |result: &KernelResult| -> u64 {
            across(result).iter().chain(&polygons(result)).map(|(_, rate, ..)| rate.count).sum()
        };
        let results = self.scalars.iter().flat_map(|part| &part.results);
        results.map(|result| of(&result.total) + together(result)).sum()
    }
}

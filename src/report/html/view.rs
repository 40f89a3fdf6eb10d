//! A record by kernel row, as the report walks through it.

use crate::report::columns::{Across, Column};
use crate::report::lines::{Line, lines};
use crate::report::pool::Pool;
use crate::report::record::*;
use std::collections::HashMap;

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
    pub scalars: Vec<InScalar<'a>>,
}

/// A row in one scalar.
pub(super) struct InScalar<'a> {
    pub scalar: &'a str,
    pub total: Option<&'a RowTotal>,
    /// In the order of the record.
    pub results: Vec<&'a KernelResult>,
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
    pub fn finding(self) -> &'static str {
        match self {
            Kind::Miss => "false-miss",
            Kind::Hit => "false-hit",
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
}

impl<'a> View<'a> {
    pub fn new(record: &'a Record) -> View<'a> {
        type Key<'a> = [&'a str; 3];
        let mut results: HashMap<Key, Vec<&KernelResult>> = HashMap::new();
        for part in &record.result.results {
            results.entry([&part.kernel, &part.set, &part.scalar]).or_default().push(part);
        }
        let totals: HashMap<Key, &RowTotal> = record
            .result
            .totals
            .iter()
            .map(|total| ([total.kernel.as_str(), &total.set, &total.scalar], total))
            .collect();
        let plan = &record.result.plan;
        let mut rows = Vec::new();
        for (i, part) in plan.rows.iter().enumerate() {
            let in_scalar = |scalar: &'a String| {
                let key = [part.kernel.as_str(), part.set.as_str(), scalar.as_str()];
                let results = results.remove(&key)?;
                Some(InScalar { scalar, total: totals.get(&key).copied(), results })
            };
            let scalars: Vec<_> = plan.scalars.iter().filter_map(in_scalar).collect();
            if !scalars.is_empty() {
                rows.push(Row { part, anchor: format!("k{i}"), scalars });
            }
        }
        let families = plan.sources.iter().map(|source| source.family.as_str()).collect();
        let columns = Column::all(record);
        let lines = lines(record, &columns);
        View { record, rows, families, columns, lines }
    }
}

impl View<'_> {
    /// What the triangles of groups did together, of a row in a scalar.
    pub fn across(&self, row: &Row, scalar: &str) -> Option<&Across> {
        let is_of = |line: &&Line| line.scalar == scalar && std::ptr::eq(line.row.part, row.part);
        self.lines.iter().find(is_of)?.across.as_ref()
    }
}

impl Row<'_> {
    /// How many findings of all kinds.
    pub fn findings(&self) -> u64 {
        let of = |counts: &Counts| {
            [&counts.false_misses, &counts.false_hits, &counts.bad_values]
                .map(|rate| rate.count)
                .iter()
                .sum::<u64>()
                + counts.panics
                + counts.crashes
                + counts.timeouts
        };
        self.scalars.iter().flat_map(|part| &part.results).map(|result| of(&result.total)).sum()
    }
}

impl InScalar<'_> {
    /// The sum of a rate over the sources.
    pub fn sum(&self, rate: impl Fn(&KernelResult) -> Option<&Rate>) -> Pool {
        Pool::of(self.results.iter().filter_map(|result| rate(result)))
    }

    /// The sum of one kind.
    pub fn all(&self, kind: Kind) -> Pool {
        self.sum(|result| Some(kind.rate(&result.total)))
    }
}

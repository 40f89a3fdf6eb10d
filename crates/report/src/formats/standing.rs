//! How well each row did, in all scalars and in the columns of ordinary sizes.

use super::columns::{AcrossColumn, Column, ColumnCell, ColumnSizes, visible};
use super::lines::RowLine;
use crate::audit::Trials;
use hairline_record::*;
use hairline_record::{Key, disagreements, is_at_shared};
use std::collections::{BTreeMap, HashMap};

/// One row in all scalars.
pub(super) struct Standing<'a> {
    /// The row.
    pub part: &'a RowPart,
    /// Its lines, one a scalar.
    pub lines: Vec<&'a RowLine<'a>>,
    /// The mean of the cells' shares; none if no case of ordinary size demands a verdict.
    pub share: Option<f64>,
    /// Wrong verdicts, in every kind of planes and rays.
    pub wrong: u64,
    /// How many answers, verdicts and values, can be seen to be wrong, in ordinary, unusual and extreme sizes.
    visible: [u64; 3],
    /// The other breaches of the contract, on any case: `crash`, `bad-value`, `crack`, ….
    pub others: BTreeMap<FindingKind, u64>,
}

impl Standing<'_> {
    /// How many answers can be seen to be wrong, but for those at extreme exponents.
    pub fn all_far(&self) -> u64 {
        self.visible_in(ColumnSizes::Ordinary) + self.visible_in(ColumnSizes::Unusual)
    }

    /// The same in some sizes.
    pub fn visible_in(&self, sizes: ColumnSizes) -> u64 {
        self.visible[sizes as usize]
    }

    /// The share of rays at shared edges and vertices that hit nothing, in the worse scalar; none if there are no such
    /// rays.
    pub fn leaks(&self) -> Option<[u64; 2]> {
        let all = self
            .lines
            .iter()
            .filter_map(|line| Some(line.across.as_ref()?.cracks));
        all.max_by(|a, b| share(*a).total_cmp(&share(*b)))
    }

    /// How many rays at shared edges and vertices there were, in all scalars.
    pub fn crossings(&self) -> u64 {
        self.across().map(|across| across.cracks[1]).sum()
    }

    /// The rays at shared edges and vertices of other than ordinary sizes that hit nothing, of how many, in all scalars.
    pub fn extreme_leaks(&self) -> [u64; 2] {
        let all = self.across().map(|across| across.extreme_cracks);
        all.fold([0, 0], |[count, of], [more, of_more]| {
            [count + more, of + of_more]
        })
    }

    fn across(&self) -> impl Iterator<Item = &AcrossColumn> {
        self.lines.iter().filter_map(|line| line.across.as_ref())
    }

    /// True if it broke what it promises across triangles, and not by leaks in other than ordinary sizes alone.
    pub fn breaks_promise(&self) -> bool {
        self.across()
            .any(|it| it.is_broken() && !it.is_broken_by_extremes())
    }

    /// The trials in the scalar in which more are wrong.
    pub fn worse(&self, of: impl Fn(&RowLine) -> ColumnCell) -> ColumnCell {
        let share = |cell: &ColumnCell| cell.wrong.share().unwrap_or(-1.0);
        let cells = self.lines.iter().map(|line| of(line));
        cells
            .max_by(|a, b| share(a).total_cmp(&share(b)))
            .unwrap_or_default()
    }

    /// True if another row was wrong exactly as often, in every column and scalar.
    pub fn is_like(&self, other: &Standing) -> bool {
        let count = |trials: &Trials| [trials.count, trials.of];
        let cell = |cell: &ColumnCell| (count(&cell.wrong), cell.far);
        if self.visible != other.visible {
            return false;
        }
        let numbers = |line: &&RowLine| {
            let cells: Vec<_> = line.cells.iter().map(cell).collect();
            let across = line
                .across
                .as_ref()
                .map(|across| (across.cracks, across.extreme_cracks, across.doubles));
            (cells, cell(&line.values), across)
        };
        self.others == other.others
            && self
                .lines
                .iter()
                .map(numbers)
                .eq(other.lines.iter().map(numbers))
    }
}

/// The answers that can be seen to be wrong, by the sizes of the columns.
fn all_visible(columns: &[Column], lines: &[&RowLine]) -> [u64; 3] {
    let mut sums = [0; 3];
    for line in lines {
        for column in columns {
            sums[column.sizes() as usize] += visible(&column.results(&line.row));
        }
    }
    sums
}

/// A share of a number; nought of none.
pub(super) fn share([count, of]: [u64; 2]) -> f64 {
    count as f64 / of.max(1) as f64
}

/// By kernel and set: how often it broke its contract in other ways than by false misses and false hits of single cases.
type Others = HashMap<[String; 2], BTreeMap<FindingKind, u64>>;

fn other_findings(record: &Record) -> Others {
    let mut others = Others::new();
    for found in disagreements(&record.result) {
        let Key {
            kernel,
            set,
            family,
            finding,
            ..
        } = found.key;
        // Cracks at the shared edges and vertices of a scene are in the shares, promised or not.
        let is_in_shares =
            finding.is_wrong_verdict() || finding == FindingKind::Crack && is_at_shared(&family);
        if !is_in_shares {
            *others
                .entry([kernel, set])
                .or_default()
                .entry(finding)
                .or_default() += found.rate.count;
        }
    }
    others
}

/// Every row that ran.
pub(super) fn standings<'a>(
    record: &'a Record,
    columns: &[Column],
    lines: &'a [RowLine<'a>],
) -> Vec<Standing<'a>> {
    let (everywhere, others) = (Column::in_all_kinds(record), other_findings(record));
    let wrong_in = |columns: &[Column], line: &RowLine| -> u64 {
        let columns = columns.iter().filter(|column| column.is_ordinary());
        columns
            .map(|column| ColumnCell::sum(&column.results(&line.row)).wrong.count)
            .sum()
    };
    // Stored cases stay out of the mean of samples.
    let all_complete = columns.iter().all(|column| column.complete);
    let of_row = |part: &'a RowPart| {
        let of_part = lines
            .iter()
            .filter(|line| std::ptr::eq(line.row.part, part));
        let lines: Vec<&RowLine> = of_part.collect();
        let cells: Vec<(&Column, &ColumnCell)> = lines
            .iter()
            .flat_map(|line| columns.iter().zip(&line.cells))
            .filter(|(column, cell)| column.is_ordinary() && 0 < cell.wrong.of)
            .collect();
        let meant = cells
            .iter()
            .filter(|(column, _)| column.complete == all_complete);
        let shares: Vec<f64> = meant.filter_map(|(_, cell)| cell.wrong.share()).collect();
        (!lines.is_empty()).then(|| Standing {
            part,
            share: (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64),
            wrong: lines.iter().map(|line| wrong_in(&everywhere, line)).sum(),
            visible: all_visible(columns, &lines),
            others: others
                .get(&[part.kernel.clone(), part.set.clone()])
                .cloned()
                .unwrap_or_default(),
            lines,
        })
    };
    record.result.plan.rows.iter().filter_map(of_row).collect()
}

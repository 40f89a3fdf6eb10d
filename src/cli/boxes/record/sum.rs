//! A slab test on all sources of a run.

use super::{BoxesRow, Farthest};
use crate::arith::ScalarName;
use crate::record::{Rate, number_of, percent};
use crate::report::page::Cell;
use crate::report::{alike, listed};

/// How many sources of lost rays a line names.
const NAMED: usize = 2;

/// A false hit by less than this share of the largest coordinate may be rounding, in either scalar.
const ROUNDED: f64 = 1e-3;

/// A slab test on all sources.
pub struct Sum<'a> {
    pub label: String,
    pub rows: Vec<&'a BoxesRow>,
}

impl<'a> Sum<'a> {
    /// Its lost rays in a scalar.
    fn lost_in(&self, scalar: ScalarName) -> Rate {
        let rows = self.rows.iter().filter(|row| row.scalar == scalar);
        Rate::sum(rows.map(|row| &row.lost))
    }

    /// True if it lost a ray, or gave no verdict.
    pub fn is_losing(&self) -> bool {
        self.rows.iter().any(|row| row.is_losing())
    }

    /// The share of rays that it loses, by which the table is ordered.
    pub fn order(&self) -> f64 {
        let lost = Rate::sum(self.rows.iter().map(|row| &row.lost));
        lost.rate.unwrap_or(0.0)
    }

    /// The sources on which it loses most, with their shares in both scalars.
    fn sources(&self) -> String {
        let rows = self.rows.iter().copied();
        let mut shares = Vec::new();
        for (first, others) in alike(rows, |one, other| one.source == other.source) {
            let rows = others.iter().chain([&first]);
            let lost = Rate::sum(rows.map(|row| &row.lost));
            if 0 < lost.count {
                shares.push((&first.source, lost.rate.unwrap_or(0.0)));
            }
        }
        shares.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        let mut named = Vec::new();
        for (source, share) in shares {
            named.push(format!("{source} {}", percent(share)));
        }
        listed(&named, NAMED)
    }

    /// Its row of the table: a share of lost rays a scalar, then the sources that lose most if they are told.
    pub fn cells(&self, scalars: &[ScalarName], tells_sources: bool) -> Vec<Cell> {
        let mut cells = Vec::new();
        for scalar in scalars {
            let lost = self.lost_in(*scalar);
            cells.push(Cell::rate(&lost, share(&lost)).broken_if(0 < lost.count));
        }
        if tells_sources {
            cells.push(Cell::words(self.sources()));
        }
        cells
    }

    /// The false hit that passes its box by most, if that is more than rounding explains.
    pub fn far(&self) -> Option<(&'a BoxesRow, &'a Farthest)> {
        let rows = self.rows.iter().copied();
        let hits = rows.filter_map(|row| Some((row, row.farthest.as_ref()?)));
        let far = hits.filter(|(_, farthest)| ROUNDED < farthest.share);
        far.max_by(|(_, a), (_, b)| a.share.total_cmp(&b.share))
    }

    /// The share of rays at a wall that it loses in both neighbours.
    pub fn lost_in_both(&self) -> Option<String> {
        let at_walls = self.rows.iter();
        let lost = Rate::sum(at_walls.filter_map(|row| row.lost_in_both.as_ref()));
        (0 < lost.count).then(|| format!("{} {}", self.label, share(&lost)))
    }

    /// One sentence on its cases without a verdict.
    pub fn failures(&self) -> Option<String> {
        let failed: u64 = self.rows.iter().map(|row| row.failed).sum();
        let count = number_of(failed, "case", "cases");
        (0 < failed).then(|| format!("{} gives no verdict on {count}", self.label))
    }
}

/// `0`, or a share; a dash where there was no ray that it had to hit.
fn share(rate: &Rate) -> String {
    if rate.of == 0 {
        return "–".to_owned();
    }
    if rate.count == 0 {
        return "0".to_owned();
    }
    percent(rate.rate.unwrap_or(0.0))
}

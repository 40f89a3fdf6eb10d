//! Sums of what the triangles around edges and vertices did together: a commutative monoid.

use super::rays::{Aim, Part};
use crate::audit::GroupCount;
use crate::judge::GroupTruth;

/// The classes of rays, by how they meet their target: whether exactly, as the oracle says, and
/// whether they were made to graze a triangle.
pub const CLASSES: [&str; 4] = ["exact", "exact-grazing", "near", "near-grazing"];

/// What one class of rays did at one part of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClassSums {
    /// Crossings with cracks and doubles, folds with wrong parities.
    pub groups: GroupCount,
    /// Crossings with an even number of hits: there the parity is wrong.
    pub even: u64,
    /// Crossings without a hit whose hit may be among the neighbours: no cracks.
    pub elsewhere: u64,
    /// The first folds of wrong parity, by index.
    pub first_odd_folds: Vec<u64>,
    /// The first crossings whose hit may be elsewhere, by index.
    pub first_elsewhere: Vec<u64>,
}

/// Everything that is added up for one row at one part of a mesh in one scalar.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// By [`CLASSES`].
    pub classes: [ClassSums; 4],
    /// Rays on which the kernel gave no verdict on some triangle: they are not judged.
    pub failures: u64,
    /// The first of them, by index.
    pub first_failures: Vec<u64>,
    limit: usize,
}

/// What the contracts across triangles say of one ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// As it should be, or nothing was asked.
    Right,
    /// A crossing without a hit.
    Crack,
    /// A crossing without a hit, which a neighbour may have.
    Elsewhere,
    /// A crossing with two hits or more.
    Double,
    /// A fold of wrong parity.
    OddFold,
}

impl Outcome {
    /// Of a number of hits, the neighbours not asked.
    pub fn of(truth: GroupTruth, hits: usize) -> Outcome {
        match (truth, hits) {
            (GroupTruth::Crossing, 0) => Outcome::Crack,
            (GroupTruth::Crossing, 2..) => Outcome::Double,
            (GroupTruth::Fold { odd }, hits) if (hits % 2 == 1) != odd => Outcome::OddFold,
            _ => Outcome::Right,
        }
    }
}

/// An edge or vertex with a crack of some row, whatever its contract, or with a double or a wrong fold
/// of one that promises exactly one hit; and how many rays of all rows together say so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offence {
    /// Edge or vertex.
    pub part: Part,
    /// Which: its place among the targets.
    pub target: u32,
    /// Cracks.
    pub cracks: u32,
    /// Doubles, of rows that promise exactly one hit.
    pub doubles: u32,
    /// Folds of wrong parity, of rows that promise exactly one hit.
    pub odd_folds: u32,
}

impl Tally {
    /// Empty; keeps this many examples by index of each class and kind.
    pub fn new(limit: usize) -> Tally {
        Tally { limit, ..Tally::default() }
    }

    /// Counts a ray that was judged.
    pub fn add(
        &mut self,
        index: u64,
        (aim, on_target): (Aim, bool),
        (truth, hits): (GroupTruth, usize),
        outcome: Outcome,
    ) {
        let class = 2 * usize::from(!on_target) + usize::from(aim.grazing);
        let sums = &mut self.classes[class];
        if outcome == Outcome::Elsewhere {
            sums.groups.crossings += 1;
            sums.elsewhere += 1;
            if sums.first_elsewhere.len() < self.limit {
                sums.first_elsewhere.push(index);
            }
            return;
        }
        sums.groups.add(index, truth, hits, self.limit);
        sums.even += u64::from(truth == GroupTruth::Crossing && hits.is_multiple_of(2));
        if outcome == Outcome::OddFold && sums.first_odd_folds.len() < self.limit {
            sums.first_odd_folds.push(index);
        }
    }

    /// Counts a ray on which the kernel failed.
    pub fn fail(&mut self, index: u64) {
        self.failures += 1;
        if self.first_failures.len() < self.limit {
            self.first_failures.push(index);
        }
    }

    /// Adds another tally.
    pub fn merge(&mut self, other: Tally) {
        let limit = self.limit;
        let merge_first = |list: &mut Vec<u64>, more: Vec<u64>| {
            list.extend(more);
            list.sort_unstable();
            list.truncate(limit);
        };
        for (sums, more) in self.classes.iter_mut().zip(other.classes) {
            sums.groups.merge(more.groups, limit);
            sums.even += more.even;
            sums.elsewhere += more.elsewhere;
            merge_first(&mut sums.first_odd_folds, more.first_odd_folds);
            merge_first(&mut sums.first_elsewhere, more.first_elsewhere);
        }
        self.failures += other.failures;
        merge_first(&mut self.first_failures, other.first_failures);
    }
}

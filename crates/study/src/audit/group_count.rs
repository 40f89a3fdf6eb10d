//! Sums of what the triangles of groups did together: a commutative monoid.

use super::digest::{CasePlace, Digest};
use crate::judge::GroupTruth;
use serde::{Deserialize, Serialize};

/// A group that a kernel gave all verdicts on.
pub struct JudgedGroup {
    /// The index of the group in its source.
    pub index: u64,
    /// The contract's demand on the group.
    pub truth: GroupTruth,
    /// How many of its triangles are hit.
    pub hits: usize,
    /// True if no triangle is hit, and rounding may have moved the hit to a neighbour.
    pub elsewhere: bool,
}

/// Counts of the outcomes of groups.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GroupCount {
    /// Groups in which one hit is right.
    pub crossings: u64,
    /// Crossings without a hit.
    pub cracks: u64,
    /// Crossings with two hits or more.
    pub doubles: u64,
    /// Pairs that fold over their edge.
    pub folds: u64,
    /// Folds whose number of hits has the wrong parity.
    pub odd_folds: u64,
    /// Folds without a hit where the exact line has two.
    pub missed_folds: u64,
    /// Crossings on a mesh without a hit, which a neighbour may have: no cracks.
    pub elsewhere: u64,
    /// The first cracks, by index.
    pub first_cracks: Vec<u64>,
    /// The first doubles, by index.
    pub first_doubles: Vec<u64>,
    /// The first folds of wrong parity, by index.
    pub first_odd_folds: Vec<u64>,
    /// The first crossings whose hit may be elsewhere, by index.
    pub first_elsewhere: Vec<u64>,
    /// The digest of all cracks.
    pub crack_digest: Digest,
    /// The digest of all doubles.
    pub double_digest: Digest,
    /// The digest of all folds of wrong parity.
    pub odd_fold_digest: Digest,
}

/// The outcome of a group of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GroupOutcome {
    /// The number of hits is right, or the contract asks nothing.
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

impl GroupOutcome {
    fn of(group: &JudgedGroup) -> GroupOutcome {
        match (group.truth, group.hits) {
            (GroupTruth::Crossing, 0) if group.elsewhere => GroupOutcome::Elsewhere,
            (GroupTruth::Crossing, 0) => GroupOutcome::Crack,
            (GroupTruth::Crossing, 2..) => GroupOutcome::Double,
            (GroupTruth::Fold { odd }, hits) if (hits % 2 == 1) != odd => GroupOutcome::OddFold,
            _ => GroupOutcome::Right,
        }
    }
}

impl GroupCount {
    /// Counts a group; returns what it shows.
    pub(super) fn add(&mut self, group: &JudgedGroup, limit: usize) -> GroupOutcome {
        let JudgedGroup {
            index, truth, hits, ..
        } = *group;
        let outcome = GroupOutcome::of(group);
        match truth {
            GroupTruth::Free => {}
            GroupTruth::Crossing => self.crossings += 1,
            GroupTruth::Fold { odd } => {
                self.folds += 1;
                self.missed_folds += u64::from(hits == 0 && !odd);
            }
        }
        let (count, first, digest) = match outcome {
            GroupOutcome::Right => return outcome,
            GroupOutcome::Crack => (
                &mut self.cracks,
                &mut self.first_cracks,
                Some(&mut self.crack_digest),
            ),
            GroupOutcome::Elsewhere => (&mut self.elsewhere, &mut self.first_elsewhere, None),
            GroupOutcome::Double => (
                &mut self.doubles,
                &mut self.first_doubles,
                Some(&mut self.double_digest),
            ),
            GroupOutcome::OddFold => (
                &mut self.odd_folds,
                &mut self.first_odd_folds,
                Some(&mut self.odd_fold_digest),
            ),
        };
        *count += 1;
        if first.len() < limit {
            first.push(index);
        }
        if let Some(digest) = digest {
            let place = CasePlace { index, triangle: 0 };
            digest.add(place, Digest::hash(place));
        }
        outcome
    }

    /// Adds another count.
    pub(super) fn merge(&mut self, other: GroupCount, limit: usize) {
        self.crossings += other.crossings;
        self.cracks += other.cracks;
        self.doubles += other.doubles;
        self.folds += other.folds;
        self.odd_folds += other.odd_folds;
        self.missed_folds += other.missed_folds;
        self.elsewhere += other.elsewhere;
        self.crack_digest.merge(&other.crack_digest);
        self.double_digest.merge(&other.double_digest);
        self.odd_fold_digest.merge(&other.odd_fold_digest);
        for (list, more) in [
            (&mut self.first_cracks, other.first_cracks),
            (&mut self.first_doubles, other.first_doubles),
            (&mut self.first_odd_folds, other.first_odd_folds),
            (&mut self.first_elsewhere, other.first_elsewhere),
        ] {
            list.extend(more);
            list.sort_unstable();
            list.truncate(limit);
        }
    }
}

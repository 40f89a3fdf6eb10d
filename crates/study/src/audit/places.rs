//! Where a row went wrong on a mesh, up to a limit: cracks first, and otherwise spread over the mesh.

use crate::case::mix;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A fault at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum PlaceFault {
    /// A crossing without a hit.
    Crack,
    /// A crossing with two hits or more, of a row that promises exactly one.
    Double,
    /// A fold of wrong parity, of such a row.
    OddFold,
}

/// How often something is wrong at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FaultCount {
    /// How many rays show it.
    pub rays: u32,
    /// The index of the first of them.
    pub first: u64,
}

/// In the order in which they are kept: what is wrong, a scrambled number, the place among the targets.
type PlaceKey = (PlaceFault, u64, u32);

/// The first places in the order of their keys. What is kept does not depend on the order in which rays are
/// added: a place that is dropped has a limit's worth of places before it, and so it has in every sum.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Places(#[serde(with = "super::forms::pairs")] BTreeMap<PlaceKey, FaultCount>);

impl Places {
    /// Adds a ray.
    pub(super) fn add(&mut self, wrong: PlaceFault, target: u32, index: u64, limit: usize) {
        let key = (wrong, mix(u64::from(target)), target);
        self.add_seen(
            key,
            FaultCount {
                rays: 1,
                first: index,
            },
            limit,
        );
    }

    /// Adds another sum.
    pub(super) fn merge(&mut self, other: Places, limit: usize) {
        for (key, seen) in other.0 {
            self.add_seen(key, seen, limit);
        }
    }

    fn add_seen(&mut self, key: PlaceKey, seen: FaultCount, limit: usize) {
        let is_full = limit <= self.0.len();
        if is_full && self.0.last_key_value().is_none_or(|(last, _)| *last < key) {
            return;
        }
        let sum = self.0.entry(key).or_insert(FaultCount {
            rays: 0,
            first: u64::MAX,
        });
        *sum = FaultCount {
            rays: sum.rays + seen.rays,
            first: sum.first.min(seen.first),
        };
        if limit < self.0.len() {
            self.0.pop_last();
        }
    }

    /// Each fault with a number to merge several by, its target, and how often it was seen.
    pub fn iter(&self) -> impl Iterator<Item = ((PlaceFault, u64), u32, FaultCount)> + '_ {
        self.0
            .iter()
            .map(|((wrong, order, target), seen)| ((*wrong, *order), *target, *seen))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_does_not_depend_on_the_order_and_counts_all_rays() {
        let rays: Vec<(PlaceFault, u32, u64)> = (0..4000)
            .map(|index| {
                let wrong = [PlaceFault::Double, PlaceFault::Crack, PlaceFault::OddFold]
                    [mix(index) as usize % 3];
                (wrong, (mix(index + 9000) % 50) as u32, index)
            })
            .collect();
        let sum = |rays: &[(PlaceFault, u32, u64)], limit| {
            let mut places = Places::default();
            rays.iter()
                .for_each(|(wrong, target, i)| places.add(*wrong, *target, *i, limit));
            places
        };
        let all = sum(&rays, 1000);
        assert_eq!(all.iter().count(), 150);
        assert_eq!(all.iter().map(|(_, _, seen)| seen.rays).sum::<u32>(), 4000);
        for limit in [0, 1, 20, 60, 149] {
            let (front, back) = rays.split_at(1234);
            let mut merged = sum(back, limit);
            merged.merge(sum(front, limit), limit);
            assert_eq!(merged, sum(&rays, limit));
            let first: Vec<_> = all.iter().take(limit).collect();
            assert_eq!(merged.iter().collect::<Vec<_>>(), first);
        }
    }
}

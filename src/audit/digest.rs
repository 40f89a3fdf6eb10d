//! Places of cases, and a digest of a set of them that does not depend on the order in which they are
//! added.

use crate::case::mix;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Where a case stands in its source: the index, and the triangle of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Place {
    /// The index.
    pub index: u64,
    /// The triangle of a group; 0 alone.
    pub triangle: u32,
}

/// The sum, modulo 2^128, of a hash of each place. Adding is commutative, so the digest of a run does
/// not depend on threads or shards, and it takes no memory. Two sets of equal sum that differ are a
/// matter of chance (one in 2^128), not of care: it is no protection against forgery.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Digest(u128);

/// Keeps indices, triangles and the two halves apart: 2^64 divided by the golden ratio.
const STREAM: u64 = 0x9e37_79b9_7f4a_7c15;

impl Digest {
    /// Of one place.
    pub fn of(place: Place) -> Digest {
        let triangle = mix(u64::from(place.triangle) ^ STREAM);
        let low = mix(place.index ^ triangle);
        let high = mix(low.wrapping_add(place.index ^ STREAM));
        Digest(u128::from(high) << 64 | u128::from(low))
    }

    /// Adds a place.
    pub fn add(&mut self, place: Place) {
        self.merge(Digest::of(place));
    }

    /// Adds what another part of the set gave.
    pub fn merge(&mut self, other: Digest) {
        self.0 = self.0.wrapping_add(other.0);
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl From<Digest> for String {
    fn from(digest: Digest) -> String {
        digest.to_string()
    }
}

impl TryFrom<String> for Digest {
    type Error = String;

    fn try_from(text: String) -> Result<Digest, String> {
        let sum = u128::from_str_radix(&text, 16);
        sum.map(Digest).map_err(|_| format!("'{text}' is not a digest"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn digest(places: &[(u64, u32)]) -> Digest {
        let mut digest = Digest::default();
        places.iter().for_each(|&(index, triangle)| digest.add(Place { index, triangle }));
        digest
    }

    #[test]
    fn order_and_split_do_not_matter_and_every_place_does() {
        let whole = digest(&[(1, 0), (2, 0), (2, 1), (9, 3)]);
        assert_eq!(whole, digest(&[(9, 3), (2, 1), (1, 0), (2, 0)]));
        let mut parts = digest(&[(2, 1)]);
        parts.merge(digest(&[(1, 0), (9, 3), (2, 0)]));
        assert_eq!(parts, whole);
        let others = [&[(1, 0), (2, 0), (2, 1)][..], &[(1, 0), (2, 0), (2, 1), (3, 9)], &[]];
        assert!(others.iter().all(|places| digest(places) != whole));
        assert_eq!(Digest::try_from(whole.to_string()), Ok(whole));
        // Index and triangle are not exchangeable, and no small places collide.
        let all = (0..100).flat_map(|i| (0..100).map(move |k| digest(&[(i, k)]).to_string()));
        assert_eq!(all.collect::<BTreeSet<_>>().len(), 10_000);
    }
}

//! `lattice`: every case with all 15 coordinates in {-1, 0, 1}: every combinatorial situation there
//! is. Sums and products on it are exact in every scalar.

use super::integer::{IntegerCase, LatticePoint};
use super::{CaseGroup, Promise, Recipe};
use crate::case::Draw;
use crate::kernel::Scalar;

/// 3^15.
pub const LATTICE_SIZE: u64 = 14_348_907;

pub(super) struct Lattice;

impl Recipe for Lattice {
    const NAME: &'static str = "lattice";
    const PROMISE: &'static str = "all coordinates in {-1, 0, 1}, default interval";
    const KEEPS: Promise = Promise::Truths(|_| true);

    const HAS_OWN_INTERVAL: bool = true;

    fn make<F: Scalar>(_: &mut Draw, index: u64) -> CaseGroup<F> {
        let mut rest = index;
        let [origin, direction, a, b, c] = std::array::from_fn(|_| {
            LatticePoint::from_array(std::array::from_fn(|_| {
                let digit = rest % 3;
                rest /= 3;
                digit as i64 - 1
            }))
        });
        IntegerCase {
            origin,
            direction,
            triangle: [a, b, c],
        }
        .made()
    }
}

/// A fixed bijection of the indices for each seed: multiplication by a number prime to 3, and a
/// shift.
pub(super) fn shuffled(index: u64, seed: u64) -> u64 {
    let size = u128::from(LATTICE_SIZE);
    let shift = u128::from(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) % LATTICE_SIZE);
    ((u128::from(index) * 8_867_443 + shift) % size) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shuffle_visits_every_case_once() {
        let mut seen = vec![false; LATTICE_SIZE as usize];
        for index in 0..LATTICE_SIZE {
            let place = &mut seen[shuffled(index, 7) as usize];
            assert!(!*place);
            *place = true;
        }
    }
}

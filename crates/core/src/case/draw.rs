//! Random numbers of cases.

use crate::arith::{Float, scale_by_power_of_two};

/// Random numbers of one case: a stream that depends on (family, seed, index) only, so that case i
/// never depends on case i-1. SplitMix64 (Steele, Lea and Flood 2014) from a mixed start.
///
/// Integers and IEEE + - × ÷ √ only: functions in which libraries differ never enter a case.
#[derive(Clone, Debug)]
pub struct Draw {
    state: u64,
}

impl Draw {
    /// The stream of case `index` of a family's set.
    pub fn new(family: &str, seed: u64, index: u64) -> Draw {
        // FNV-1a of the name keeps the families' streams apart.
        let name = family
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
            });
        Draw {
            state: mix(name ^ mix(seed.wrapping_add(mix(index)))),
        }
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix(self.state)
    }

    /// A uniform integer in `low..=high` (within 2^-32 for the ranges that families use).
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        let span = u128::from(high.abs_diff(low)) + 1;
        low + ((u128::from(self.bits()) * span) >> 64) as i64
    }

    /// An index below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.integer(0, count as i64 - 1) as usize
    }

    /// One of the elements.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// True once in two.
    pub fn coin(&mut self) -> bool {
        self.bits() >> 63 == 1
    }

    /// A number in [0, 1) on the grid of 2^-53.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// A number in [-1, 1] with a full significand at every magnitude.
    pub fn symmetric<F: Float>(&mut self) -> F {
        let exponent = -1 - self.bits().trailing_zeros().min(40) as i32;
        self.with_exponent(exponent)
    }

    /// A number of either sign with a random significand and a given binary exponent, which lies in
    /// the scalar's range (subnormals included).
    pub fn with_exponent<F: Float>(&mut self, exponent: i32) -> F {
        let significand = 1.0 + (self.bits() >> 12) as f64 * (1.0 / (1u64 << 52) as f64);
        let value = F::from_f64(scale_by_power_of_two(significand, exponent));
        if self.coin() { -value } else { value }
    }

    /// Three of [`Draw::symmetric`].
    pub fn point<F: Float>(&mut self) -> [F; 3] {
        std::array::from_fn(|_| self.symmetric())
    }

    /// Three integers in `-bound..=bound`.
    pub fn lattice_point(&mut self, bound: i64) -> [i64; 3] {
        std::array::from_fn(|_| self.integer(-bound, bound))
    }
}

pub fn mix(value: u64) -> u64 {
    let z = (value ^ value >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_depend_on_family_seed_and_index_only() {
        let first = Draw::new("edge-near", 1, 2).bits();
        assert_eq!(first, Draw::new("edge-near", 1, 2).bits());
        for other in [
            ("edge-exact", 1, 2),
            ("edge-near", 2, 2),
            ("edge-near", 1, 3),
        ] {
            assert_ne!(first, Draw::new(other.0, other.1, other.2).bits());
        }
    }
}

//! Bytes read from the front; where they end, zeros follow.

use crate::arith::Float;

/// The rest of an input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    pub fn byte(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    /// A byte taken as a number below `count`.
    pub fn below(&mut self, count: u8) -> u8 {
        self.byte() % count
    }

    /// A small integer, -`bound` to `bound`.
    pub fn small(&mut self, bound: u8) -> i64 {
        i64::from(self.below(2 * bound + 1)) - i64::from(bound)
    }

    /// A float's bits, low byte first: four bytes or eight.
    pub fn number<F: Float>(&mut self) -> F {
        if F::NAME == f32::NAME {
            F::from_bits(u32::from_le_bytes(self.take()).into())
        } else {
            F::from_bits(u64::from_le_bytes(self.take()))
        }
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (taken, rest) = self.0.split_at(N.min(self.0.len()));
        self.0 = rest;
        std::array::from_fn(|i| taken.get(i).copied().unwrap_or(0))
    }
}

/// As [`Bytes::number`] reads it.
pub(super) fn push_number<F: Float>(bytes: &mut Vec<u8>, number: F) {
    let all = number.to_bits().to_le_bytes();
    bytes.extend_from_slice(&all[..if F::NAME == f32::NAME { 4 } else { 8 }]);
}

//! Integers of 192 bits: what determinants of coordinates of 61 bits need, and no more than that.

use num_bigint::BigInt;
use std::ops::{Add, Sub};

/// `high * 2^64 + low`. Ordered by value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct I192 {
    high: i128,
    low: u64,
}

impl I192 {
    /// The product of any `a` and of a `b` below 2^126 in absolute value.
    #[inline(always)]
    pub fn product(a: i64, b: i128) -> I192 {
        let a = i128::from(a);
        let low = a * i128::from(b as u64);
        I192 { high: a * (b >> 64) + (low >> 64), low: low as u64 }
    }
}

impl Add for I192 {
    type Output = I192;
    #[inline(always)]
    fn add(self, other: I192) -> I192 {
        let (low, carry) = self.low.overflowing_add(other.low);
        I192 { high: self.high + other.high + i128::from(carry), low }
    }
}

impl Sub for I192 {
    type Output = I192;
    #[inline(always)]
    fn sub(self, other: I192) -> I192 {
        let (low, borrow) = self.low.overflowing_sub(other.low);
        I192 { high: self.high - other.high - i128::from(borrow), low }
    }
}

impl From<I192> for BigInt {
    fn from(I192 { high, low }: I192) -> BigInt {
        (BigInt::from(high) << 64) + low
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use crate::oracle::integer::ExactInteger;

    /// Numbers near the ends of their bits, near zero, and between.
    fn number(draw: &mut Draw, bits: u32) -> i128 {
        let most = (1i128 << bits) - 1;
        let near = i128::from(draw.integer(0, 2));
        let any = (i128::from(draw.bits()) << 64 | i128::from(draw.bits())) & most;
        let carry = i128::from(u64::MAX) & most;
        let x = draw.pick(&[near, most - near, any, any >> (bits / 2), (carry + near) & most]);
        if draw.coin() { x } else { -x }
    }

    #[test]
    fn products_sums_and_orders_are_those_of_integers_of_any_size() {
        let mut carries = 0;
        for index in 0..20_000 {
            let mut draw = Draw::new("wide", 1, index);
            let mut product = || {
                let (a, b) = (number(&mut draw, 63) as i64, number(&mut draw, 125));
                let product = I192::product(a, b);
                assert_eq!(product.big(), BigInt::from(a) * BigInt::from(b), "{a} {b}");
                product
            };
            let (x, y) = (product(), product());
            let (sum, difference) = (x + y, x - y);
            assert_eq!(sum.big(), x.big() + y.big(), "{x:?} {y:?}");
            assert_eq!(difference.big(), x.big() - y.big(), "{x:?} {y:?}");
            assert_eq!(difference.sign(), x.big().cmp(&y.big()), "{x:?} {y:?}");
            assert_eq!(x.sign(), x.big().cmp(&BigInt::ZERO), "{x:?}");
            carries += usize::from(sum.high != x.high + y.high);
        }
        assert!(carries > 1000, "{carries}");
    }
}

//! The integers of a grid: how many bits a coordinate has, and what holds minors and determinants.
//!
//! With n bits a coordinate is below 2^n, a difference below 2^(n+1), a minor of differences and the normal
//! below 2^(2n+3), and a determinant of differences below 2^(3n+6).

use super::integer::{ExactInteger, Integer};
use num_bigint::BigInt;
use std::ops::{Add, Sub};

/// Integers for coordinates of some bits. Coordinates and differences are `i64`.
pub(super) trait Width {
    /// Bits of a coordinate.
    const BITS: i32;
    /// How many numbers are rounded before it is asked whether they are on the grid.
    const AT_ONCE: usize;
    /// Holds a minor, and a sum of three.
    type Minor: ExactInteger + Copy + Add<Output = Self::Minor> + Sub<Output = Self::Minor>;
    /// Holds a determinant.
    type Determinant: ExactInteger
        + Copy
        + Add<Output = Self::Determinant>
        + Sub<Output = Self::Determinant>;
    /// Holds what contacts are made of.
    type Contact: Integer + From<i64> + From<Self::Minor>;

    /// A float below 2^[`Width::BITS`] as an integer, and that again as a float: the same if it was one.
    fn rounded(x: f64) -> (i64, f64);
    /// The product of two differences.
    fn product(a: i64, b: i64) -> Self::Minor;
    /// The product of a difference and a minor.
    fn wide_product(a: i64, b: Self::Minor) -> Self::Determinant;
}

/// 30 bits: minors in 64, determinants in 128. What n bits are said to need above is a little more than they do:
/// products of two differences below 2^31 are below 2^62, the difference of two and the normal, which is one,
/// below 2^63.
pub(super) struct Narrow;

impl Width for Narrow {
    const BITS: i32 = 30;
    // Vectors.
    const AT_ONCE: usize = 12;
    type Minor = i64;
    type Determinant = i128;
    type Contact = i128;

    #[inline(always)]
    fn rounded(x: f64) -> (i64, f64) {
        /// Adding and subtracting it rounds a number below 2^51 to an integer; the sum's low bits are it.
        const TO_INTEGER: f64 = 1.5 * (1u64 << 52) as f64;
        let shifted = x + TO_INTEGER;
        let integer = shifted.to_bits().wrapping_sub(TO_INTEGER.to_bits()) as i64;
        (integer, shifted - TO_INTEGER)
    }
    #[inline(always)]
    fn product(a: i64, b: i64) -> i64 {
        a * b
    }
    #[inline(always)]
    fn wide_product(a: i64, b: i64) -> i128 {
        i128::from(a) * i128::from(b)
    }
}

/// 61 bits: minors in 128, determinants in 192.
pub(super) struct Wide;

impl Width for Wide {
    const BITS: i32 = 61;
    // Most of what is on no grid shows it at its first points.
    const AT_ONCE: usize = 3;
    type Minor = i128;
    type Determinant = I192;
    type Contact = BigInt;

    #[inline(always)]
    fn rounded(x: f64) -> (i64, f64) {
        let integer = x as i64;
        (integer, integer as f64)
    }
    #[inline(always)]
    fn product(a: i64, b: i64) -> i128 {
        i128::from(a) * i128::from(b)
    }
    #[inline(always)]
    fn wide_product(a: i64, b: i128) -> I192 {
        I192::product(a, b)
    }
}

/// An integer of 192 bits: what determinants of coordinates of 61 bits need, and no more than that.
///
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
        I192 {
            high: a * (b >> 64) + (low >> 64),
            low: low as u64,
        }
    }
}

impl Add for I192 {
    type Output = I192;
    #[inline(always)]
    fn add(self, other: I192) -> I192 {
        let (low, carry) = self.low.overflowing_add(other.low);
        I192 {
            high: self.high + other.high + i128::from(carry),
            low,
        }
    }
}

impl Sub for I192 {
    type Output = I192;
    #[inline(always)]
    fn sub(self, other: I192) -> I192 {
        let (low, borrow) = self.low.overflowing_sub(other.low);
        I192 {
            high: self.high - other.high - i128::from(borrow),
            low,
        }
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

    /// Numbers near the ends of their bits, near zero, and between.
    fn number(draw: &mut Draw, bits: u32) -> i128 {
        let most = (1i128 << bits) - 1;
        let near = i128::from(draw.integer(0, 2));
        let any = (i128::from(draw.bits()) << 64 | i128::from(draw.bits())) & most;
        let carry = i128::from(u64::MAX) & most;
        let x = draw.pick(&[
            near,
            most - near,
            any,
            any >> (bits / 2),
            (carry + near) & most,
        ]);
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

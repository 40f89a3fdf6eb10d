//! The integers of a grid: how many bits a coordinate has, and what holds minors and determinants.
//!
//! With n bits a coordinate is below 2^n, a difference below 2^(n+1), a minor of differences and the normal
//! below 2^(2n+3), and a determinant of differences below 2^(3n+6).

use super::fixed::I192;
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

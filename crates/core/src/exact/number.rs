//! The constants of a margin, for each format that is computed in.

use crate::arith::Float;

/// A format that the numbers of a test are computed in. docs/design/margin.md says where the constants come from.
pub trait Number: Float {
    /// 9.25 u, u half the distance from 1 to the next float: the error of a sum of products of three vectors that pass at
    /// most 8 roundings, relative to the product of the vectors' lengths.
    const ROUNDING: Self;
    /// Its square is more than underflow can add. Unit: that of the inputs.
    const LEAST: Self;
    /// Coordinates and lengths up to which no product overflows.
    const LARGEST: Self;
    /// An end of a ray beyond this counts as this, and proves no miss.
    const FAR: Self;
    /// The largest ratio of margin and determinant with which the values of a hit are taken as computed.
    const SHARE: Self;
}

impl Number for f32 {
    const ROUNDING: f32 = 4.625 * f32::EPSILON;
    const LEAST: f32 = 1.0 / (1u64 << 59) as f32;
    const LARGEST: f32 = (1u64 << 27) as f32;
    const FAR: f32 = (1u64 << 40) as f32;
    const SHARE: f32 = 1.0;
}

impl Number for f64 {
    const ROUNDING: f64 = 4.625 * f64::EPSILON;
    const LEAST: f64 = f64::from_bits((1023 - 506) << 52);
    const LARGEST: f64 = f64::from_bits((1023 + 280) << 52);
    const FAR: f64 = f64::from_bits((1023 + 128) << 52);
    const SHARE: f64 = 1.0 / (1u64 << 25) as f64;
}

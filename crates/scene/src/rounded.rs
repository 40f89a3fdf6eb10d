//! The nearest double to a rational.

use hairline_core::arith::scale_by_power_of_two;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

/// The nearest double to a rational, ties to even: correctly rounded, subnormal numbers and overflow included.
pub fn rounded(x: &BigRational) -> f64 {
    rounded_quotient(x.numer(), x.denom(), 0)
}

/// The same for a quotient of integers times 2 to a power. The denominator is positive, and may have a factor in common with the numerator.
pub fn rounded_quotient(numerator: &BigInt, denominator: &BigInt, exponent: i64) -> f64 {
    let size = size_rounded(numerator.abs(), denominator.clone(), exponent);
    match numerator.is_negative() {
        true => -size,
        false => size,
    }
}

/// The same for a numerator that is not negative.
fn size_rounded(mut numerator: BigInt, mut denominator: BigInt, exponent: i64) -> f64 {
    if numerator.is_zero() {
        return 0.0;
    }
    // A quotient of 55 or 56 bits, and one more that says if anything is left.
    let shift = 55 + denominator.bits() as i64 - numerator.bits() as i64;
    if shift >= 0 {
        numerator <<= shift;
    } else {
        denominator <<= -shift;
    }
    let quotient = &numerator / &denominator;
    let is_inexact = &quotient * denominator != numerator;
    let quotient = quotient.to_u64().expect("a quotient of 56 bits at most");
    let digits = quotient << 1 | u64::from(is_inexact);
    let unit = exponent - shift - 1;
    // The unit in the last place of the result.
    let leading = unit + 63 - i64::from(digits.leading_zeros());
    let last = (leading - 52).max(-1074);
    let dropped = last - unit;
    if dropped >= 64 {
        return 0.0;
    }
    let kept = digits >> dropped;
    let rest = digits - (kept << dropped);
    let half = 1 << (dropped - 1);
    let goes_up = half < rest || (half == rest && kept % 2 == 1);
    let kept = kept + u64::from(goes_up);
    // Exact, or an overflow: 2^53 at most times a power of two.
    scale_by_power_of_two(kept as f64, last.min(2000) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hairline_core::case::Draw;

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).unwrap()
    }

    /// Halfway between a float and the next larger one; beyond the largest one as if there were another.
    fn middle_above(x: f64) -> BigRational {
        let below = exact(x) - exact(x.next_down());
        let step = match x.next_up() {
            f64::INFINITY => below,
            next => exact(next) - exact(x),
        };
        exact(x) + step / BigInt::from(2)
    }

    #[test]
    fn floats_and_the_middles_between_them_are_rounded_to_even() {
        let tiny = exact(f64::from_bits(1)) * exact(f64::from_bits(1));
        for index in 0..4000 {
            let mut draw = Draw::new("rounded", 1, index);
            let bits = draw.bits() >> 1;
            let any = f64::from_bits(draw.pick(&[bits, bits >> 12, bits >> 40]));
            let ends = [
                f64::MAX,
                f64::MIN_POSITIVE,
                f64::MIN_POSITIVE.next_down(),
                1.0,
            ];
            let end = draw.pick(&ends);
            let x = draw.pick(&[any, any, end]);
            if !x.is_finite() {
                continue;
            }
            assert_eq!(rounded(&exact(x)), x);
            assert_eq!(rounded(&-exact(x)), -x);
            let middle = middle_above(x);
            let even = if x.to_bits().is_multiple_of(2) {
                x
            } else {
                x.next_up()
            };
            assert_eq!(rounded(&middle), even, "{x:e}");
            assert_eq!(rounded(&(&middle - &tiny)), x, "{x:e}");
            assert_eq!(rounded(&(&middle + &tiny)), x.next_up(), "{x:e}");
        }
        assert_eq!(rounded(&(exact(f64::MAX) * exact(f64::MAX))), f64::INFINITY);
        assert_eq!(rounded(&tiny), 0.0);
    }
}

//! Numbers of the vectors as text: bit patterns, hexadecimal floats, and the doubles nearest to fractions.

use crate::arith::{Float, decompose, smallest_normal};
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// A float of either scalar.
pub(super) struct EitherFloat {
    /// The bit pattern in hexadecimal, all digits.
    pub bits: String,
    /// True if its square is beyond the range of its scalar, or below the normal numbers.
    pub is_extreme: bool,
    value: f64,
}

impl EitherFloat {
    pub fn of<F: Float>(x: F) -> EitherFloat {
        let square = x * x;
        let is_normal = square.is_finite() && smallest_normal::<F>() <= square.to_f64();
        EitherFloat {
            bits: x.hex(),
            is_extreme: x.is_finite() && !x.is_zero() && !is_normal,
            value: x.to_f64(),
        }
    }

    /// As C, Python and Java read it: `-0x1.8p-3`, `Infinity`, `NaN`.
    pub fn text(&self) -> String {
        let sign = if self.value.is_sign_negative() {
            "-"
        } else {
            ""
        };
        if self.value.is_nan() {
            return "NaN".to_owned();
        }
        if self.value.is_infinite() {
            return format!("{sign}Infinity");
        }
        let (odd, exponent) = decompose(self.value.abs());
        if odd == 0 {
            return format!("{sign}0x0p0");
        }
        let places = odd.ilog2();
        // What follows the leading one, from the left.
        let fraction = (u128::from(odd as u64) << (64 - places)) as u64;
        let fraction = format!("{fraction:016x}");
        let fraction = fraction.trim_end_matches('0');
        let point = if fraction.is_empty() { "" } else { "." };
        format!(
            "{sign}0x1{point}{fraction}p{}",
            exponent + i64::from(places)
        )
    }
}

/// The double nearest to a fraction, ties to even; infinite beyond the largest.
pub(super) fn nearest(value: &BigRational) -> f64 {
    value.to_f64().expect("a fraction is no NaN")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use crate::files::number::parse;

    #[test]
    fn a_float_is_written_as_its_bits_and_as_a_literal_that_reads_back() {
        for (x, text) in [
            (1.0, "0x1p0"),
            (-0.0, "-0x0p0"),
            (-0.1875, "-0x1.8p-3"),
            (f64::from_bits(1), "0x1p-1074"),
            (f64::MAX, "0x1.fffffffffffffp1023"),
            (f64::NEG_INFINITY, "-Infinity"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(EitherFloat::of(x).text(), text);
        }
        assert_eq!(EitherFloat::of(f32::from_bits(1)).text(), "0x1p-149");
        assert_eq!(EitherFloat::of(1f32).bits, "3f800000");
        let mut draw = Draw::new("numbers", 1, 1);
        for _ in 0..1000 {
            let x = f64::from_bits(draw.bits());
            if x.is_finite() {
                assert_eq!(parse::<f64>(&EitherFloat::of(x).text()), Ok(x));
            }
        }
    }

    #[test]
    fn fractions_are_rounded_to_nearest_and_ties_to_even() {
        let ratio = |p: i128, q: i128| BigRational::new(p.into(), q.into());
        assert_eq!(nearest(&ratio(1, 3)), 1.0 / 3.0);
        assert_eq!(nearest(&ratio(0, 1)), 0.0);
        assert_eq!(nearest(&ratio(-22, 7)), -22.0 / 7.0);
        let tie = (1 << 53) + 1;
        assert_eq!(nearest(&ratio(tie, 1)), (1u64 << 53) as f64);
        assert_eq!(nearest(&ratio(tie + 2, 1)), ((1u64 << 53) + 4) as f64);
        assert_eq!(nearest(&ratio(3 * tie + 1, 3)), ((1u64 << 53) + 2) as f64);
        let big = ratio(1, 1) * num_traits::pow(ratio(10, 1), 400);
        assert_eq!(nearest(&big), f64::INFINITY);
        assert_eq!(nearest(&big.recip()), 0.0);
        let least = BigRational::from_float(f64::from_bits(1)).unwrap();
        assert_eq!(nearest(&(&least * ratio(3, 4))), f64::from_bits(1));
        assert_eq!(nearest(&(&least * ratio(3, 2))), f64::from_bits(2));
        assert_eq!(nearest(&(&least * ratio(1, 2))), 0.0);
    }
}

//! Exact numbers as decimals: seventeen significant digits, correctly rounded.

use crate::arith::{Exact, Fraction};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::fmt;
use std::str::FromStr;

/// Significant digits: as many as tell any two `f64` apart.
const DIGITS: u32 = 17;

/// The bits after the point of a square root, from the first attempt to the last.
const ROOT_BITS: [u64; 5] = [128, 512, 2048, 8192, 32768];

/// A number that is not negative, rounded to seventeen significant digits. Ordered by value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Decimal {
    /// The power of ten of the first digit; the least of all for zero.
    exponent: i64,
    /// 10^16 to 10^17 - 1, or 0.
    digits: u64,
}

impl Decimal {
    /// Zero.
    pub const ZERO: Decimal = Decimal {
        exponent: i64::MIN,
        digits: 0,
    };

    /// The decimal nearest to an exact number, ties to even. None of NaN, an infinity or a negative
    /// number.
    pub fn of(value: &Exact) -> Option<Decimal> {
        match value {
            Exact::Nan | Exact::Infinite(_) => None,
            Exact::Rational(p) => Decimal::of_rational(&p.to_rational()),
            Exact::Root { p, q, r } => Decimal::of_root(p, q, r),
        }
    }

    fn of_rational(value: &BigRational) -> Option<Decimal> {
        if value.is_zero() {
            return Some(Decimal::ZERO);
        }
        if value.is_negative() {
            return None;
        }
        // From the sizes in bits the power of ten is right or one off.
        let bits = value.numer().bits() as f64 - value.denom().bits() as f64;
        let mut exponent = (bits * std::f64::consts::LOG10_2).floor() as i64;
        loop {
            let digits = rounded(value, i64::from(DIGITS) - 1 - exponent);
            match digits.to_u64() {
                Some(digits) if digits < 10u64.pow(DIGITS - 1) => exponent -= 1,
                Some(digits) if digits < 10u64.pow(DIGITS) => {
                    return Some(Decimal { exponent, digits });
                }
                _ => exponent += 1,
            }
        }
    }

    /// `p + q√r` between two rationals that round alike.
    fn of_root(p: &Fraction, q: &Fraction, r: &Fraction) -> Option<Decimal> {
        let [p, q, r] = [p, q, r].map(Fraction::to_rational);
        ROOT_BITS.into_iter().find_map(|bits| {
            let [below, above] = root_bounds(&r, bits).map(|root| &p + &q * root);
            let below = Decimal::of_rational(&below)?;
            (Decimal::of_rational(&above)? == below).then_some(below)
        })
    }

    /// Rounded to some digits, 1 to 17, a half upwards.
    pub fn rounded(self, digits: u32) -> Decimal {
        let unit = 10u64.pow(DIGITS - digits);
        let rounded = (self.digits + unit / 2) / unit * unit;
        match rounded == 10u64.pow(DIGITS) {
            true => Decimal {
                exponent: self.exponent + 1,
                digits: rounded / 10,
            },
            false => Decimal {
                digits: rounded,
                ..self
            },
        }
    }

    /// Rounded to some digits, with zeros at the end.
    pub fn with_digits(self, digits: u32) -> String {
        let Decimal {
            exponent,
            digits: all,
        } = self.rounded(digits);
        if all == 0 {
            return "0".to_owned();
        }
        scientific(&(all / 10u64.pow(DIGITS - digits)).to_string(), exponent)
    }

    /// Rounded to four digits, for people.
    pub fn brief(self) -> String {
        self.with_digits(4)
    }

    /// The nearest `f64`; infinite beyond its range.
    pub fn to_f64(self) -> f64 {
        self.to_string().parse().unwrap_or(f64::NAN)
    }
}

/// `1.25e-3`: a point after the first digit.
fn scientific(digits: &str, exponent: i64) -> String {
    let (first, rest) = digits.split_at(1);
    let point = if rest.is_empty() { "" } else { "." };
    format!("{first}{point}{rest}e{exponent}")
}

/// `value * 10^power`, rounded to an integer, ties to even.
fn rounded(value: &BigRational, power: i64) -> BigInt {
    let ten = num_traits::pow(BigInt::from(10), power.unsigned_abs() as usize);
    let (numerator, denominator) = if power < 0 {
        (value.numer().clone(), value.denom() * ten)
    } else {
        (value.numer() * ten, value.denom().clone())
    };
    let (quotient, rest): (BigInt, BigInt) = (&numerator / &denominator, &numerator % &denominator);
    let up = match (rest * 2u8).cmp(&denominator) {
        std::cmp::Ordering::Less => false,
        std::cmp::Ordering::Equal => quotient.bit(0),
        std::cmp::Ordering::Greater => true,
    };
    if up {
        quotient + BigInt::one()
    } else {
        quotient
    }
}

/// Rationals below and above √r, 2^-bits over the denominator of r apart; equal if √r is one of them.
fn root_bounds(r: &BigRational, bits: u64) -> [BigRational; 2] {
    // √(n/d) = √(n·d) / d.
    let square = (r.numer() * r.denom()) << (2 * bits);
    let root = square.sqrt();
    let exact = &root * &root == square;
    let denominator = r.denom() << bits;
    let above = if exact {
        root.clone()
    } else {
        &root + BigInt::one()
    };
    [root, above].map(|root| BigRational::new(root, denominator.clone()))
}

impl fmt::Display for Decimal {
    /// `1.25e-3`: without zeros at the end.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.digits == 0 {
            return f.write_str("0");
        }
        let digits = self.digits.to_string();
        f.write_str(&scientific(digits.trim_end_matches('0'), self.exponent))
    }
}

impl FromStr for Decimal {
    type Err = String;

    /// Reads what `Display` writes, and nothing else.
    fn from_str(text: &str) -> Result<Decimal, String> {
        let parsed = || -> Option<Decimal> {
            if text == "0" {
                return Some(Decimal::ZERO);
            }
            let (digits, exponent) = text.split_once('e')?;
            let (first, rest) = digits.split_once('.').unwrap_or((digits, ""));
            let padded = format!("{first}{rest:0<16}");
            let digits = padded
                .parse()
                .ok()
                .filter(|_| padded.len() == DIGITS as usize)?;
            Some(Decimal {
                exponent: exponent.parse().ok()?,
                digits,
            })
        };
        parsed()
            .filter(|decimal| decimal.to_string() == text)
            .ok_or_else(|| format!("'{text}' is not a score: expected digits as 1.25e-3"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::Real;

    fn of(value: f64) -> String {
        Decimal::of(&Exact::from_f64(value)).unwrap().to_string()
    }

    #[test]
    fn rationals_are_rounded_to_seventeen_digits() {
        assert_eq!(of(0.0), "0");
        assert_eq!(of(1.0), "1e0");
        assert_eq!(of(1234.5), "1.2345e3");
        assert_eq!(of(0.1), "1.0000000000000001e-1");
        assert_eq!(of(f64::from_bits(1)), "4.9406564584124654e-324");
        assert_eq!(of(f64::MAX), "1.7976931348623157e308");
        let third = Exact::one() / Exact::from_f64(3.0);
        assert_eq!(
            Decimal::of(&third).unwrap().to_string(),
            "3.3333333333333333e-1"
        );
        let two_thirds = Exact::from_f64(2.0) / Exact::from_f64(3.0);
        assert_eq!(
            Decimal::of(&two_thirds).unwrap().to_string(),
            "6.6666666666666667e-1"
        );
        // Seventeen nines and a half round up to a power of ten.
        let nines = Exact::from_f64(1e17) * Exact::from_f64(10.0) - Exact::from_f64(1.0);
        assert_eq!(Decimal::of(&nines).unwrap().to_string(), "1e18");
        assert_eq!(Decimal::of(&-Exact::one()), None);
        assert_eq!(Decimal::of(&Exact::infinity()), None);
    }

    #[test]
    fn roots_are_rounded_right_through_cancellation() {
        let two = Exact::from_f64(2.0).sqrt();
        assert_eq!(
            Decimal::of(&two).unwrap().to_string(),
            "1.414213562373095e0"
        );
        // √2 against its nearest f64: it is 9.66729331345291303718…e-17 above it.
        let rest = Exact::from_f64(2f64.sqrt()) - two;
        assert_eq!(
            Decimal::of(&rest).unwrap().to_string(),
            "9.667293313452913e-17"
        );
        assert_eq!(
            Decimal::of(&Exact::from_f64(9.0).sqrt())
                .unwrap()
                .to_string(),
            "3e0"
        );
    }

    #[test]
    fn four_digits_are_rounded_into_the_next_power_of_ten() {
        let brief = |text: &str| text.parse::<Decimal>().unwrap().brief();
        assert_eq!(brief("9.9995e-2"), "1.000e-1");
        assert_eq!(brief("9.9994e411"), "9.999e411");
        assert_eq!(brief("1e0"), "1.000e0");
        assert_eq!(Decimal::ZERO.brief(), "0");
        let third: Decimal = "3.3333333333333333e-1".parse().unwrap();
        assert_eq!(
            (third.with_digits(1), third.with_digits(7)),
            ("3e-1".into(), "3.333333e-1".into())
        );
        assert_eq!(third.rounded(17), third);
    }

    #[test]
    fn decimals_survive_their_text_and_keep_their_order() {
        let values = [0.0, 1e-300, 0.25, 0.3, 1.0, 1.0 + f64::EPSILON, 7e22];
        let decimals: Vec<Decimal> = values
            .iter()
            .map(|x| Decimal::of(&Exact::from_f64(*x)).unwrap())
            .collect();
        assert!(decimals.is_sorted_by(|a, b| a < b));
        for (decimal, value) in decimals.iter().zip(values) {
            assert_eq!(decimal.to_string().parse(), Ok(*decimal));
            assert_eq!(decimal.to_f64(), value);
        }
        for bad in [
            "",
            "1",
            "1.50e3",
            "-1e0",
            "12e0",
            "1.25",
            "0e0",
            "1e0x",
            "1.12345678901234567e0",
        ] {
            assert!(bad.parse::<Decimal>().is_err(), "{bad}");
        }
    }
}

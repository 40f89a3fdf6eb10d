//! Rationals that are never reduced, with a power of two beside them.

use super::decompose;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive};
use std::cmp::Ordering;

/// A rational `numerator / denominator * 2^exponent`, never reduced by a gcd: on the short formulas
/// of a kernel the digits grow less than gcds cost.
#[derive(Clone, Debug)]
pub struct Fraction {
    numerator: BigInt,
    /// Positive.
    denominator: BigInt,
    exponent: i64,
}

impl Fraction {
    /// The exact value of a finite float.
    pub fn from_f64(value: f64) -> Fraction {
        let (digits, exponent) = decompose(value);
        Fraction {
            numerator: BigInt::from(digits),
            denominator: BigInt::one(),
            exponent,
        }
    }

    /// The same value.
    pub fn from_rational(value: &BigRational) -> Fraction {
        Fraction {
            numerator: value.numer().clone(),
            denominator: value.denom().clone(),
            exponent: 0,
        }
    }

    /// As a reduced rational.
    pub fn to_rational(&self) -> BigRational {
        let power = BigInt::one() << self.exponent.unsigned_abs();
        if self.exponent < 0 {
            BigRational::new(self.numerator.clone(), &self.denominator * power)
        } else {
            BigRational::new(&self.numerator * power, self.denominator.clone())
        }
    }

    pub(super) fn zero() -> Fraction {
        Fraction::from_f64(0.0)
    }

    pub(super) fn sign(&self) -> Ordering {
        self.numerator.cmp(&BigInt::ZERO)
    }

    pub(super) fn add(&self, other: &Fraction) -> Fraction {
        let exponent = self.exponent.min(other.exponent);
        let align = |f: &Fraction| &f.numerator << (f.exponent - exponent);
        if self.denominator == other.denominator {
            return Fraction {
                numerator: align(self) + align(other),
                denominator: self.denominator.clone(),
                exponent,
            };
        }
        Fraction {
            numerator: align(self) * &other.denominator + align(other) * &self.denominator,
            denominator: &self.denominator * &other.denominator,
            exponent,
        }
    }

    pub(super) fn negated(&self) -> Fraction {
        Fraction {
            numerator: -&self.numerator,
            ..self.clone()
        }
    }

    pub(super) fn mul(&self, other: &Fraction) -> Fraction {
        Fraction {
            numerator: &self.numerator * &other.numerator,
            denominator: &self.denominator * &other.denominator,
            exponent: self.exponent + other.exponent,
        }
    }

    /// A float `digits` of a size between 2^-63 and 2^63, or 0, and a power: the value is about `digits * 2^power`.
    ///
    /// The leading bits of numerator and denominator keep the quotient within a few ulps.
    pub(super) fn significand(&self) -> (f64, i64) {
        let (above, power_above) = leading(&self.numerator);
        let (below, power_below) = leading(&self.denominator);
        (above / below, power_above - power_below + self.exponent)
    }

    /// The square root, as a float and a power of two.
    pub(super) fn root_significand(&self) -> (f64, i64) {
        let (mut digits, power) = self.significand();
        let is_odd = power.rem_euclid(2) == 1;
        if is_odd {
            digits *= 2.0;
        }
        (digits.sqrt(), power.div_euclid(2))
    }

    /// `1 / self`; `self` is not zero.
    pub(super) fn reciprocal(&self) -> Fraction {
        let numerator = if self.numerator.is_negative() {
            -&self.denominator
        } else {
            self.denominator.clone()
        };
        Fraction {
            numerator,
            denominator: self.numerator.abs(),
            exponent: -self.exponent,
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }
}

/// The 63 leading bits of an integer, as a float of a size of at most 1 and a power of two.
fn leading(n: &BigInt) -> (f64, i64) {
    let shift = n.bits().saturating_sub(63);
    let digits = (n >> shift).to_f64().unwrap_or(f64::NAN);
    (digits * (-63f64).exp2(), shift as i64 + 63)
}

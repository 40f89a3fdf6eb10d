//! An exact t: a fraction of integers and a power of two, of 128 bits or of any size.

use crate::bounds::Bounds;
use crate::rounded::rounded_quotient;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::oracle::integer::{ExactInteger, Integer, RayInterval};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};
use std::cmp::Ordering;

/// `numerator / denominator * 2^exponent`, with a positive denominator.
#[derive(Clone, Debug)]
pub struct Fraction<I> {
    pub numerator: I,
    pub denominator: I,
    pub exponent: i64,
}

impl<I: Integer> Fraction<I> {
    /// From a denominator of either sign.
    pub fn new(numerator: I, denominator: I, exponent: i64) -> Fraction<I> {
        let is_negative = denominator.sign() == Ordering::Less;
        let [numerator, denominator] = if is_negative {
            [-numerator, -denominator]
        } else {
            [numerator, denominator]
        };
        Fraction {
            numerator,
            denominator,
            exponent,
        }
    }

    /// The order of two fractions; one of the same exponent is compared without shifts.
    pub fn compare(&self, other: &Fraction<I>) -> Ordering {
        if self.exponent == other.exponent {
            return I::compare_products(
                &self.numerator,
                &other.denominator,
                &other.numerator,
                &self.denominator,
            );
        }
        let mut left = self.numerator.big() * other.denominator.big();
        let mut right = other.numerator.big() * self.denominator.big();
        let shift = self.exponent - other.exponent;
        if shift >= 0 {
            left <<= shift
        } else {
            right <<= -shift
        }
        left.cmp(&right)
    }

    fn compare_float(&self, t: f64) -> Ordering {
        let interval = RayInterval::between(t, t, self.exponent);
        interval.compare_start(&self.numerator, &self.denominator)
    }
}

/// An exact t, in the form in which it was found.
#[derive(Clone, Debug)]
pub enum Parameter {
    /// On a grid of few bits.
    Small(Fraction<i128>),
    /// On any grid.
    Large(Fraction<BigInt>),
    /// An end of the interval.
    End(f64),
}

impl Parameter {
    /// The order of two.
    pub fn compare(&self, other: &Parameter) -> Ordering {
        match (self, other) {
            (Parameter::Small(a), Parameter::Small(b)) => a.compare(b),
            (Parameter::Large(a), Parameter::Large(b)) => a.compare(b),
            (Parameter::Small(a), Parameter::Large(b)) => a.big().compare(b),
            (Parameter::Large(a), Parameter::Small(b)) => a.compare(&b.big()),
            (a, Parameter::End(end)) => a.compare_float(*end),
            (Parameter::End(end), b) => b.compare_float(*end).reverse(),
        }
    }

    /// The order of the parameter and a float, which may be infinite.
    pub fn compare_float(&self, t: f64) -> Ordering {
        match self {
            Parameter::Small(fraction) => fraction.compare_float(t),
            Parameter::Large(fraction) => fraction.compare_float(t),
            Parameter::End(end) => {
                let order = end.partial_cmp(&t);
                order.expect("ends are not NaN")
            }
        }
    }

    /// Floats between which it lies.
    pub fn bounds(&self) -> Bounds {
        match self {
            Parameter::Small(fraction) => {
                let numerator = (fraction.numerator as f64, 0);
                let denominator = (fraction.denominator as f64, 0);
                around(numerator, denominator, fraction.exponent)
            }
            Parameter::Large(fraction) => around(
                leading(&fraction.numerator),
                leading(&fraction.denominator),
                fraction.exponent,
            ),
            Parameter::End(end) => Bounds::at(*end),
        }
    }

    /// The nearest double; an infinite end is itself.
    pub fn nearest_double(&self) -> f64 {
        match self {
            Parameter::Small(fraction) => fraction.big().nearest_double(),
            Parameter::Large(fraction) => fraction.nearest_double(),
            Parameter::End(end) => *end,
        }
    }

    /// As a rational; none of an infinite end.
    pub fn rational(&self) -> Option<BigRational> {
        match self {
            Parameter::Small(fraction) => Some(fraction.big().rational()),
            Parameter::Large(fraction) => Some(fraction.rational()),
            Parameter::End(end) => BigRational::from_float(*end),
        }
    }
}

impl Fraction<i128> {
    fn big(&self) -> Fraction<BigInt> {
        Fraction {
            numerator: self.numerator.big(),
            denominator: self.denominator.big(),
            exponent: self.exponent,
        }
    }
}

impl Fraction<BigInt> {
    fn nearest_double(&self) -> f64 {
        rounded_quotient(&self.numerator, &self.denominator, self.exponent)
    }

    fn rational(&self) -> BigRational {
        let power = BigInt::one() << self.exponent.unsigned_abs();
        if self.exponent < 0 {
            BigRational::new(self.numerator.clone(), &self.denominator * power)
        } else {
            BigRational::new(&self.numerator * power, self.denominator.clone())
        }
    }
}

/// An integer as a float times a power of two, off by less than u relative to its size.
fn leading(n: &BigInt) -> (f64, i64) {
    // 62 bits lose less than 2^-61, and the float loses half an ulp.
    let shift = n.bits().saturating_sub(62);
    let digits = (n >> shift).to_f64();
    (digits.unwrap_or(f64::NAN), shift as i64)
}

/// Bounds of a quotient of floats that are off by less than 2u relative to their size, times a power of two.
fn around(numerator: (f64, i64), denominator: (f64, i64), exponent: i64) -> Bounds {
    if numerator.0 == 0.0 {
        return Bounds::at(0.0);
    }
    // Three roundings and two errors: below 8u.
    let quotient = numerator.0 / denominator.0;
    let error = quotient.abs() * 4.0 * f64::EPSILON;
    let exponent = exponent + numerator.1 - denominator.1;
    let exponent = exponent.clamp(-10_000, 10_000) as i32;
    // A product that underflows or overflows is the next number to a bound, or an infinity.
    Bounds {
        lower: scale_by_power_of_two(quotient - error, exponent).next_down(),
        upper: scale_by_power_of_two(quotient + error, exponent).next_up(),
    }
}

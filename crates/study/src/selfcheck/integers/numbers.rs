//! The numbers of the second reference: floats taken apart, fractions and vectors of integers.

use num_bigint::BigInt;
use num_traits::{Float as _, RefNum, Signed, ToPrimitive};
use std::cmp::Ordering;
use std::ops::Shl;

/// Integers of one or another size.
pub trait Integer:
    Signed + Ord + Clone + ToPrimitive + From<i64> + Shl<i64, Output = Self>
{
}

impl Integer for i64 {}
impl Integer for i128 {}
impl Integer for BigInt {}

/// A finite float as an odd integer, or zero, times a power of two.
#[derive(Clone, Copy, Default)]
pub struct Digits {
    pub odd: i64,
    pub exponent: i64,
}

impl Digits {
    pub fn of(x: f64) -> Digits {
        let (mantissa, exponent, sign) = x.integer_decode();
        if mantissa == 0 {
            return Digits::default();
        }
        let zeros = mantissa.trailing_zeros();
        Digits {
            odd: (mantissa >> zeros) as i64 * i64::from(sign),
            exponent: i64::from(exponent) + i64::from(zeros),
        }
    }

    /// The number of bits before the binary point.
    pub fn length(self) -> i64 {
        let bits = 64 - self.odd.unsigned_abs().leading_zeros();
        i64::from(bits) + self.exponent
    }

    /// The number divided by 2 to a power.
    pub fn in_units_of(self, power: i64) -> Digits {
        let exponent = if self.odd == 0 {
            0
        } else {
            self.exponent - power
        };
        Digits { exponent, ..self }
    }

    /// The number as an integer, if its exponent is not negative.
    pub fn integer<I: Integer>(self) -> I {
        I::from(self.odd) << self.exponent
    }
}

pub type IntegerPoint<I> = [I; 3];

/// A fraction with a denominator that is not negative; 1/0 and -1/0 are the infinite ends of an interval.
#[derive(Clone)]
pub struct IntegerFraction<I> {
    pub numerator: I,
    pub denominator: I,
}

impl<I: Integer> IntegerFraction<I>
where
    for<'a> &'a I: RefNum<I>,
{
    pub fn new(numerator: I, denominator: I) -> IntegerFraction<I> {
        let (numerator, denominator) = if denominator.is_negative() {
            (-numerator, -denominator)
        } else {
            (numerator, denominator)
        };
        IntegerFraction {
            numerator,
            denominator,
        }
    }

    /// An end of an interval.
    pub fn of(t: f64) -> IntegerFraction<I> {
        if t.is_infinite() {
            let sign = if t < 0.0 { -I::one() } else { I::one() };
            return IntegerFraction::new(sign, I::zero());
        }
        let Digits { odd, exponent } = Digits::of(t);
        let numerator = I::from(odd) << exponent.max(0);
        IntegerFraction::new(numerator, I::one() << (-exponent).max(0))
    }

    pub fn compare(&self, other: &IntegerFraction<I>) -> Ordering {
        // Where a segment crosses the line, t is below 2^77 / 2^75: with an interval's end its product
        // fits, with itself it would not.
        if self.numerator == other.numerator && self.denominator == other.denominator {
            return Ordering::Equal;
        }
        let left = &self.numerator * &other.denominator;
        let right = &other.numerator * &self.denominator;
        left.cmp(&right)
    }

    /// A float nearby, where both numbers are in its range.
    pub fn near(&self) -> Option<f64> {
        let t = self.numerator.to_f64()? / self.denominator.to_f64()?;
        t.is_finite().then_some(t)
    }
}

pub fn sign<I: Integer>(x: &I) -> Ordering {
    x.cmp(&I::zero())
}

pub fn is_zero<I: Integer>(v: &IntegerPoint<I>) -> bool {
    v.iter().all(I::is_zero)
}

pub fn minus<I>(p: &IntegerPoint<I>, q: &IntegerPoint<I>) -> IntegerPoint<I>
where
    for<'a> &'a I: RefNum<I>,
{
    std::array::from_fn(|i| &p[i] - &q[i])
}

pub fn dot<I: Integer>(p: &IntegerPoint<I>, q: &IntegerPoint<I>) -> I
where
    for<'a> &'a I: RefNum<I>,
{
    &p[0] * &q[0] + &p[1] * &q[1] + &p[2] * &q[2]
}

pub fn cross<I: Integer>(p: &IntegerPoint<I>, q: &IntegerPoint<I>) -> IntegerPoint<I>
where
    for<'a> &'a I: RefNum<I>,
{
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &p[i] * &q[j] - &p[j] * &q[i])
}

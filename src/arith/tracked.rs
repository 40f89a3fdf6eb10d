//! Floats that know whether they are exact: what a kernel computes in `f32` or `f64`, bit for bit,
//! and which of IEEE 754's exceptions (clause 7) the numbers behind its decisions met on their way.
//!
//! Each number carries the exceptions of all that it was made from. A comparison, in which a number
//! turns into a decision, adds them to the account of the run: values that are computed but never
//! compared, as a hit's, do not count.

use super::{Exact, Float, Real, decompose};
use std::cell::Cell;
use std::ops::{Add, BitOr, Div, Mul, Neg, Sub};

/// Which exceptions happened. A division by zero is none of them: its infinity is exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exceptions {
    /// An operation rounded.
    pub inexact: bool,
    /// A finite result was too large for the format.
    pub overflow: bool,
    /// An operation rounded to a subnormal number or to zero: bits were lost to underflow.
    pub underflow: bool,
}

impl BitOr for Exceptions {
    type Output = Exceptions;
    fn bitor(self, other: Exceptions) -> Exceptions {
        Exceptions {
            inexact: self.inexact | other.inexact,
            overflow: self.overflow | other.overflow,
            underflow: self.underflow | other.underflow,
        }
    }
}

thread_local! {
    /// Of the numbers that the run on this thread has compared.
    static COMPARED: Cell<Exceptions> = const {
        Cell::new(Exceptions { inexact: false, overflow: false, underflow: false })
    };
}

/// Runs a computation in [`Tracked`] numbers; returns the exceptions behind its comparisons too.
pub fn tracked<T>(run: impl FnOnce() -> T) -> (T, Exceptions) {
    let outer = COMPARED.replace(Exceptions::default());
    let result = run();
    (result, COMPARED.replace(outer))
}

/// A float with the exceptions of its making.
#[derive(Clone, Copy, Debug)]
pub struct Tracked<F> {
    value: F,
    raised: Exceptions,
}

impl<F: Float> Tracked<F> {
    /// A given number, which is what it is.
    pub fn new(value: F) -> Self {
        Tracked { value, raised: Exceptions::default() }
    }

    /// The float.
    pub fn value(self) -> F {
        self.value
    }

    /// What happened on the way to it.
    pub fn raised(self) -> Exceptions {
        self.raised
    }

    /// The result of an operation on finite operands (`exact` says whether it did not round), or of
    /// one on infinities and NaN, which is never inexact.
    fn made<const N: usize>(
        value: F,
        operands: [&Self; N],
        exact: impl FnOnce() -> bool,
        divides_by_zero: bool,
    ) -> Self {
        let earlier = operands.iter().fold(Exceptions::default(), |sum, x| sum | x.raised);
        if divides_by_zero || operands.iter().any(|x| !x.value.is_finite()) {
            return Tracked { value, raised: earlier };
        }
        let overflow = !value.is_finite();
        let inexact = overflow || !exact();
        let smallest_normal = F::from_place(1 << (F::DIGITS - 1));
        let underflow = inexact && value.abs() < smallest_normal;
        Tracked { value, raised: earlier | Exceptions { inexact, overflow, underflow } }
    }

    fn sum(&self, other: &Self) -> Self {
        let (a, b) = (self.value, other.value);
        let high = a + b;
        // Knuth's two-sum: the rounding error of a sum is a float. Where it overflows on the way it
        // says inexact, which is the safe side.
        let exact = || {
            let part = high - a;
            ((a - (high - part)) + (b - part)).is_zero()
        };
        Tracked::made(high, [self, other], exact, false)
    }

    fn product(&self, other: &Self) -> Self {
        let value = self.value * other.value;
        let exact = || is_product(value, self.value, other.value);
        Tracked::made(value, [self, other], exact, false)
    }

    fn quotient(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        let exact = || is_product(self.value, value, other.value);
        Tracked::made(value, [self, other], exact, other.value.is_zero())
    }

    /// Adds what this number met to the account of the run.
    fn note(&self) {
        COMPARED.set(COMPARED.get() | self.raised);
    }

    fn compare(&self, other: &Self, holds: impl Fn(&F, &F) -> bool) -> bool {
        self.note();
        other.note();
        holds(&self.value, &other.value)
    }
}

/// Whether `product` is `a*b` without rounding; all finite.
fn is_product<F: Float>(product: F, a: F, b: F) -> bool {
    let [(p, i), (a, j), (b, k)] = [product, a, b].map(|x| decompose(x.to_f64()));
    // Odd digits and exponents of a product are those of its factors multiplied and added.
    i128::from(p) == i128::from(a) * i128::from(b) && (p == 0 || i == j + k)
}

macro_rules! operator {
    ($trait:ident, $method:ident, |$a:ident, $b:ident| $body:expr) => {
        impl<F: Float> $trait for Tracked<F> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (&self, &other);
                $body
            }
        }
        impl<F: Float> $trait<&Self> for Tracked<F> {
            type Output = Self;
            fn $method(self, other: &Self) -> Self {
                let ($a, $b) = (&self, other);
                $body
            }
        }
    };
}

operator!(Add, add, |a, b| a.sum(b));
operator!(Sub, sub, |a, b| a.sum(&-*b));
operator!(Mul, mul, |a, b| a.product(b));
operator!(Div, div, |a, b| a.quotient(b));

impl<F: Float> Neg for Tracked<F> {
    type Output = Self;
    fn neg(self) -> Self {
        Tracked { value: -self.value, ..self }
    }
}

impl<F: Float> Real for Tracked<F> {
    fn zero() -> Self {
        Tracked::new(F::zero())
    }
    fn one() -> Self {
        Tracked::new(F::one())
    }
    fn abs(&self) -> Self {
        Tracked { value: self.value.abs(), ..*self }
    }
    fn sqrt(&self) -> Self {
        let value = self.value.sqrt();
        if value.is_nan() {
            return Tracked { value, ..*self };
        }
        Tracked::made(value, [self], || is_product(self.value, value, value), false)
    }
    fn is_sign_negative(&self) -> bool {
        self.note();
        self.value.is_sign_negative()
    }
    fn is_less(&self, other: &Self) -> bool {
        self.compare(other, F::is_less)
    }
    fn is_at_most(&self, other: &Self) -> bool {
        self.compare(other, F::is_at_most)
    }
    fn is_zero(&self) -> bool {
        self.note();
        self.value.is_zero()
    }
    fn is_nan(&self) -> bool {
        self.note();
        self.value.is_nan()
    }
    fn is_finite(&self) -> bool {
        self.note();
        self.value.is_finite()
    }
    fn infinity() -> Self {
        Tracked::new(F::infinity())
    }
    fn just_below(&self) -> Self {
        Tracked { value: self.value.just_below(), ..*self }
    }
    fn difference_of_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        let value = F::difference_of_products(&a.value, &b.value, &c.value, &d.value);
        let exact = || {
            let [a, b, c, d, found] =
                [a.value, b.value, c.value, d.value, value].map(|x| Exact::from_f64(x.to_f64()));
            (Exact::difference_of_products(&a, &b, &c, &d) - found).is_zero()
        };
        Tracked::made(value, [a, b, c, d], exact, false)
    }
    fn largest_accepted(accepts: impl Fn(&Self) -> bool, exact: impl FnOnce() -> Self) -> Self {
        let found = F::largest_accepted(|e| accepts(&Tracked::new(*e)), || exact().value);
        Tracked::new(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use num_rational::BigRational;

    /// Numbers whose operations are often exact, and often out of range.
    fn number<F: Float>(draw: &mut Draw) -> F {
        let high = F::MAX_EXPONENT - 3;
        let exponent = draw.pick(&[0, 0, F::MIN_EXPONENT / 2, F::MIN_EXPONENT + 3, high]);
        let few = F::from_f64(draw.integer(-9, 9) as f64);
        let power = |k: i32| F::from_f64(crate::arith::scale_by_power_of_two(1.0, k));
        match draw.below(3) {
            0 => few,
            1 => few * power(exponent),
            _ => {
                let exponent = exponent + draw.integer(-3, 0) as i32;
                draw.with_exponent(exponent)
            }
        }
    }

    fn rational<F: Float>(x: F) -> Option<BigRational> {
        BigRational::from_float(x.to_f64())
    }

    fn exceptions_are_those_that_rationals_tell<F: Float>() {
        let (mut exact_ones, mut inexact_ones) = (0, 0);
        for index in 0..40_000 {
            let mut draw = Draw::new("tracked", 1, index);
            let [a, b, c, d]: [F; 4] = std::array::from_fn(|_| number(&mut draw));
            let [x, y, z, w] = [a, b, c, d].map(Tracked::new);
            let [p, q, r, s] = [a, b, c, d].map(|x| rational(x).unwrap());
            let mut results = vec![
                (x + y, Some(&p + &q)),
                (x - y, Some(&p - &q)),
                (x * y, Some(&p * &q)),
                (Real::difference_of_products(&x, &y, &z, &w), Some(&p * &q - &r * &s)),
            ];
            if !b.is_zero() {
                results.push((x / y, Some(&p / &q)));
            }
            let squared = x * x;
            if !squared.raised.inexact {
                results.push((squared.sqrt(), Some(if a < F::zero() { -p } else { p })));
            }
            for (found, expected) in results {
                let rounded = rational(found.value);
                let inexact = rounded != expected;
                let told = format!("{} {found:?} {a} {b} {c} {d}", F::NAME);
                assert_eq!(found.raised.inexact, inexact, "{told}");
                assert_eq!(found.raised.overflow, rounded.is_none(), "{told}");
                let small = F::from_place(1 << (F::DIGITS - 1));
                let underflow = inexact && found.value.abs() < small;
                assert_eq!(found.raised.underflow, underflow, "{told}");
                exact_ones += usize::from(!inexact);
                inexact_ones += usize::from(inexact);
            }
        }
        assert!(exact_ones > 20_000 && inexact_ones > 20_000, "{exact_ones} {inexact_ones}");
    }

    #[test]
    fn exceptions_are_those_that_rationals_tell_in_either_scalar() {
        exceptions_are_those_that_rationals_tell::<f32>();
        exceptions_are_those_that_rationals_tell::<f64>();
    }

    #[test]
    fn a_division_by_zero_is_exact_and_what_follows_an_overflow_is_not() {
        let [zero, one, max] = [0.0f32, 1.0, f32::MAX].map(Tracked::new);
        assert_eq!((one / zero).raised, Exceptions::default());
        assert_eq!((zero / zero).raised, Exceptions::default());
        let later = one / (max + max);
        assert_eq!(later.value, 0.0);
        assert!(later.raised.overflow && later.raised.inexact);
    }

    #[test]
    fn only_compared_numbers_count() {
        let third = || Tracked::new(1.0f64) / Tracked::new(3.0);
        assert_eq!(tracked(|| third().value).1, Exceptions::default());
        assert!(tracked(|| third().is_less(&Tracked::one())).1.inexact);
        let tiny = Tracked::new(f64::MIN_POSITIVE);
        let (_, raised) = tracked(|| (tiny * tiny).is_zero());
        assert!(raised.underflow && !raised.overflow);
    }
}

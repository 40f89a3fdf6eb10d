//! Floats that know whether they are exact. A run computes what the kernel computes in `f32` or `f64` in
//! some [`Arithmetic`], bit for bit, and records which of IEEE 754's exceptions (clause 7) occurred in
//! the numbers behind its decisions. A number that is flushed to zero underflows; a product that is
//! fused into a sum does not round.
//!
//! Each number carries the exceptions of all numbers that it was computed from. A comparison turns
//! numbers into a decision, so it adds their exceptions to the run's. Values that are computed but never
//! compared, such as those of a hit, do not count.

use super::arithmetic::{Arithmetic, RoundedOperation, smallest_normal};
use super::{Emulated, Exact, Float, Real, decompose};
use std::cell::Cell;
use std::ops::BitOr;

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

impl Exceptions {
    /// The exceptions of a result of finite operands; `exact` is true if a finite one is not rounded.
    fn of<F: Float>(result: F, exact: impl FnOnce() -> bool) -> Exceptions {
        let overflow = !result.is_finite();
        let inexact = overflow || !exact();
        Exceptions { inexact, overflow, underflow: inexact && result.abs() < smallest_normal() }
    }
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
    /// The exceptions of the numbers that the run on this thread has compared.
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
#[derive(Clone, Debug)]
pub struct Tracked<F: Float> {
    number: Emulated<F>,
    raised: Exceptions,
    /// For a product that may still be fused, the exceptions on the way to its factors.
    before: Exceptions,
}

impl<F: Float> Tracked<F> {
    /// A given number, which is what it is unless it is flushed to zero.
    pub fn new(value: F, arithmetic: Arithmetic) -> Self {
        let number = Emulated::new(value, arithmetic);
        let flushed = number.value().is_zero() && !value.is_zero();
        let raised = Exceptions { inexact: flushed, overflow: false, underflow: flushed };
        Tracked { number, raised, before: raised }
    }

    /// A constant, which takes on the arithmetic of what it meets.
    fn constant(value: F) -> Self {
        Tracked::new(value, Arithmetic::IEEE)
    }

    /// The float.
    pub fn value(&self) -> F {
        self.number.value()
    }

    /// The exceptions on the way to this number.
    pub fn raised(&self) -> Exceptions {
        self.raised
    }

    /// The result of an operation. One on finite operands may raise exceptions; one on infinities
    /// and NaN, and a division by zero, is never inexact.
    fn made(operation: RoundedOperation<F>, arithmetic: Arithmetic, earlier: Exceptions) -> Self {
        let number = Emulated::made(operation, arithmetic);
        let raised = earlier | operation.raises(number.value());
        Tracked { number, raised, before: earlier }
    }

    #[inline(never)]
    fn sum(&self, other: &Self) -> Self {
        let earlier = match (self.number.is_product(), other.number.is_product()) {
            (true, _) => self.before | other.raised,
            (false, true) => self.raised | other.before,
            (false, false) => self.raised | other.raised,
        };
        Tracked::made(
            self.number.operation_of_sum(&other.number),
            self.arithmetic_with(other),
            earlier,
        )
    }

    fn difference(&self, other: &Self) -> Self {
        self.sum(&other.negation())
    }

    fn negation(&self) -> Self {
        Tracked { number: self.number.negation(), ..*self }
    }

    #[inline(never)]
    fn product(&self, other: &Self) -> Self {
        let operation = RoundedOperation::Product(self.value(), other.value());
        Tracked::made(operation, self.arithmetic_with(other), self.raised | other.raised)
    }

    #[inline(never)]
    fn quotient(&self, other: &Self) -> Self {
        let operation = RoundedOperation::Quotient(self.value(), other.value());
        Tracked::made(operation, self.arithmetic_with(other), self.raised | other.raised)
    }

    fn arithmetic_with(&self, other: &Self) -> Arithmetic {
        self.number.arithmetic().and(other.number.arithmetic())
    }

    /// Adds what this number met to the account of the run.
    fn note(&self) {
        COMPARED.set(COMPARED.get() | self.raised);
    }

    fn compare(&self, other: &Self, holds: impl Fn(&F, &F) -> bool) -> bool {
        self.note();
        other.note();
        holds(&self.value(), &other.value())
    }
}

impl<F: Float> RoundedOperation<F> {
    /// The exceptions of this operation alone, whose result this is.
    fn raises(self, result: F) -> Exceptions {
        let is_special = match self {
            RoundedOperation::Sum(a, b) | RoundedOperation::Product(a, b) => {
                !(a.is_finite() && b.is_finite())
            }
            RoundedOperation::Fused(a, b, c) => !(a.is_finite() && b.is_finite() && c.is_finite()),
            RoundedOperation::Quotient(a, b) => !(a.is_finite() && b.is_finite()) || b.is_zero(),
            RoundedOperation::Root(a) => !a.is_finite() || a < F::zero(),
        };
        if is_special {
            return Exceptions::default();
        }
        Exceptions::of(result, || self.is_exact(result))
    }

    /// True if the finite result of finite operands is not rounded.
    fn is_exact(self, result: F) -> bool {
        match self {
            RoundedOperation::Sum(a, b) => {
                // Knuth's two-sum: the rounding error of a sum is a float. Where it overflows on the
                // way it says inexact, which is the safe side.
                let high = a + b;
                let part = high - a;
                high == result && ((a - (high - part)) + (b - part)).is_zero()
            }
            RoundedOperation::Product(a, b) => is_product(result, a, b),
            RoundedOperation::Fused(a, b, c) => {
                let [a, b, c, result] = [a, b, c, result].map(|x| Exact::from_f64(x.to_f64()));
                (a * b + c - result).is_zero()
            }
            RoundedOperation::Quotient(a, b) => is_product(a, result, b),
            RoundedOperation::Root(a) => is_product(a, result, result),
        }
    }
}

/// True if `product` is `a*b` without rounding; all three are finite.
fn is_product<F: Float>(product: F, a: F, b: F) -> bool {
    let [(p, i), (a, j), (b, k)] = [product, a, b].map(|x| decompose(x.to_f64()));
    // Odd digits and exponents of a product are those of its factors multiplied and added.
    i128::from(p) == i128::from(a) * i128::from(b) && (p == 0 || i == j + k)
}

operators!([F: Float] Tracked<F>, Clone::clone);

impl<F: Float> Real for Tracked<F> {
    fn zero() -> Self {
        Tracked::constant(F::zero())
    }
    fn one() -> Self {
        Tracked::constant(F::one())
    }
    fn abs(&self) -> Self {
        Tracked { number: self.number.abs(), ..*self }
    }
    fn sqrt(&self) -> Self {
        Tracked::made(RoundedOperation::Root(self.value()), self.number.arithmetic(), self.raised)
    }
    fn is_sign_negative(&self) -> bool {
        self.note();
        self.value().is_sign_negative()
    }
    fn is_less(&self, other: &Self) -> bool {
        self.compare(other, F::is_less)
    }
    fn is_at_most(&self, other: &Self) -> bool {
        self.compare(other, F::is_at_most)
    }
    fn is_zero(&self) -> bool {
        self.note();
        self.value().is_zero()
    }
    fn is_nan(&self) -> bool {
        self.note();
        self.value().is_nan()
    }
    fn is_finite(&self) -> bool {
        self.note();
        self.value().is_finite()
    }
    fn infinity() -> Self {
        Tracked::constant(F::infinity())
    }
    fn just_below(&self) -> Self {
        Tracked { number: self.number.just_below(), ..*self }
    }
    fn difference_of_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        let operands = [a, b, c, d];
        let earlier = operands.iter().fold(Exceptions::default(), |sum, x| sum | x.raised);
        let number = Real::difference_of_products(&a.number, &b.number, &c.number, &d.number);
        let value = number.value();
        if operands.iter().any(|x| !x.value().is_finite()) {
            return Tracked { number, raised: earlier, before: earlier };
        }
        let exact = || {
            let [a, b, c, d, found] = [a.value(), b.value(), c.value(), d.value(), value]
                .map(|x| Exact::from_f64(x.to_f64()));
            (Exact::difference_of_products(&a, &b, &c, &d) - found).is_zero()
        };
        let raised = earlier | Exceptions::of(value, exact);
        Tracked { number, raised, before: earlier }
    }
    fn largest_accepted(accepts: impl Fn(&Self) -> bool, exact: impl FnOnce() -> Self) -> Self {
        let start = exact();
        let arithmetic = start.number.arithmetic();
        let found =
            F::largest_accepted(|e| accepts(&Tracked::new(*e, arithmetic)), || start.value());
        Tracked::new(found, arithmetic)
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

    /// The result of an operation, and the result that it would have without rounding.
    type Result<F> = (Tracked<F>, Option<BigRational>);

    fn exceptions_are_those_that_rationals_tell<F: Float>(arithmetic: Arithmetic) {
        let (mut exact_ones, mut inexact_ones) = (0, 0);
        for index in 0..6_000 {
            let mut draw = Draw::new("tracked", 1, index);
            let numbers: [F; 4] = std::array::from_fn(|_| arithmetic.flush(number(&mut draw)));
            let [a, b, c, d] = numbers;
            let [x, y, z, w] = numbers.map(|x| Tracked::new(x, arithmetic));
            let [p, q, r, s] = numbers.map(|x| rational(x).unwrap());
            let product = || x.clone() * &y;
            let mut results: Vec<Result<F>> = vec![
                (x.clone() + &y, Some(&p + &q)),
                (x.clone() - &y, Some(&p - &q)),
                (product(), Some(&p * &q)),
                (Real::difference_of_products(&x, &y, &z, &w), Some(&p * &q - &r * &s)),
            ];
            if !b.is_zero() {
                results.push((x.clone() / &y, Some(&p / &q)));
            }
            if arithmetic.fused {
                // The product itself does not round.
                results.push((product() + &z, Some(&p * &q + &r)));
                results.push((z.clone() - product(), Some(&r - &p * &q)));
            }
            let squared = x.clone() * &x;
            if !squared.raised.inexact {
                results.push((squared.sqrt(), Some(if a < F::zero() { -p } else { p })));
            }
            for (found, expected) in results {
                let rounded = rational(found.value());
                let inexact = rounded != expected;
                let told = format!("{} {arithmetic} {found:?} {a} {b} {c} {d}", F::NAME);
                assert_eq!(found.raised.inexact, inexact, "{told}");
                assert_eq!(found.raised.overflow, rounded.is_none(), "{told}");
                let small = F::from_place(1 << (F::DIGITS - 1));
                let underflow = inexact && found.value().abs() < small;
                assert_eq!(found.raised.underflow, underflow, "{told}");
                exact_ones += usize::from(!inexact);
                inexact_ones += usize::from(inexact);
            }
        }
        assert!(exact_ones > 3_000 && inexact_ones > 3_000, "{exact_ones} {inexact_ones}");
    }

    #[test]
    fn exceptions_are_those_that_rationals_tell_in_either_scalar_and_every_arithmetic() {
        for arithmetic in Arithmetic::ALL {
            exceptions_are_those_that_rationals_tell::<f32>(arithmetic);
            exceptions_are_those_that_rationals_tell::<f64>(arithmetic);
        }
    }

    #[test]
    fn a_division_by_zero_is_exact_and_what_follows_an_overflow_is_not() {
        let [zero, one, max] = [0.0f32, 1.0, f32::MAX].map(Tracked::constant);
        assert_eq!((one.clone() / &zero).raised, Exceptions::default());
        assert_eq!((zero.clone() / &zero).raised, Exceptions::default());
        let later = one / (max.clone() + &max);
        assert_eq!(later.value(), 0.0);
        assert!(later.raised.overflow && later.raised.inexact);
    }

    #[test]
    fn a_number_that_is_flushed_as_it_comes_lost_bits_to_underflow() {
        let least = f64::from_bits(1);
        assert!(Tracked::new(least, Arithmetic::FTZ).raised.underflow);
        for kept in [0.0, -0.0, 1.0, f64::MIN_POSITIVE, f64::INFINITY, f64::NAN] {
            assert_eq!(Tracked::new(kept, Arithmetic::FTZ).raised, Exceptions::default());
        }
        assert_eq!(Tracked::new(least, Arithmetic::FMA).raised, Exceptions::default());
    }

    #[test]
    fn only_compared_numbers_count() {
        let third = || Tracked::one() / Tracked::constant(3.0f64);
        assert_eq!(tracked(|| third().value()).1, Exceptions::default());
        assert!(tracked(|| third().is_less(&Tracked::one())).1.inexact);
        let tiny = Tracked::constant(f64::MIN_POSITIVE);
        let (_, raised) = tracked(|| (tiny.clone() * &tiny).is_zero());
        assert!(raised.underflow && !raised.overflow);
    }
}

//! Double-doubles with a bound on their error: exact numbers for the price of a few dozen
//! operations, where the bound decides.
//!
//! A number is `high + low ± error`. Sums, products and quotients of floats that come out exact keep
//! the error at zero, so a zero is known to be zero. Every other operation adds the bound of its
//! rounding, rounded up. If the bounds cannot decide a comparison the whole run is in doubt, and the
//! caller repeats it in [`Exact`](super::Exact). Infinities, NaN and the single zero behave as in
//! `Exact`. The oracle has double-doubles of its own: no arithmetic is shared with it.

use super::Real;
use std::cell::Cell;
use std::cmp::Ordering;

thread_local! {
    /// True if a comparison of the run on this thread was not decided.
    static DOUBT: Cell<bool> = const { Cell::new(false) };
}

/// Runs a computation in [`Bounded`] numbers; none if a comparison was not decided.
pub fn bounded<T>(run: impl FnOnce() -> T) -> Option<T> {
    let outer = DOUBT.replace(false);
    let result = run();
    (!DOUBT.replace(outer)).then_some(result)
}

/// A number within `error` of `high + low`; an infinity or NaN in `high` is exactly that.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    high: f64,
    low: f64,
    /// Infinite where nothing is known.
    error: f64,
}

/// Beyond these magnitudes nothing is claimed: products of floats within, and their rounding errors,
/// neither overflow nor underflow.
const LARGEST: f64 = f64::from_bits((1023 + 900) << 52);
const SMALLEST: f64 = f64::from_bits((1023 - 900) << 52);
/// Added to every error, for what underflows in the errors' own arithmetic.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);
/// 1 + 2^-40: the errors' own rounding, a few dozen ulps a step.
const ROUND_UP: f64 = 1.0 + f64::from_bits((1023 - 40) << 52);

/// 2 to a power.
const fn power(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

const UNKNOWN: Bounded = Bounded {
    high: 0.0,
    low: 0.0,
    error: f64::INFINITY,
};

/// The sum of two floats and its rounding error (Knuth).
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let high = a + b;
    let part = high - a;
    (high, (a - (high - part)) + (b - part))
}

/// The same where |a| ≥ |b| (Dekker).
#[inline]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let high = a + b;
    (high, b - (high - a))
}

/// The product of two floats and its rounding error (Veltkamp, Dekker).
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let split = |x: f64| {
        let scaled = 134_217_729.0 * x;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    let high = a * b;
    (high, a2 * b2 - (((high - a1 * b1) - a2 * b1) - a1 * b2))
}

impl Bounded {
    /// The exact value of a float.
    #[inline]
    pub fn new(value: f64) -> Bounded {
        let magnitude = value.abs();
        if value == 0.0 {
            Bounded::exact(0.0)
        } else if (SMALLEST..=LARGEST).contains(&magnitude) || !value.is_finite() {
            Bounded::exact(value)
        } else {
            UNKNOWN
        }
    }

    /// The number as a float, if it is known to about a millionth of itself.
    #[inline]
    pub fn approximate(&self) -> Option<f64> {
        (self.error <= self.high.abs() * power(-20)).then_some(self.high)
    }

    /// The number as a float, if it is known to within a tolerance, or to a millionth of itself.
    #[inline]
    pub fn within(&self, tolerance: f64) -> Option<f64> {
        if self.error <= tolerance {
            Some(self.high)
        } else {
            self.approximate()
        }
    }

    /// The number as a float, if its error is known to be at most this; the float's own rounding is left out.
    #[inline]
    pub fn known_to(&self, error: f64) -> Option<f64> {
        (self.error <= error).then_some(self.high)
    }

    #[inline]
    fn exact(high: f64) -> Bounded {
        Bounded {
            high,
            low: 0.0,
            error: 0.0,
        }
    }

    #[inline]
    fn is_known(&self) -> bool {
        self.error < f64::INFINITY
    }

    #[inline]
    fn is_special(&self) -> bool {
        !self.high.is_finite()
    }

    /// From a result, the error handed on by the operands and that of the operation.
    #[inline]
    fn rounded((high, low): (f64, f64), handed_on: f64, operation: f64) -> Bounded {
        let error = handed_on + operation;
        let size = high.abs();
        if !(size <= LARGEST && error <= LARGEST) {
            return UNKNOWN;
        }
        let error = if error > 0.0 {
            error * ROUND_UP + UNDERFLOW
        } else {
            0.0
        };
        // There is one zero, which reads positive.
        Bounded {
            high: high + 0.0,
            low,
            error,
        }
    }

    /// The sign, if it is certain; none of NaN either.
    #[inline]
    fn sign(&self) -> Option<Ordering> {
        // The low part is at most half an ulp of the high one.
        if self.high.abs() * (1.0 - power(-50)) > self.error || self.error == 0.0 {
            return self.high.partial_cmp(&0.0);
        }
        None
    }

    fn sum(&self, other: &Bounded) -> Bounded {
        if !(self.is_known() && other.is_known()) {
            return UNKNOWN;
        }
        if self.is_special() || other.is_special() {
            return Bounded::exact(self.high + other.high);
        }
        let (high, low) = two_sum(self.high, other.high);
        let handed_on = self.error + other.error;
        if self.low == 0.0 && other.low == 0.0 {
            return Bounded::rounded((high, low), handed_on, 0.0);
        }
        // The sum of the low parts and its addition round once each: below 4u²(|x| + |y|), u = 2^-53.
        let operation = power(-103) * (self.high.abs() + other.high.abs());
        let sum = fast_two_sum(high, low + (self.low + other.low));
        Bounded::rounded(sum, handed_on, operation)
    }

    fn difference(&self, other: &Bounded) -> Bounded {
        self.sum(&other.negation())
    }

    #[inline]
    fn negation(&self) -> Bounded {
        if self.high == 0.0 && self.low == 0.0 {
            return *self;
        }
        Bounded {
            high: -self.high,
            low: -self.low,
            ..*self
        }
    }

    fn product(&self, other: &Bounded) -> Bounded {
        if !(self.is_known() && other.is_known()) {
            return UNKNOWN;
        }
        if self.is_special() || other.is_special() {
            return match (self.sign(), other.sign()) {
                (Some(_), Some(_)) => Bounded::exact(self.high * other.high),
                _ if self.high.is_nan() || other.high.is_nan() => Bounded::exact(f64::NAN),
                _ => UNKNOWN,
            };
        }
        let (x, y) = (self.high.abs(), other.high.abs());
        if x * y < SMALLEST && x > 0.0 && y > 0.0 || x * y > LARGEST {
            return UNKNOWN;
        }
        let (high, low) = two_product(self.high, other.high);
        let handed_on =
            (x * other.error + y * self.error) * (1.0 + power(-50)) + self.error * other.error;
        if self.low == 0.0 && other.low == 0.0 {
            return Bounded::rounded((high, low), handed_on, 0.0);
        }
        // The product of the low parts is left out (u²), those of high and low parts and their sums
        // round: below 8u²|xy|.
        let mixed = self.high * other.low + self.low * other.high;
        Bounded::rounded(
            fast_two_sum(high, low + mixed),
            handed_on,
            power(-102) * high.abs(),
        )
    }

    fn quotient(&self, other: &Bounded) -> Bounded {
        if !(self.is_known() && other.is_known()) {
            return UNKNOWN;
        }
        if self.high.is_nan() || other.high.is_nan() {
            return Bounded::exact(f64::NAN);
        }
        let Some(sign) = other.sign() else {
            return UNKNOWN;
        };
        if self.is_special() || other.is_special() || sign == Ordering::Equal {
            // Dividing by the one zero, which reads positive, needs the sign of the dividend.
            let certain = self.sign().is_some() || other.is_special();
            return if certain {
                Bounded::new(self.high / other.high)
            } else {
                UNKNOWN
            };
        }
        let divisor = other.high.abs();
        if divisor <= 2.0 * other.error {
            return UNKNOWN;
        }
        let first = self.high / other.high;
        let size = first.abs();
        let small = size < SMALLEST && self.high != 0.0;
        if small || size > LARGEST || (size * divisor < SMALLEST && self.high != 0.0) {
            return UNKNOWN;
        }
        // One step of long division: what the first quotient leaves, divided again.
        let rest = self.sum(&-Bounded::exact(first).product(&Bounded {
            error: 0.0,
            ..*other
        }));
        let both_floats = self.low == 0.0 && other.low == 0.0;
        let handed_on = (self.error + size * other.error) / (divisor - other.error);
        if both_floats && rest.high == 0.0 && rest.low == 0.0 {
            return Bounded::rounded((first, 0.0), handed_on, 0.0);
        }
        // The rest is below 2u|x| and known to 16u²|x|; its division rounds, and leaves out the
        // divisor's low part: below 2^-99 of the quotient.
        let quotient = fast_two_sum(first, rest.high / other.high);
        Bounded::rounded(quotient, handed_on * (1.0 + power(-40)), power(-97) * size)
    }
}

operators!([] Bounded, std::convert::identity);

/// The answer of a comparison; doubt if there is none.
#[inline]
fn decided(answer: Option<bool>) -> bool {
    answer.unwrap_or_else(|| {
        DOUBT.set(true);
        false
    })
}

/// The order of two numbers: none if it is not known, and `Some(None)` with a NaN.
#[inline]
fn compare(a: &Bounded, b: &Bounded) -> Option<Option<Ordering>> {
    if !(a.is_known() && b.is_known()) {
        return None;
    }
    if a.is_special() || b.is_special() {
        return Some(a.high.partial_cmp(&b.high));
    }
    a.difference(b).sign().map(Some)
}

/// The second of two numbers if its order to the first is `wanted`, or else the first. Where the bounds
/// do not tell, either is right within the larger one: |min(x, y) - min(x', y')| ≤ max(|x - x'|, |y - y'|).
fn either(a: Bounded, b: Bounded, wanted: Ordering) -> Bounded {
    let chosen = |order| if order == Some(wanted) { b } else { a };
    match compare(&b, &a) {
        Some(order) => chosen(order),
        None if a.is_known() && b.is_known() => {
            let order = b.high.total_cmp(&a.high).then(b.low.total_cmp(&a.low));
            Bounded {
                error: a.error.max(b.error),
                ..chosen(Some(order))
            }
        }
        None => UNKNOWN,
    }
}

impl Real for Bounded {
    fn zero() -> Self {
        Bounded::exact(0.0)
    }
    fn one() -> Self {
        Bounded::exact(1.0)
    }
    fn number(value: f64) -> Self {
        Bounded::new(value)
    }
    fn abs(&self) -> Self {
        // Where the sign is not certain either reading keeps |x| within the error.
        if self.high < 0.0 { -*self } else { *self }
    }
    fn sqrt(&self) -> Self {
        match self.sign() {
            Some(Ordering::Equal) => return *self,
            Some(Ordering::Less) => return Bounded::exact(f64::NAN),
            _ if self.is_special() => return Bounded::exact(self.high.sqrt()),
            Some(_) if 4.0 * self.error < self.high => {}
            _ => return UNKNOWN,
        }
        // One step of Newton's method from the root of the high part.
        let first = self.high.sqrt();
        let square = Bounded::exact(first).product(&Bounded::exact(first));
        let rest = Bounded {
            error: 0.0,
            ..*self
        }
        .sum(&-square);
        let handed_on = self.error / first;
        if self.low == 0.0 && rest.high == 0.0 && rest.low == 0.0 {
            return Bounded::rounded((first, 0.0), handed_on, 0.0);
        }
        let root = fast_two_sum(first, rest.high / (2.0 * first));
        Bounded::rounded(root, handed_on, power(-97) * first)
    }
    fn is_sign_negative(&self) -> bool {
        self.is_less(&Bounded::zero())
    }
    fn is_less(&self, other: &Self) -> bool {
        decided(compare(self, other).map(|order| order == Some(Ordering::Less)))
    }
    fn is_at_most(&self, other: &Self) -> bool {
        let at_most = |order| matches!(order, Some(Ordering::Less | Ordering::Equal));
        decided(compare(self, other).map(at_most))
    }
    fn is_zero(&self) -> bool {
        decided(compare(self, &Bounded::zero()).map(|order| order == Some(Ordering::Equal)))
    }
    fn is_nan(&self) -> bool {
        decided(self.is_known().then(|| self.high.is_nan()))
    }
    fn is_finite(&self) -> bool {
        decided(self.is_known().then(|| self.high.is_finite()))
    }
    fn smaller(self, other: Self) -> Self {
        either(self, other, Ordering::Less)
    }
    fn larger(self, other: Self) -> Self {
        either(self, other, Ordering::Greater)
    }
    fn infinity() -> Self {
        Bounded::exact(f64::INFINITY)
    }
}

#[cfg(test)]
mod tests;

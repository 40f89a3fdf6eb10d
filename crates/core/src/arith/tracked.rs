//! Floats that know whether they are exact. A run computes what the kernel computes in `f32` or `f64` in
//! some [`Arithmetic`](super::Arithmetic), bit for bit, and records which of IEEE 754's exceptions (clause 7) occurred in
//! the numbers behind its decisions. A number that is flushed to zero underflows; a product that is
//! fused into a sum does not round.
//!
//! Each number carries the exceptions of all numbers that it was computed from. A comparison turns
//! numbers into a decision, so it adds their exceptions to the run's. Values that are computed but never
//! compared, such as those of a hit, do not count.

use super::arithmetic::{RoundedOperation, smallest_normal};
use super::emulated::{Notes, Rounded};
use super::{Exact, Float, Real, decompose};
use std::cell::Cell;

/// A float with the exceptions of all operations that made it.
pub type Tracked<F> = Rounded<F, Exceptions>;

/// The exceptions that happened. A division by zero does not count: its infinity is exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exceptions {
    /// An operation rounded.
    pub inexact: bool,
    /// A finite result was too large for the format.
    pub overflow: bool,
    /// An operation rounded to a subnormal number or to zero: bits were lost to underflow.
    pub underflow: bool,
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

impl Notes for Exceptions {
    fn of_given(is_flushed: bool) -> Exceptions {
        Exceptions {
            inexact: is_flushed,
            overflow: false,
            underflow: is_flushed,
        }
    }

    /// The exceptions of one operation. On infinities and NaN, and as a division by zero, it is never inexact.
    fn of_operation<F: Float>(operation: RoundedOperation<F>, result: F) -> Exceptions {
        if operation.is_special() {
            return Exceptions::default();
        }
        let overflow = !result.is_finite();
        let inexact = overflow || !operation.is_exact(result);
        Exceptions {
            inexact,
            overflow,
            underflow: inexact && result.abs() < smallest_normal(),
        }
    }

    fn and(self, other: Exceptions) -> Exceptions {
        Exceptions {
            inexact: self.inexact | other.inexact,
            overflow: self.overflow | other.overflow,
            underflow: self.underflow | other.underflow,
        }
    }

    fn compared(self) {
        COMPARED.set(COMPARED.get().and(self));
    }
}

impl<F: Float> RoundedOperation<F> {
    /// True if an operand is not finite, or if the operation is a quotient by zero or a root of a negative number.
    fn is_special(self) -> bool {
        let any_special = |operands: &[F]| !operands.iter().all(F::is_finite);
        match self {
            RoundedOperation::Sum(a, b) | RoundedOperation::Product(a, b) => any_special(&[a, b]),
            RoundedOperation::Fused(a, b, c) => any_special(&[a, b, c]),
            RoundedOperation::Minor(a, b, c, d) => any_special(&[a, b, c, d]),
            RoundedOperation::Quotient(a, b) => any_special(&[a, b]) || b.is_zero(),
            RoundedOperation::Root(a) => any_special(&[a]) || a < F::zero(),
        }
    }

    /// True if the finite result of finite operands is not rounded.
    fn is_exact(self, result: F) -> bool {
        let exact = |x: F| Exact::from_f64(x.to_f64());
        match self {
            RoundedOperation::Sum(a, b) => is_sum(result, a, b),
            RoundedOperation::Product(a, b) => is_product(result, a, b),
            RoundedOperation::Fused(a, b, c) => {
                let sum = exact(a) * exact(b) + exact(c);
                (sum - exact(result)).is_zero()
            }
            RoundedOperation::Minor(a, b, c, d) => {
                let difference = exact(a) * exact(b) - exact(c) * exact(d);
                (difference - exact(result)).is_zero()
            }
            RoundedOperation::Quotient(a, b) => is_product(a, result, b),
            RoundedOperation::Root(a) => is_product(a, result, result),
        }
    }
}

/// True if `sum` is `a+b` without rounding; all three are finite.
fn is_sum<F: Float>(sum: F, a: F, b: F) -> bool {
    // Knuth's two-sum: the rounding error of a sum is a float. Where it overflows on the way it is no zero, so the sum
    // counts as inexact, which is the safe side.
    let rounded = a + b;
    let of_b = rounded - a;
    let of_a = rounded - of_b;
    let error = (a - of_a) + (b - of_b);
    rounded == sum && error.is_zero()
}

/// True if `product` is `a*b` without rounding; all three are finite.
fn is_product<F: Float>(product: F, a: F, b: F) -> bool {
    let (digits, exponent) = decompose(product.to_f64());
    let (a_digits, a_exponent) = decompose(a.to_f64());
    let (b_digits, b_exponent) = decompose(b.to_f64());
    // All digits are odd, and a product of odd numbers is odd: so there is one way to write a product.
    i128::from(digits) == i128::from(a_digits) * i128::from(b_digits)
        && (digits == 0 || exponent == a_exponent + b_exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::Arithmetic;
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
                (
                    Real::difference_of_products(&x, &y, &z, &w),
                    Some(&p * &q - &r * &s),
                ),
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
            if !squared.notes().inexact {
                results.push((squared.sqrt(), Some(if a < F::zero() { -p } else { p })));
            }
            for (found, expected) in results {
                let rounded = rational(found.value());
                let inexact = rounded != expected;
                let told = format!("{} {arithmetic} {found:?} {a} {b} {c} {d}", F::NAME);
                assert_eq!(found.notes().inexact, inexact, "{told}");
                assert_eq!(found.notes().overflow, rounded.is_none(), "{told}");
                let small = F::from_place(1 << (F::DIGITS - 1));
                let underflow = inexact && found.value().abs() < small;
                assert_eq!(found.notes().underflow, underflow, "{told}");
                exact_ones += usize::from(!inexact);
                inexact_ones += usize::from(inexact);
            }
        }
        assert!(
            exact_ones > 3_000 && inexact_ones > 3_000,
            "{exact_ones} {inexact_ones}"
        );
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
        assert_eq!((one.clone() / &zero).notes(), Exceptions::default());
        assert_eq!((zero.clone() / &zero).notes(), Exceptions::default());
        let later = one / (max.clone() + &max);
        assert_eq!(later.value(), 0.0);
        assert!(later.notes().overflow && later.notes().inexact);
    }

    #[test]
    fn a_number_that_is_flushed_as_it_comes_lost_bits_to_underflow() {
        let least = f64::from_bits(1);
        assert!(Tracked::new(least, Arithmetic::FTZ).notes().underflow);
        for kept in [0.0, -0.0, 1.0, f64::MIN_POSITIVE, f64::INFINITY, f64::NAN] {
            assert_eq!(
                Tracked::new(kept, Arithmetic::FTZ).notes(),
                Exceptions::default()
            );
        }
        assert_eq!(
            Tracked::new(least, Arithmetic::FMA).notes(),
            Exceptions::default()
        );
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

//! Numbers that compute as another machine would: a float and the [`Arithmetic`] of its operations.
//!
//! A product remembers its factors until it is used. If it goes straight into a sum (it is moved there)
//! a fused arithmetic takes the factors and rounds once. A value with a name that is used more than once
//! is cloned or borrowed, and that rounds it. Compilers fuse the same products: GCC's `widening_mul` pass
//! fuses a product if every use is a sum, LLVM's DAG combiner if it has a single use; of two products in
//! a sum both fuse the left one. So
//!
//! ```text
//! dot(a, b)   = fma(a.z, b.z, fma(a.x, b.x, a.y*b.y))      from a.x*b.x + a.y*b.y + a.z*b.z
//! cross(a, b) = fma(a.y, b.z, -(b.y*a.z)), and cyclic      from a.y*b.z - b.y*a.z
//! o + t·d     = fma(d.x, t, o.x), and so on
//! x*y - z*w   = fma(x, y, -(z*w)),  x - y*z = fma(-y, z, x)
//! ```

use super::arithmetic::{Arithmetic, RoundedOperation};
use super::{Float, Real};

/// A float of another machine.
#[derive(Debug)]
pub struct Emulated<F> {
    value: F,
    /// If this is a product that may still be fused.
    factors: Option<[F; 2]>,
    arithmetic: Arithmetic,
}

/// The number as a name that is used again: rounded, no longer a product.
impl<F: Float> Clone for Emulated<F> {
    #[inline]
    fn clone(&self) -> Self {
        Emulated { factors: None, ..*self }
    }
}

impl<F: Float> Emulated<F> {
    /// A given number, as the arithmetic's operations see it.
    #[inline]
    pub fn new(value: F, arithmetic: Arithmetic) -> Self {
        Emulated { value: arithmetic.flush(value), factors: None, arithmetic }
    }

    /// A constant, which takes on the arithmetic of what it meets.
    fn constant(value: F) -> Self {
        Emulated::new(value, Arithmetic::IEEE)
    }

    /// The float.
    #[inline]
    pub fn value(&self) -> F {
        self.value
    }

    /// How its operations round.
    pub fn arithmetic(&self) -> Arithmetic {
        self.arithmetic
    }

    /// True if this is a product that may still be fused.
    pub(super) fn is_product(&self) -> bool {
        self.factors.is_some()
    }

    /// The operation that `self + other` is.
    #[inline]
    pub(super) fn operation_of_sum(&self, other: &Self) -> RoundedOperation<F> {
        match (self.factors, other.factors) {
            (Some([a, b]), _) => RoundedOperation::Fused(a, b, other.value),
            (None, Some([a, b])) => RoundedOperation::Fused(a, b, self.value),
            (None, None) => RoundedOperation::Sum(self.value, other.value),
        }
    }

    /// The result of an operation on two numbers.
    #[inline]
    pub(super) fn made(operation: RoundedOperation<F>, arithmetic: Arithmetic) -> Self {
        let factors = match operation {
            RoundedOperation::Product(a, b) if arithmetic.fused => Some([a, b]),
            _ => None,
        };
        Emulated { value: operation.run(arithmetic), factors, arithmetic }
    }

    #[inline(never)]
    fn sum(&self, other: &Self) -> Self {
        Emulated::made(self.operation_of_sum(other), self.arithmetic.and(other.arithmetic))
    }

    fn difference(&self, other: &Self) -> Self {
        self.sum(&other.negation())
    }

    #[inline]
    pub(super) fn negation(&self) -> Self {
        let factors = self.factors.map(|[a, b]| [-a, b]);
        Emulated { value: -self.value, factors, ..*self }
    }

    #[inline(never)]
    fn product(&self, other: &Self) -> Self {
        let operation = RoundedOperation::Product(self.value, other.value);
        Emulated::made(operation, self.arithmetic.and(other.arithmetic))
    }

    #[inline(never)]
    fn quotient(&self, other: &Self) -> Self {
        let operation = RoundedOperation::Quotient(self.value, other.value);
        Emulated::made(operation, self.arithmetic.and(other.arithmetic))
    }
}

operators!([F: Float] Emulated<F>, Clone::clone);

impl<F: Float> Real for Emulated<F> {
    fn zero() -> Self {
        Emulated::constant(F::zero())
    }
    fn one() -> Self {
        Emulated::constant(F::one())
    }
    fn abs(&self) -> Self {
        Emulated { value: self.value.abs(), ..self.clone() }
    }
    fn sqrt(&self) -> Self {
        Emulated::made(RoundedOperation::Root(self.value), self.arithmetic)
    }
    fn is_sign_negative(&self) -> bool {
        self.value.is_sign_negative()
    }
    fn is_less(&self, other: &Self) -> bool {
        self.value < other.value
    }
    fn is_at_most(&self, other: &Self) -> bool {
        self.value <= other.value
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
    fn is_nan(&self) -> bool {
        self.value.is_nan()
    }
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }
    fn infinity() -> Self {
        Emulated::constant(F::infinity())
    }
    fn just_below(&self) -> Self {
        Emulated { value: self.arithmetic.just_below(self.value), ..self.clone() }
    }
    /// Products in wider arithmetic are exact in every one of them; operands and result are flushed.
    fn difference_of_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        let all = [a, b, c, d].map(|x| x.arithmetic);
        let arithmetic = all.into_iter().fold(Arithmetic::IEEE, Arithmetic::and);
        let value = F::difference_of_products(&a.value, &b.value, &c.value, &d.value);
        Emulated::new(value, arithmetic)
    }
    fn largest_accepted(accepts: impl Fn(&Self) -> bool, exact: impl FnOnce() -> Self) -> Self {
        let Emulated { value, arithmetic, .. } = exact();
        let found = F::largest_accepted(|e| accepts(&Emulated::new(*e, arithmetic)), || value);
        Emulated::new(found, arithmetic)
    }
}

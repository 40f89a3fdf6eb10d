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
//!
//! An arithmetic that rearranges sums looks at their [`Expression`]s, whether or not a term has a name. What comes
//! out is not fused again.

use super::arithmetic::{Arithmetic, RoundedOperation};
use super::expression::{Expression, Part};
use super::rearranged::{Rest, rearranged};
use super::{Float, Real};
use std::fmt::Debug;

/// A float of another machine, which notes nothing.
pub type Emulated<F> = Rounded<F, ()>;

/// A float of another machine, with notes of the operations that made it.
#[derive(Debug)]
pub struct Rounded<F, N> {
    value: F,
    arithmetic: Arithmetic,
    notes: N,
    /// If this is a product that may still be fused.
    product: Option<Factors<F, N>>,
    expression: Expression<F, N>,
}

/// The factors of a product, and the notes on both.
#[derive(Clone, Copy, Debug)]
struct Factors<F, N> {
    a: F,
    b: F,
    notes: N,
}

/// The notes of a number on all operations that made it.
pub trait Notes: Copy + Debug + Default + Send + Sync + 'static {
    /// The notes on a given number, which may have been flushed to zero.
    fn of_given(is_flushed: bool) -> Self;
    /// The notes on one operation with its result.
    fn of_operation<F: Float>(operation: RoundedOperation<F>, result: F) -> Self;
    /// These notes and others.
    fn and(self, other: Self) -> Self;
    /// A number with these notes is compared.
    fn compared(self);
}

impl Notes for () {
    fn of_given(_: bool) {}
    fn of_operation<F: Float>(_: RoundedOperation<F>, _: F) {}
    fn and(self, (): ()) {}
    fn compared(self) {}
}

/// The number as a name that is used again: rounded, no longer a product.
impl<F: Float, N: Notes> Clone for Rounded<F, N> {
    #[inline]
    fn clone(&self) -> Self {
        Rounded {
            product: None,
            ..*self
        }
    }
}

impl<F: Float, N: Notes> Rounded<F, N> {
    /// A given number, as the arithmetic's operations see it.
    #[inline]
    pub fn new(given: F, arithmetic: Arithmetic) -> Self {
        let value = arithmetic.flush(given);
        let notes = N::of_given(value.is_zero() && !given.is_zero());
        Rounded {
            value,
            arithmetic,
            notes,
            product: None,
            expression: Expression::of_its_own(arithmetic),
        }
    }

    /// A constant, which takes on the arithmetic of what it meets.
    pub(super) fn constant(value: F) -> Self {
        Rounded {
            expression: Expression::constant(value),
            ..Rounded::new(value, Arithmetic::IEEE)
        }
    }

    /// The float.
    #[inline]
    pub fn value(&self) -> F {
        self.value
    }

    /// The notes on the operations that made it.
    pub fn notes(&self) -> N {
        self.notes
    }

    /// The result of an operation on numbers of these notes.
    #[inline]
    fn made(operation: RoundedOperation<F>, arithmetic: Arithmetic, before: N) -> Self {
        let product = match operation {
            RoundedOperation::Product(a, b) if arithmetic.fused => Some(Factors {
                a,
                b,
                notes: before,
            }),
            _ => None,
        };
        let value = operation.run(arithmetic);
        let notes = before.and(N::of_operation(operation, value));
        Rounded {
            value,
            arithmetic,
            notes,
            product,
            expression: Expression::of_its_own(arithmetic),
        }
    }

    /// The result of an operation on two numbers, with its expression where that matters.
    #[inline]
    fn known_as(
        self,
        expression: impl FnOnce(Part<F, N>, Part<F, N>) -> Expression<F, N>,
        of: [&Self; 2],
    ) -> Self {
        if !self.arithmetic.rearranged {
            return self;
        }
        let [a, b] = of.map(Rounded::part);
        Rounded {
            expression: expression(a, b),
            ..self
        }
    }

    /// As a factor or a term of others.
    fn part(&self) -> Part<F, N> {
        Part {
            value: self.value,
            notes: self.notes,
            name: self.expression.name,
        }
    }

    /// A factor or a term, as a number again.
    fn of_part(part: Part<F, N>, arithmetic: Arithmetic) -> Self {
        Rounded {
            value: part.value,
            arithmetic,
            notes: part.notes,
            product: None,
            expression: Expression::named(part.name),
        }
    }

    /// A sum as a compiler rearranges it; none if it leaves it.
    fn rearranged_sum(&self, other: &Self, arithmetic: Arithmetic) -> Option<Self> {
        let of_part = |part| Rounded::of_part(part, arithmetic);
        let rest = rearranged([self, other].map(|it| (it.part(), it.expression.made_of)))?;
        Some(match rest {
            Rest::Term(term) => of_part(term),
            Rest::Product {
                terms: [a, b],
                factor,
            } => of_part(a)
                .sum(&of_part(b))
                .product(&of_part(factor))
                .clone(),
        })
    }

    /// Rearranges the sum or fuses a product into it, of two the left one.
    #[inline(never)]
    fn sum(&self, other: &Self) -> Self {
        let arithmetic = self.arithmetic.and(other.arithmetic);
        if arithmetic.rearranged
            && let Some(sum) = self.rearranged_sum(other, arithmetic)
        {
            return sum;
        }
        self.rounded_sum(other, arithmetic)
            .known_as(Expression::sum, [self, other])
    }

    /// Fuses a product into the sum, of two the left one.
    fn rounded_sum(&self, other: &Self, arithmetic: Arithmetic) -> Self {
        let (product, term) = match self.product {
            Some(product) => (Some(product), other),
            None => (other.product, self),
        };
        if let Some(Factors { a, b, notes }) = product {
            let operation = RoundedOperation::Fused(a, b, term.value);
            return Rounded::made(operation, arithmetic, notes.and(term.notes));
        }
        let operation = RoundedOperation::Sum(self.value, other.value);
        Rounded::made(operation, arithmetic, self.notes.and(other.notes))
    }

    fn difference(&self, other: &Self) -> Self {
        self.sum(&other.negation())
    }

    #[inline]
    fn negation(&self) -> Self {
        let product = self.product.map(|product| Factors {
            a: -product.a,
            ..product
        });
        Rounded {
            value: -self.value,
            product,
            expression: self.expression.negation(),
            ..*self
        }
    }

    #[inline(never)]
    fn product(&self, other: &Self) -> Self {
        let operation = RoundedOperation::Product(self.value, other.value);
        let arithmetic = self.arithmetic.and(other.arithmetic);
        Rounded::made(operation, arithmetic, self.notes.and(other.notes))
            .known_as(Expression::product, [self, other])
    }

    #[inline(never)]
    fn quotient(&self, other: &Self) -> Self {
        let operation = RoundedOperation::Quotient(self.value, other.value);
        let arithmetic = self.arithmetic.and(other.arithmetic);
        Rounded::made(operation, arithmetic, self.notes.and(other.notes))
            .known_as(Expression::quotient, [self, other])
    }

    /// The float, which decides something.
    #[inline]
    fn compared(&self) -> F {
        self.notes.compared();
        self.value
    }
}

operators!([F: Float, N: Notes] Rounded<F, N>, Clone::clone);

impl<F: Float, N: Notes> Real for Rounded<F, N> {
    fn zero() -> Self {
        Rounded::constant(F::zero())
    }
    fn one() -> Self {
        Rounded::constant(F::one())
    }
    fn number(value: f64) -> Self {
        Rounded::constant(F::from_f64(value))
    }
    fn abs(&self) -> Self {
        Rounded {
            value: self.value.abs(),
            expression: Expression::of_its_own(self.arithmetic),
            ..self.clone()
        }
    }
    fn sqrt(&self) -> Self {
        Rounded::made(
            RoundedOperation::Root(self.value),
            self.arithmetic,
            self.notes,
        )
    }
    fn is_sign_negative(&self) -> bool {
        self.compared().is_sign_negative()
    }
    fn is_less(&self, other: &Self) -> bool {
        self.compared() < other.compared()
    }
    fn is_at_most(&self, other: &Self) -> bool {
        self.compared() <= other.compared()
    }
    fn is_zero(&self) -> bool {
        self.compared().is_zero()
    }
    fn is_nan(&self) -> bool {
        self.compared().is_nan()
    }
    fn is_finite(&self) -> bool {
        self.compared().is_finite()
    }
    fn infinity() -> Self {
        Rounded::constant(F::infinity())
    }
    fn just_below(&self) -> Self {
        Rounded {
            value: self.arithmetic.just_below(self.value),
            expression: Expression::of_its_own(self.arithmetic),
            ..self.clone()
        }
    }
    /// The wider arithmetic is the same on every machine: only operands and result are flushed.
    fn difference_of_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        let mut arithmetic = Arithmetic::IEEE;
        let mut before = N::default();
        for operand in [a, b, c, d] {
            arithmetic = arithmetic.and(operand.arithmetic);
            before = before.and(operand.notes);
        }
        let operation = RoundedOperation::Minor(a.value, b.value, c.value, d.value);
        Rounded::made(operation, arithmetic, before)
    }
    fn fused(a: &Self, b: &Self, c: &Self) -> Self {
        let arithmetic = a.arithmetic.and(b.arithmetic).and(c.arithmetic);
        let before = a.notes.and(b.notes).and(c.notes);
        let operation = RoundedOperation::Fused(a.value, b.value, c.value);
        Rounded::made(operation, arithmetic, before)
    }
    fn largest_accepted(accepts: impl Fn(&Self) -> bool, exact: impl FnOnce() -> Self) -> Self {
        let Rounded {
            value, arithmetic, ..
        } = exact();
        let found = F::largest_accepted(|e| accepts(&Rounded::new(*e, arithmetic)), || value);
        Rounded::new(found, arithmetic)
    }
}

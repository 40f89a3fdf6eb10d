//! The expression that made a number, which a compiler sees where the machine sees its value.

use super::rearranged::{MadeOf, Operand};
use super::{Arithmetic, Float};
use std::cell::Cell;

/// A name of an expression. Expressions that are written alike, of the same numbers, have one name; the negative of
/// an expression has its name's complement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Name(u64);

/// A kind of name.
#[derive(Clone, Copy)]
enum Kind {
    OfItsOwn = 1,
    Constant,
    Sum,
    Product,
    Quotient,
}

impl Name {
    /// Where nothing is rearranged.
    const UNKNOWN: Name = Name(0);

    fn negation(self) -> Name {
        Name(!self.0)
    }

    /// Two expressions share a name by an accident of 1 in 2^64.
    fn of(kind: Kind, words: [u64; 2]) -> Name {
        let mixed = words.into_iter().fold(kind as u64, |mixed, word| {
            let product = (mixed ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            product ^ (product >> 29)
        });
        Name(mixed)
    }
}

/// A number with the name of its expression, as a factor or a term of others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<F, N> {
    pub value: F,
    pub notes: N,
    pub name: Name,
}

impl<F: Float, N: Copy> Operand for Part<F, N> {
    fn is_the_same_as(self, other: Self) -> bool {
        self.name == other.name
    }

    fn negation(self) -> Self {
        Part {
            value: -self.value,
            name: self.name.negation(),
            ..self
        }
    }
}

/// The expression of a number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expression<F, N> {
    pub name: Name,
    pub made_of: MadeOf<Part<F, N>>,
}

thread_local! {
    /// How many expressions have a name of their own.
    static OWN_NAMES: Cell<u64> = const { Cell::new(0) };
}

impl<F: Float, N: Copy> Expression<F, N> {
    pub(super) const fn named(name: Name) -> Self {
        Expression {
            name,
            made_of: MadeOf::Other,
        }
    }

    /// A number that is like no other, whatever its value: a given one, a root. An arithmetic that rearranges
    /// nothing needs no names.
    #[inline]
    pub(super) fn of_its_own(arithmetic: Arithmetic) -> Self {
        if !arithmetic.rearranged {
            return Expression::named(Name::UNKNOWN);
        }
        let number = OWN_NAMES.get().wrapping_add(1);
        OWN_NAMES.set(number);
        Expression::named(Name::of(Kind::OfItsOwn, [number, 0]))
    }

    /// A constant has its value's name.
    pub(super) fn constant(value: F) -> Self {
        let name = Name::of(Kind::Constant, [value.abs().to_f64().to_bits(), 0]);
        match value.is_sign_negative() {
            true => Expression::named(name.negation()),
            false => Expression::named(name),
        }
    }

    pub(super) fn sum(a: Part<F, N>, b: Part<F, N>) -> Self {
        Expression {
            name: Name::of(Kind::Sum, [a.name.0, b.name.0]),
            made_of: MadeOf::Sum(a, b),
        }
    }

    pub(super) fn product(a: Part<F, N>, b: Part<F, N>) -> Self {
        Expression {
            name: Name::of(Kind::Product, [a.name.0, b.name.0]),
            made_of: MadeOf::Product(a, b),
        }
    }

    pub(super) fn quotient(a: Part<F, N>, b: Part<F, N>) -> Self {
        Expression::named(Name::of(Kind::Quotient, [a.name.0, b.name.0]))
    }

    /// The negative, through which no rule looks.
    pub(super) fn negation(&self) -> Self {
        Expression::named(self.name.negation())
    }
}

//! The normal form of each number of a program.
//!
//! Rounding to nearest is odd, and sums and products commute, so each number of a program has a normal
//! form: a sign, and a formula without order and without a sign. Two numbers with the same normal form are equal for
//! all inputs, but for the signs of zeros (a - b and b - a are both +0), and so for what is divided by one. If the
//! normal form of an edge's value with the edge's ends exchanged has the same formula and the other sign, the two
//! values are exact negatives, or both 0.

use crate::arith::recorded::{Operation, Place, Term};
use crate::kernel::Path;
use std::collections::HashMap;

/// A formula without order or sign, by number.
type Form = usize;

/// The value of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Signed {
    is_negative: bool,
    form: Form,
}

impl Signed {
    pub fn negated(self) -> Signed {
        Signed {
            is_negative: !self.is_negative,
            form: self.form,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Shape {
    Input(u8),
    Number(i32),
    /// Without its sign.
    Size(Form),
    Quotient(Form, Form),
    Root(Signed),
    /// A sum that is rounded once, of products and single numbers; true of each that has the other sign than the first.
    Terms(Vec<Term<Form>>),
}

/// The formulas seen so far.
#[derive(Default)]
pub struct Forms {
    known: HashMap<Shape, Form>,
}

impl Forms {
    /// The value of a number, its inputs renamed.
    pub fn of(&mut self, path: &Path, place: Place, rename: &dyn Fn(u8) -> u8) -> Signed {
        let mut values: Vec<Signed> = Vec::new();
        for operation in &path.operations[..=place as usize] {
            let value = match operation.with(|place| values[place as usize]) {
                Operation::Input(i) => self.positive(Shape::Input(rename(i))),
                Operation::Number(value) => Signed {
                    is_negative: value < 0,
                    ..self.positive(Shape::Number(value.abs()))
                },
                Operation::Neg(a) => a.negated(),
                Operation::Abs(a) => self.positive(Shape::Size(a.form)),
                Operation::Sqrt(a) => self.positive(Shape::Root(a)),
                Operation::Div(a, b) => Signed {
                    is_negative: a.is_negative ^ b.is_negative,
                    ..self.positive(Shape::Quotient(a.form, b.form))
                },
                sum => self.sum(sum.terms().map(without_order).collect()),
            };
            values.push(value);
        }
        values[place as usize]
    }

    fn sum(&mut self, mut terms: Vec<Term<Form>>) -> Signed {
        terms.sort_by_key(|(_, a, b)| (*a, *b));
        let (is_negative, ..) = terms[0];
        for term in &mut terms {
            term.0 ^= is_negative;
        }
        Signed {
            is_negative,
            ..self.positive(Shape::Terms(terms))
        }
    }

    fn positive(&mut self, shape: Shape) -> Signed {
        let next = self.known.len();
        Signed {
            is_negative: false,
            form: *self.known.entry(shape).or_insert(next),
        }
    }
}

/// A term of a sum with its sign, and with its factors in the order of their forms.
fn without_order((is_negative, a, b): Term<Signed>) -> Term<Form> {
    match b {
        Some(b) => (
            is_negative ^ a.is_negative ^ b.is_negative,
            a.form.min(b.form),
            Some(a.form.max(b.form)),
        ),
        None => (is_negative ^ a.is_negative, a.form, None),
    }
}

//! Normal forms of the numbers of a program.
//!
//! Rounding to nearest is odd, and sums and products commute, so each number of a program has a normal
//! form: a sign, and a formula without order and without a sign. Two numbers with the same normal form are equal for
//! all inputs, but for the signs of zeros (a - b and b - a are both +0), and so for what is divided by one.

use crate::arith::recorded::{Operation, Place, Term};
use crate::kernel::Path;
use std::collections::HashMap;

/// A formula without order or sign, by number.
pub type Form = usize;
/// A sign (true is minus) and a formula.
pub type Signed = (bool, Form);

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Shape {
    Input(u8),
    Number(i32),
    /// Without its sign.
    Size(Form),
    Quotient(Form, Form),
    Root(Form),
    /// A sum that is rounded once, of products and single numbers; true of each that has the other sign than the first.
    Terms(Vec<Term<Form>>),
}

/// The formulas seen so far.
#[derive(Default)]
pub struct Forms {
    known: HashMap<Shape, Form>,
}

impl Forms {
    /// The sign (true is minus) and the form of a number, its inputs renamed.
    pub fn of(&mut self, path: &Path, place: Place, rename: &dyn Fn(u8) -> u8) -> Signed {
        let mut values: Vec<(bool, Form)> = Vec::new();
        for operation in &path.operations[..=place as usize] {
            let of = |place: Place| values[place as usize];
            let term = |(is_minus, a, b): Term<Place>| {
                let (s, a) = of(a);
                match b.map(of) {
                    Some((t, b)) => (is_minus ^ s ^ t, a.min(b), Some(a.max(b))),
                    None => (is_minus ^ s, a, None),
                }
            };
            let value = match *operation {
                Operation::Input(i) => (false, self.number(Shape::Input(rename(i)))),
                Operation::Number(value) => (value < 0, self.number(Shape::Number(value.abs()))),
                Operation::Neg(a) => (!of(a).0, of(a).1),
                Operation::Abs(a) => (false, self.number(Shape::Size(of(a).1))),
                Operation::Sqrt(a) => {
                    let (sign, a) = of(a);
                    (false, self.number(Shape::Root(2 * a + usize::from(sign))))
                }
                Operation::Div(a, b) => {
                    let ((s, a), (t, b)) = (of(a), of(b));
                    (s ^ t, self.number(Shape::Quotient(a, b)))
                }
                _ => self.sum(operation.terms().map(term).collect()),
            };
            values.push(value);
        }
        values[place as usize]
    }

    fn sum(&mut self, mut terms: Vec<Term<Form>>) -> Signed {
        terms.sort_by_key(|(_, a, b)| (*a, *b));
        let sign = terms[0].0;
        terms.iter_mut().for_each(|term| term.0 ^= sign);
        (sign, self.number(Shape::Terms(terms)))
    }

    fn number(&mut self, shape: Shape) -> Form {
        let next = self.known.len();
        *self.known.entry(shape).or_insert(next)
    }
}

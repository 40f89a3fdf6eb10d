//! Normal forms of the numbers of a program.
//!
//! Rounding to nearest is odd, and sums and products commute, so each number of a program has a normal
//! form: a sign, and a formula without order and without a sign. Two numbers with the same normal form are equal for
//! all inputs, but for the signs of zeros (a - b and b - a are both +0), and so for what is divided by one.

use crate::arith::recorded::{Operation, Place};
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
    /// Two terms; whether the second has the other sign than the first.
    Sum(Form, Form, bool),
    Product(Form, Form),
    Quotient(Form, Form),
    Root(Form),
    /// A product rounded with a term; whether they differ in sign.
    Fused(Form, Form, Form, bool),
    /// Two products, and whether they differ in sign.
    Minor([Form; 2], [Form; 2], bool),
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
            let ordered = |a: Form, b: Form| [a.min(b), a.max(b)];
            let value = match *operation {
                Operation::Input(i) => (false, self.number(Shape::Input(rename(i)))),
                Operation::Number(value) => (value < 0, self.number(Shape::Number(value.abs()))),
                Operation::Neg(a) => (!of(a).0, of(a).1),
                Operation::Abs(a) => (false, self.number(Shape::Size(of(a).1))),
                Operation::Sqrt(a) => {
                    let (sign, a) = of(a);
                    (false, self.number(Shape::Root(2 * a + usize::from(sign))))
                }
                Operation::Add(a, b) => self.sum(of(a), of(b)),
                Operation::Sub(a, b) => self.sum(of(a), (!of(b).0, of(b).1)),
                Operation::Mul(a, b) => {
                    let ((s, a), (t, b)) = (of(a), of(b));
                    let [a, b] = ordered(a, b);
                    (s ^ t, self.number(Shape::Product(a, b)))
                }
                Operation::Div(a, b) => {
                    let ((s, a), (t, b)) = (of(a), of(b));
                    (s ^ t, self.number(Shape::Quotient(a, b)))
                }
                Operation::Fma(a, b, c) => {
                    let ((s, a), (t, b), (r, c)) = (of(a), of(b), of(c));
                    let [a, b] = ordered(a, b);
                    (r, self.number(Shape::Fused(a, b, c, s ^ t ^ r)))
                }
                Operation::Minor(a, b, c, d) => {
                    let ((s, a), (t, b)) = (of(a), of(b));
                    let ((q, c), (r, d)) = (of(c), of(d));
                    let (first, second) = (ordered(a, b), ordered(c, d));
                    let (sign, other) = (s ^ t, !(q ^ r));
                    if first <= second {
                        (sign, self.number(Shape::Minor(first, second, sign ^ other)))
                    } else {
                        (other, self.number(Shape::Minor(second, first, sign ^ other)))
                    }
                }
            };
            values.push(value);
        }
        values[place as usize]
    }

    fn sum(&mut self, (s, a): (bool, Form), (t, b): (bool, Form)) -> (bool, Form) {
        if a <= b {
            (s, self.number(Shape::Sum(a, b, s ^ t)))
        } else {
            (t, self.number(Shape::Sum(b, a, s ^ t)))
        }
    }

    fn number(&mut self, shape: Shape) -> Form {
        let next = self.known.len();
        *self.known.entry(shape).or_insert(next)
    }
}

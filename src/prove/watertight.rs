//! Whether a kernel's value of an edge is, bit for bit, the negative of what it computes for the
//! triangle on the other side.
//!
//! Rounding to nearest is odd, and sums and products commute, so each number of a program has a normal
//! form: a sign, and a formula without order and without a sign. If the normal form of an edge's value
//! with the edge's ends exchanged has the same formula and the other sign, the two values are exact
//! negatives for all inputs.

use super::Quantity;
use crate::arith::recorded::{Operation, Place};
use crate::kernel::Path;
use std::collections::HashMap;

/// What is known of a kernel's edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symmetry {
    /// Some edge's value is not made of the edge and the ray alone, or not the negative of the neighbour's.
    None,
    /// The values of the two sides are exact negatives on the same path.
    Negatives,
    /// And each of them, if it is not zero, has the sign of the exact determinant of the same two rounded
    /// points of a plane.
    ExactSigns,
}

/// The symmetry of the edge values on one path.
pub fn symmetry<'a>(path: &Path, quantities: impl Iterator<Item = &'a Quantity>) -> Symmetry {
    let found = quantities.map(|quantity| symmetry_of(path, quantity.place));
    found.min().unwrap_or(Symmetry::None)
}

/// The symmetry of one edge value.
pub fn symmetry_of(path: &Path, place: Place) -> Symmetry {
    let points = vertices(path, place);
    let [p, q] = points[..] else { return Symmetry::None };
    let mut forms = Forms::default();
    let (sign, form) = forms.of(path, place, &|i| i);
    let exchange = |i: u8| match usize::from(i) / 3 {
        _ if !(6..15).contains(&i) => i,
        point if point == p => (q * 3) as u8 + i % 3,
        point if point == q => (p * 3) as u8 + i % 3,
        _ => i,
    };
    let (other_sign, other) = forms.of(path, place, &exchange);
    if form != other || sign == other_sign {
        Symmetry::None
    } else if is_difference_of_two_products(path, place) {
        Symmetry::ExactSigns
    } else {
        Symmetry::Negatives
    }
}

/// `a*b - c*d` of numbers, with both products rounded or neither: rounding is monotone, so the
/// difference is not of the wrong sign.
fn is_difference_of_two_products(path: &Path, place: Place) -> bool {
    let is_product = |place: Place| matches!(path.operations[place as usize], Operation::Mul(..));
    match path.operations[place as usize] {
        Operation::Minor(..) => true,
        Operation::Sub(a, b) => is_product(a) && is_product(b),
        Operation::Neg(a) => is_difference_of_two_products(path, a),
        _ => false,
    }
}

/// The vertices that a number is made of: a, b and c as 2, 3 and 4.
fn vertices(path: &Path, place: Place) -> Vec<usize> {
    let mut open = vec![place];
    let mut seen = vec![false; path.operations.len()];
    let mut found = Vec::new();
    while let Some(place) = open.pop() {
        if std::mem::replace(&mut seen[place as usize], true) {
            continue;
        }
        let operation = path.operations[place as usize];
        if let Operation::Input(i @ 6..15) = operation {
            found.push(usize::from(i) / 3);
        }
        open.extend(operation.operands());
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// A formula without order or sign, by number.
type Form = usize;

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Shape {
    Input(u8),
    Number(i32),
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

#[derive(Default)]
struct Forms {
    known: HashMap<Shape, Form>,
}

impl Forms {
    /// The sign (true is minus) and the form of a number, its inputs renamed.
    fn of(&mut self, path: &Path, place: Place, rename: &dyn Fn(u8) -> u8) -> (bool, Form) {
        let mut values: Vec<(bool, Form)> = Vec::new();
        for operation in &path.operations[..=place as usize] {
            let of = |place: Place| values[place as usize];
            let ordered = |a: Form, b: Form| [a.min(b), a.max(b)];
            let value = match *operation {
                Operation::Input(i) => (false, self.number(Shape::Input(rename(i)))),
                Operation::Number(value) => (value < 0, self.number(Shape::Number(value.abs()))),
                Operation::Neg(a) => (!of(a).0, of(a).1),
                Operation::Abs(a) => (false, of(a).1),
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

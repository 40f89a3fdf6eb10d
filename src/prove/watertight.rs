//! Whether a kernel's value of an edge is, bit for bit, the negative of what it computes for the
//! triangle on the other side.
//!
//! Rounding to nearest is odd, and sums and products commute, so each number of a program has a normal
//! form: a sign, and a formula without order and without a sign. If the normal form of an edge's value
//! with the edge's ends exchanged has the same formula and the other sign, the two values are exact
//! negatives for all inputs.

use super::order::unsigned;
use crate::arith::recorded::{Comparison, Operation, Place};
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

/// The symmetry of a kernel's edge values on all its paths; `is_edge` tells the gates that compare them.
///
/// For exact signs, all edges of a ray must be decided on one picture of the vertices. What a ray alone decides, before
/// the first comparison that depends on a vertex, is the same for both triangles of an edge: wherever it is the same,
/// all edges must have the same images.
pub fn symmetry(paths: &[Path], is_edge: impl Fn(usize) -> bool) -> Symmetry {
    let mut forms = Forms::default();
    let mut images_of: HashMap<Vec<Decision>, [Signed; 2]> = HashMap::new();
    let mut least = None;
    for path in paths {
        let of_edges = path.compared.iter().filter(|compared| is_edge(compared.gate));
        let places = of_edges.flat_map(|compared| compared.quantities.iter().copied());
        // A fixed number, or one of the ray, is no edge's value.
        let places = places.filter(|place| !vertices(path, *place).is_empty());
        let mut places: Vec<Place> = places.map(|place| unsigned(path, place)).collect();
        places.sort_unstable();
        places.dedup();
        for place in places {
            let mut found = symmetry_of(path, place);
            if let Some(images) = images(&mut forms, path, place) {
                let known = images_of.entry(forms.of_the_ray(path)).or_insert(images);
                if *known != images {
                    found = found.min(Symmetry::Negatives);
                }
            }
            least = least.min(Some(found)).or(Some(found));
            if found == Symmetry::None {
                return Symmetry::None;
            }
        }
    }
    least.unwrap_or(Symmetry::None)
}

/// The symmetry of one edge value.
pub fn symmetry_of(path: &Path, place: Place) -> Symmetry {
    let points = vertices(path, place);
    let [p, q] = points[..] else { return Symmetry::None };
    let mut forms = Forms::default();
    let (sign, form) = forms.of(path, place, &|i| i);
    let (other_sign, other) = forms.of(path, place, &|i| exchanged(i, p, q));
    if form != other || sign == other_sign {
        Symmetry::None
    } else if images(&mut forms, path, place).is_some() {
        Symmetry::ExactSigns
    } else {
        Symmetry::Negatives
    }
}

/// An input where two vertices are exchanged.
fn exchanged(input: u8, p: usize, q: usize) -> u8 {
    match usize::from(input) / 3 {
        _ if !(6..15).contains(&input) => input,
        point if point == p => (q * 3) as u8 + input % 3,
        point if point == q => (p * 3) as u8 + input % 3,
        _ => input,
    }
}

/// If a number is x(p)·y(q) - x(q)·y(p) of two vertices p and q, with both products rounded or neither: x and y, as they
/// are of vertex a, where q comes after p. Rounding is monotone, so that the difference is not of the wrong sign.
fn images(forms: &mut Forms, path: &Path, place: Place) -> Option<[Signed; 2]> {
    let operation = |place: Place| path.operations[place as usize];
    let (first, second) = match operation(place) {
        Operation::Minor(x, y, z, w) => ([x, y], [z, w]),
        Operation::Sub(a, b) => match (operation(a), operation(b)) {
            (Operation::Mul(x, y), Operation::Mul(z, w)) => ([x, y], [z, w]),
            _ => return None,
        },
        _ => return None,
    };
    let of = |place: Place| <[usize; 1]>::try_from(vertices(path, place)).ok();
    let ([p], [q]) = (of(first[0])?, of(first[1])?);
    let mut there = first.map(|place| forms.of(path, place, &|i| exchanged(i, p, q)));
    let mut here = second.map(|place| forms.of(path, place, &|i| i));
    there.sort_unstable();
    here.sort_unstable();
    if p == q || there != here {
        return None;
    }
    let [x, y] = [(first[0], p), (first[1], q)]
        .map(|(place, vertex)| forms.of(path, place, &|i| exchanged(i, vertex, FIRST_VERTEX)));
    let is_next = (p + 1 - FIRST_VERTEX) % 3 == q - FIRST_VERTEX;
    Some(if is_next { [x, y] } else { [y, x] })
}

/// Vertex a among the points.
const FIRST_VERTEX: usize = 2;

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
/// A sign (true is minus) and a formula.
type Signed = (bool, Form);
/// What a path compared, and the answer.
type Decision = (u8, Signed, Signed, bool);

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

#[derive(Default)]
struct Forms {
    known: HashMap<Shape, Form>,
}

impl Forms {
    /// The sign (true is minus) and the form of a number, its inputs renamed.
    fn of(&mut self, path: &Path, place: Place, rename: &dyn Fn(u8) -> u8) -> Signed {
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

    /// What a path decides before its first comparison that depends on a vertex.
    fn of_the_ray(&mut self, path: &Path) -> Vec<Decision> {
        let is_of_ray = |(comparison, _): &&(Comparison, bool)| {
            comparison.places().iter().all(|place| vertices(path, *place).is_empty())
        };
        let of_ray: Vec<_> = path.decisions.iter().take_while(is_of_ray).copied().collect();
        let decision = |(comparison, answer): (Comparison, bool)| {
            let mut of = |place: Place| self.of(path, place, &|i| i);
            match comparison {
                Comparison::Less(a, b) => (0, of(a), of(b), answer),
                Comparison::AtMost(a, b) => (1, of(a), of(b), answer),
                Comparison::Zero(a) => (2, of(a), of(a), answer),
                Comparison::Negative(a) => (3, of(a), of(a), answer),
            }
        };
        of_ray.into_iter().map(decision).collect()
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

//! Checks if a kernel's value of an edge is, bit for bit, the negative of the value that it computes for the triangle
//! on the other side, and shows what follows for rays there.
//!
//! Rounding to nearest is odd, and sums and products commute, so each number of a program has a normal
//! form: a sign, and a formula without order and without a sign. Two numbers with the same normal form are equal for
//! all inputs, but for the signs of zeros (a - b and b - a are both +0), and so for what is divided by one. If the
//! normal form of an edge's value with the edge's ends exchanged has the same formula and the other sign, the two
//! values are exact negatives, or both 0.

use super::run::parts;
use crate::arith::recorded::{Comparison, Operation, Outcome, Place, Term};
use crate::kernel::{Acceptance, Compared, Path, Refuse};
use std::collections::{BTreeSet, HashMap};
use std::mem::{Discriminant, discriminant};
use std::ops::Range;

/// The strongest statement that is known of a kernel's edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symmetry {
    /// Nothing: some edge's value is not made of the edge and the ray alone, or not the negative of the neighbour's, or
    /// the gates make something else of their signs.
    None,
    /// The values of the two sides are exact negatives, or both 0.
    Negatives,
    /// Each of them, if it is not 0, has the sign of the exact determinant of the same two rounded points of a plane.
    ExactSigns,
}

/// The symmetry of a kernel's edge values on all its paths; `is_edge` tells the gates that compare them.
///
/// The decisions of the ray alone, before the first comparison that depends on anything else, are the same for both
/// triangles of an edge. Wherever they are the same, all edges must be the same formula of their two vertices, or have
/// the same images. On every path the gates, at an epsilon of 0, must accept all triples of edge values that are not
/// negative, and all that are not positive; and nothing but gates may refuse. How the gates treat signs is tried, not
/// recognised.
pub fn symmetry(paths: &[Path], is_edge: impl Fn(usize) -> bool) -> Symmetry {
    let mut forms = Forms::default();
    let mut met: HashMap<Vec<Decision>, Met> = HashMap::new();
    for path in paths {
        let gates: Vec<&Compared> = path
            .compared
            .iter()
            .filter(|compared| is_edge(compared.gate))
            .collect();
        let edges = three_edges(path, &gates).filter(|edges| {
            path.hits
                && [1, -1]
                    .iter()
                    .all(|side| accept_all(path, &gates, edges, *side))
        });
        let Some(edges) = edges else {
            return Symmetry::None;
        };
        let of_ray = of_the_ray(&mut forms, path);
        for place in edges {
            let form = Some(of_edge(&mut forms, path, place)).filter(|_| is_opposite(path, place));
            let of_edge = Met {
                form,
                images: images(&mut forms, path, place),
            };
            met.entry(of_ray.clone()).or_insert(of_edge).join(of_edge);
        }
    }
    met.values()
        .map(Met::symmetry)
        .min()
        .unwrap_or(Symmetry::None)
}

/// The common formula or images of all edges that one ray may meet.
#[derive(Clone, Copy, Debug)]
struct Met {
    /// The formula, as it is of an edge from a to b; none if there are several, or if it is not the negative of itself
    /// with its ends exchanged.
    form: Option<Signed>,
    /// The images, if all are decided on the same.
    images: Option<[Signed; 2]>,
}

impl Met {
    fn join(&mut self, other: Met) {
        self.form = self.form.filter(|form| other.form == Some(*form));
        self.images = self.images.filter(|images| other.images == Some(*images));
    }

    fn symmetry(&self) -> Symmetry {
        match self {
            Met {
                images: Some(_), ..
            } => Symmetry::ExactSigns,
            Met { form: Some(_), .. } => Symmetry::Negatives,
            _ => Symmetry::None,
        }
    }
}

/// The values of the edges ab, bc and ca without the signs around them, if some gates compare these and 0 and nothing
/// else, and if short of overflow they are numbers that depend on the edge and the ray's line alone.
fn three_edges(path: &Path, gates: &[&Compared]) -> Option<[Place; 3]> {
    let mut edges = [None; 3];
    for place in gates.iter().flat_map(|compared| &compared.quantities) {
        let (_, place) = signed(path, *place);
        if path.operations[place as usize] == Operation::Number(0) {
            continue;
        }
        let (from, _) = ends(path, place).filter(|_| is_sound(path, place))?;
        let known = edges[from - FIRST_VERTEX].get_or_insert(place);
        if *known != place {
            return None;
        }
    }
    let [Some(ab), Some(bc), Some(ca)] = edges else {
        return None;
    };
    Some([ab, bc, ca])
}

/// True if a number does not depend on t_min or t_max, which differ from triangle to triangle as hits are found, and no
/// vertex is in a divisor, where 0 divided by 0 would be refused on both sides of an edge, or under a root.
fn is_sound(path: &Path, place: Place) -> bool {
    let depends = |place: Place, on: Range<u8>| {
        inputs(path, place)
            .into_iter()
            .any(|input| on.contains(&input))
    };
    let is_critical = |place: Place| match path.operations[place as usize] {
        Operation::Div(_, part) | Operation::Sqrt(part) => depends(part, VERTICES),
        _ => false,
    };
    !depends(place, ENDS) && !parts(&path.operations, place).into_iter().any(is_critical)
}

/// True if some gates accept surely, at an epsilon of 0, if the three edges' values are 0 or have the sign of `side`.
fn accept_all(path: &Path, gates: &[&Compared], edges: &[Place; 3], side: i8) -> bool {
    (0..8).all(|which: u8| {
        let value = |place: Place| {
            let (minus, place) = signed(path, place);
            let edge = edges.iter().position(|edge| *edge == place);
            let sign = edge.map_or(0, |edge| if which >> edge & 1 == 1 { side } else { 0 });
            (edge.is_some(), if minus { -sign } else { sign })
        };
        gates
            .iter()
            .all(|compared| accepts_surely(&compared.accepts, value))
    })
}

/// True if a gate accepts at an epsilon of 0, given for each number if it is an edge's value (else it is 0), and its
/// sign.
fn accepts_surely(acceptance: &Acceptance, value: impl Fn(Place) -> (bool, i8)) -> bool {
    let sign = |place: Place| value(place).1;
    // None if the answer may be either.
    let answer = |comparison: &Comparison| match *comparison {
        Comparison::Less(a, b) | Comparison::AtMost(a, b) if value(a).0 && value(b).0 => None,
        Comparison::Less(a, b) => Some(sign(a) < sign(b)),
        Comparison::AtMost(a, b) => Some(sign(a) <= sign(b)),
        Comparison::Zero(a) => Some(sign(a) == 0),
        // Of a zero the sign bit may be set.
        Comparison::Negative(a) => Some(sign(a) < 0).filter(|_| sign(a) != 0),
    };
    match acceptance {
        Acceptance::Fixed(..) => false,
        Acceptance::Clauses(refuse, clauses) => {
            let least = match refuse {
                Refuse::Below | Refuse::UnlessAtLeast => 0,
                Refuse::AtMost | Refuse::UnlessAbove => 1,
            };
            clauses
                .iter()
                .any(|clause| clause.iter().all(|place| least <= sign(*place)))
        }
        Acceptance::Rounded(outcomes) => {
            let may_happen = |outcome: &&Outcome| {
                let mut answers = outcome.answers.iter();
                answers.all(|(comparison, given)| answer(comparison).is_none_or(|it| it == *given))
            };
            outcomes
                .iter()
                .filter(may_happen)
                .all(|outcome| outcome.accepts)
        }
    }
}

/// A number without the signs around it, and whether they make it the negative.
pub(super) fn signed(path: &Path, place: Place) -> (bool, Place) {
    match path.operations[place as usize] {
        Operation::Neg(inner) => {
            let (minus, place) = signed(path, inner);
            (!minus, place)
        }
        _ => (false, place),
    }
}

/// The two vertices that an edge's value is made of, the second one after the first in the order a, b, c, a.
fn ends(path: &Path, place: Place) -> Option<(usize, usize)> {
    let [p, q] = vertices(path, place)[..] else {
        return None;
    };
    Some(if q == p + 1 { (p, q) } else { (q, p) })
}

/// The symmetry of one edge value.
pub fn symmetry_of(path: &Path, place: Place) -> Symmetry {
    if !is_opposite(path, place) {
        Symmetry::None
    } else if images(&mut Forms::default(), path, place).is_some() {
        Symmetry::ExactSigns
    } else {
        Symmetry::Negatives
    }
}

/// True if a number of two vertices becomes its negative, bit for bit, when these are exchanged.
fn is_opposite(path: &Path, place: Place) -> bool {
    let Some((p, q)) = ends(path, place) else {
        return false;
    };
    let mut forms = Forms::default();
    let (sign, form) = forms.of(path, place, &|i| i);
    let (other_sign, other) = forms.of(path, place, &|i| exchanged(i, p, q));
    form == other && sign != other_sign
}

/// An input where two vertices are exchanged.
fn exchanged(input: u8, p: usize, q: usize) -> u8 {
    renamed(input, |vertex| match vertex {
        _ if vertex == p => q,
        _ if vertex == q => p,
        _ => vertex,
    })
}

/// An input where vertices have other names.
fn renamed(input: u8, name: impl Fn(usize) -> usize) -> u8 {
    match VERTICES.contains(&input) {
        true => (3 * name(usize::from(input / 3))) as u8 + input % 3,
        false => input,
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
    // Written from the edge's first end to its second.
    let is_along = ends(path, place).is_some_and(|(from, _)| from == p);
    Some(if is_along { [x, y] } else { [y, x] })
}

/// Vertex a among the points.
const FIRST_VERTEX: usize = 2;
/// The inputs that are the vertices' coordinates.
const VERTICES: Range<u8> = 6..15;
/// Those that are t_min and t_max.
const ENDS: Range<u8> = 15..17;

/// The vertices that a number is made of: a, b and c as 2, 3 and 4.
fn vertices(path: &Path, place: Place) -> Vec<usize> {
    let inputs = inputs(path, place).into_iter();
    let found = inputs
        .filter(|i| VERTICES.contains(i))
        .map(|i| usize::from(i) / 3);
    found.collect::<BTreeSet<_>>().into_iter().collect()
}

/// The inputs that a number is made of.
fn inputs(path: &Path, place: Place) -> Vec<u8> {
    let of_part = |place: Place| match path.operations[place as usize] {
        Operation::Input(i) => Some(i),
        _ => None,
    };
    let parts = parts(&path.operations, place).into_iter();
    parts.filter_map(of_part).collect()
}

/// The comparison of a path, and its answer.
type Decision = (Discriminant<Comparison>, Vec<Signed>, bool);

/// An edge's value as it is of the edge from a to b.
fn of_edge(forms: &mut Forms, path: &Path, place: Place) -> Signed {
    let ends = ends(path, place);
    let name = |vertex: usize| match ends {
        Some((from, _)) if vertex == from => FIRST_VERTEX,
        Some((_, to)) if vertex == to => FIRST_VERTEX + 1,
        _ => vertex,
    };
    forms.of(path, place, &|i| renamed(i, name))
}

/// The decisions of a path before its first comparison that depends on more than the ray's line.
fn of_the_ray(forms: &mut Forms, path: &Path) -> Vec<Decision> {
    // t_max is no part of it: it shrinks from triangle to triangle as hits are found.
    let depends = |i: u8| 6 <= i;
    let is_of_ray = |(comparison, _): &&(Comparison, bool)| {
        comparison
            .places()
            .iter()
            .all(|place| !inputs(path, *place).into_iter().any(depends))
    };
    let of_ray: Vec<_> = path
        .decisions
        .iter()
        .take_while(is_of_ray)
        .copied()
        .collect();
    let decision = |(comparison, answer): (Comparison, bool)| {
        let places = comparison.places().into_iter();
        let forms = places.map(|place| forms.of(path, place, &|i| i)).collect();
        (discriminant(&comparison), forms, answer)
    };
    of_ray.into_iter().map(decision).collect()
}

/// A formula without order or sign, by number.
type Form = usize;
/// A sign (true is minus) and a formula.
type Signed = (bool, Form);

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
struct Forms {
    known: HashMap<Shape, Form>,
}

impl Forms {
    /// The sign (true is minus) and the form of a number, its inputs renamed.
    fn of(&mut self, path: &Path, place: Place, rename: &dyn Fn(u8) -> u8) -> Signed {
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

//! Checks if a kernel's value of an edge is, bit for bit, the negative of the value that it computes for the triangle
//! on the other side, and shows what follows for rays there.

use super::normal::{Forms, Signed};
use super::order::{is_at_most, unsigned};
use super::run::parts;
use crate::arith::recorded::{Comparison, Operation, Outcome, Place};
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
    let mut met: HashMap<Vec<Decision>, EdgesOfRay> = HashMap::new();
    for path in paths {
        let mut gates: Vec<&Compared> = path.compared.iter().collect();
        gates.retain(|compared| is_edge(compared.gate));
        let Some(edges) = three_edges(path, &gates) else {
            return Symmetry::None;
        };
        let accept = |side| accept_all(path, &gates, &edges, side);
        if !path.hits || !accept(1) || !accept(-1) {
            return Symmetry::None;
        }
        let of_ray = of_the_ray(&mut forms, path);
        for place in edges {
            let form = of_edge(&mut forms, path, place);
            let of_edge = EdgesOfRay {
                form: is_opposite(path, place).then_some(form),
                images: images(&mut forms, path, place),
            };
            met.entry(of_ray.clone()).or_insert(of_edge).join(of_edge);
        }
    }
    let least = met.values().map(EdgesOfRay::symmetry).min();
    least.unwrap_or(Symmetry::None)
}

/// The common formula or images of all edges that one ray may meet.
#[derive(Clone, Copy)]
struct EdgesOfRay {
    /// The formula, as it is of an edge from a to b; none if there are several, or if it is not the negative of itself
    /// with its ends exchanged.
    form: Option<Signed>,
    /// The images, if all are decided on the same.
    images: Option<[Signed; 2]>,
}

impl EdgesOfRay {
    fn join(&mut self, other: EdgesOfRay) {
        self.form = self.form.filter(|form| other.form == Some(*form));
        self.images = self.images.filter(|images| other.images == Some(*images));
    }

    fn symmetry(&self) -> Symmetry {
        if self.images.is_some() {
            Symmetry::ExactSigns
        } else if self.form.is_some() {
            Symmetry::Negatives
        } else {
            Symmetry::None
        }
    }
}

/// The values of the edges ab, bc and ca without the signs around them, if some gates compare these and 0 and nothing
/// else, and if short of overflow they are numbers that depend on the edge and the ray's line alone.
fn three_edges(path: &Path, gates: &[&Compared]) -> Option<[Place; 3]> {
    let mut edges = [None; 3];
    for place in gates.iter().flat_map(|compared| &compared.quantities) {
        let place = signed(path, *place).place;
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

/// True if a number does not depend on t_min or t_max, which differ from triangle to triangle as hits are found, and is never
/// NaN, which may be refused on both sides of an edge: it divides by nothing but the largest coordinate of the direction, and has no
/// root.
fn is_sound(path: &Path, place: Place) -> bool {
    let is_largest = |divisor: Place| match path.operations[unsigned(path, divisor) as usize] {
        Operation::Input(k @ 3..6) => (3..6).all(|other| is_at_most(path, other, k)),
        Operation::Number(value) => value != 0,
        _ => false,
    };
    let is_critical = |part: &Place| match path.operations[*part as usize] {
        Operation::Div(_, divisor) => !is_largest(divisor),
        Operation::Sqrt(_) => true,
        _ => false,
    };
    let parts = parts(&path.operations, place);
    !depends(path, place, ENDS) && !parts.iter().any(is_critical)
}

/// True if a number is made of some of these inputs.
fn depends(path: &Path, place: Place, on: Range<u8>) -> bool {
    let mut inputs = inputs(path, place).into_iter();
    inputs.any(|input| on.contains(&input))
}

/// True if some gates accept surely, at an epsilon of 0, if the three edges' values are 0 or have the sign of `side`.
fn accept_all(path: &Path, gates: &[&Compared], edges: &[Place; 3], side: i8) -> bool {
    (0..8).all(|which| {
        let values = EdgeValues {
            path,
            edges,
            which,
            side,
        };
        gates
            .iter()
            .all(|compared| values.are_accepted(&compared.accepts))
    })
}

/// Signs of the three edges' values.
struct EdgeValues<'a> {
    path: &'a Path,
    edges: &'a [Place; 3],
    /// The edges whose values have the sign of `side`, as bits; all others are 0.
    which: u8,
    side: i8,
}

impl EdgeValues<'_> {
    /// The sign of an edge's value, which may be under negations; none of other numbers.
    fn of_edge(&self, place: Place) -> Option<i8> {
        let signed = signed(self.path, place);
        let edge = self.edges.iter().position(|edge| *edge == signed.place)?;
        let is_zero = self.which >> edge & 1 == 0;
        Some(match (is_zero, signed.is_negative) {
            (true, _) => 0,
            (false, true) => -self.side,
            (false, false) => self.side,
        })
    }

    /// The sign of a number, which is 0 if it is no edge's value.
    fn sign(&self, place: Place) -> i8 {
        self.of_edge(place).unwrap_or(0)
    }

    /// The answer to a comparison; none if it may be either.
    fn answer(&self, comparison: &Comparison) -> Option<bool> {
        let are_edges = |a, b| self.of_edge(a).is_some() && self.of_edge(b).is_some();
        match *comparison {
            Comparison::Less(a, b) | Comparison::AtMost(a, b) if are_edges(a, b) => None,
            Comparison::Less(a, b) => Some(self.sign(a) < self.sign(b)),
            Comparison::AtMost(a, b) => Some(self.sign(a) <= self.sign(b)),
            Comparison::Zero(a) => Some(self.sign(a) == 0),
            // Of a zero the sign bit may be set.
            Comparison::Negative(a) if self.sign(a) == 0 => None,
            Comparison::Negative(a) => Some(self.sign(a) < 0),
        }
    }

    fn may_happen(&self, outcome: &Outcome) -> bool {
        for (comparison, given) in &outcome.answers {
            if self.answer(comparison) == Some(!given) {
                return false;
            }
        }
        true
    }

    /// True if a gate accepts them at an epsilon of 0.
    fn are_accepted(&self, acceptance: &Acceptance) -> bool {
        match acceptance {
            Acceptance::Fixed(..) => false,
            Acceptance::Clauses(refuse, clauses) => {
                let least = match refuse {
                    Refuse::Below | Refuse::UnlessAtLeast => 0,
                    Refuse::AtMost | Refuse::UnlessAbove => 1,
                };
                let holds =
                    |clause: &Vec<Place>| clause.iter().all(|place| least <= self.sign(*place));
                clauses.iter().any(holds)
            }
            Acceptance::Rounded(outcomes) => outcomes
                .iter()
                .all(|outcome| outcome.accepts || !self.may_happen(outcome)),
        }
    }
}

/// A number without the signs around it.
pub struct Unsigned {
    /// True if they make it the negative.
    pub is_negative: bool,
    pub place: Place,
}

pub fn signed(path: &Path, place: Place) -> Unsigned {
    let mut found = Unsigned {
        is_negative: false,
        place,
    };
    while let Operation::Neg(inner) = path.operations[found.place as usize] {
        found.is_negative = !found.is_negative;
        found.place = inner;
    }
    found
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
    let here = forms.of(path, place, &|i| i);
    let there = forms.of(path, place, &|i| exchanged(i, p, q));
    here == there.negated()
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
    if !VERTICES.contains(&input) {
        return input;
    }
    let vertex = name(usize::from(input / 3)) as u8;
    3 * vertex + input % 3
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
    let p = only_vertex(path, first[0])?;
    let q = only_vertex(path, first[1])?;
    let mut there = first.map(|place| forms.of(path, place, &|i| exchanged(i, p, q)));
    let mut here = second.map(|place| forms.of(path, place, &|i| i));
    there.sort_unstable();
    here.sort_unstable();
    if p == q || there != here {
        return None;
    }
    let x = forms.of(path, first[0], &|i| exchanged(i, p, FIRST_VERTEX));
    let y = forms.of(path, first[1], &|i| exchanged(i, q, FIRST_VERTEX));
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
    let mut vertices = BTreeSet::new();
    for input in inputs(path, place) {
        if VERTICES.contains(&input) {
            vertices.insert(usize::from(input) / 3);
        }
    }
    vertices.into_iter().collect()
}

/// The vertex that a number is made of, if it is one.
fn only_vertex(path: &Path, place: Place) -> Option<usize> {
    match vertices(path, place)[..] {
        [vertex] => Some(vertex),
        _ => None,
    }
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
    let mut of_ray = Vec::new();
    for (comparison, answer) in &path.decisions {
        let mut values = Vec::new();
        for place in comparison.places() {
            // t_max is no part of the ray: it shrinks from triangle to triangle as hits are found.
            if depends(path, place, VERTICES) || depends(path, place, ENDS) {
                return of_ray;
            }
            values.push(forms.of(path, place, &|i| i));
        }
        of_ray.push((discriminant(comparison), values, *answer));
    }
    of_ray
}

//! A second reference: truths by the words of the definition, in integers, with formulas and code that
//! share nothing with the oracle.
//!
//! All fifteen coordinates are multiplied by one power of two that makes them integers, so that t is
//! the same. A crossing is Cramer's rule for o + t d = a + u (b-a) + v (c-a). A contact is a range of
//! t: of a line in the triangle's plane the part inside its three edges, seen along an axis; of a
//! triangle without area where the line meets the segment between its outermost vertices.

mod numbers;

use crate::case::Case;
use crate::truth::{Contact, ContactKind, Crossing, Facing, Feature, Place, Truth};
use num_bigint::BigInt;
use num_traits::RefNum;
use numbers::{Digits, Integer, IntegerFraction, IntegerPoint, cross, dot, is_zero, minus, sign};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// A range of t.
struct Range<I> {
    low: IntegerFraction<I>,
    high: IntegerFraction<I>,
}

/// A function that is linear in t.
struct Linear<I> {
    constant: I,
    slope: I,
}

/// A case in integers.
pub(super) struct Integers<I> {
    o: IntegerPoint<I>,
    d: IntegerPoint<I>,
    vertices: [IntegerPoint<I>; 3],
    t_min: IntegerFraction<I>,
    t_max: IntegerFraction<I>,
}

/// Bits of coordinates, and of interval ends before and behind the point: determinants of degree 3 stay
/// below 2^78, and times an end of 48 bits below 2^126, so that 128 bits hold every product.
const NARROW: i64 = 24;
/// Coordinates below 2^39: determinants and their sums stay below 2^(3·39 + 8).
const WIDE: i64 = 39;

/// The truth of a case, and its t (or that of a contact's end) as a nearby float.
pub(super) fn truth(case: &Case<f64>) -> (Truth, Option<f64>) {
    if !is_valid(case) {
        return (Truth::Invalid, None);
    }
    let floats = case.vectors().map(|vector| vector.map(Digits::of));
    let nonzero = || floats.as_flattened().iter().filter(|x| x.odd != 0);
    // All coordinates are multiples of 2 to this power.
    let grid = nonzero().map(|x| x.exponent).min().expect("a direction");
    let top = nonzero().map(|x| x.length()).max().expect("a direction");
    let bits = top - grid;
    let integers = floats.map(|vector| vector.map(|x| x.in_units_of(grid)));
    let ends = [case.ray.t_min, case.ray.t_max];
    if bits <= NARROW && ends.into_iter().all(is_short) {
        return Integers::<i128>::new(integers, ends).truth();
    }
    if bits <= WIDE
        && ends == [0.0, f64::INFINITY]
        && let Some(found) = Integers::<i128>::new(integers, ends).crossing()
    {
        return found;
    }
    Integers::<BigInt>::new(integers, ends).truth()
}

fn is_valid(case: &Case<f64>) -> bool {
    let vectors = case.vectors();
    let is_finite = vectors.as_flattened().iter().all(|x| x.is_finite());
    // False of NaN too.
    let is_interval = case.ray.t_min <= case.ray.t_max;
    is_finite && is_interval && vectors[1] != [0.0; 3]
}

/// True if an end of an interval has so few bits that products with it fit.
fn is_short(t: f64) -> bool {
    if t.is_infinite() {
        return true;
    }
    let digits = Digits::of(t);
    digits.length() <= NARROW && -digits.exponent <= NARROW
}

impl<I: Integer> Integers<I>
where
    for<'a> &'a I: RefNum<I>,
{
    /// The case from numbers whose exponents are not negative, and an interval.
    fn new(vectors: [[Digits; 3]; 5], ends: [f64; 2]) -> Integers<I> {
        let [o, d, vertices @ ..] = vectors.map(|vector| vector.map(Digits::integer));
        let [t_min, t_max] = ends.map(IntegerFraction::of);
        Integers {
            o,
            d,
            vertices,
            t_min,
            t_max,
        }
    }

    /// A case on the lattice, on [0, inf).
    pub fn of_lattice([o, d, vertices @ ..]: [IntegerPoint<I>; 5]) -> Integers<I> {
        Integers {
            o,
            d,
            vertices,
            t_min: IntegerFraction::new(I::zero(), I::one()),
            t_max: IntegerFraction::new(I::one(), I::zero()),
        }
    }

    pub fn truth(&self) -> (Truth, Option<f64>) {
        self.crossing().unwrap_or_else(|| self.contact())
    }

    /// The truth where the line is not parallel to the plane.
    fn crossing(&self) -> Option<(Truth, Option<f64>)> {
        let [a, b, c] = &self.vertices;
        let e = minus(b, a);
        let f = minus(c, a);
        let s = minus(&self.o, a);
        let n = cross(&e, &f);
        let along_normal = dot(&self.d, &n);
        if along_normal.is_zero() {
            return None;
        }
        // The determinants of (-d, e, f), (s, e, f), (-d, s, f), (-d, e, s), the first made positive.
        let is_front = along_normal.is_negative();
        let positive = |x: I| if is_front { x } else { -x };
        let whole = positive(-along_normal);
        let t = positive(dot(&s, &n));
        let u = positive(dot(&self.d, &cross(&f, &s)));
        let v = positive(dot(&self.d, &cross(&s, &e)));
        let w = &(&whole - &u) - &v;
        let t_sign = sign(&t);
        let t = IntegerFraction::new(t, whole);
        let facing = if is_front {
            Facing::Front
        } else {
            Facing::Back
        };
        let crossing = Crossing {
            facing,
            place: self.place(&t),
            t_sign,
            feature: feature_by_signs([w, u, v].each_ref().map(sign)),
        };
        Some((Truth::Transversal(crossing), t.near()))
    }

    /// The place of a crossing's t against the interval.
    fn place(&self, t: &IntegerFraction<I>) -> Place {
        match (t.compare(&self.t_min), t.compare(&self.t_max)) {
            (Less, _) => Place::Before,
            (Equal, _) => Place::AtMin,
            (_, Greater) => Place::Beyond,
            (_, Equal) => Place::AtMax,
            _ => Place::Within,
        }
    }

    /// The truth where the line is parallel to the plane, or there is none.
    fn contact(&self) -> (Truth, Option<f64>) {
        let [a, b, c] = &self.vertices;
        let n = cross(&minus(b, a), &minus(c, a));
        let Some(axis) = n.iter().position(|x| !x.is_zero()) else {
            let (contact, end) = self.cut(self.range_of_segment(), |t| self.feature_on_segment(t));
            return (Truth::Degenerate(contact), end);
        };
        if !dot(&n, &minus(&self.o, a)).is_zero() {
            return (Truth::Parallel, None);
        }
        let edges = self.edges(axis, n[axis].is_negative());
        let (contact, end) = self.cut(Self::range_inside(&edges), |t| {
            Self::feature_in_plane(&edges, t)
        });
        (Truth::Coplanar(contact), end)
    }

    /// For each edge ab, bc, ca, seen along an axis: twice the area that the edge spans with the line's point, positive
    /// inside.
    fn edges(&self, axis: usize, is_clockwise: bool) -> [Linear<I>; 3] {
        let i = (axis + 1) % 3;
        let j = (axis + 2) % 3;
        [(0, 1), (1, 2), (2, 0)].map(|(from, to)| {
            let from = &self.vertices[from];
            let to = &self.vertices[to];
            let x = &to[i] - &from[i];
            let y = &to[j] - &from[j];
            let constant = &x * &(&self.o[j] - &from[j]) - &y * &(&self.o[i] - &from[i]);
            let slope = &x * &self.d[j] - &y * &self.d[i];
            let [constant, slope] = if is_clockwise {
                [-constant, -slope]
            } else {
                [constant, slope]
            };
            Linear { constant, slope }
        })
    }

    /// The t between which the line runs through a triangle without area.
    fn range_of_segment(&self) -> Option<Range<I>> {
        // The outermost of points on one line are the first and the last by x, then y, then z.
        let p = self.vertices.iter().min()?;
        let q = self.vertices.iter().max()?;
        // An axis along which the line moves.
        let m = self.d.iter().position(|x| !x.is_zero())?;
        let [x, y] = [p, q].map(|v| cross(&minus(v, &self.o), &self.d));
        if is_zero(&x) && is_zero(&y) {
            let [s, t] =
                [p, q].map(|v| IntegerFraction::new(&v[m] - &self.o[m], self.d[m].clone()));
            let (low, high) = if s.compare(&t).is_le() {
                (s, t)
            } else {
                (t, s)
            };
            return Some(Range { low, high });
        }
        // x + s (y-x) = 0 for an s in [0, 1]: x and y opposite, or one of them zero.
        if !is_zero(&cross(&x, &y)) || dot(&x, &y).is_positive() {
            return None;
        }
        let k = (0..3).find(|&k| x[k] != y[k])?;
        let whole = &x[k] - &y[k];
        let along = &whole * &(&p[m] - &self.o[m]) + &x[k] * &(&q[m] - &p[m]);
        let t = IntegerFraction::new(along, &whole * &self.d[m]);
        Some(Range {
            low: t.clone(),
            high: t,
        })
    }

    /// The feature of a triangle without area at a point of the line that lies on it.
    fn feature_on_segment(&self, t: &IntegerFraction<I>) -> Feature {
        match self.vertices.each_ref().map(|v| self.compare_at(t, v)) {
            [Equal, ..] => Feature::VertexA,
            [_, Equal, _] => Feature::VertexB,
            [.., Equal] => Feature::VertexC,
            [a, b, _] if a != b => Feature::EdgeAb,
            [_, b, c] if b != c => Feature::EdgeBc,
            _ => Feature::EdgeCa,
        }
    }

    /// The order of the line's point o + t d and a vertex, by x, then y, then z.
    fn compare_at(&self, t: &IntegerFraction<I>, vertex: &IntegerPoint<I>) -> Ordering {
        for (i, coordinate) in vertex.iter().enumerate() {
            let of_line = &self.o[i] * &t.denominator + &self.d[i] * &t.numerator;
            let order = of_line.cmp(&(coordinate * &t.denominator));
            if order.is_ne() {
                return order;
            }
        }
        Equal
    }

    /// The contact of a line that runs through the triangle in a range of t, and the end of that range as a float.
    fn cut(
        &self,
        range: Option<Range<I>>,
        feature: impl Fn(&IntegerFraction<I>) -> Feature,
    ) -> (Contact, Option<f64>) {
        let Some(Range { low, high }) = range else {
            let none = Contact {
                kind: ContactKind::None,
                meets_ray: false,
                meets_line: false,
            };
            return (none, None);
        };
        let starts_before = low.compare(&self.t_min).is_lt();
        let first = if starts_before { &self.t_min } else { &low };
        let ends_beyond = high.compare(&self.t_max).is_gt();
        let last = if ends_beyond { &self.t_max } else { &high };
        let kind = match first.compare(last) {
            Less => ContactKind::Segment,
            Equal => ContactKind::Point(feature(first)),
            Greater => ContactKind::None,
        };
        let contact = Contact {
            kind,
            meets_ray: !high.numerator.is_negative(),
            meets_line: true,
        };
        (contact, high.near())
    }

    /// The t at which the functions of all three edges are at least zero.
    fn range_inside(edges: &[Linear<I>; 3]) -> Option<Range<I>> {
        let mut low: Option<IntegerFraction<I>> = None;
        let mut high: Option<IntegerFraction<I>> = None;
        for Linear { constant, slope } in edges {
            if slope.is_zero() {
                if constant.is_negative() {
                    return None;
                }
                continue;
            }
            let zero = IntegerFraction::new(-constant.clone(), slope.clone());
            if slope.is_positive() {
                if low.as_ref().is_none_or(|low| low.compare(&zero).is_lt()) {
                    low = Some(zero);
                }
            } else if high.as_ref().is_none_or(|high| high.compare(&zero).is_gt()) {
                high = Some(zero);
            }
        }
        let low = low?;
        let high = high?;
        low.compare(&high).is_le().then_some(Range { low, high })
    }

    /// The feature at a point of the line in the closed triangle. A point's distance from an edge is the weight of the vertex
    /// across from it.
    fn feature_in_plane(edges: &[Linear<I>; 3], t: &IntegerFraction<I>) -> Feature {
        let [ab, bc, ca] = edges.each_ref().map(|Linear { constant, slope }| {
            sign(&(constant * &t.denominator + slope * &t.numerator))
        });
        feature_by_signs([bc, ca, ab])
    }
}

/// The feature at the point of the plane whose weights of a, b and c have these signs.
fn feature_by_signs(signs: [Ordering; 3]) -> Feature {
    match signs {
        [Less, ..] | [_, Less, _] | [.., Less] => Feature::Outside,
        [Greater, Greater, Greater] => Feature::Interior,
        [Equal, Greater, Greater] => Feature::EdgeBc,
        [Greater, Equal, Greater] => Feature::EdgeCa,
        [Greater, Greater, Equal] => Feature::EdgeAb,
        [Greater, ..] => Feature::VertexA,
        [_, Greater, _] => Feature::VertexB,
        _ => Feature::VertexC,
    }
}

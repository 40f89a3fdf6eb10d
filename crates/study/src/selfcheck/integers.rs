//! A second reference: truths by the words of the definition, in integers, with formulas and code that
//! share nothing with the oracle.
//!
//! All fifteen coordinates are multiplied by one power of two that makes them integers, so that t is
//! the same. A crossing is Cramer's rule for o + t d = a + u (b-a) + v (c-a). A contact is a range of
//! t: of a line in the triangle's plane the part inside its three edges, seen along an axis; of a
//! triangle without area where the line meets the segment between its outermost vertices.

use crate::case::Case;
use crate::truth::{Contact, ContactKind, Crossing, Facing, Feature, Place, Truth};
use num_bigint::BigInt;
use num_traits::{Float as _, RefNum, Signed, ToPrimitive};
use std::cmp::Ordering;

type IntegerPoint<I> = [I; 3];

/// A fraction with a positive denominator; 1/0 and -1/0 are the infinite ends of an interval.
#[derive(Clone)]
struct IntegerFraction<I>(I, I);

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
    let vectors = case.vectors();
    let finite = vectors.as_flattened().iter().all(|x| x.is_finite());
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    if !finite || t_min.is_nan() || t_max.is_nan() || t_min > t_max || vectors[1] == [0.0; 3] {
        return (Truth::Invalid, None);
    }
    let parts = vectors.map(|v| v.map(digits));
    let nonzero = || parts.as_flattened().iter().filter(|(odd, _)| *odd != 0);
    let grid = nonzero().map(|(_, exponent)| *exponent).min().unwrap_or(0);
    let bits = nonzero()
        .map(|part| length(*part) - grid)
        .max()
        .unwrap_or(0);
    let shifted = |(odd, exponent)| {
        if odd == 0 {
            (0, 0)
        } else {
            (odd, exponent - grid)
        }
    };
    let parts = parts.map(|point| point.map(shifted));
    let ends = [t_min, t_max];
    let short = |t: f64| t.is_infinite() || length(digits(t)).max(-digits(t).1) <= NARROW;
    let narrow = |odd: i64, shift: i64| i128::from(odd) << shift;
    if bits <= NARROW && ends.into_iter().all(short) {
        return Integers::new(parts, ends, narrow).truth();
    }
    if bits <= WIDE
        && ends == [0.0, f64::INFINITY]
        && let Some(found) = Integers::new(parts, ends, narrow).crossing()
    {
        return found;
    }
    Integers::new(parts, ends, |odd, shift| BigInt::from(odd) << shift).truth()
}

/// A finite float as an odd integer, or zero, times a power of two.
fn digits(x: f64) -> (i64, i64) {
    let (mantissa, exponent, sign) = x.integer_decode();
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    (
        (mantissa >> zeros) as i64 * i64::from(sign),
        i64::from(exponent) + i64::from(zeros),
    )
}

/// The number of bits before the binary point.
fn length((odd, exponent): (i64, i64)) -> i64 {
    i64::from(64 - odd.unsigned_abs().leading_zeros()) + exponent
}

impl<I: Signed + Ord + Clone + ToPrimitive> Integers<I>
where
    for<'a> &'a I: RefNum<I>,
{
    /// From numbers and exponents that are not negative, and an interval.
    fn new(
        parts: [IntegerPoint<(i64, i64)>; 5],
        ends: [f64; 2],
        integer: impl Fn(i64, i64) -> I,
    ) -> Self {
        let end = |t: f64| {
            let (odd, exponent) = digits(t);
            match t {
                f64::NEG_INFINITY => IntegerFraction(-I::one(), I::zero()),
                f64::INFINITY => IntegerFraction(I::one(), I::zero()),
                _ if exponent < 0 => IntegerFraction(integer(odd, 0), integer(1, -exponent)),
                _ => IntegerFraction(integer(odd, exponent), I::one()),
            }
        };
        let [t_min, t_max] = ends.map(end);
        let number = |(odd, shift)| integer(odd, shift);
        let [o, d, vertices @ ..] = parts.map(|point| point.map(number));
        Integers {
            o,
            d,
            vertices,
            t_min,
            t_max,
        }
    }

    /// A case on the lattice, on [0, inf).
    pub fn of_lattice([o, d, vertices @ ..]: [IntegerPoint<I>; 5]) -> Self {
        let t_min = IntegerFraction(I::zero(), I::one());
        Integers {
            o,
            d,
            vertices,
            t_min,
            t_max: IntegerFraction(I::one(), I::zero()),
        }
    }

    pub fn truth(&self) -> (Truth, Option<f64>) {
        self.crossing().unwrap_or_else(|| self.contact())
    }

    /// The truth where the line is not parallel to the plane.
    fn crossing(&self) -> Option<(Truth, Option<f64>)> {
        let [a, b, c] = &self.vertices;
        let (e, f, s) = (minus(b, a), minus(c, a), minus(&self.o, a));
        let n = cross(&e, &f);
        let capital_d = dot(&self.d, &n);
        if capital_d.is_zero() {
            return None;
        }
        // The determinants of (-d, e, f), (s, e, f), (-d, s, f), (-d, e, s), the first made positive.
        let front = capital_d.is_negative();
        let positive = |x: I| if front { x } else { -x };
        let whole = positive(-capital_d);
        let t = positive(dot(&s, &n));
        let u = positive(dot(&self.d, &cross(&f, &s)));
        let v = positive(dot(&self.d, &cross(&s, &e)));
        let rest = &(&whole - &u) - &v;
        let feature = match [&rest, &u, &v].map(sign) {
            [Ordering::Less, ..] | [_, Ordering::Less, _] | [.., Ordering::Less] => {
                Feature::Outside
            }
            [Ordering::Greater, Ordering::Greater, Ordering::Greater] => Feature::Interior,
            [Ordering::Equal, Ordering::Greater, Ordering::Greater] => Feature::EdgeBc,
            [Ordering::Greater, Ordering::Equal, Ordering::Greater] => Feature::EdgeCa,
            [Ordering::Greater, Ordering::Greater, Ordering::Equal] => Feature::EdgeAb,
            [Ordering::Greater, ..] => Feature::VertexA,
            [_, Ordering::Greater, _] => Feature::VertexB,
            _ => Feature::VertexC,
        };
        let t = IntegerFraction(t, whole);
        let place = match (t.compare(&self.t_min), t.compare(&self.t_max)) {
            (Ordering::Less, _) => Place::Before,
            (Ordering::Equal, _) => Place::AtMin,
            (_, Ordering::Greater) => Place::Beyond,
            (_, Ordering::Equal) => Place::AtMax,
            _ => Place::Within,
        };
        let facing = if front { Facing::Front } else { Facing::Back };
        let crossing = Crossing {
            facing,
            place,
            t_sign: sign(&t.0),
            feature,
        };
        Some((Truth::Transversal(crossing), t.near()))
    }

    /// The truth where the line is parallel to the plane, or there is none.
    fn contact(&self) -> (Truth, Option<f64>) {
        let [a, b, c] = &self.vertices;
        let n = cross(&minus(b, a), &minus(c, a));
        let Some(axis) = n.iter().position(|x| !x.is_zero()) else {
            let range = self.range_of_segment();
            let contact = self.cut(&range, |t| self.feature_on_segment(t));
            return (
                Truth::Degenerate(contact),
                range.and_then(|range| range[1].near()),
            );
        };
        if !dot(&n, &minus(&self.o, a)).is_zero() {
            return (Truth::Parallel, None);
        }
        let edges = self.edges(axis, n[axis].is_negative());
        let range = Self::range_inside(&edges);
        let contact = self.cut(&range, |t| Self::feature_in_plane(&edges, t));
        (
            Truth::Coplanar(contact),
            range.and_then(|range| range[1].near()),
        )
    }

    /// For each edge ab, bc, ca, seen along an axis: the constant and the slope in t of twice the area
    /// that the edge spans with the line's point, positive inside.
    fn edges(&self, axis: usize, clockwise: bool) -> [(I, I); 3] {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        [(0, 1), (1, 2), (2, 0)].map(|(from, to)| {
            let (from, to) = (&self.vertices[from], &self.vertices[to]);
            let (x, y) = (&to[i] - &from[i], &to[j] - &from[j]);
            let constant = &x * &(&self.o[j] - &from[j]) - &y * &(&self.o[i] - &from[i]);
            let slope = &x * &self.d[j] - &y * &self.d[i];
            if clockwise {
                (-constant, -slope)
            } else {
                (constant, slope)
            }
        })
    }

    /// The t between which the line runs through a triangle without area.
    fn range_of_segment(&self) -> Option<[IntegerFraction<I>; 2]> {
        // The outermost of points on one line are the first and the last by x, then y, then z.
        let (p, q) = (self.vertices.iter().min()?, self.vertices.iter().max()?);
        let m = self.d.iter().position(|x| !x.is_zero())?;
        let [x, y] = [p, q].map(|v| cross(&minus(v, &self.o), &self.d));
        let is_zero = |v: &IntegerPoint<I>| v.iter().all(|x| x.is_zero());
        if is_zero(&x) && is_zero(&y) {
            let [s, t] =
                [p, q].map(|v| IntegerFraction::new(&v[m] - &self.o[m], self.d[m].clone()));
            return Some(if s.compare(&t).is_le() {
                [s, t]
            } else {
                [t, s]
            });
        }
        // x + s (y-x) = 0 for an s in [0, 1]: x and y opposite, or one of them zero.
        if !is_zero(&cross(&x, &y)) || dot(&x, &y).is_positive() {
            return None;
        }
        let k = (0..3).find(|&k| x[k] != y[k])?;
        let whole = &x[k] - &y[k];
        let along = &whole * &(&p[m] - &self.o[m]) + &x[k] * &(&q[m] - &p[m]);
        let t = IntegerFraction::new(along, &whole * &self.d[m]);
        Some([t.clone(), t])
    }

    /// The feature of a triangle without area at a point of the line that lies on it.
    fn feature_on_segment(&self, IntegerFraction(t, whole): &IntegerFraction<I>) -> Feature {
        // o + t d against a vertex, coordinate by coordinate.
        let order = |vertex: &IntegerPoint<I>| {
            let by_axis =
                (0..3).map(|i| (&self.o[i] * whole + &self.d[i] * t).cmp(&(&vertex[i] * whole)));
            by_axis.fold(Ordering::Equal, Ordering::then)
        };
        match self.vertices.each_ref().map(order) {
            [Ordering::Equal, ..] => Feature::VertexA,
            [_, Ordering::Equal, _] => Feature::VertexB,
            [.., Ordering::Equal] => Feature::VertexC,
            [a, b, _] if a != b => Feature::EdgeAb,
            [_, b, c] if b != c => Feature::EdgeBc,
            _ => Feature::EdgeCa,
        }
    }

    /// A range of t cut to the interval.
    fn cut(
        &self,
        range: &Option<[IntegerFraction<I>; 2]>,
        feature: impl Fn(&IntegerFraction<I>) -> Feature,
    ) -> Contact {
        let Some([low, high]) = range else {
            return Contact {
                kind: ContactKind::None,
                meets_ray: false,
                meets_line: false,
            };
        };
        let first = if low.compare(&self.t_min).is_lt() {
            &self.t_min
        } else {
            low
        };
        let last = if high.compare(&self.t_max).is_gt() {
            &self.t_max
        } else {
            high
        };
        let kind = match first.compare(last) {
            Ordering::Less => ContactKind::Segment,
            Ordering::Equal => ContactKind::Point(feature(first)),
            Ordering::Greater => ContactKind::None,
        };
        Contact {
            kind,
            meets_ray: !high.0.is_negative(),
            meets_line: true,
        }
    }

    /// The t at which three functions, linear in t, are all at least zero.
    fn range_inside(edges: &[(I, I); 3]) -> Option<[IntegerFraction<I>; 2]> {
        let (mut low, mut high): (Option<IntegerFraction<I>>, Option<IntegerFraction<I>>) =
            (None, None);
        for (constant, slope) in edges {
            if slope.is_zero() {
                if constant.is_negative() {
                    return None;
                }
                continue;
            }
            let bound = IntegerFraction::new(-constant.clone(), slope.clone());
            let (end, tighter) = if slope.is_positive() {
                (&mut low, Ordering::Less)
            } else {
                (&mut high, Ordering::Greater)
            };
            if end
                .as_ref()
                .is_none_or(|end| end.compare(&bound) == tighter)
            {
                *end = Some(bound);
            }
        }
        let (low, high) = (low?, high?);
        low.compare(&high).is_le().then_some([low, high])
    }

    /// The feature at a point of the line in the closed triangle.
    fn feature_in_plane(
        edges: &[(I, I); 3],
        IntegerFraction(t, whole): &IntegerFraction<I>,
    ) -> Feature {
        let on = edges
            .each_ref()
            .map(|(constant, slope)| (constant * whole + slope * t).is_zero());
        match on {
            [true, _, true] => Feature::VertexA,
            [true, true, _] => Feature::VertexB,
            [_, true, true] => Feature::VertexC,
            [true, ..] => Feature::EdgeAb,
            [_, true, _] => Feature::EdgeBc,
            [.., true] => Feature::EdgeCa,
            _ => Feature::Interior,
        }
    }
}

impl<I: Signed + Ord + Clone + ToPrimitive> IntegerFraction<I>
where
    for<'a> &'a I: RefNum<I>,
{
    fn new(numerator: I, denominator: I) -> Self {
        if denominator.is_negative() {
            IntegerFraction(-numerator, -denominator)
        } else {
            IntegerFraction(numerator, denominator)
        }
    }

    fn compare(&self, other: &Self) -> Ordering {
        // Where a segment crosses the line, t is below 2^77 / 2^75: with an interval's end its product
        // fits, with itself it would not.
        if self.0 == other.0 && self.1 == other.1 {
            return Ordering::Equal;
        }
        (&self.0 * &other.1).cmp(&(&other.0 * &self.1))
    }

    /// A float nearby, where both numbers are in its range.
    fn near(&self) -> Option<f64> {
        let t = self.0.to_f64()? / self.1.to_f64()?;
        t.is_finite().then_some(t)
    }
}

fn sign<I: Signed + Ord>(x: &I) -> Ordering {
    x.cmp(&I::zero())
}

fn minus<I>(p: &IntegerPoint<I>, q: &IntegerPoint<I>) -> IntegerPoint<I>
where
    for<'a> &'a I: RefNum<I>,
{
    std::array::from_fn(|i| &p[i] - &q[i])
}

fn dot<I: Signed>(p: &IntegerPoint<I>, q: &IntegerPoint<I>) -> I
where
    for<'a> &'a I: RefNum<I>,
{
    &p[0] * &q[0] + &p[1] * &q[1] + &p[2] * &q[2]
}

fn cross<I: Signed>(p: &IntegerPoint<I>, q: &IntegerPoint<I>) -> IntegerPoint<I>
where
    for<'a> &'a I: RefNum<I>,
{
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &p[i] * &q[j] - &p[j] * &q[i])
}

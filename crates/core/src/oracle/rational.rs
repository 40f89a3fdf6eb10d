//! The definition of truth, with num-rational: slow, obvious, and the reference for all else.

use super::signs::place;
use crate::arith::Float;
use crate::case::{Case, Instance};
use crate::truth::{Contact, ContactKind, Crossing, ExactValues, Facing, Feature, Truth};
use num_rational::BigRational as Rational;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;

type RationalPoint = [Rational; 3];

/// The truth of a case by definition, with the exact values behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// The truth.
    pub truth: Truth,
    /// t, u, v, or the contact's range of t.
    pub exact: ExactValues,
}

/// An end of an interval: a number or an infinity.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum RationalEnd {
    MinusInfinity,
    At(Rational),
    PlusInfinity,
}

/// The truth of a case, by definition.
pub fn define<F: Float>(case: &Case<F>) -> Definition {
    define_with(case, Some)
}

/// The truth of a ray in the world and a triangle that a matrix puts there, by definition: that of the triangle and the
/// ray by the exact inverse, which leaves t, u and v. Invalid if there is no inverse.
pub fn define_instance<F: Float>(case: &Case<F>, instance: &Instance<F>) -> Definition {
    let matrix = instance
        .matrix()
        .map(|row| row.map(|x| Rational::from_float(x.to_f64())));
    define_with(case, |[origin, direction]| {
        let column = |i: usize| {
            Some([
                matrix[0][i].clone()?,
                matrix[1][i].clone()?,
                matrix[2][i].clone()?,
            ])
        };
        let [x, y, z, moved] = [column(0)?, column(1)?, column(2)?, column(3)?];
        let rows = [cross(&y, &z), cross(&z, &x), cross(&x, &y)];
        let determinant = dot(&z, &rows[2]);
        let solved =
            |point: &RationalPoint| rows.each_ref().map(|row| dot(row, point) / &determinant);
        (!determinant.is_zero()).then(|| [solved(&minus(&origin, &moved)), solved(&direction)])
    })
}

/// The truth of a ray's origin and direction and of three vertices, in this order, by definition, where they are rational. The
/// interval has two floats.
pub fn define_points(points: [RationalPoint; 5], interval: [f64; 2]) -> Definition {
    between(points, interval).unwrap_or_else(|| flat(Truth::Invalid, None))
}

fn define_with<F: Float>(
    case: &Case<F>,
    seen: impl FnOnce([RationalPoint; 2]) -> Option<[RationalPoint; 2]>,
) -> Definition {
    define_valid(&case.widen(), seen).unwrap_or_else(|| flat(Truth::Invalid, None))
}

/// None of an invalid case.
fn define_valid(
    case: &Case<f64>,
    seen: impl FnOnce([RationalPoint; 2]) -> Option<[RationalPoint; 2]>,
) -> Option<Definition> {
    let rational = |x: f64| Rational::from_float(x);
    let point = |v: [f64; 3]| -> Option<RationalPoint> {
        let [x, y, z] = v.map(rational);
        Some([x?, y?, z?])
    };
    let [o, d, a, b, c] = case.vectors().map(point);
    let [o, d] = seen([o?, d?])?;
    between([o, d, a?, b?, c?], [case.ray.t_min, case.ray.t_max])
}

/// None of an invalid case.
fn between([o, d, a, b, c]: [RationalPoint; 5], interval: [f64; 2]) -> Option<Definition> {
    let end = |t: f64| match Rational::from_float(t) {
        Some(t) => Some(RationalEnd::At(t)),
        None if t == f64::INFINITY => Some(RationalEnd::PlusInfinity),
        None if t == f64::NEG_INFINITY => Some(RationalEnd::MinusInfinity),
        None => None,
    };
    let [t_min, t_max] = interval.map(end);
    let (t_min, t_max) = (t_min?, t_max?);
    if t_min > t_max || d.iter().all(Zero::is_zero) {
        return None;
    }

    let n = cross(&minus(&b, &a), &minus(&c, &a));
    let capital_d = dot(&d, &n);
    let capital_t = dot(&n, &minus(&a, &o));
    if n.iter().all(Zero::is_zero) {
        let (contact, range) = line_and_segment(&o, &d, [&a, &b, &c], &t_min, &t_max);
        return Some(flat(Truth::Degenerate(contact), range));
    }
    if capital_d.is_zero() {
        if !capital_t.is_zero() {
            return Some(flat(Truth::Parallel, None));
        }
        let (contact, range) = line_in_plane(&o, &d, [&a, &b, &c], &n, &t_min, &t_max);
        return Some(flat(Truth::Coplanar(contact), range));
    }

    let t = capital_t / &capital_d;
    let at = RationalEnd::At(t.clone());
    // U, V, W: d with (c-o, b-o), (a-o, c-o), (b-o, a-o). Their sum is -D.
    let [ra, rb, rc] = [&a, &b, &c].map(|p| minus(p, &o));
    let triple = |p: &RationalPoint, q: &RationalPoint| dot(&d, &cross(p, q));
    let [u, v, w] =
        [triple(&rc, &rb), triple(&ra, &rc), triple(&rb, &ra)].map(|weight| -weight / &capital_d);
    let truth = Truth::Transversal(Crossing {
        facing: if capital_d.is_negative() {
            Facing::Front
        } else {
            Facing::Back
        },
        place: place(at.cmp(&t_min), at.cmp(&t_max)),
        t_sign: t.cmp(&Rational::zero()),
        feature: Feature::from_weight_signs([&u, &v, &w].map(|x| x.cmp(&Rational::zero()))),
    });
    let exact = ExactValues {
        t: Some(t),
        u: Some(v),
        v: Some(w),
        contact_t: None,
    };
    Some(Definition { truth, exact })
}

fn flat(truth: Truth, contact_t: Option<[Rational; 2]>) -> Definition {
    Definition {
        truth,
        exact: ExactValues {
            contact_t,
            ..ExactValues::default()
        },
    }
}

/// The common points of a line in the triangle's plane and the triangle: the t at which the three
/// edge functions, linear in t, are all at least zero.
fn line_in_plane(
    o: &RationalPoint,
    d: &RationalPoint,
    [a, b, c]: [&RationalPoint; 3],
    n: &RationalPoint,
    t_min: &RationalEnd,
    t_max: &RationalEnd,
) -> (Contact, Option<[Rational; 2]>) {
    // Constant and slope of N·((to - from) × (o + t d - from)).
    let edges = [(a, b), (b, c), (c, a)].map(|(from, to)| {
        let edge = minus(to, from);
        (
            dot(n, &cross(&edge, &minus(o, from))),
            dot(n, &cross(&edge, d)),
        )
    });
    let solve = |mut low: RationalEnd, mut high: RationalEnd| {
        for (constant, slope) in &edges {
            let bound = || RationalEnd::At(-constant / slope);
            match slope.cmp(&Rational::zero()) {
                Ordering::Greater if low < bound() => low = bound(),
                Ordering::Less if bound() < high => high = bound(),
                Ordering::Equal if constant.is_negative() => return None,
                _ => {}
            }
        }
        match (low, high) {
            (RationalEnd::At(low), RationalEnd::At(high)) if low <= high => Some([low, high]),
            _ => None,
        }
    };
    let feature = |t: &Rational| {
        let [ab, bc, ca] =
            [0, 1, 2].map(|i| (&edges[i].0 + &edges[i].1 * t).cmp(&Rational::zero()));
        Feature::from_weight_signs([bc, ca, ab])
    };
    contact(
        solve(t_min.clone(), t_max.clone()),
        solve(RationalEnd::At(Rational::zero()), RationalEnd::PlusInfinity).is_some(),
        solve(RationalEnd::MinusInfinity, RationalEnd::PlusInfinity).is_some(),
        feature,
    )
}

/// The common points of any line and a triangle without area, which is the segment between two of
/// its vertices.
fn line_and_segment(
    o: &RationalPoint,
    d: &RationalPoint,
    vertices: [&RationalPoint; 3],
    t_min: &RationalEnd,
    t_max: &RationalEnd,
) -> (Contact, Option<[Rational; 2]>) {
    let [a, b, c] = vertices;
    let (p, q) = [(a, b), (b, c), (c, a)]
        .into_iter()
        .max_by_key(|(p, q)| dot(&minus(p, q), &minus(p, q)))
        .expect("three edges");
    let d_squared = dot(d, d);
    // The t of the point of the line nearest to a point.
    let parameter = |x: &RationalPoint| dot(&minus(x, o), d) / &d_squared;
    let on_line = |x: &RationalPoint| cross(&minus(x, o), d).iter().all(Zero::is_zero);

    let whole: Option<[Rational; 2]> = if on_line(p) && on_line(q) {
        let (s, t) = (parameter(p), parameter(q));
        Some(if s <= t { [s, t] } else { [t, s] })
    } else {
        // p + s (q - p) is on the line where (p - o) × d + s (q - p) × d = 0.
        let (constant, slope) = (cross(&minus(p, o), d), cross(&minus(q, p), d));
        (0..3).find(|&i| !slope[i].is_zero()).and_then(|i| {
            let s = -&constant[i] / &slope[i];
            let point = along(p, &minus(q, p), &s);
            let inside = !s.is_negative() && s <= Rational::from_integer(1.into());
            (inside && on_line(&point)).then(|| [parameter(&point), parameter(&point)])
        })
    };

    let cut = |low: &RationalEnd, high: &RationalEnd| {
        let [s, t] = whole.clone()?;
        match (
            RationalEnd::At(s).max(low.clone()),
            RationalEnd::At(t).min(high.clone()),
        ) {
            (RationalEnd::At(s), RationalEnd::At(t)) if s <= t => Some([s, t]),
            _ => None,
        }
    };
    let feature = |t: &Rational| {
        let x = along(o, d, t);
        let named = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
        if let Some(i) = vertices.iter().position(|vertex| **vertex == x) {
            return named[i];
        }
        let between =
            |p: &RationalPoint, q: &RationalPoint| !dot(&minus(p, &x), &minus(q, &x)).is_positive();
        if between(a, b) {
            Feature::EdgeAb
        } else if between(b, c) {
            Feature::EdgeBc
        } else {
            Feature::EdgeCa
        }
    };
    contact(
        cut(t_min, t_max),
        cut(
            &RationalEnd::At(Rational::zero()),
            &RationalEnd::PlusInfinity,
        )
        .is_some(),
        whole.is_some(),
        feature,
    )
}

fn contact(
    range: Option<[Rational; 2]>,
    meets_ray: bool,
    meets_line: bool,
    feature: impl Fn(&Rational) -> Feature,
) -> (Contact, Option<[Rational; 2]>) {
    let kind = match &range {
        None => ContactKind::None,
        Some([low, high]) if low == high => ContactKind::Point(feature(low)),
        Some(_) => ContactKind::Segment,
    };
    (
        Contact {
            kind,
            meets_ray,
            meets_line,
        },
        range,
    )
}

fn minus(a: &RationalPoint, b: &RationalPoint) -> RationalPoint {
    std::array::from_fn(|i| &a[i] - &b[i])
}

fn along(o: &RationalPoint, d: &RationalPoint, t: &Rational) -> RationalPoint {
    std::array::from_fn(|i| &o[i] + t * &d[i])
}

fn dot(a: &RationalPoint, b: &RationalPoint) -> Rational {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &RationalPoint, b: &RationalPoint) -> RationalPoint {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}

#[cfg(test)]
mod tests;

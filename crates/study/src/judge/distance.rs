//! How far a case is from where its truth would change: from the line to the triangle's boundary, and
//! along the line from the ends of its extent.
//!
//! Three steps, each trusted only where it is certain to a thousandth: floats, double-doubles with
//! bounds, integers. What the truth knows to be zero is zero.

mod integers;
#[cfg(test)]
mod tests;

use crate::arith::{
    Bounded, Exact, Float, Real, Triple, Vector, bounded, scale_by_power_of_two as scaled,
};
use crate::case::{Case, Instance, Ray, Triangle};
use crate::truth::{Contact, Place, Truth};
use glam::DVec3;
use std::cmp::Ordering;

/// Distances of a valid case, in units of the triangle's longest edge (of length, for a triangle that
/// is a point), to about a thousandth of themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distances {
    /// From the line to the triangle's boundary, in space.
    pub in_space: f64,
    /// |t - end|·|d| for ends 0, t_min and t_max; infinite where the end is, NaN where the line does
    /// not cross the plane.
    pub along: [f64; 3],
    /// The longest edge in ulps of the largest coordinate of the case's points.
    pub edge_in_ulps: f64,
}

/// The arithmetic that found distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DistanceStep {
    Floats,
    /// Floats, after the case was moved near 1.
    FloatsNearOne,
    DoubleDoubles,
    Integers,
}

/// Squares of lengths of a case.
pub struct Squares<R> {
    /// The square of the longest edge.
    pub longest: R,
    /// From the line to the boundary.
    pub in_space: R,
    /// |t - end|·|d| for ends 0, t_min and t_max; none where the line does not cross the plane or the
    /// end is infinite.
    pub along: [Option<R>; 3],
}

impl<R: Real> Squares<R> {
    /// The squares of a valid case, in an arithmetic that does not round. `crosses` says whether the line crosses
    /// the plane at one point.
    pub fn of(ray: &Ray<Triple<R>>, triangle: &Triangle<Triple<R>>, crosses: bool) -> Squares<R> {
        let (o, d) = (&ray.origin, &ray.direction);
        let edges = triangle.edges();
        let longest = edges
            .map(|(p, q)| square(&q.minus(p)))
            .into_iter()
            .reduce(R::larger);
        let to_edges = edges.map(|(p, q)| line_to_segment(o, d, p, q));
        Squares {
            longest: longest.expect("three edges"),
            in_space: to_edges
                .into_iter()
                .reduce(R::smaller)
                .expect("three edges"),
            along: if crosses {
                along(ray, triangle)
            } else {
                [None, None, None]
            },
        }
    }
}

/// The squares of |t - end|·|d| for ends 0, t_min and t_max, of a line that crosses the plane; none
/// where the end is infinite.
fn along<R: Real>(ray: &Ray<Triple<R>>, triangle: &Triangle<Triple<R>>) -> [Option<R>; 3] {
    let Ray {
        origin: o,
        direction: d,
        t_min,
        t_max,
    } = ray;
    let Triangle { a, b, c } = triangle;
    let n = b.minus(a).cross(&c.minus(a));
    let t = n.dot(&a.minus(o)) / n.dot(d);
    [&R::zero(), t_min, t_max].map(|end| {
        let gap = end.is_finite().then(|| t.clone() - end)?;
        Some(gap.clone() * gap * square(d))
    })
}

/// The square of a vector's length.
pub fn square<V: Vector>(v: &V) -> V::Real {
    v.dot(v)
}

/// The square of the distance between a line and a segment: |(p - o + s·(q - p)) × d|² / |d|² at the
/// s in [0, 1] that makes it least.
pub(super) fn line_to_segment<V: Vector>(o: &V, d: &V, p: &V, q: &V) -> V::Real {
    let (offset, slope) = (p.minus(o).cross(d), q.minus(p).cross(d));
    let s = nearest_on_segment(-offset.dot(&slope), square(&slope));
    square(&offset.plus(&slope.times(&s))) / square(d)
}

/// `numerator / denominator` cut to [0, 1]; 0 if the denominator is zero.
pub fn nearest_on_segment<R: Real>(numerator: R, denominator: R) -> R {
    if denominator.is_zero() {
        return R::zero();
    }
    R::zero().larger(R::one().smaller(numerator / denominator))
}

/// The unit in the last place of the largest coordinate of a case's points.
pub fn ulp_of_points<F: Float>(case: &Case<F>) -> F {
    let [o, _, a, b, c] = case.vectors();
    let coordinates = [o, a, b, c];
    coordinates
        .as_flattened()
        .iter()
        .map(F::abs)
        .fold(F::zero(), F::larger)
        .ulp()
}

impl Distances {
    /// The distances of a valid case with its truth.
    pub fn of<F: Float>(case: &Case<F>, truth: &Truth) -> Distances {
        Distances::and_step(case, truth).0
    }

    /// Those of a ray of the world and the triangle that an instance puts there, as the object has them.
    pub fn of_instance<F: Float>(
        case: &Case<F>,
        instance: &Instance<F>,
        truth: &Truth,
    ) -> Distances {
        let (zeros, ulp) = (Zeros::of(truth), ulp_of_points(case).to_f64());
        let root = |square: &Bounded| Some(square.approximate()?.sqrt());
        let found = bounded(|| relative((case, instance), Bounded::new, &zeros, ulp, root));
        found.flatten().unwrap_or_else(|| {
            let root = |square: &Exact| Some(square.approximate_root());
            relative((case, instance), Exact::from_f64, &zeros, ulp, root).expect("always a root")
        })
    }

    /// As floats see them, right or not: for a search to climb on.
    pub fn at_a_glance<F: Float>(case: &Case<F>, truth: &Truth) -> Distances {
        let near = NearOne::of(&case.widen());
        let ulp = scaled(ulp_of_points(case).to_f64(), -near.size);
        let found = quick(&near.case, near.size, ulp, &Zeros::of(truth));
        found.map_or_else(|| Distances::of(case, truth), |quick| quick.distances)
    }

    /// And the step that was certain.
    fn and_step<F: Float>(case: &Case<F>, truth: &Truth) -> (Distances, DistanceStep) {
        let zeros = Zeros::of(truth);
        let ulp = ulp_of_points(case).to_f64();
        let wide = case.widen();
        // No product of a few numbers of f32 leaves the range of f64.
        if size_of::<F>() == size_of::<f32>()
            && let Some(found) = quick(&wide, 0, ulp, &zeros).and_then(Quick::certain)
        {
            return (found, DistanceStep::Floats);
        }
        let near = NearOne::of(&wide);
        let found = quick(&near.case, near.size, scaled(ulp, -near.size), &zeros);
        if let Some(found) = found.and_then(Quick::certain) {
            return (found, DistanceStep::FloatsNearOne);
        }
        let by_bounds = || by_bounds(&near, &found?, &zeros).filter(|_| near.is_exact(&wide));
        match by_bounds() {
            Some(found) => (found, DistanceStep::DoubleDoubles),
            None => (
                integers::distances(&wide, ulp, zeros.along.is_some()),
                DistanceStep::Integers,
            ),
        }
    }
}

/// The distances of an instance, from squares in an arithmetic that does not round; none where no root is known.
fn relative<F: Float, R: Real>(
    (case, instance): (&Case<F>, &Instance<F>),
    number: fn(f64) -> R,
    zeros: &Zeros,
    ulp: f64,
    root: impl Fn(&R) -> Option<f64>,
) -> Option<Distances> {
    let (ray, triangle, times) = instance.lift(case, number);
    let ulp = number(ulp) * times;
    let Squares {
        longest,
        in_space,
        along,
    } = Squares::of(&ray, &triangle, zeros.along.is_some());
    let unit = if longest.is_zero() { R::one() } else { longest };
    let relative = |square: R| root(&(square / &unit));
    let mut ends = [f64::NAN; 3];
    for (i, square) in along.into_iter().enumerate() {
        ends[i] = match (zeros.along, square) {
            (None, _) => f64::NAN,
            (Some(at), _) if at[i] => 0.0,
            (Some(_), None) => f64::INFINITY,
            (Some(_), Some(square)) => relative(square)?,
        };
    }
    Some(Distances {
        in_space: if zeros.in_space {
            0.0
        } else {
            relative(in_space)?
        },
        along: ends,
        edge_in_ulps: root(&(unit.clone() / (ulp.clone() * ulp)))?,
    })
}

/// The distances that a truth knows to be zero, or not to be.
struct Zeros {
    in_space: bool,
    /// True for each of 0, t_min and t_max that t equals; none where the line does not cross the plane.
    along: Option<[bool; 3]>,
}

impl Zeros {
    fn of(truth: &Truth) -> Zeros {
        match truth {
            Truth::Transversal(crossing) => Zeros {
                in_space: crossing.feature.is_edge() || crossing.feature.is_vertex(),
                along: Some([
                    crossing.t_sign == Ordering::Equal,
                    crossing.place == Place::AtMin,
                    crossing.place == Place::AtMax,
                ]),
            },
            Truth::Coplanar(Contact { meets_line, .. })
            | Truth::Degenerate(Contact { meets_line, .. }) => Zeros {
                in_space: *meets_line,
                along: None,
            },
            Truth::Parallel | Truth::Invalid => Zeros {
                in_space: false,
                along: None,
            },
        }
    }
}

/// A case moved near 1 by powers of two: the points by one, the direction by another.
struct NearOne {
    case: Case<f64>,
    /// The points were divided by 2 to this power.
    size: i32,
}

impl NearOne {
    fn of(case: &Case<f64>) -> NearOne {
        let [o, d, a, b, c] = case.vectors();
        let (size, length) = (exponent_of([o, a, b, c].as_flattened()), exponent_of(&d));
        let [o, a, b, c] = [o, a, b, c].map(|point| point.map(|x| scaled(x, -size)));
        let [t_min, t_max] = [case.ray.t_min, case.ray.t_max].map(|end| scaled(end, length - size));
        let near = Case::new(o, d.map(|x| scaled(x, -length)), [a, b, c]).on(t_min, t_max);
        NearOne { case: near, size }
    }

    /// True if every number equals the case's but for the powers of two: none underflowed.
    fn is_exact(&self, case: &Case<f64>) -> bool {
        let length = exponent_of(&case.vectors()[1]);
        let mut back = self.case.vectors();
        for (i, vector) in back.iter_mut().enumerate() {
            let power = if i == 1 { length } else { self.size };
            *vector = vector.map(|x| scaled(x, power));
        }
        let end = |t: f64| scaled(t, self.size - length);
        let near = &self.case.ray;
        back == case.vectors()
            && [end(near.t_min), end(near.t_max)] == [case.ray.t_min, case.ray.t_max]
    }
}

/// The divisor of distances: the longest edge, or a length of 1 if that is zero; lengths were
/// divided by 2^size.
fn unit_of(longest: f64, size: i32) -> f64 {
    if longest > 0.0 {
        longest
    } else {
        scaled(1.0, -size)
    }
}

/// The exponent of the largest number; -1023 where all are subnormal.
fn exponent_of(numbers: &[f64]) -> i32 {
    let largest = numbers.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    (largest.to_bits() >> 52) as i32 - 1023
}

/// The distances that floats find, and those that they leave in doubt.
#[derive(Clone, Copy)]
struct Quick {
    distances: Distances,
    /// The divisor of lengths.
    unit: f64,
    /// Edges so near to the line that rounding could matter; none if the distance is certain.
    edges_in_doubt: [bool; 3],
    along_in_doubt: bool,
}

impl Quick {
    fn certain(self) -> Option<Distances> {
        let doubt = self.along_in_doubt || self.edges_in_doubt != [false; 3];
        (!doubt).then_some(self.distances)
    }
}

/// In floats, of a case whose lengths, and the ulp, were divided by 2^size; none where a square may
/// underflow.
fn quick(case: &Case<f64>, size: i32, ulp: f64, zeros: &Zeros) -> Option<Quick> {
    let vectors = case.vectors();
    let [o, d, a, b, c] = vectors.map(DVec3::from);
    let largest = scaled(
        1.0,
        exponent_of([vectors[0], vectors[2], vectors[3], vectors[4]].as_flattened()),
    );
    let sides = [b - a, c - b, a - c].map(DVec3::length_squared);
    let longest = sides.into_iter().fold(0.0, f64::max).sqrt();
    // The square of a very short edge underflows.
    if longest < scaled(largest, -400) && !(a == b && b == c) {
        return None;
    }
    let unit = unit_of(longest, size);
    let length = d.length();
    let offsets = [a, b, c].map(|p| (p - o).cross(d));
    let to_edges = [(0, 1), (1, 2), (2, 0)].map(|(p, q)| {
        let (offset, edge) = (offsets[p], offsets[q] - offsets[p]);
        // Of an edge that is a point, 0/0: the larger of NaN and 0 is 0.
        let s = (-offset.dot(edge) / edge.length_squared())
            .clamp(0.0, 1.0)
            .max(0.0);
        (offset + edge * s).length_squared()
    });
    let in_space = to_edges.into_iter().fold(f64::INFINITY, f64::min).sqrt() / length;
    // Let L be `largest` and u = 2^-53. Coordinates are below 2L, so p - o is below 4L in each, and its
    // rounding, that of two products and of their difference come to 24uL|d| in the cross product. The
    // difference of two of these, its product with s and the sum round by less than 40uL|d| together;
    // a rounded s only chooses another point of the edge. In all that is below 2^-46 L|d|.
    let near = scaled(largest, -36);
    let mut edges_in_doubt = [false; 3];
    if !zeros.in_space && (in_space < near || in_space.is_nan()) {
        // An edge beyond twice that is not the nearest.
        let limit = 2.0 * near * length;
        edges_in_doubt = to_edges.map(|square| square < limit * limit || square.is_nan());
    }
    let mut along = [f64::NAN; 3];
    let mut along_in_doubt = false;
    if let Some(at) = zeros.along {
        let n = (b - a).cross(c - a);
        let (plane, speed) = (n.dot(a - o), n.dot(d));
        let t = plane / speed;
        // n is off by 8u times the square of the longest edge, products with it and their sums by 4u more:
        // in all by less than 2^-48. That holds for t where n·d is certain, and only then 0, which is an end
        // always, is far enough from t.
        let of_normal = scaled(longest * longest, -48);
        let error = of_normal * ((a - o).length() + t.abs() * length) / speed.abs();
        let ends = [0.0, case.ray.t_min, case.ray.t_max];
        for ((along, end), is_at) in along.iter_mut().zip(ends).zip(at) {
            let gap = (t - end).abs();
            let certain = gap > 1024.0 * error;
            along_in_doubt |= !is_at && end.is_finite() && !certain;
            *along = if is_at { 0.0 } else { gap * length / unit };
        }
    }
    let in_space = if zeros.in_space { 0.0 } else { in_space / unit };
    let distances = Distances {
        in_space,
        along,
        edge_in_ulps: unit / ulp,
    };
    Some(Quick {
        distances,
        unit,
        edges_in_doubt,
        along_in_doubt,
    })
}

/// Decides in double-doubles with bounds what floats left in doubt; none where the bounds do not decide.
fn by_bounds(near: &NearOne, found: &Quick, zeros: &Zeros) -> Option<Distances> {
    let (ray, triangle) = near.case.lift(Bounded::new);
    let mut distances = found.distances;
    let relative = |square: Bounded| Some(square.approximate()?.sqrt() / found.unit);
    if found.edges_in_doubt != [false; 3] {
        distances.in_space = f64::INFINITY;
        for ((p, q), in_doubt) in triangle.edges().into_iter().zip(found.edges_in_doubt) {
            if in_doubt {
                let square = bounded(|| line_to_segment(&ray.origin, &ray.direction, p, q))?;
                distances.in_space = distances.in_space.min(relative(square)?);
            }
        }
    }
    if let (true, Some(at)) = (found.along_in_doubt, zeros.along) {
        let squares = bounded(|| along(&ray, &triangle))?;
        for (i, square) in squares.into_iter().enumerate() {
            distances.along[i] = match square {
                _ if at[i] => 0.0,
                // The end is infinite.
                None => f64::INFINITY,
                Some(square) => relative(square)?,
            };
        }
    }
    Some(distances)
}

//! How far a case is from where its truth would change: from the line to the triangle's boundary, and
//! along the line from the ends of its extent.
//!
//! Three steps, each trusted only where it is certain to a thousandth: floats, double-doubles with
//! bounds, integers. What the truth knows to be zero is zero.

mod floats;
mod integers;
#[cfg(test)]
mod tests;

use crate::arith::{
    Bounded, Exact, Float, Real, Triple, Vector, bounded, scale_by_power_of_two as scaled,
};
use crate::case::{Case, Instance, Ray, Triangle};
use crate::truth::{Place, Truth};
use floats::{Quick, quick};
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
        let o = &ray.origin;
        let d = &ray.direction;
        let edges = triangle.edges();
        let [ab, bc, ca] = edges.map(|(p, q)| square(&q.minus(p)));
        let [to_ab, to_bc, to_ca] = edges.map(|(p, q)| line_to_segment(o, d, p, q));
        let along = if crosses {
            along(ray, triangle)
        } else {
            [None, None, None]
        };
        Squares {
            longest: ab.larger(bc).larger(ca),
            in_space: to_ab.smaller(to_bc).smaller(to_ca),
            along,
        }
    }

    /// The square of the divisor of distances: the longest edge, or a length of 1 if that is zero.
    pub fn unit(&self) -> R {
        if self.longest.is_zero() {
            R::one()
        } else {
            self.longest.clone()
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
        if !end.is_finite() {
            return None;
        }
        let gap = t.clone() - end;
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
    let offset = p.minus(o).cross(d);
    let slope = q.minus(p).cross(d);
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
    let points = [o, a, b, c];
    let sizes = points.as_flattened().iter().map(F::abs);
    let largest = sizes.fold(F::zero(), F::larger);
    largest.ulp()
}

impl Distances {
    /// The distances of a valid case with its truth.
    pub fn of<F: Float>(case: &Case<F>, truth: &Truth) -> Distances {
        Distances::and_step(case, truth).0
    }

    /// The distances of a ray of the world and the triangle that an instance puts there, as the object has them.
    pub fn of_instance<F: Float>(
        case: &Case<F>,
        instance: &Instance<F>,
        truth: &Truth,
    ) -> Distances {
        let zeros = Zeros::of(truth);
        let root = |square: &Bounded| Some(square.approximate()?.sqrt());
        let in_bounds = bounded(|| relative(case, instance, &zeros, root));
        in_bounds.flatten().unwrap_or_else(|| {
            let root = |square: &Exact| Some(square.approximate_root());
            relative(case, instance, &zeros, root).expect("always a root")
        })
    }

    /// The distances as floats see them, right or not: for a search to climb on.
    pub fn at_a_glance<F: Float>(case: &Case<F>, truth: &Truth) -> Distances {
        let near = NearOne::of(&case.widen());
        let ulp = scaled(ulp_of_points(case).to_f64(), -near.size);
        let found = quick(&near.case, near.size, ulp, &Zeros::of(truth));
        found.map_or_else(|| Distances::of(case, truth), |quick| quick.distances)
    }

    /// The distances, and the step that was certain.
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
        if near.is_exact(&wide)
            && let Some(found) = found
            && let Some(found) = by_bounds(&near, &found, &zeros)
        {
            return (found, DistanceStep::DoubleDoubles);
        }
        let found = integers::distances(&wide, ulp, zeros.along.is_some());
        (found, DistanceStep::Integers)
    }
}

/// The distances of an instance, from squares in an arithmetic that does not round; none where no root is known.
fn relative<F: Float, R: Real>(
    case: &Case<F>,
    instance: &Instance<F>,
    zeros: &Zeros,
    root: impl Fn(&R) -> Option<f64>,
) -> Option<Distances> {
    let (ray, triangle, times) = instance.lift(case, R::number);
    let squares = Squares::of(&ray, &triangle, zeros.along.is_some());
    let unit = squares.unit();
    let relative = |square: R| root(&(square / &unit));
    let along = match zeros.along {
        Some(is_at) => along_from(squares.along, is_at, relative)?,
        None => [f64::NAN; 3],
    };
    let in_space = if zeros.in_space {
        0.0
    } else {
        relative(squares.in_space)?
    };
    let ulp = R::number(ulp_of_points(case).to_f64()) * times;
    Some(Distances {
        in_space,
        along,
        edge_in_ulps: root(&(unit.clone() / (ulp.clone() * ulp)))?,
    })
}

/// The distances along a line, from their squares and from the ends at which t is known to be; none where a root is not
/// known.
fn along_from<R>(
    squares: [Option<R>; 3],
    is_at: [bool; 3],
    root: impl Fn(R) -> Option<f64>,
) -> Option<[f64; 3]> {
    let mut along = [f64::INFINITY; 3];
    for (i, square) in squares.into_iter().enumerate() {
        if is_at[i] {
            along[i] = 0.0;
        } else if let Some(square) = square {
            along[i] = root(square)?;
        }
    }
    Some(along)
}

/// The distances that a truth knows to be zero, or not to be.
struct Zeros {
    in_space: bool,
    /// True for each of 0, t_min and t_max that t equals; none where the line does not cross the plane.
    along: Option<[bool; 3]>,
}

impl Zeros {
    fn of(truth: &Truth) -> Zeros {
        let (in_space, along) = match truth {
            Truth::Transversal(crossing) => {
                let along = [
                    crossing.t_sign == Ordering::Equal,
                    crossing.place == Place::AtMin,
                    crossing.place == Place::AtMax,
                ];
                let is_at_boundary = crossing.feature.is_edge() || crossing.feature.is_vertex();
                (is_at_boundary, Some(along))
            }
            Truth::Coplanar(contact) | Truth::Degenerate(contact) => (contact.meets_line, None),
            Truth::Parallel | Truth::Invalid => (false, None),
        };
        Zeros { in_space, along }
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
        let size = exponent_of([o, a, b, c].as_flattened());
        let length = exponent_of(&d);
        let [o, a, b, c] = [o, a, b, c].map(|point| point.map(|x| scaled(x, -size)));
        let d = d.map(|x| scaled(x, -length));
        let [t_min, t_max] = [case.ray.t_min, case.ray.t_max].map(|end| scaled(end, length - size));
        NearOne {
            case: Case::new(o, d, [a, b, c]).on(t_min, t_max),
            size,
        }
    }

    /// True if every number equals the case's but for the powers of two: none underflowed.
    fn is_exact(&self, case: &Case<f64>) -> bool {
        let length = exponent_of(&case.vectors()[1]);
        let mut back = self.case.vectors();
        for (i, vector) in back.iter_mut().enumerate() {
            let power = if i == 1 { length } else { self.size };
            *vector = vector.map(|x| scaled(x, power));
        }
        let near = &self.case.ray;
        let ends = [near.t_min, near.t_max].map(|end| scaled(end, self.size - length));
        back == case.vectors() && ends == [case.ray.t_min, case.ray.t_max]
    }
}

/// The exponent of the largest number; -1023 where all are subnormal.
fn exponent_of(numbers: &[f64]) -> i32 {
    let largest = numbers.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    (largest.to_bits() >> 52) as i32 - 1023
}

/// Decides in double-doubles with bounds what floats left in doubt; none where the bounds do not decide.
fn by_bounds(near: &NearOne, found: &Quick, zeros: &Zeros) -> Option<Distances> {
    let (ray, triangle) = near.case.lift(Bounded::number);
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
    if found.along_in_doubt
        && let Some(is_at) = zeros.along
    {
        let squares = bounded(|| along(&ray, &triangle))?;
        distances.along = along_from(squares, is_at, relative)?;
    }
    Some(distances)
}

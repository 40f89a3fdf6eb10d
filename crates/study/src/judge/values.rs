//! How far t, u and v of a hit may be from their exact values: as far as rounding could carry them.
//!
//! Where the line meets the plane, o + t·d = w·a + u·b + v·c with w = 1 - u - v. If rounding moves the points of
//! this equation by r, (t, u, v) moves by (N·r, (d×ac)·r, (ab×d)·r) / D. The largest coordinate of the
//! equation's terms, with signs dropped, is the size of the numbers that a kernel adds there:
//! M = max over the axes of |w·a| + |u·b| + |v·c| + |o| + |t·d|. An error of one unit roundoff u in each
//! coordinate moves t by at most u·κ, where κ = M·|N|₁ / |D|, and likewise u and v. Rounding may carry a value
//! [`ALLOWANCE`] times as far: a weight always that many unit roundoffs of 1, because weights add up to 1, and
//! every value the least positive number. A contract may allow more, as a distance.

#[cfg(test)]
mod tests;

use super::distance::{Distances, square, ulp_of_points};
use crate::arith::{Bounded, Exact, Float, Real, Triple, Vector, bounded};
use crate::case::{Case, Ray, Triangle};
use crate::kernel::{Gives, Hit, Verdict};
use crate::truth::{Feature, Truth};

/// How many times u·κ a value may be off. Of 500,000 rays at the insides, the edges and the vertices of
/// triangles that are no slivers, no value of Möller and Trumbore's, of Cramer's rule and of Woop's test was off
/// by more than nine times.
pub const ALLOWANCE: f64 = 16.0;

/// True if the values of a hit are compared, because the line meets the triangle at one point.
pub(super) fn has_values(truth: &Truth) -> bool {
    truth
        .crossing()
        .is_some_and(|crossing| crossing.feature != Feature::Outside)
}

/// Exact t, u, v of a line that crosses the plane, and how far each may be off.
pub(super) struct Allowed<R> {
    pub(super) exact: [R; 3],
    /// u·κ; [`ALLOWANCE`] times as much is allowed.
    pub(super) unit: [R; 3],
    /// The squares of the longest edge and of the direction's length.
    edge_squared: R,
    direction_squared: R,
    /// The least positive number of the scalar.
    least: f64,
}

impl<R: Real> Allowed<R> {
    /// The exact values of a case, in an arithmetic that does not round; the unit roundoff and the least number are those of
    /// the case's scalar.
    pub(super) fn of<F: Float>(case: &Case<F>) -> Allowed<R> {
        let (ray, triangle) = case.widen().lift(R::number);
        let Triangle { a, b, c } = &triangle;
        let d = &ray.direction;
        let ab = b.minus(a);
        let ac = c.minus(a);
        let bc = c.minus(b);
        let rows = [ab.cross(&ac), d.cross(&ac), ab.cross(d)];
        let determinant = d.dot(&rows[0]);
        let start = a.minus(&ray.origin);
        let exact = rows.each_ref().map(|row| row.dot(&start) / &determinant);
        let size = size_of_terms(&ray, &triangle, &exact);
        let roundoff = R::number(roundoff::<F>());
        let per_row = size * &roundoff / determinant.abs();
        let [of_t, of_u, of_v] = rows.map(|row| sum_of_magnitudes(&row) * &per_row);
        Allowed {
            exact,
            unit: [of_t, of_u.larger(roundoff.clone()), of_v.larger(roundoff)],
            edge_squared: square(&ab).larger(square(&ac)).larger(square(&bc)),
            direction_squared: square(d),
            least: F::from_place(1).to_f64(),
        }
    }

    /// True if a value is as near as rounding may leave it, or as near as a contract tolerates.
    fn admits(&self, which: usize, value: R, tolerance: f64) -> bool {
        let off = (value - &self.exact[which]).abs();
        let allowed = R::number(ALLOWANCE) * &self.unit[which];
        if off.is_at_most(&allowed) {
            return true;
        }
        // Far above the least number of f64, of which bounded numbers know nothing.
        let tiny = R::number(2.0f64.powi(-140));
        if off.is_at_most(&tiny) && off.is_at_most(&R::number(self.least)) {
            return true;
        }
        0.0 < tolerance && self.is_within(which, &off, tolerance)
    }

    /// True if several values of a hit are all admitted.
    pub(super) fn admits_all(&self, values: &[(usize, f64)], tolerance: f64) -> bool {
        values
            .iter()
            .all(|&(which, value)| self.admits(which, R::number(value), tolerance))
    }

    /// True if an error moves the point by at most so many longest edges, or a weight by at most so much.
    fn is_within(&self, which: usize, off: &R, edges: f64) -> bool {
        if edges == f64::INFINITY {
            return true;
        }
        let edges = R::number(edges);
        if which != 0 {
            return off.is_at_most(&edges);
        }
        let moved = off.clone() * off * &self.direction_squared;
        moved.is_at_most(&(edges.clone() * &edges * &self.edge_squared))
    }
}

/// M: the largest coordinate of |w·a| + |u·b| + |v·c| + |o| + |t·d|.
fn size_of_terms<R: Real>(
    ray: &Ray<Triple<R>>,
    triangle: &Triangle<Triple<R>>,
    [t, u, v]: &[R; 3],
) -> R {
    let Triangle { a, b, c } = triangle;
    let w = R::one() - u - v;
    let terms = [(a, &w), (b, u), (c, v), (&ray.direction, t)];
    let [x, y, z] = [0, 1, 2].map(|axis| {
        let mut sum = ray.origin.at(axis).abs();
        for (vector, factor) in terms {
            sum = sum + (vector.at(axis) * factor).abs();
        }
        sum
    });
    x.larger(y).larger(z)
}

fn sum_of_magnitudes<R: Real>(v: &Triple<R>) -> R {
    v.at(0).abs() + v.at(1).abs() + v.at(2).abs()
}

/// Half the distance from 1 to the next number of a scalar.
pub(super) fn roundoff<F: Float>() -> f64 {
    F::EPSILON.to_f64() / 2.0
}

fn given(gives: Gives) -> [bool; 3] {
    [gives.t, gives.uv, gives.uv]
}

/// The values among t, u and v (0, 1 and 2) that a kernel gives; not a t that is rightly infinite, which is as near as a number can
/// be.
pub(super) fn given_values<F: Float>(gives: Gives, verdict: &Verdict<F>) -> Vec<(usize, f64)> {
    let is_given = given(gives);
    let mut values = Vec::with_capacity(3);
    for (which, value) in [verdict.t, verdict.u, verdict.v].into_iter().enumerate() {
        if is_given[which] && value.is_finite() {
            values.push((which, value.to_f64()));
        }
    }
    values
}

/// True if each value that the kernel gives is as near to its exact one as rounding may leave it, or as a contract
/// tolerates. The hit has finite values, and its line crosses the plane.
pub(super) fn are_near<F: Float>(
    case: &Case<F>,
    gives: Gives,
    verdict: &Verdict<F>,
    tolerance: f64,
) -> bool {
    let values = given_values(gives, verdict);
    let in_bounds = bounded(|| Allowed::<Bounded>::of(case).admits_all(&values, tolerance));
    in_bounds.unwrap_or_else(|| Allowed::<Exact>::of(case).admits_all(&values, tolerance))
}

/// True if a t is an infinity to which the exact t of a hit rounds: it is as far beyond the largest number as half of that
/// number's last place.
pub fn rounds_to_infinity<F: Float>(case: &Case<F>, truth: &Truth, t: F) -> bool {
    if t.is_nan() || t.is_finite() || !has_values(truth) {
        return false;
    }
    let largest = F::infinity().offset_ulps(-1);
    let last_place = Exact::from_f64(largest.ulp().to_f64());
    let limit = Exact::from_f64(largest.to_f64()) + last_place / Exact::from_f64(2.0);
    let [exact, ..] = Allowed::<Exact>::of(case).exact;
    let toward_infinity = if t < F::zero() { -exact } else { exact };
    limit.is_at_most(&toward_infinity)
}

/// True if the values that a kernel's formula gives without rounding are as near as those of a hit have to be.
pub fn exact_values_are_near<F: Float>(
    case: &Case<F>,
    gives: Gives,
    hit: Hit<Exact>,
    tolerance: f64,
) -> bool {
    let allowed = Allowed::<Exact>::of(case);
    let is_given = given(gives);
    let (u, v) = hit.uv.unzip();
    let mut values = [hit.t, u, v].into_iter().enumerate();
    values.all(|(which, value)| {
        !is_given[which] || value.is_some_and(|value| allowed.admits(which, value, tolerance))
    })
}

/// The error of the worst value of a hit, in multiples of u·κ; infinite if a value has no unit. The hit has finite values,
/// and its line crosses the plane.
pub fn exact_times<F: Float>(case: &Case<F>, gives: Gives, verdict: &Verdict<F>) -> Exact {
    let allowed = Allowed::<Exact>::of(case);
    let mut worst = Exact::from_f64(0.0);
    for (which, value) in given_values(gives, verdict) {
        let off = (Exact::from_f64(value) - &allowed.exact[which]).abs();
        if !off.is_zero() {
            worst = worst.larger(off / &allowed.unit[which]);
        }
    }
    worst
}

/// How far the values of a hit are off, on a line that crosses the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueErrors {
    /// Exact t, u and v, to a millionth of themselves.
    pub exact: [f64; 3],
    /// By how many times u·κ each is off; none where the kernel does not give it.
    pub times: [Option<f64>; 3],
    /// How far the point is off in longest edges: along the ray by t, or in the plane by u or v.
    pub edges: f64,
    /// How far each value is off in longest edges.
    by_value: [f64; 3],
}

impl ValueErrors {
    /// The errors of a hit with finite values.
    pub fn of<F: Float>(case: &Case<F>, truth: &Truth, gives: Gives, verdict: &Verdict<F>) -> Self {
        let values = [verdict.t, verdict.u, verdict.v].map(F::to_f64);
        let in_bounds = measure(case, values, Bounded::approximate);
        let Measured { exact, off, times } = in_bounds.unwrap_or_else(|| {
            let float = |x: &Exact| Some(x.approximate());
            measure(case, values, float).expect("always a number")
        });
        let longest = Distances::of(case, truth).edge_in_ulps * ulp_of_points(case).to_f64();
        let direction = length(case.widen().vectors()[1]);
        let [off_t, off_u, off_v] = off;
        let mut errors = ValueErrors {
            exact,
            times: [None; 3],
            edges: 0.0,
            by_value: [off_t / longest * direction, off_u, off_v],
        };
        for (which, is_given) in given(gives).into_iter().enumerate() {
            if is_given {
                errors.times[which] = Some(times[which]);
                errors.edges = errors.edges.max(errors.by_value[which]);
            }
        }
        errors
    }

    /// True if t, u or v (0, 1 or 2) is farther off than rounding explains and a contract tolerates.
    pub fn is_wrong(&self, which: usize, tolerance: f64) -> bool {
        let is_tolerated = self.by_value[which] <= tolerance;
        self.times[which].is_some_and(|times| ALLOWANCE < times) && !is_tolerated
    }
}

/// The values of a hit, measured; 0 where a value is not finite.
#[derive(Default)]
struct Measured {
    exact: [f64; 3],
    /// How far each value is from its exact one.
    off: [f64; 3],
    /// By how many times u·κ.
    times: [f64; 3],
}

/// Measures the values of a hit in an arithmetic that does not round; none where a number is not known as a float.
fn measure<F: Float, R: Real>(
    case: &Case<F>,
    values: [f64; 3],
    float: impl Fn(&R) -> Option<f64>,
) -> Option<Measured> {
    let allowed = Allowed::of(case);
    let mut measured = Measured::default();
    for (which, value) in values.into_iter().enumerate() {
        let exact = &allowed.exact[which];
        measured.exact[which] = float(exact)?;
        if !value.is_finite() {
            continue;
        }
        let off = (R::number(value) - exact).abs();
        measured.off[which] = float(&off)?;
        let unit = &allowed.unit[which];
        measured.times[which] = if !unit.is_zero() {
            float(&(off / unit))?
        } else if measured.off[which] == 0.0 {
            0.0
        } else {
            // A t that is 0 whatever rounds has no unit.
            f64::INFINITY
        };
    }
    Some(measured)
}

/// The length of a vector, without overflow on the way.
pub(super) fn length(v: [f64; 3]) -> f64 {
    let largest = v.into_iter().map(f64::abs).fold(0.0, f64::max);
    let squares = v.map(|x| (x / largest).powi(2));
    largest * squares.into_iter().sum::<f64>().sqrt()
}

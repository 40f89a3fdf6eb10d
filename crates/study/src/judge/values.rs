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

use super::distance::{Distances, ulp_of_points};
use crate::arith::{Bounded, Exact, Float, Real, Triple, Vector, bounded};
use crate::case::{Case, Ray, Triangle};
use crate::kernel::{Gives, Hit, Verdict};
use crate::truth::{Feature, Truth};
use glam::{DVec3, Vec3Swizzles};
use std::array;

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
    pub(super) number: fn(f64) -> R,
}

impl<R: Real> Allowed<R> {
    /// In an arithmetic that does not round, of a case in a scalar with this unit roundoff and this least
    /// number.
    pub(super) fn of<F: Float>(case: &Case<F>, number: fn(f64) -> R) -> Allowed<R> {
        let roundoff = roundoff::<F>();
        let (ray, triangle) = case.widen().lift(number);
        let (
            Ray {
                origin: o,
                direction: d,
                ..
            },
            Triangle { a, b, c },
        ) = (&ray, &triangle);
        let (ab, ac) = (b.minus(a), c.minus(a));
        let rows = [ab.cross(&ac), d.cross(&ac), ab.cross(d)];
        let determinant = d.dot(&rows[0]);
        let start = a.minus(o);
        let exact = rows.each_ref().map(|row| row.dot(&start) / &determinant);
        let [t, u, v] = &exact;
        let w = R::one() - u - v;
        let terms = [(a, &w), (b, u), (c, v), (d, t)];
        let size = (0..3).map(|axis| {
            let term = |(point, weight): (&Triple<R>, &R)| (point.at(axis) * weight).abs();
            terms
                .into_iter()
                .map(term)
                .fold(o.at(axis).abs(), |sum, term| sum + term)
        });
        let size = size.reduce(R::larger).expect("three axes");
        let per_row = size * number(roundoff) / determinant.abs();
        let unit: [R; 3] = array::from_fn(|i| {
            let row = &rows[i];
            let moved = (row.at(0).abs() + row.at(1).abs() + row.at(2).abs()) * &per_row;
            if i == 0 {
                moved
            } else {
                moved.larger(number(roundoff))
            }
        });
        let edge = |edge: &Triple<R>| edge.dot(edge);
        Allowed {
            exact,
            unit,
            edge_squared: edge(&ab).larger(edge(&ac)).larger(edge(&c.minus(b))),
            direction_squared: d.dot(d),
            least: F::from_place(1).to_f64(),
            number,
        }
    }

    /// True if a value is as near as rounding may leave it, or as near as a contract tolerates.
    fn admits(&self, which: usize, value: R, tolerance: f64) -> bool {
        let off = (value - &self.exact[which]).abs();
        let allowed = (self.number)(ALLOWANCE) * &self.unit[which];
        // Far above the least number of f64, of which bounded numbers know nothing.
        let tiny = (self.number)(2.0f64.powi(-140));
        off.is_at_most(&allowed)
            || off.is_at_most(&tiny) && off.is_at_most(&(self.number)(self.least))
            || 0.0 < tolerance && self.is_within(which, &off, tolerance)
    }

    /// The same of several values of a hit.
    pub(super) fn admits_all(&self, values: &[(usize, f64)], tolerance: f64) -> bool {
        values
            .iter()
            .all(|&(which, value)| self.admits(which, (self.number)(value), tolerance))
    }

    /// True if an error moves the point by at most so many longest edges, or a weight by at most so much.
    fn is_within(&self, which: usize, off: &R, edges: f64) -> bool {
        if edges == f64::INFINITY {
            return true;
        }
        let edges = (self.number)(edges);
        if which != 0 {
            return off.is_at_most(&edges);
        }
        let moved = off.clone() * off * &self.direction_squared;
        moved.is_at_most(&(edges.clone() * &edges * &self.edge_squared))
    }
}

/// Half the distance from 1 to the next number of a scalar.
pub(super) fn roundoff<F: Float>() -> f64 {
    F::EPSILON.to_f64() / 2.0
}

fn given(gives: Gives) -> [bool; 3] {
    [gives.t, gives.uv, gives.uv]
}

/// Those of t, u and v (0, 1 and 2) that a kernel gives; not a t that is rightly infinite, which is as near as a number can
/// be.
pub(super) fn given_values<F: Float>(gives: Gives, verdict: &Verdict<F>) -> Vec<(usize, f64)> {
    let values = [verdict.t, verdict.u, verdict.v]
        .map(F::to_f64)
        .into_iter()
        .enumerate();
    let finite = values.filter(|(_, value)| value.is_finite());
    finite.filter(|(which, _)| given(gives)[*which]).collect()
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
    let in_bounds = bounded(|| Allowed::of(case, Bounded::new).admits_all(&values, tolerance));
    in_bounds.unwrap_or_else(|| Allowed::of(case, Exact::from_f64).admits_all(&values, tolerance))
}

/// True if a t is an infinity to which the exact t of a hit rounds: it is as far beyond the largest number as half of that
/// number's last place.
pub fn rounds_to_infinity<F: Float>(case: &Case<F>, truth: &Truth, t: F) -> bool {
    if t.is_nan() || t.is_finite() || !has_values(truth) {
        return false;
    }
    let largest = F::infinity().offset_ulps(-1);
    let half = Exact::from_f64(largest.ulp().to_f64()) / Exact::from_f64(2.0);
    let limit = Exact::from_f64(largest.to_f64()) + half;
    let [exact, ..] = Allowed::of(case, Exact::from_f64).exact;
    let exact = if t < F::zero() { -exact } else { exact };
    limit.is_at_most(&exact)
}

/// True if what a kernel's formula gives without rounding is as near.
pub fn exact_values_are_near<F: Float>(
    case: &Case<F>,
    gives: Gives,
    hit: Hit<Exact>,
    tolerance: f64,
) -> bool {
    let allowed = Allowed::of(case, Exact::from_f64);
    let (u, v) = hit.uv.map_or((None, None), |(u, v)| (Some(u), Some(v)));
    let values = [hit.t, u, v].into_iter().zip(given(gives)).enumerate();
    let near =
        |value: Option<Exact>, which| value.is_some_and(|x| allowed.admits(which, x, tolerance));
    values
        .into_iter()
        .all(|(which, (value, given))| !given || near(value, which))
}

/// The error of the worst value of a hit, in multiples of u·κ; infinite if a value has no unit. The hit has finite values,
/// and its line crosses the plane.
pub fn exact_times<F: Float>(case: &Case<F>, gives: Gives, verdict: &Verdict<F>) -> Exact {
    let allowed = Allowed::of(case, Exact::from_f64);
    let times = given_values(gives, verdict)
        .into_iter()
        .map(|(which, value)| {
            let off = (Exact::from_f64(value) - &allowed.exact[which]).abs();
            if off.is_zero() {
                off
            } else {
                off / &allowed.unit[which]
            }
        });
    times.fold(Exact::from_f64(0.0), Exact::larger)
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
    /// The same of each value.
    by_value: [f64; 3],
}

impl ValueErrors {
    /// The errors of a hit with finite values.
    pub fn of<F: Float>(case: &Case<F>, truth: &Truth, gives: Gives, verdict: &Verdict<F>) -> Self {
        let values = [verdict.t, verdict.u, verdict.v].map(F::to_f64);
        let measured = measure(case, values, Bounded::new, Bounded::approximate);
        let (exact, off, times) = measured.unwrap_or_else(|| {
            let float = |x: &Exact| Some(x.approximate());
            measure(case, values, Exact::from_f64, float).expect("always a number")
        });
        let longest = Distances::of(case, truth).edge_in_ulps * ulp_of_points(case).to_f64();
        let direction = length(case.widen().vectors()[1]);
        let edges = [off[0] / longest * direction, off[1], off[2]];
        let given = given(gives);
        let worst = (0..3)
            .filter(|i| given[*i])
            .map(|i| edges[i])
            .fold(0.0, f64::max);
        let times = array::from_fn(|i| given[i].then_some(times[i]));
        ValueErrors {
            exact,
            times,
            edges: worst,
            by_value: edges,
        }
    }

    /// True if t, u or v (0, 1 or 2) is farther off than rounding explains and a contract tolerates.
    pub fn is_wrong(&self, which: usize, tolerance: f64) -> bool {
        let is_within = self.by_value[which] <= tolerance;
        self.times[which].is_some_and(|times| ALLOWANCE < times) && !is_within
    }
}

/// The exact values, how far those of a hit are off, and in multiples of u·κ.
fn measure<F: Float, R: Real>(
    case: &Case<F>,
    values: [f64; 3],
    number: fn(f64) -> R,
    float: impl Fn(&R) -> Option<f64>,
) -> Option<([f64; 3], [f64; 3], [f64; 3])> {
    let allowed = Allowed::of(case, number);
    let mut all = ([0.0; 3], [0.0; 3], [0.0; 3]);
    for (which, value) in values.into_iter().enumerate() {
        all.0[which] = float(&allowed.exact[which])?;
        if value.is_finite() {
            let off = (number(value) - &allowed.exact[which]).abs();
            all.1[which] = float(&off)?;
            let unit = &allowed.unit[which];
            // A t that is 0 whatever rounds has no unit.
            all.2[which] = match (unit.is_zero(), all.1[which]) {
                (true, 0.0) => 0.0,
                (true, _) => f64::INFINITY,
                (false, _) => float(&(off / unit))?,
            };
        }
    }
    Some(all)
}

/// The length of a vector, without overflow on the way.
pub(super) fn length(v: [f64; 3]) -> f64 {
    let largest = v.into_iter().map(f64::abs).fold(0.0, f64::max);
    largest
        * v.into_iter()
            .map(|x| (x / largest).powi(2))
            .sum::<f64>()
            .sqrt()
}

/// Ranges in which t, u and v of a hit are surely right. Beyond these numbers `are_near` decides.
#[derive(Clone, Copy, Debug)]
pub struct ValueLimits<F> {
    /// The least t, u and v.
    pub low: [F; 3],
    /// The largest t, u and v.
    pub high: [F; 3],
}

impl<F: Float> ValueLimits<F> {
    /// Every finite number.
    fn any() -> Self {
        let largest = F::infinity().offset_ulps(-1);
        ValueLimits {
            low: [-largest; 3],
            high: [largest; 3],
        }
    }

    /// No number.
    fn none() -> Self {
        ValueLimits {
            low: [F::infinity(); 3],
            high: [-F::infinity(); 3],
        }
    }

    /// The ranges for a case with its truth.
    pub fn of(case: &Case<F>, truth: &Truth) -> Self {
        if !has_values(truth) {
            return ValueLimits::any();
        }
        let found = quick(&case.widen(), roundoff::<F>()).or_else(|| {
            let Allowed { exact, unit, .. } = Allowed::of(case, Bounded::new);
            let mut found = [(0.0, 0.0); 3];
            for i in 0..3 {
                // Each is known to a millionth of itself at least; what that leaves open is taken off.
                let off = ALLOWANCE * unit[i].approximate()? * (1.0 - 1e-5);
                found[i] = (exact[i].known_to(off * 1e-5)?, off * (1.0 - 1e-5));
            }
            Some(found)
        });
        found.map_or_else(ValueLimits::none, |found| {
            let mut limits = ValueLimits::any();
            for (i, (value, off)) in found.into_iter().enumerate() {
                // Each is rounded once or twice, by less than what is taken off here.
                let off = off - (value.abs() + off) * (4.0 * f64::EPSILON);
                let (low, high) = (F::from_f64(value - off), F::from_f64(value + off));
                let inside = |x: F, ulps| {
                    if x.is_finite() {
                        x.offset_ulps(ulps)
                    } else {
                        x
                    }
                };
                limits.low[i] = if low.to_f64() < value - off {
                    inside(low, 1)
                } else {
                    low
                };
                limits.high[i] = if high.to_f64() > value + off {
                    inside(high, -1)
                } else {
                    high
                };
                if !(limits.low[i].is_finite() && limits.high[i].is_finite()) {
                    return ValueLimits::none();
                }
            }
            limits
        })
    }
}

/// In floats: each value, and how far from it a kernel's value surely may be; none where that is not known well.
fn quick(case: &Case<f64>, roundoff: f64) -> Option<[(f64, f64); 3]> {
    /// Products of four numbers of this size neither overflow nor underflow.
    const LARGEST: f64 = (1u128 << 127) as f64 * (1u128 << 73) as f64;
    let vectors = case.vectors();
    let size = vectors.as_flattened().iter().map(|x| x.abs());
    if !size
        .clone()
        .all(|x| x == 0.0 || (1.0 / LARGEST..=LARGEST).contains(&x))
    {
        return None;
    }
    let [o, d, a, b, c] = vectors.map(DVec3::from);
    let (ab, ac, start) = (b - a, c - a, a - o);
    // A cross product, and the same with all signs dropped.
    let cross = |p: DVec3, q: DVec3| {
        let (left, right) = (p.yzx() * q.zxy(), p.zxy() * q.yzx());
        (left - right, left.abs() + right.abs())
    };
    let rows = [cross(ab, ac), cross(d, ac), cross(ab, d)];
    let determinant = d.dot(rows[0].0).abs();
    let sign = if d.dot(rows[0].0) < 0.0 { -1.0 } else { 1.0 };
    // Differences, products and sums: at most eight roundings of half an epsilon on the way to each term.
    let error = 4.0 * f64::EPSILON;
    let determinant_error = error * d.abs().dot(rows[0].1);
    let least = determinant - determinant_error;
    // False of NaN too.
    let is_known = determinant / 2.0 < least;
    if !is_known {
        return None;
    }
    let values = rows.map(|(row, _)| sign * row.dot(start) / determinant);
    let errors: [f64; 3] = array::from_fn(|i| {
        let numerator = error * rows[i].1.dot(start.abs());
        (numerator + values[i].abs() * determinant_error) / least + error * values[i].abs()
    });
    let [t, u, v] = values;
    let w = 1.0 - u - v;
    let largest = |p: DVec3| p.abs().max_element();
    let sizes = (w * a).abs() + (u * b).abs() + (v * c).abs() + o.abs() + (t * d).abs();
    // The weights' errors move each term by no more than this.
    let moved = (errors[1] + errors[2] + error) * (largest(a) + largest(b) + largest(c))
        + errors[0] * largest(d);
    let size = (largest(sizes) * (1.0 - error) - moved).max(0.0);
    let mut found = [(0.0, 0.0); 3];
    for i in 0..3 {
        let (row, permanents) = (rows[i].0.abs(), rows[i].1);
        let row = (row.element_sum() - error * permanents.element_sum()).max(0.0);
        let unit = roundoff * size * row / (determinant + determinant_error);
        let unit = if i == 0 { unit } else { unit.max(roundoff) };
        let off = ALLOWANCE * unit * (1.0 - 1e-9) - errors[i];
        // Most values of kernels are off by less than twice this unit. A limit of 0 is one.
        let is_known = 2.0 * unit <= off;
        if !is_known {
            return None;
        }
        found[i] = (values[i], off);
    }
    Some(found)
}

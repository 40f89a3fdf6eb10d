//! How badly a verdict was wrong: how far the line is from where the verdict would be right.
//!
//! Every finding gets an approximate severity in `f64`, by which the worst is chosen; what a report
//! shows of the chosen ones is computed from exact squares.

use crate::arith::{Exact, ExactVector, Float, Real, Vector};
use crate::case::{Case, Ray, Triangle};
use crate::contract::Extent;
use crate::judge::Finding;
use crate::truth::{Crossing, Feature, Place, Truth};
use std::cmp::Ordering;

/// The exact distances behind a finding, rounded to floats from exact squares, in units of the
/// triangle's longest edge (of length, for a triangle that is a point). `None` where a distance does
/// not apply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Severity {
    /// In the plane, from where the line meets it to the triangle's boundary.
    pub in_plane: Option<f64>,
    /// In space, from the line to the boundary.
    pub in_space: f64,
    /// |t - end|·|d| to the nearest finite end of the extent.
    pub along: Option<f64>,
    /// The longest edge in ulps of the largest coordinate of the case's points: a distance times
    /// this is in ulps.
    pub edge_in_ulps: f64,
}

/// The squares of the distances behind a finding, exact. As in [`Severity`], but not divided by the
/// longest edge.
struct Squares {
    in_plane: Option<Exact>,
    in_space: Exact,
    along: Option<Exact>,
    /// Of the longest edge; 1 of a triangle that is a point.
    unit: Exact,
}

impl Squares {
    /// Of a case; none for invalid input.
    fn of<F: Float>(case: &Case<F>, extent: Extent) -> Option<Squares> {
        let vectors = case.vectors();
        if vectors.iter().flatten().any(|x| !x.is_finite()) || vectors[1].iter().all(F::is_zero) {
            return None;
        }
        let (Ray { origin: o, direction: d, .. }, Triangle { a, b, c }) = case.exact();
        let edges = [(&a, &b), (&b, &c), (&c, &a)];
        let longest = edges.map(|(p, q)| square(&q.minus(p))).into_iter().reduce(larger)?;
        let unit = if longest.is_zero() { Exact::one() } else { longest };

        let n = b.minus(&a).cross(&c.minus(&a));
        let capital_d = n.dot(&d);
        let t = (!capital_d.is_zero()).then(|| n.dot(&a.minus(&o)) / capital_d);
        let in_plane = t.as_ref().and_then(|t| {
            let hit = o.plus(&d.times(t));
            edges.map(|(p, q)| point_to_segment(&hit, p, q)).into_iter().reduce(smaller)
        });
        let in_space =
            edges.map(|(p, q)| line_to_segment(&o, &d, p, q)).into_iter().reduce(smaller)?;
        let along = t.and_then(|t| {
            let ends = ends(case, extent).into_iter().filter(F::is_finite);
            let gaps = ends.map(|end| (t.clone() - Exact::from_f64(end.to_f64())).abs());
            let gap = gaps.reduce(smaller)?;
            Some(gap.clone() * gap * square(&d))
        });
        Some(Squares { in_plane, in_space, along, unit })
    }
}

/// The distances of a case; none for invalid input.
pub fn exact_severity<F: Float>(case: &Case<F>, extent: Extent) -> Option<Severity> {
    let Squares { in_plane, in_space, along, unit } = Squares::of(case, extent)?;
    let relative = |square: Exact| (square / &unit).approximate_root();
    let vectors = case.vectors();
    let points = [vectors[0], vectors[2], vectors[3], vectors[4]];
    let largest =
        points.iter().flatten().map(F::abs).fold(F::zero(), |m, x| if m < x { x } else { m });
    let ulp = Exact::from_f64(largest.ulp().to_f64());
    Some(Severity {
        in_plane: in_plane.map(relative),
        in_space: relative(in_space),
        along: along.map(relative),
        edge_in_ulps: (unit.clone() / (ulp.clone() * ulp)).approximate_root(),
    })
}

/// How badly a finding is wrong, exactly, in units of the longest edge: what
/// [`Distances::severity`] approximates. None for invalid input.
pub(crate) fn exact_severity_of<F: Float>(
    case: &Case<F>,
    truth: &Truth,
    finding: Finding,
    extent: Extent,
) -> Option<Exact> {
    let Squares { in_space, along, unit, .. } = Squares::of(case, extent)?;
    let square = match (finding, truth.crossing()) {
        (Finding::FalseMiss, Some(_)) => along.into_iter().fold(in_space, smaller),
        (Finding::FalseHit, Some(crossing)) => {
            let along = along.filter(|_| is_off_end(crossing, extent)).unwrap_or(Exact::zero());
            let outside = crossing.feature == Feature::Outside;
            larger(along, if outside { in_space } else { Exact::zero() })
        }
        _ => in_space,
    };
    Some((square / unit).sqrt())
}

/// Whether a crossing lies before or beyond the part of the line that counts.
pub(crate) fn is_off_end(crossing: &Crossing, extent: Extent) -> bool {
    match extent {
        Extent::Line => false,
        Extent::Ray => crossing.t_sign == Ordering::Less,
        Extent::Interval => matches!(crossing.place, Place::Before | Place::Beyond),
    }
}

/// Approximate distances of a case, from which the severity of any kernel's finding on it follows.
#[derive(Clone, Copy)]
pub(crate) struct Distances {
    /// From the line to the triangle's boundary, in units of the longest edge.
    pub(crate) in_space: f64,
    /// |t - end|·|d| for ends 0, t_min and t_max, in the same units; NaN where the line does not cross
    /// the plane.
    along: [f64; 3],
}

impl Distances {
    /// Of a case.
    pub fn of<F: Float>(case: &Case<F>) -> Distances {
        let case = case.widen();
        let vectors = case.vectors();
        let points = [vectors[0], vectors[2], vectors[3], vectors[4]];
        let largest = |v: &[f64]| v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let (size, length) = (largest(points.as_flattened()), largest(&vectors[1]));
        // Far from overflow and underflow: sizes about 1.
        let near_one = |v: [f64; 3], unit: f64| glam::DVec3::from(v.map(|x| x / unit));
        let [o, a, b, c] = points.map(|v| near_one(v, size));
        let d = near_one(vectors[1], length);
        let edges = [(a, b), (b, c), (c, a)];
        let longest = edges.iter().fold(0.0f64, |m, (p, q)| m.max(p.distance(*q)));
        let unit = if longest > 0.0 { longest } else { 1.0 };
        let in_space = edges.iter().fold(f64::INFINITY, |m, (p, q)| {
            let (offset, edge) = ((*p - o).cross(d), (*q - *p).cross(d));
            let s = (-offset.dot(edge) / edge.dot(edge)).clamp(0.0, 1.0);
            let s = if s.is_nan() { 0.0 } else { s };
            m.min((offset + edge * s).length() / d.length())
        });
        let n = (b - a).cross(c - a);
        let t = n.dot(a - o) / n.dot(d);
        let along = [0.0, case.ray.t_min, case.ray.t_max]
            .map(|end| (t - end * (length / size)).abs() * d.length() / unit);
        Distances { in_space: in_space / unit, along }
    }

    /// The approximate severity by which the worst finding is chosen: for a false miss how far inside
    /// the line passes, for any other finding how far outside. Zero where it cannot be computed.
    pub fn severity(&self, truth: &Truth, finding: Finding, extent: Extent) -> f64 {
        let along = match extent {
            Extent::Line => f64::INFINITY,
            Extent::Ray => self.along[0],
            Extent::Interval => self.along[1].min(self.along[2]),
        };
        let distance = match (finding, truth.crossing()) {
            (Finding::FalseMiss, Some(_)) => self.in_space.min(along),
            (Finding::FalseHit, Some(crossing)) => {
                let outside = crossing.feature == Feature::Outside;
                let along = if is_off_end(crossing, extent) { along } else { 0.0 };
                along.max(if outside { self.in_space } else { 0.0 })
            }
            _ => self.in_space,
        };
        if distance.is_finite() { distance } else { 0.0 }
    }
}

/// Where an extent begins and ends, in units of the direction.
fn ends<F: Float>(case: &Case<F>, extent: Extent) -> [F; 2] {
    match extent {
        Extent::Line => [-F::infinity(), F::infinity()],
        Extent::Ray => [F::zero(), F::infinity()],
        Extent::Interval => [case.ray.t_min, case.ray.t_max],
    }
}

fn smaller(a: Exact, b: Exact) -> Exact {
    if b.is_less(&a) { b } else { a }
}

fn larger(a: Exact, b: Exact) -> Exact {
    if a.is_less(&b) { b } else { a }
}

fn square(v: &ExactVector) -> Exact {
    v.dot(v)
}

/// The square of the distance between a point and a segment.
fn point_to_segment(x: &ExactVector, p: &ExactVector, q: &ExactVector) -> Exact {
    let (edge, offset) = (q.minus(p), p.minus(x));
    let s = nearest_on_segment(-offset.dot(&edge), square(&edge));
    square(&offset.plus(&edge.times(&s)))
}

/// The square of the distance between a line and a segment: |(p - o + s·(q - p)) × d|² / |d|² at the
/// s in [0, 1] that makes it least.
fn line_to_segment(o: &ExactVector, d: &ExactVector, p: &ExactVector, q: &ExactVector) -> Exact {
    let (offset, slope) = (p.minus(o).cross(d), q.minus(p).cross(d));
    let s = nearest_on_segment(-offset.dot(&slope), square(&slope));
    square(&offset.plus(&slope.times(&s))) / square(d)
}

/// `numerator / denominator` cut to [0, 1]; 0 if the denominator is zero.
fn nearest_on_segment(numerator: Exact, denominator: Exact) -> Exact {
    if denominator.is_zero() || numerator.is_sign_negative() {
        return Exact::zero();
    }
    smaller(numerator / denominator, Exact::one())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::truth;

    const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

    #[test]
    fn distances_are_those_measured_by_hand() {
        // Down onto (1, 1): 1 from both legs, 1 from the hypotenuse (x/4 + y/3 = 1): 5/12·12/5 = 1.
        let case = Case::<f64>::new([1.0, 1.0, 2.0], [0.0, 0.0, -1.0], TRIANGLE);
        let severity = exact_severity(&case, Extent::Interval).unwrap();
        assert_eq!(severity.in_plane, Some(0.2));
        assert_eq!(severity.in_space, 0.2);
        assert_eq!(severity.along, Some(0.4));
        // Longest edge 5; the largest coordinate is 4, whose ulp is 2^-50.
        assert_eq!(severity.edge_in_ulps, 5.0 * 2f64.powi(50));
    }

    #[test]
    fn a_slanted_line_is_nearer_in_space_than_in_the_plane() {
        // Onto (2, -1) in the plane, 45 degrees along y: distance 1 in the plane, 1/√2 in space.
        let case = Case::<f64>::new([2.0, -3.0, 2.0], [0.0, 1.0, -1.0], TRIANGLE);
        let severity = exact_severity(&case, Extent::Interval).unwrap();
        assert_eq!(severity.in_plane, Some(0.2));
        assert!((severity.in_space - 0.2 / 2f64.sqrt()).abs() < 1e-16);
    }

    #[test]
    fn the_approximation_follows_the_exact_value_at_every_scale() {
        for scale in [-900, -300, 0, 300] {
            let by = |x: f64| crate::arith::scale_by_power_of_two(x, scale);
            let case = Case::<f64>::new(
                [2.0, -3.0, 2.0].map(by),
                [0.0, 1.0, -1.0],
                TRIANGLE.map(|v| v.map(by)),
            );
            let exact = exact_severity(&case, Extent::Interval).unwrap().in_space;
            let distances = Distances::of(&case);
            let near = distances.severity(&truth(&case), Finding::FalseHit, Extent::Interval);
            assert!((near - exact).abs() < 1e-12, "{scale}: {near} {exact}");
        }
    }
}

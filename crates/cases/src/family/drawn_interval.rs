//! Draws the interval of the ray that the cases of one index share, about the place where its line meets them.
//!
//! A kernel that ignores t_min, or compares t with the wrong end, is right wherever the interval is `[0, inf)`. So half of
//! the rays get another interval: most of those hold the crossing, and one ray in six has it before t_min or beyond t_max.
//! An end is a quarter of the way to the crossing or more away from it, so that rounding t does not decide; only on
//! lattices, where t may be a float exactly, some ends are at the crossing itself.

use super::Grouping;
use super::scene::wide;
use crate::arith::Float;
use crate::case::{Case, Draw};

/// Gives the cases of one index the interval that is drawn for their ray; the first of them says where the crossing is.
///
/// Where t is not in the range of `f64`, the ray keeps the interval that it has. A ray that starts on its triangle keeps
/// its start, t = 0: on which side of that the triangle lies is the question.
pub(crate) fn draw_interval<F: Float>(grouping: Grouping, draw: &mut Draw, cases: &mut [Case<F>]) {
    let crossing = Crossing::of(&cases[0]);
    let [t_min, t_max] = match grouping {
        Grouping::SecondaryRay => crossing.end_far_beyond(draw),
        _ => crossing.interval(draw),
    };
    put_on(cases, F::from_f64(t_min), F::from_f64(t_max));
}

/// Puts all cases on an interval that is one.
fn put_on<F: Float>(cases: &mut [Case<F>], t_min: F, t_max: F) {
    if !t_min.is_finite() || t_max.is_nan() || t_max < t_min {
        return;
    }
    for case in cases {
        *case = case.on(t_min, t_max);
    }
}

/// Where a line meets a triangle's plane, near enough to put the ends of an interval about it.
struct Crossing {
    /// The crossing's t; without a crossing that of the point nearest to the triangle's middle. NaN beyond `f64`.
    t: f64,
    /// How far apart ends are: |t|, or the triangle's own size if the ray starts at it.
    step: f64,
    /// True if t is exactly a float.
    is_exact: bool,
    /// The interval that the case has.
    ends: [f64; 2],
}

/// A ray that starts at a triangle counts as at least this share of the longest edge away from it.
const LEAST_STEP: f64 = 1.0 / 16.0;

/// Products of three integers up to this are exact in `f64`, and so are their sums.
const LARGEST_INTEGER: f64 = 8192.0;

/// True if all coordinates of a case are small integers.
fn is_lattice<F: Float>(case: &Case<F>) -> bool {
    let vectors = case.vectors();
    vectors.as_flattened().iter().all(|x| {
        let x = x.to_f64();
        x.fract() == 0.0 && x.abs() <= LARGEST_INTEGER
    })
}

/// True if the number has so few digits that its product with a sum of products of three such integers is exact.
fn is_short(t: f64) -> bool {
    (t * 16.0).fract() == 0.0 && t.abs() < 32.0
}

impl Crossing {
    fn of<F: Float>(case: &Case<F>) -> Crossing {
        let [origin, direction, a, b, c] = case.vectors().map(wide);
        let normal = (b - a).cross(c - a);
        let numerator = normal.dot(a - origin);
        let denominator = normal.dot(direction);
        let t = if denominator == 0.0 {
            let middle = (a + b + c) / 3.0;
            direction.dot(middle - origin) / direction.dot(direction)
        } else {
            numerator / denominator
        };
        let longest_edge = (b - a).abs().max((c - a).abs()).max_element();
        let speed = direction.abs().max_element();
        Crossing {
            t,
            step: t.abs().max(longest_edge / speed * LEAST_STEP),
            is_exact: is_lattice(case) && is_short(t) && t * denominator == numerator,
            ends: [case.ray.t_min.to_f64(), case.ray.t_max.to_f64()],
        }
    }

    /// An interval about the crossing: 16 of 32 are the case's own, 10 of 32 hold the crossing, 5 of 32 do not, and on lattices one of 32
    /// ends at it.
    fn interval(&self, draw: &mut Draw) -> [f64; 2] {
        let near = self.step * (0.25 + 0.5 * draw.unit());
        let far = self.step * (1.25 + 2.75 * draw.unit());
        let before = self.t - near;
        let after = self.t + near;
        // On the other side of t = 0, where t > 0.
        let far_before = self.t - far;
        let far_after = self.t + far;
        match draw.below(32) {
            0..16 => self.ends,
            16..20 if self.t < 0.0 => [far_before, 0.0],
            16..20 => [0.0, far_after],
            20..22 => [before, f64::INFINITY],
            22..24 => [before, far_after],
            24 => [far_before, f64::INFINITY],
            25 => [far_before, after],
            26 => [after, f64::INFINITY],
            27 => [after, far_after],
            28 | 29 => [far_before, before],
            30 => [far_before - self.step, far_before],
            _ if self.is_exact => draw.pick(&[
                [self.t, f64::INFINITY],
                [self.t, far_after],
                [far_before, self.t],
            ]),
            _ => self.ends,
        }
    }

    /// An interval from the case's own start to far beyond the triangle; three of four are the case's own.
    fn end_far_beyond(&self, draw: &mut Draw) -> [f64; 2] {
        let [start, own_end] = self.ends;
        let end = match draw.below(4) {
            0 => self.step * (1.0 + 7.0 * draw.unit()),
            _ => own_end,
        };
        [start, end]
    }
}

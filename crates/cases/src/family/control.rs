//! `interior`, `outside`: the control. Random transversal hits and misses, both sides, well away
//! from every boundary.

use super::integer::shuffle;
use super::scene::wide;
use super::{CaseGroup, Corners, Promise, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::Feature;
use glam::DVec3;
use std::cmp::Ordering;

pub(super) struct Interior;
pub(super) struct Outside;

impl Recipe for Interior {
    const NAME: &'static str = "interior";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "transversal, at t > 0, in the interior";
    const KEEPS: Promise = Promise::Crossings(|crossing| {
        crossing.feature == Feature::Interior && crossing.t_sign == Ordering::Greater
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        CaseGroup::One(aimed(draw, interior_weights))
    }
}

impl Recipe for Outside {
    const NAME: &'static str = "outside";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "transversal, at t > 0, outside the triangle";
    const KEEPS: Promise = Promise::Crossings(|crossing| {
        crossing.feature == Feature::Outside && crossing.t_sign == Ordering::Greater
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        CaseGroup::One(aimed(draw, outside_weights))
    }
}

/// Weights of which one or two are below zero; their sum stays 1.
fn outside_weights(draw: &mut Draw) -> [f64; 3] {
    let [u, v, w] = interior_weights(draw);
    let shift = 0.125 + draw.unit();
    let weights = if draw.coin() {
        [-u - shift, v + u, w + u + shift]
    } else {
        [u + 2.0 + shift, v - 1.0 - shift, w - 1.0]
    };
    shuffle(draw, weights)
}

/// Weights of at least 1/16 each.
pub(super) fn interior_weights(draw: &mut Draw) -> [f64; 3] {
    let mut u = draw.unit();
    let mut v = draw.unit();
    if u + v > 1.0 {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    let weights = [u, v, 1.0 - u - v];
    weights.map(|weight| 0.0625 + weight * 0.8125)
}

/// A ray at the point of a random well-shaped triangle that has the given weights, from far enough
/// and steep enough that rounding leaves it there.
pub(super) fn aimed<F: Float>(draw: &mut Draw, draw_weights: fn(&mut Draw) -> [f64; 3]) -> Case<F> {
    loop {
        let triangle = well_shaped::<F>(draw);
        let weights = draw_weights(draw).map(F::from_f64);
        let target = combination(triangle, weights);
        let origin = draw.point::<F>();
        let length = F::from_f64(0.25 + 3.75 * draw.unit());
        let direction = std::array::from_fn(|axis| (target[axis] - origin[axis]) * length);
        if is_steep(direction, triangle) {
            return Case::new(origin, direction, triangle);
        }
    }
}

/// A triangle of size about 1 whose normal is not small.
pub(super) fn well_shaped<F: Float>(draw: &mut Draw) -> Corners<F> {
    loop {
        let triangle = [draw.point::<F>(), draw.point(), draw.point()];
        let n = wide_normal(triangle);
        if n.dot(n) > 0.04 {
            return triangle;
        }
    }
}

/// True if a direction is at least 1/4 long and makes a sine of at least 1/8 with the plane.
pub(super) fn is_steep<F: Float>(direction: [F; 3], triangle: Corners<F>) -> bool {
    let d = wide(direction);
    let n = wide_normal(triangle);
    let length_squared = d.dot(d);
    // The sine is the determinant over the lengths of both.
    let determinant = n.dot(d);
    let is_long = length_squared > 0.0625;
    is_long && determinant * determinant > length_squared * n.dot(n) / 64.0
}

/// The point with the given weights, in the scalar's arithmetic.
pub fn combination<F: Float>(triangle: Corners<F>, weights: [F; 3]) -> [F; 3] {
    let [a, b, c] = triangle;
    let [u, v, w] = weights;
    std::array::from_fn(|axis| a[axis] * u + b[axis] * v + c[axis] * w)
}

/// The normal of a triangle in `f64`.
fn wide_normal<F: Float>(triangle: Corners<F>) -> DVec3 {
    let [a, b, c] = triangle.map(wide);
    (b - a).cross(c - a)
}

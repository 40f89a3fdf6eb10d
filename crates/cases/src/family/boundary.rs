//! `edge-exact`, `edge-near`, `vertex-exact`, `vertex-near`: lines at the boundary.

use super::control::{combination, is_steep, well_shaped};
use super::integer::{
    IntegerCase, LatticePoint, normal, shuffle, transversal, triangle_with_edge_point,
};
use super::{CaseGroup, Promise, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use std::cmp::Ordering;

pub(super) struct EdgeExact;
pub(super) struct EdgeNear;
pub(super) struct VertexExact;
pub(super) struct VertexNear;

/// All coordinates of the fine variant are within 2^6, so that in `f32` every triple product is
/// exact; those of the coarse one within 2^12.
fn reach(draw: &mut Draw) -> i64 {
    draw.pick(&[32, 2048])
}

/// A ray through a lattice point of the plane, from a lattice point at integer t.
fn through(
    draw: &mut Draw,
    triangle: [LatticePoint; 3],
    target: LatticePoint,
    reach: i64,
) -> IntegerCase {
    let triangle = shuffle(draw, triangle);
    let direction = transversal(draw, normal(triangle), reach / 8);
    let origin = target - direction * draw.integer(1, 4);
    IntegerCase {
        origin,
        direction,
        triangle,
    }
}

impl Recipe for EdgeExact {
    const NAME: &'static str = "edge-exact";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "transversal, at t > 0, exactly on an open edge";
    const KEEPS: Promise = Promise::Crossings(|crossing| {
        crossing.t_sign == Ordering::Greater && crossing.feature.is_edge()
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let reach = reach(draw);
        let (triangle, point) = triangle_with_edge_point(draw, reach);
        through(draw, triangle, point, reach).made()
    }
}

impl Recipe for VertexExact {
    const NAME: &'static str = "vertex-exact";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "transversal, at t > 0, exactly on a vertex";
    const KEEPS: Promise = Promise::Crossings(|crossing| {
        crossing.t_sign == Ordering::Greater && crossing.feature.is_vertex()
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let reach = reach(draw);
        let (triangle, _) = triangle_with_edge_point(draw, reach);
        let vertex = draw.pick(&triangle);
        through(draw, triangle, vertex, reach).made()
    }
}

impl Recipe for EdgeNear {
    const NAME: &'static str = "edge-near";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "transversal, at t > 0, some ulps about an edge: both truths occur";
    const KEEPS: Promise = Promise::Crossings(|crossing| crossing.t_sign == Ordering::Greater);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        CaseGroup::One(near(draw, |draw| {
            let s = 0.0625 + 0.875 * draw.unit();
            draw.pick(&[[0.0, s, 1.0 - s], [s, 0.0, 1.0 - s], [s, 1.0 - s, 0.0]])
        }))
    }
}

impl Recipe for VertexNear {
    const NAME: &'static str = "vertex-near";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "transversal, at t > 0, some ulps about a vertex: both truths occur";
    const KEEPS: Promise = Promise::Crossings(|crossing| crossing.t_sign == Ordering::Greater);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        CaseGroup::One(near(draw, |draw| {
            draw.pick(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        }))
    }
}

/// Aimed at the float nearest to a point of the boundary, then nudged.
fn near<F: Float>(draw: &mut Draw, weights: impl Fn(&mut Draw) -> [f64; 3]) -> Case<F> {
    loop {
        let triangle = well_shaped::<F>(draw);
        let target = combination(triangle, weights(draw).map(F::from_f64));
        let (origin, direction) = nudged_ray(draw, target);
        if is_steep(direction, triangle) {
            return Case::new(origin, direction, triangle);
        }
    }
}

/// A ray at a point, nudged by -k..k ulps a coordinate.
pub(super) fn nudged_ray<F: Float>(draw: &mut Draw, target: [F; 3]) -> ([F; 3], [F; 3]) {
    let origin = draw.point::<F>();
    let ulps = draw.pick(&[0, 1, 4, 16]);
    (origin, nudged(draw, toward(origin, target), ulps))
}

/// Each coordinate moved by at most so many ulps.
pub(crate) fn nudged<F: Float>(draw: &mut Draw, vector: [F; 3], ulps: i64) -> [F; 3] {
    vector.map(|x| x.offset_ulps(draw.integer(-ulps, ulps)))
}

/// The direction to a rounded point.
pub(crate) fn toward<F: Float>(origin: [F; 3], target: [F; 3]) -> [F; 3] {
    std::array::from_fn(|i| target[i] - origin[i])
}

/// The middle of two points, rounded.
pub(super) fn middle<F: Float>(p: [F; 3], q: [F; 3]) -> [F; 3] {
    let half = F::from_f64(0.5);
    std::array::from_fn(|axis| p[axis] * half + q[axis] * half)
}

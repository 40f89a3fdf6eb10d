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
    corners: [LatticePoint; 3],
    target: LatticePoint,
    reach: i64,
) -> IntegerCase {
    let triangle = shuffle(draw, corners);
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
        CaseGroup::One(near(draw, edge_weights))
    }
}

/// Weights on one of the edges, away from its ends.
fn edge_weights(draw: &mut Draw) -> [f64; 3] {
    let s = 0.0625 + 0.875 * draw.unit();
    let rest = 1.0 - s;
    draw.pick(&[[0.0, s, rest], [s, 0.0, rest], [s, rest, 0.0]])
}

impl Recipe for VertexNear {
    const NAME: &'static str = "vertex-near";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "transversal, at t > 0, some ulps about a vertex: both truths occur";
    const KEEPS: Promise = Promise::Crossings(|crossing| crossing.t_sign == Ordering::Greater);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        CaseGroup::One(near(draw, vertex_weights))
    }
}

/// Weights of one of the vertices.
fn vertex_weights(draw: &mut Draw) -> [f64; 3] {
    draw.pick(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
}

/// A ray that is aimed at the float nearest to a point of the boundary, then nudged.
fn near<F: Float>(draw: &mut Draw, draw_weights: fn(&mut Draw) -> [f64; 3]) -> Case<F> {
    loop {
        let triangle = well_shaped::<F>(draw);
        let weights = draw_weights(draw).map(F::from_f64);
        let target = combination(triangle, weights);
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
    let direction = nudged(draw, toward(origin, target), ulps);
    (origin, direction)
}

/// A vector whose coordinates are moved by at most some ulps each.
pub(crate) fn nudged<F: Float>(draw: &mut Draw, vector: [F; 3], ulps: i64) -> [F; 3] {
    vector.map(|x| x.offset_ulps(draw.integer(-ulps, ulps)))
}

/// The direction to a rounded point.
pub(crate) fn toward<F: Float>(origin: [F; 3], target: [F; 3]) -> [F; 3] {
    std::array::from_fn(|axis| target[axis] - origin[axis])
}

/// The middle of two points, rounded.
pub(super) fn middle<F: Float>(p: [F; 3], q: [F; 3]) -> [F; 3] {
    let half = F::from_f64(0.5);
    std::array::from_fn(|axis| p[axis] * half + q[axis] * half)
}

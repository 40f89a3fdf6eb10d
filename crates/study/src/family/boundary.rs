//! `edge-exact`, `edge-near`, `vertex-exact`, `vertex-near`: lines at the boundary.

use super::control::{combination, is_steep, well_shaped};
use super::integer::{
    IntegerCase, minus, normal, shuffle, times, transversal, triangle_with_edge_point,
};
use super::{Made, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::{Crossing, Place};

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
fn through(draw: &mut Draw, triangle: [[i64; 3]; 3], target: [i64; 3], reach: i64) -> IntegerCase {
    let triangle = shuffle(draw, triangle);
    let direction = transversal(draw, normal(triangle), reach / 8);
    let origin = minus(target, times(direction, draw.integer(1, 4)));
    IntegerCase { origin, direction, triangle }
}

impl Recipe for EdgeExact {
    const NAME: &'static str = "edge-exact";
    const PROMISE: &'static str = "transversal, within, exactly on an open edge";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let reach = reach(draw);
        let (triangle, point) = triangle_with_edge_point(draw, reach);
        through(draw, triangle, point, reach).made()
    }

    fn crosses(crossing: &Crossing) -> bool {
        crossing.place == Place::Within && crossing.feature.is_edge()
    }
}

impl Recipe for VertexExact {
    const NAME: &'static str = "vertex-exact";
    const PROMISE: &'static str = "transversal, within, exactly on a vertex";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let reach = reach(draw);
        let (triangle, _) = triangle_with_edge_point(draw, reach);
        let vertex = draw.pick(&triangle);
        through(draw, triangle, vertex, reach).made()
    }

    fn crosses(crossing: &Crossing) -> bool {
        crossing.place == Place::Within && crossing.feature.is_vertex()
    }
}

impl Recipe for EdgeNear {
    const NAME: &'static str = "edge-near";
    const PROMISE: &'static str = "transversal, within, some ulps about an edge: both truths occur";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        Made::One(near(draw, |draw| {
            let s = 0.0625 + 0.875 * draw.unit();
            draw.pick(&[[0.0, s, 1.0 - s], [s, 0.0, 1.0 - s], [s, 1.0 - s, 0.0]])
        }))
    }

    fn crosses(crossing: &Crossing) -> bool {
        crossing.place == Place::Within
    }
}

impl Recipe for VertexNear {
    const NAME: &'static str = "vertex-near";
    const PROMISE: &'static str =
        "transversal, within, some ulps about a vertex: both truths occur";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        Made::One(near(draw, |draw| {
            draw.pick(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        }))
    }

    fn crosses(crossing: &Crossing) -> bool {
        crossing.place == Place::Within
    }
}

/// Aimed at the float nearest to a point of the boundary, then nudged by -k..k ulps a coordinate.
fn near<F: Float>(draw: &mut Draw, weights: impl Fn(&mut Draw) -> [f64; 3]) -> Case<F> {
    loop {
        let triangle = well_shaped::<F>(draw);
        let target = combination(triangle, weights(draw).map(F::from_f64));
        let origin = draw.point::<F>();
        let ulps = draw.pick(&[0, 1, 4, 16]);
        let direction =
            std::array::from_fn(|i| (target[i] - origin[i]).offset_ulps(draw.integer(-ulps, ulps)));
        if is_steep(direction, triangle) {
            return Case::new(origin, direction, triangle);
        }
    }
}

/// The same ray construction for other families: the direction to a rounded point.
pub(super) fn toward<F: Float>(origin: [F; 3], target: [F; 3]) -> [F; 3] {
    std::array::from_fn(|i| target[i] - origin[i])
}

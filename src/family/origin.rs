//! `origin-on`, `origin-near`, `respawn`: rays that start at the triangle.

use super::boundary::toward;
use super::control::{combination, interior_weights, is_steep, well_shaped};
use super::integer::{IntegerCase, normal, shuffle, transversal, triangle_with_edge_point};
use super::{Grouping, Made, Recipe, apply_to_direction};
use crate::arith::Vector;
use crate::case::{Case, Draw, Parameters};
use crate::kernel::{Scalar, find};
use crate::truth::{Feature, Truth};
use std::cmp::Ordering;

pub(super) struct OriginOn;
pub(super) struct OriginNear;
pub(super) struct Respawn;

impl Recipe for OriginOn {
    const NAME: &'static str = "origin-on";
    const PROMISE: &'static str = "transversal, t = 0, on the face, an edge or a vertex";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let reach = draw.pick(&[64, 4096]);
        let ([a, b, c], edge_point) = triangle_with_edge_point(draw, reach);
        // Twice the triangle has a lattice point inside: the middle of c and the edge point.
        let [a, b, c, edge_point] = [a, b, c, edge_point].map(|p| p.map(|x| 2 * x));
        let middle = std::array::from_fn(|i| (c[i] + edge_point[i]) / 2);
        let triangle = shuffle(draw, [a, b, c]);
        let origin = draw.pick(&[a, b, c, edge_point, edge_point, middle, middle]);
        let direction = transversal(draw, normal(triangle), reach / 8);
        IntegerCase { origin, direction, triangle }.made()
    }

    fn keeps(truths: &[Truth]) -> bool {
        truths.iter().all(|truth| {
            truth.crossing().is_some_and(|crossing| {
                crossing.t_sign == Ordering::Equal && crossing.feature != Feature::Outside
            })
        })
    }
}

impl Recipe for OriginNear {
    const NAME: &'static str = "origin-near";
    const PROMISE: &'static str = "transversal, the origin some ulps before or behind the triangle";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        loop {
            let triangle = well_shaped::<F>(draw);
            let s = draw.unit();
            let weights = match draw.below(4) {
                0 => [1.0, 0.0, 0.0],
                1 => [s, 1.0 - s, 0.0],
                _ => interior_weights(draw),
            };
            let point = combination(shuffle(draw, triangle), weights.map(F::from_f64));
            let ulps = draw.pick(&[0, 1, 2, 16]);
            let origin = point.map(|x| x.offset_ulps(draw.integer(-ulps, ulps)));
            let direction = draw.point();
            if is_steep(direction, triangle) {
                return Made::One(Case::new(origin, direction, triangle));
            }
        }
    }

    fn keeps(truths: &[Truth]) -> bool {
        truths.iter().all(|truth| truth.crossing().is_some())
    }
}

impl Recipe for Respawn {
    const NAME: &'static str = "respawn";
    const PROMISE: &'static str = "transversal, from a kernel's own rounded hit point on this triangle into either half-space";
    const GROUPING: Grouping = Grouping::Respawn;

    /// The first ray: its hit point is where the case's ray starts.
    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        loop {
            let triangle = well_shaped::<F>(draw);
            let target = combination(triangle, interior_weights(draw).map(F::from_f64));
            let origin = draw.point::<F>();
            let direction = toward(origin, target);
            if is_steep(direction, triangle) {
                return Made::One(Case::new(origin, direction, triangle));
            }
        }
    }

    fn finish<F: Scalar>(draw: &mut Draw, parameters: &Parameters, made: &mut Made<F>) {
        let Made::One(case) = made else { return };
        let triangle = case.triangle.vertices().map(Into::into);
        let kernel = find("moller-trumbore").and_then(F::subject);
        let hit = kernel.and_then(|kernel| kernel.gated()?.measure(case).values);
        let (t, (u, v)) =
            hit.and_then(|hit| hit.t.zip(hit.uv)).expect("a kernel that gives t, u, v");
        // The two ways in which renderers form the hit point.
        let point: [F; 3] = if draw.coin() {
            case.ray.origin.plus(&case.ray.direction.times(&t)).into()
        } else {
            combination(triangle, [F::one() - u - v, u, v])
        };
        // Steep for a triangle of any size; at the ends of the range none may be found.
        let mut next = draw.point();
        for _ in 0..64 {
            if is_steep(next, triangle) {
                break;
            }
            next = draw.point();
        }
        *case = Case::new(point, apply_to_direction(parameters, next), triangle);
    }

    fn keeps(truths: &[Truth]) -> bool {
        truths.iter().all(|truth| truth.crossing().is_some())
    }
}

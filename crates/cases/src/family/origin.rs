//! `origin-on`, `origin-near`, `secondary-ray`: rays that start at the triangle.

use super::boundary::{nudged, toward};
use super::control::{combination, interior_weights, is_steep, well_shaped};
use super::integer::{IntegerCase, doubled_triangle, normal, shuffle, transversal};
use super::ring::corners;
use super::scene::{any_direction, hit_point, rounded};
use super::{CaseGroup, Grouping, Promise, Recipe, apply_to_direction};
use crate::case::{Case, Draw, Parameters};
use crate::kernel::{Scalar, find};
use crate::truth::Feature;
use std::cmp::Ordering;

pub(super) struct OriginOn;
pub(super) struct OriginNear;
pub(super) struct SecondaryRay;

/// The kernels at whose hit points secondary rays start: they find t and u, v in different ways.
const FIRST_HIT: [&str; 4] = [
    "moller-trumbore",
    "plane-unit-normal",
    "plucker",
    "woop-watertight",
];

impl Recipe for OriginOn {
    const NAME: &'static str = "origin-on";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "transversal, t = 0, on the face, an edge or a vertex";
    const KEEPS: Promise = Promise::Crossings(|crossing| {
        crossing.t_sign == Ordering::Equal && crossing.feature != Feature::Outside
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let reach = draw.pick(&[64, 4096]);
        let ([a, b, c], edge_point) = doubled_triangle(draw, reach);
        let middle = (c + edge_point) / 2;
        let triangle = shuffle(draw, [a, b, c]);
        let origin = draw.pick(&[a, b, c, edge_point, edge_point, middle, middle]);
        let direction = transversal(draw, normal(triangle), reach / 8);
        IntegerCase {
            origin,
            direction,
            triangle,
        }
        .made()
    }
}

impl Recipe for OriginNear {
    const NAME: &'static str = "origin-near";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "transversal, the origin some ulps before or behind the triangle";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        loop {
            let triangle = well_shaped::<F>(draw);
            let s = draw.unit();
            let weights = match draw.below(4) {
                0 => [1.0, 0.0, 0.0],
                1 => [s, 1.0 - s, 0.0],
                _ => interior_weights(draw),
            };
            let corners = shuffle(draw, triangle);
            let point = combination(corners, weights.map(F::from_f64));
            let ulps = draw.pick(&[0, 1, 2, 16]);
            let origin = nudged(draw, point, ulps);
            let direction = draw.point();
            if is_steep(direction, triangle) {
                return CaseGroup::One(Case::new(origin, direction, triangle));
            }
        }
    }
}

impl Recipe for SecondaryRay {
    const NAME: &'static str = "secondary-ray";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "transversal, from a kernel's own rounded hit point on this triangle, in every direction";
    const GROUPING: Grouping = Grouping::SecondaryRay;

    /// Makes the first ray: its hit point is where the case's ray starts.
    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let triangle = well_shaped::<F>(draw);
        let weights = interior_weights(draw).map(F::from_f64);
        let target = combination(triangle, weights);
        let origin = draw.point::<F>();
        CaseGroup::One(Case::new(origin, toward(origin, target), triangle))
    }

    fn finish<F: Scalar>(draw: &mut Draw, parameters: &Parameters, made: &mut CaseGroup<F>) {
        let CaseGroup::One(case) = made else { return };
        let triangle = corners(case);
        let first_kernel = find(draw.pick(&FIRST_HIT));
        let reported = first_kernel.and_then(|kernel| hit_point(draw, case, kernel));
        // A kernel that misses leaves the middle of the triangle.
        let third = F::from_f64(1.0 / 3.0);
        let origin = reported.unwrap_or_else(|| combination(triangle, [third; 3]));
        let direction = apply_to_direction(parameters, rounded(any_direction(draw)));
        *case = Case::new(origin, direction, triangle);
    }
}

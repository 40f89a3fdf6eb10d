//! `tiny`, `huge`, `far`: triangles of 2^-40 and of 2^40, and small triangles far from the origin.

use super::boundary::toward;
use super::control::{aimed, interior_weights, is_steep};
use super::integer::{
    LatticePoint, doubled_triangle, float, lattice_point, normal, shuffle, transversal,
};
use super::{CaseGroup, Recipe, apply};
use crate::arith::Float;
use crate::case::{Case, Draw, Parameters};
use crate::kernel::Scalar;

pub(super) struct Tiny;
pub(super) struct Huge;
pub(super) struct Far;

/// A case of a scale, at the interior, at the boundary or outside; the direction is scaled in half of the cases.
fn scaled<F: Float>(draw: &mut Draw, scale: i32) -> CaseGroup<F> {
    let mut case = aimed::<F>(draw, any_weights);
    let parameters = Parameters {
        scale,
        scale_direction: draw.coin(),
        ..Parameters::default()
    };
    apply(&parameters, &mut case);
    CaseGroup::One(case)
}

/// Weights of a point inside a triangle, on an edge or outside.
fn any_weights(draw: &mut Draw) -> [f64; 3] {
    let s = draw.unit();
    let weights = match draw.below(4) {
        0 => [s, 1.0 - s, 0.0],
        1 => [-s, 1.0, s],
        _ => interior_weights(draw),
    };
    shuffle(draw, weights)
}

impl Recipe for Tiny {
    const NAME: &'static str = "tiny";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "transversal, triangles of size 2^-40";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        scaled(draw, -40)
    }
}

impl Recipe for Huge {
    const NAME: &'static str = "huge";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "transversal, triangles of size 2^40";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        scaled(draw, 40)
    }
}

impl Recipe for Far {
    const NAME: &'static str = "far";
    const VERSION: u32 = 3;
    const PROMISE: &'static str =
        "transversal, triangles some hundred ulps wide, far from the origin";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        // All on the integer grid of a large offset, which is exact below 2^DIGITS.
        let (corners, edge_point) = doubled_triangle(draw, 64);
        let [.., c] = corners;
        let middle = (c + edge_point) / 2;
        let target = draw.pick(&[middle, edge_point, c, c + LatticePoint::X]);
        let corners = shuffle(draw, corners);
        let exponent = draw.integer(10, i64::from(F::DIGITS) - 2);
        let base = lattice_point(draw, 1 << exponent);
        let direction = transversal(draw, normal(corners), 32);
        let origin = target - direction * draw.integer(1, 8);
        let triangle = corners.map(|corner| float(corner + base));
        // Half of the rays come from the far side of the coordinate system.
        if draw.coin() {
            let opposite = float(base).map(|x: F| -x);
            let way = toward(opposite, float(target + base));
            if is_steep(way, triangle) {
                return CaseGroup::One(Case::new(opposite, way, triangle));
            }
        }
        CaseGroup::One(Case::new(float(origin + base), float(direction), triangle))
    }
}

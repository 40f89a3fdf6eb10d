//! `tiny`, `huge`, `far`: triangles of 2^-40 and of 2^40, and small triangles far from the origin.

use super::boundary::toward;
use super::control::{aimed, interior_weights, is_steep};
use super::integer::{
    LatticePoint, float, lattice_point, normal, shuffle, transversal, triangle_with_edge_point,
};
use super::{CaseGroup, Recipe, apply};
use crate::arith::Float;
use crate::case::{Case, Draw, Parameters};
use crate::kernel::Scalar;

pub(super) struct Tiny;
pub(super) struct Huge;
pub(super) struct Far;

/// Interior, boundary and outside, scaled; the direction is scaled in half of the cases.
fn scaled<F: Float>(draw: &mut Draw, scale: i32) -> CaseGroup<F> {
    let mut case = aimed::<F>(draw, &mut |draw| {
        let s = draw.unit();
        let weights = match draw.below(4) {
            0 => [s, 1.0 - s, 0.0],
            1 => [-s, 1.0, s],
            _ => interior_weights(draw),
        };
        shuffle(draw, weights)
    });
    let parameters = Parameters {
        scale,
        scale_direction: draw.coin(),
        ..Parameters::default()
    };
    apply(&parameters, &mut case);
    CaseGroup::One(case)
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
        let ([a, b, c], edge_point) = triangle_with_edge_point(draw, 64);
        let [a, b, c, edge_point] = [a, b, c, edge_point].map(|p| p * 2);
        let middle = (c + edge_point) / 2;
        let target = draw.pick(&[middle, edge_point, c, c + LatticePoint::X]);
        let [a, b, c] = shuffle(draw, [a, b, c]);
        let exponent = draw.integer(10, i64::from(F::DIGITS) - 2);
        let base = lattice_point(draw, 1 << exponent);
        let direction = transversal(draw, normal([a, b, c]), 32);
        let origin = target - direction * draw.integer(1, 8);
        let [a, b, c, goal] = [a, b, c, target].map(|p| float(p + base));
        // Half of the rays come from the far side of the coordinate system.
        if draw.coin() {
            let start = float(base).map(|x: F| -x);
            let direction = toward(start, goal);
            if is_steep(direction, [a, b, c]) {
                return CaseGroup::One(Case::new(start, direction, [a, b, c]));
            }
        }
        CaseGroup::One(Case::new(float(origin + base), float(direction), [a, b, c]))
    }
}

//! `direction-length`, `axis-aligned`: the same line with other directions, and zeros in them.

use super::control::{aimed, interior_weights};
use super::integer::{IntegerCase, LatticePoint, normal, shuffle, triangle_with_edge_point};
use super::{CaseGroup, Recipe};
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Draw};
use crate::kernel::Scalar;

pub(super) struct DirectionLengthFamily;
pub(super) struct AxisAligned;

impl Recipe for DirectionLengthFamily {
    const NAME: &'static str = "direction-length";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "transversal, the direction scaled by 2^-60 to 2^60";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let case = aimed::<F>(draw, |draw| {
            let s = draw.unit();
            if draw.coin() {
                shuffle(draw, [s, 1.0 - s, 0.0])
            } else {
                interior_weights(draw)
            }
        });
        let exponent = draw.integer(-60, 60) as i32;
        let [origin, direction, a, b, c] = case.vectors();
        let scale = |x: F| F::from_f64(scale_by_power_of_two(x.to_f64(), exponent));
        CaseGroup::One(Case::new(origin, direction.map(scale), [a, b, c]))
    }
}

impl Recipe for AxisAligned {
    const NAME: &'static str = "axis-aligned";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "transversal, along an axis, zeros and negative zeros throughout";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let (triangle, edge_point) = loop {
            let (triangle, point) = triangle_with_edge_point(draw, 64);
            if normal(triangle) != LatticePoint::ZERO {
                break (shuffle(draw, triangle), point);
            }
        };
        let n = normal(triangle);
        let axis = loop {
            let axis = draw.below(3);
            if n[axis] != 0 {
                break axis;
            }
        };
        let mut direction = LatticePoint::ZERO;
        direction[axis] = draw.pick(&[-2, -1, 1, 2]);
        let (vertex, other) = (draw.pick(&triangle), draw.pick(&triangle));
        let target = draw.pick(&[vertex, other, edge_point, edge_point + LatticePoint::Y]);
        let origin = target - direction * draw.integer(1, 4);
        // Half of the cases have a vertex at the coordinate origin: zeros in the triangle.
        let base = if draw.coin() {
            draw.pick(&triangle)
        } else {
            LatticePoint::ZERO
        };
        let case = IntegerCase {
            origin: origin - base,
            direction,
            triangle: triangle.map(|p| p - base),
        };
        CaseGroup::One(with_signed_zeros(draw, case.case()))
    }
}

/// Gives each zero coordinate a random sign.
fn with_signed_zeros<F: Float>(draw: &mut Draw, case: Case<F>) -> Case<F> {
    let [origin, direction, a, b, c] = case.vectors().map(|v| {
        v.map(|x| {
            if x.is_zero() && draw.coin() {
                -F::zero()
            } else {
                x
            }
        })
    });
    Case::new(origin, direction, [a, b, c])
}

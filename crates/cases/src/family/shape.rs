//! `sliver`, `degenerate`: needles and caps, and triangles without area.

use super::control::is_steep;
use super::flat::{axes, placed};
use super::integer::{
    IntegerCase, LatticePoint, independent, lattice_point, normal, shuffle, transversal,
};
use super::scene::{RayAxes, any_direction, either_sign, rounded, wide};
use super::{CaseGroup, Promise, Recipe};
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::Truth;

pub(super) struct Sliver;
pub(super) struct Degenerate;

/// The thinnest slivers are 2^-40 thick.
const FINEST: i64 = 40;

impl Recipe for Sliver {
    const NAME: &'static str = "sliver";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "transversal, needles and caps of aspect 2^4 to 2^40, on generic planes in half of the cases";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        match draw.below(4) {
            0 => CaseGroup::One(level(draw)),
            1 => tilted(draw).made(),
            _ => CaseGroup::One(generic(draw)),
        }
    }
}

/// A sliver in the coordinates of its plane, and a point to aim at.
struct Outline {
    corners: [[f64; 2]; 3],
    target: [f64; 2],
}

impl Outline {
    /// An outline about 2^-k thick, with k up to `finest`.
    fn draw(draw: &mut Draw, finest: i64) -> Outline {
        let k = draw.integer(4, finest) as i32;
        let thickness = scale_by_power_of_two(1.0 + draw.unit(), -k);
        let long = 0.5 + 0.5 * draw.unit();
        // A needle's third vertex is near an end, a cap's near the middle.
        let third = if draw.coin() {
            thickness * draw.unit()
        } else {
            long * (0.25 + 0.5 * draw.unit())
        };
        let corners = shuffle(draw, [[0.0, 0.0], [long, 0.0], [third, thickness]]);
        let across = thickness * draw.pick(&[0.0, 0.25, 0.5, 1.0, -0.25]);
        Outline {
            corners,
            target: [draw.unit() * long, across],
        }
    }
}

/// A sliver on a generic plane, so thick that rounded vertices still have an area.
fn generic<F: Float>(draw: &mut Draw) -> Case<F> {
    let finest = FINEST.min(i64::from(F::DIGITS) - 4);
    loop {
        let frame = RayAxes::draw(draw);
        let base = wide(draw.point::<F>());
        let Outline { corners, target } = Outline::draw(draw, finest);
        let triangle = corners.map(|[x, y]| rounded(base + frame.flat(x, y)));
        let [along, across] = target;
        let goal = base + frame.flat(along, across);
        let way = any_direction(draw);
        let distance = 0.25 + draw.unit();
        let origin: [F; 3] = rounded(goal - way * distance);
        let direction = rounded(goal - wide(origin));
        if is_steep(direction, triangle) {
            return Case::new(origin, direction, triangle);
        }
    }
}

/// A sliver in the plane of two axes, where the thin side has its own exponent.
fn level<F: Float>(draw: &mut Draw) -> Case<F> {
    let axes = axes(draw);
    let Outline { corners, target } = Outline::draw(draw, FINEST);
    let triangle = corners.map(|corner| {
        let [x, y] = corner.map(F::from_f64);
        placed(axes, x, y, F::zero())
    });
    let [along, across] = target.map(F::from_f64);
    let dx: F = draw.symmetric();
    let dy: F = draw.symmetric();
    let steep = F::from_f64(0.25 + 0.75 * draw.unit());
    let rise = either_sign(draw, steep);
    let origin = placed(axes, along - dx, across - dy, -rise);
    let direction = placed(axes, dx, dy, rise);
    Case::new(origin, direction, triangle)
}

/// A tilted sliver in integers: a long edge of 2^m steps, and a third vertex one small step beside it.
fn tilted(draw: &mut Draw) -> IntegerCase {
    let a = lattice_point(draw, 8);
    let step = independent(draw, LatticePoint::Z, 4);
    let aside = independent(draw, step, 4);
    let m = draw.integer(4, 16);
    let long = 1 << m;
    let is_needle = draw.coin();
    let along = if is_needle { 0 } else { long / 2 };
    let b = a + step * long;
    let c = a + step * along + aside;
    let triangle = shuffle(draw, [a, b, c]);
    let mut target = a + step * draw.integer(0, long);
    let is_on_the_edge = draw.coin();
    if !is_on_the_edge {
        target += aside;
    }
    let direction = transversal(draw, normal(triangle), 8);
    IntegerCase {
        origin: target - direction * draw.integer(1, 4),
        direction,
        triangle,
    }
}

impl Recipe for Degenerate {
    const NAME: &'static str = "degenerate";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "the triangle is a segment or a point";
    const KEEPS: Promise = Promise::Truths(|truth| matches!(truth, Truth::Degenerate(_)));

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let a = lattice_point(draw, 16);
        let step = lattice_point(draw, 4);
        let [b, c, target] = [(); 3].map(|()| a + step * draw.integer(-3, 3));
        let corners = draw.pick(&[[a, a, a], [a, a, b], [a, b, c]]);
        let triangle = shuffle(draw, corners);
        let has_own_direction = step != LatticePoint::ZERO;
        let direction = if has_own_direction && draw.below(3) == 0 {
            step
        } else {
            let avoided = if has_own_direction {
                step
            } else {
                LatticePoint::Z
            };
            independent(draw, avoided, 4)
        };
        let origin = target - direction * draw.integer(-1, 3);
        IntegerCase {
            origin,
            direction,
            triangle,
        }
        .made()
    }
}

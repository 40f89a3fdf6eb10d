//! `sliver`, `degenerate`: needles and caps, and triangles without area.

use super::control::is_steep;
use super::flat::placed;
use super::integer::{
    IntegerCase, LatticePoint, independent, lattice_point, normal, shuffle, transversal,
};
use super::scene::{RayAxes, any_direction, rounded, wide};
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
    /// About 2^-k thick, k up to `finest`.
    fn draw(draw: &mut Draw, finest: i64) -> Outline {
        let power = -(draw.integer(4, finest) as i32);
        let thickness = scale_by_power_of_two(1.0 + draw.unit(), power);
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

/// On a generic plane, so thick that rounded vertices still have an area.
fn generic<F: Float>(draw: &mut Draw) -> Case<F> {
    let finest = FINEST.min(i64::from(F::DIGITS) - 4);
    loop {
        let (frame, corner) = (RayAxes::draw(draw), wide(draw.point::<F>()));
        let Outline { corners, target } = Outline::draw(draw, finest);
        let point = |[x, y]: [f64; 2]| corner + frame.flat(x, y);
        let triangle = corners.map(|corner| rounded(point(corner)));
        let origin: [F; 3] = rounded(point(target) - any_direction(draw) * (0.25 + draw.unit()));
        let direction = rounded(point(target) - wide(origin));
        if is_steep(direction, triangle) {
            return Case::new(origin, direction, triangle);
        }
    }
}

/// In the plane of two axes, where the thin side has its own exponent.
fn level<F: Float>(draw: &mut Draw) -> Case<F> {
    let axes = draw.pick(&[[0, 1, 2], [1, 2, 0], [2, 0, 1]]);
    let Outline {
        corners,
        target: [along, across],
    } = Outline::draw(draw, FINEST);
    let float = |x: f64| F::from_f64(x);
    let triangle = corners.map(|[x, y]| placed(axes, float(x), float(y), F::zero()));
    let [dx, dy] = [draw.symmetric::<F>(), draw.symmetric()];
    let fall = float(0.25 + 0.75 * draw.unit());
    let fall = if draw.coin() { fall } else { -fall };
    let origin = placed(axes, float(along) - dx, float(across) - dy, -fall);
    Case::new(origin, placed(axes, dx, dy, fall), triangle)
}

/// Tilted, in integers: a long edge of 2^m steps, and a third vertex one small step beside it.
fn tilted(draw: &mut Draw) -> IntegerCase {
    let (a, step) = (
        lattice_point(draw, 8),
        independent(draw, LatticePoint::Z, 4),
    );
    let aside = independent(draw, step, 4);
    let m = draw.integer(4, 16);
    let along = if draw.coin() { 0 } else { 1 << (m - 1) };
    let [b, c] = [a + step * (1 << m), a + step * along + aside];
    let triangle = shuffle(draw, [a, b, c]);
    let target = a + step * draw.integer(0, 1 << m);
    let target = if draw.coin() { target } else { target + aside };
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
        let at = |k: i64| -> LatticePoint { a + step * k };
        let [i, j, k] = [-3, -3, -3].map(|low| draw.integer(low, 3));
        let triangle = draw.pick(&[[a, a, a], [a, a, at(i)], [a, at(i), at(j)]]);
        let triangle = shuffle(draw, triangle);
        let target = at(k);
        let direction = if step != LatticePoint::ZERO && draw.below(3) == 0 {
            step
        } else {
            // Any direction but the segment's own.
            let other = if step == LatticePoint::ZERO {
                LatticePoint::Z
            } else {
                step
            };
            independent(draw, other, 4)
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

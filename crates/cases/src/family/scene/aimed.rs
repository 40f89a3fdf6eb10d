//! Rays at a point inside a triangle, at one beside it, at one of an edge and at a vertex.

use super::super::CaseGroup;
use super::Setup;
use super::draw::{RayAxes, any_direction, beside, either_sign, inside, point_of, ray, wide};
use super::planes::{AXES, turn};
use super::triangles::{Corners, Pair, Ring};
use crate::arith::Float;
use crate::case::{Case, Draw, Scene, Toward};
use glam::DVec3;

/// A sine of the angle to a triangle below which rays along axes are drawn again: they would be parallel to floors.
const LEAST_SINE: f64 = 0.0625;

/// How often such rays are drawn: a triangle may lie at no other angle.
const AIMS: usize = 64;

/// Where a ray at a triangle goes in a scene: a unit vector, uniform over all that the scene has.
pub fn aim<F: Float>(draw: &mut Draw, scene: &Scene, triangle: Corners<F>) -> DVec3 {
    if scene.toward == Toward::Any {
        return any_direction(draw);
    }
    let normal = RayAxes::of(triangle).map_or(DVec3::ZERO, |frame| frame.normal);
    let mut toward = DVec3::ZERO;
    for _ in 0..AIMS {
        let [i, j, _] = draw.pick(&AXES);
        let [x, y] = match scene.toward {
            Toward::Axis => [either_sign(draw, 1.0), 0.0],
            _ => turn(draw),
        };
        toward = DVec3::ZERO;
        toward[i] = x;
        toward[j] = y;
        if LEAST_SINE < normal.dot(toward).abs() {
            break;
        }
    }
    toward
}

pub fn interior_case<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Case<F> {
    aimed(setup, draw, inside)
}

pub fn interior<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    CaseGroup::One(aimed(setup, draw, inside))
}

pub fn outside<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    CaseGroup::One(aimed(setup, draw, beside))
}

/// A ray at the point of a triangle that has certain weights.
fn aimed<F: Float>(
    setup: &Setup<'_, F>,
    draw: &mut Draw,
    weights: fn(&mut Draw) -> [f64; 2],
) -> Case<F> {
    let (triangle, _) = setup.triangles.triangle(draw);
    let target = point_of(triangle, weights(draw));
    let toward = aim(draw, setup.scene, triangle);
    let (origin, direction) = ray(draw, setup.scene, target, toward);
    Case::new(origin, direction, triangle)
}

pub fn edges<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let Pair {
        ends: [p, q],
        triangles,
    } = setup.triangles.pair(draw);
    // Away from the ends, where rounding moves the ray off the rim of both.
    let along = 0.0625 + 0.875 * draw.unit();
    let target = wide(p) + (wide(q) - wide(p)) * along;
    group_at(setup, draw, target, &triangles)
}

pub fn vertices<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let Ring { center, triangles } = setup.triangles.fan(draw);
    group_at(setup, draw, wide(center), &triangles)
}

/// One ray at a point that several triangles share, with each of them.
fn group_at<F: Float>(
    setup: &Setup<'_, F>,
    draw: &mut Draw,
    target: DVec3,
    triangles: &[Corners<F>],
) -> CaseGroup<F> {
    let toward = aim(draw, setup.scene, triangles[0]);
    let (origin, direction) = ray(draw, setup.scene, target, toward);
    let mut cases = Vec::with_capacity(triangles.len());
    for triangle in triangles {
        cases.push(Case::new(origin, direction, *triangle));
    }
    CaseGroup::Group(cases)
}

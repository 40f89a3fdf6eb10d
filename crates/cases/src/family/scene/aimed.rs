//! Rays at a point inside a triangle, beside it, of an edge and at a vertex.

use super::super::CaseGroup;
use super::Setup;
use super::draw::{RayAxes, any_direction, beside, inside, point_of, ray, wide};
use super::planes::{AXES, turn};
use super::triangles::{Pair, Ring};
use crate::arith::Float;
use crate::case::{Case, Draw, Scene, Toward};
use glam::DVec3;

/// A sine of the angle to a triangle below which rays along axes are drawn again: they would be parallel to floors.
const LEAST_SINE: f64 = 0.0625;

/// How often such rays are drawn: a triangle may lie at no other angle.
const AIMS: usize = 64;

/// Where a ray at a triangle goes in a scene: a unit vector, uniform over all that the scene has.
pub fn aim<F: Float>(draw: &mut Draw, scene: &Scene, triangle: [[F; 3]; 3]) -> DVec3 {
    if scene.toward == Toward::Any {
        return any_direction(draw);
    }
    let normal = RayAxes::of(triangle).map_or(DVec3::ZERO, |frame| frame.normal);
    let mut toward = DVec3::ZERO;
    for _ in 0..AIMS {
        let [i, j, _] = draw.pick(&AXES);
        toward = DVec3::ZERO;
        (toward[i], toward[j]) = match scene.toward {
            Toward::Axis => (if draw.coin() { 1.0 } else { -1.0 }, 0.0),
            _ => turn(draw).into(),
        };
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
    let (target, toward) = (
        point_of(triangle, weights(draw)),
        aim(draw, setup.scene, triangle),
    );
    let (start, direction) = ray(draw, setup.scene, target, toward);
    Case::new(start, direction, triangle)
}

pub fn edges<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let Pair {
        ends: [p, q],
        triangles,
    } = setup.triangles.pair(draw);
    // Away from the ends, where rounding moves the ray off the rim of both.
    let along = 0.0625 + 0.875 * draw.unit();
    let target = wide(p) + (wide(q) - wide(p)) * along;
    let toward = aim(draw, setup.scene, triangles[0]);
    let (start, direction) = ray(draw, setup.scene, target, toward);
    CaseGroup::Group(
        triangles
            .map(|triangle| Case::new(start, direction, triangle))
            .into(),
    )
}

pub fn vertices<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let Ring { center, triangles } = setup.triangles.fan(draw);
    let toward = aim(draw, setup.scene, triangles[0]);
    let (start, direction) = ray(draw, setup.scene, wide(center), toward);
    CaseGroup::Group(
        triangles
            .into_iter()
            .map(|triangle| Case::new(start, direction, triangle))
            .collect(),
    )
}

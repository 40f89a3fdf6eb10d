//! Rays at a point inside a triangle, beside it, of an edge and at a vertex.

use super::super::Made;
use super::Setup;
use super::draw::{any_direction, beside, inside, point_of, ray, wide};
use super::triangles::{Pair, Ring};
use crate::arith::Float;
use crate::case::{Case, Draw};

pub fn interior_case<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Case<F> {
    let (triangle, _) = setup.triangles.triangle(draw);
    let (target, toward) = (point_of(triangle, inside(draw)), any_direction(draw));
    let (start, direction) = ray(draw, setup.scene, target, toward);
    Case::new(start, direction, triangle)
}

pub fn interior<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    Made::One(interior_case(setup, draw))
}

pub fn outside<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let (triangle, _) = setup.triangles.triangle(draw);
    let (target, toward) = (point_of(triangle, beside(draw)), any_direction(draw));
    let (start, direction) = ray(draw, setup.scene, target, toward);
    Made::One(Case::new(start, direction, triangle))
}

pub fn edges<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let Pair { ends: [p, q], triangles } = setup.triangles.pair(draw);
    // Away from the ends, where rounding moves the ray off the rim of both.
    let along = 0.0625 + 0.875 * draw.unit();
    let target = wide(p) + (wide(q) - wide(p)) * along;
    let toward = any_direction(draw);
    let (start, direction) = ray(draw, setup.scene, target, toward);
    Made::Group(triangles.map(|triangle| Case::new(start, direction, triangle)).into())
}

pub fn vertices<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let Ring { center, triangles } = setup.triangles.fan(draw);
    let toward = any_direction(draw);
    let (start, direction) = ray(draw, setup.scene, wide(center), toward);
    Made::Group(
        triangles.into_iter().map(|triangle| Case::new(start, direction, triangle)).collect(),
    )
}

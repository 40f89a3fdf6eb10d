//! Rays at a point inside a triangle, beside it, of an edge and at a vertex.

use super::super::Made;
use super::Setup;
use super::draw::{any_direction, beside, inside, point_of, ray, wide};
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
    let [p, q, first, second] = setup.triangles.pair(draw);
    // Away from the ends, where rounding moves the ray off the rim of both.
    let along = 0.0625 + 0.875 * draw.unit();
    let target = wide(p) + (wide(q) - wide(p)) * along;
    let toward = any_direction(draw);
    let (start, direction) = ray(draw, setup.scene, target, toward);
    let turned = |[a, b, c]: [[F; 3]; 3], turn: usize| [[a, b, c], [b, c, a], [c, a, b]][turn];
    let case = |triangle| Case::new(start, direction, triangle);
    let turns = [draw.below(3), draw.below(3)];
    Made::Group(vec![case(turned([p, q, first], turns[0])), case(turned([q, p, second], turns[1]))])
}

pub fn vertices<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let fan = setup.triangles.fan(draw);
    let toward = any_direction(draw);
    let (start, direction) = ray(draw, setup.scene, wide(fan[0][0]), toward);
    Made::Group(fan.into_iter().map(|triangle| Case::new(start, direction, triangle)).collect())
}

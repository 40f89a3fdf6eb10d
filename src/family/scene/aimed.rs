//! Rays at a point inside a triangle, beside it, of an edge and at a vertex.

use super::super::Made;
use super::draw::{
    Frame, any_direction, apex, beside, between_powers, inside, place, point_of, ray, rounded,
    symmetric, triangle, wide, with_scene,
};
use crate::arith::Float;
use crate::case::{Case, Draw, Parameters, Scene};
use crate::kernel::Scalar;

pub fn interior_case<F: Float>(draw: &mut Draw, scene: &Scene) -> Case<F> {
    let (triangle, _) = triangle(draw, scene);
    let (target, toward) = (point_of(triangle, inside(draw)), any_direction(draw));
    let (start, direction) = ray(draw, scene, target, toward);
    Case::new(start, direction, triangle)
}

pub fn interior<F: Scalar>(parameters: &Parameters, draw: &mut Draw, _: u64) -> Made<F> {
    Made::One(with_scene(parameters, |scene| interior_case(draw, scene)))
}

pub fn outside<F: Scalar>(parameters: &Parameters, draw: &mut Draw, _: u64) -> Made<F> {
    with_scene(parameters, |scene| {
        let (triangle, _) = triangle(draw, scene);
        let (target, toward) = (point_of(triangle, beside(draw)), any_direction(draw));
        let (start, direction) = ray(draw, scene, target, toward);
        Made::One(Case::new(start, direction, triangle))
    })
}

pub fn edges<F: Scalar>(parameters: &Parameters, draw: &mut Draw, _: u64) -> Made<F> {
    with_scene(parameters, |scene| {
        let size = between_powers(draw, scene.edge);
        let (p, frame) = (place(draw, scene, size), Frame::draw(draw));
        let q = p + frame.flat(size, 0.0);
        let (x, y) = apex(draw, size);
        let first = p + frame.flat(x, y);
        // The second triangle is bent out of the plane of the first by up to 27 degrees.
        let (x, y) = apex(draw, size);
        let bend = 0.5 * symmetric(draw);
        let down = (frame.normal * bend - frame.across) / (1.0 + bend * bend).sqrt();
        let second = p + frame.along * x + down * y;
        let [p, q, first, second] = [p, q, first, second].map(rounded::<F>);
        // Away from the ends, where rounding moves the ray off the rim of both.
        let along = 0.0625 + 0.875 * draw.unit();
        let target = wide(p) + (wide(q) - wide(p)) * along;
        let toward = any_direction(draw);
        let (start, direction) = ray(draw, scene, target, toward);
        let turned = |[a, b, c]: [[F; 3]; 3], turn: usize| [[a, b, c], [b, c, a], [c, a, b]][turn];
        let case = |triangle| Case::new(start, direction, triangle);
        let turns = [draw.below(3), draw.below(3)];
        Made::Group(vec![
            case(turned([p, q, first], turns[0])),
            case(turned([q, p, second], turns[1])),
        ])
    })
}

/// The corners of a hexagon: cosines and sines of multiples of 60 degrees.
const HEXAGON: [[f64; 2]; 6] = {
    const SINE: f64 = 0.866_025_403_784_438_6;
    [[1.0, 0.0], [0.5, SINE], [-0.5, SINE], [-1.0, 0.0], [-0.5, -SINE], [0.5, -SINE]]
};

pub fn vertices<F: Scalar>(parameters: &Parameters, draw: &mut Draw, _: u64) -> Made<F> {
    with_scene(parameters, |scene| {
        let size = between_powers(draw, scene.edge);
        let (center, frame) = (place(draw, scene, size), Frame::draw(draw));
        let ring = HEXAGON.map(|[x, y]| {
            let (spoke, height) = (0.5 + 0.5 * draw.unit(), 0.2 * symmetric(draw));
            let corner = frame.flat(x * spoke, y * spoke) + frame.normal * height;
            rounded::<F>(center + corner * (size / 1.1))
        });
        let center = rounded::<F>(center);
        let toward = any_direction(draw);
        let (start, direction) = ray(draw, scene, wide(center), toward);
        let case =
            |i: usize| Case::new(start, direction, [center, ring[i], ring[(i + 1) % ring.len()]]);
        Made::Group((0..ring.len()).map(case).collect())
    })
}

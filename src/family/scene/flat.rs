//! Rays almost and exactly parallel to the plane of a triangle.

use super::super::{Made, integer, unit};
use super::draw::*;
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, DirectionLength, Draw, Parameters, Scene};
use crate::kernel::Scalar;
use glam::DVec3;

pub fn grazing<F: Scalar>(parameters: &Parameters, draw: &mut Draw, _: u64) -> Made<F> {
    with_scene(parameters, |scene| Made::One(grazing_case(draw, scene)))
}

/// A ray that grazes a triangle on a generic plane.
pub fn grazing_case<F: Float>(draw: &mut Draw, scene: &Scene) -> Case<F> {
    let (triangle, frame) = triangle(draw, scene);
    let weights = if draw.coin() { inside(draw) } else { beside(draw) };
    let target = point_of(triangle, weights);
    let sine = grazing_sine::<F>(draw);
    let flat = in_plane(draw, &frame);
    let toward = flat * (1.0 - sine * sine).sqrt() + frame.normal * sine;
    let (start, direction) = ray(draw, scene, target, toward);
    Case::new(start, direction, triangle)
}

/// The sine of the angle to a plane, of either sign: from 1/8 down to an eighth of an ulp of 1, each
/// halving equally likely. On a generic plane the rounded direction has another: near the lower end
/// rounding decides it.
pub fn grazing_sine<F: Float>(draw: &mut Draw) -> f64 {
    let power = -(draw.integer(4, i64::from(F::DIGITS) + 2) as i32);
    let sine = scale_by_power_of_two(1.0 + draw.unit(), power);
    if draw.coin() { sine } else { -sine }
}

/// Unit vectors exactly in a generic plane do not exist among floats. What does: rays along an axis in a
/// plane that holds the axis, rays in planes of constant height, and, if directions may have any length,
/// sums of edges on a grid.
pub fn parallel<F: Scalar>(parameters: &Parameters, draw: &mut Draw, _: u64) -> Made<F> {
    with_scene(parameters, |scene| {
        let size = between_powers(draw, scene.edge);
        let axes = draw.pick(&[[0, 1, 2], [1, 2, 0], [2, 0, 1]]);
        let (triangle, flat) = match (scene.direction, draw.below(3)) {
            (DirectionLength::Target, 0) => on_grid::<F>(draw, scene, size),
            (_, 0 | 1) => holding_axis(draw, scene, size, axes),
            _ => level(draw, scene, size, axes),
        };
        let length = wide(flat).dot(wide(flat)).sqrt();
        let ahead = wide(flat) / length;
        let off = match draw.below(4) {
            0 => DVec3::ZERO,
            _ => any_direction(draw) * between_powers(draw, [size / 65536.0, size]),
        };
        let target = point_of(triangle, inside(draw)) + off;
        let start = target - ahead * between(draw, scene.distance);
        let mut start: [F; 3] = rounded(start);
        if off == DVec3::ZERO {
            // Where the ray does not move, it starts as the plane's first vertex does, and so in the plane.
            let still = axes.into_iter().filter(|&axis| flat[axis].is_zero());
            still.for_each(|axis| start[axis] = triangle[0][axis]);
        }
        Made::One(Case::new(start, flat, triangle))
    })
}

/// The spacing of floats near the extent, on whose multiples small sums are exact.
fn grid<F: Float>(scene: &Scene) -> f64 {
    F::from_f64(scene.extent).ulp().to_f64()
}

/// The multiple of a spacing next to a number.
fn snapped(x: f64, spacing: f64) -> f64 {
    // Within 2^52 multiples, as all coordinates are, adding and taking away rounds to whole numbers.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    ((x / spacing + ROUND) - ROUND) * spacing
}

/// A triangle on the grid of a generic plane, and a sum of its edges.
fn on_grid<F: Float>(draw: &mut Draw, scene: &Scene, size: f64) -> ([[F; 3]; 3], [F; 3]) {
    // Coarser than a float's own grid, so that sums of three edges are floats too.
    let spacing = 8.0 * grid::<F>(scene);
    let size = size.max(4.0 * spacing);
    loop {
        let (a, frame) = (place(draw, scene, size), Frame::draw(draw));
        let (x, y) = apex(draw, size);
        let corners = [a, a + frame.flat(size, 0.0), a + frame.flat(x, y)];
        let [a, b, c] = corners.map(|p| DVec3::from(p.to_array().map(|x| snapped(x, spacing))));
        let (e, f) = (b - a, c - a);
        let normal = e.cross(f);
        if 0.001 * size.powi(4) < normal.dot(normal) {
            let sums = [(1.0, 0.0), (0.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 2.0)];
            let (i, j) = draw.pick(&sums);
            return ([a, b, c].map(rounded), rounded(e * i + f * j));
        }
    }
}

/// A triangle whose plane holds an axis, and the direction of that axis. Along the two other axes the
/// corners are steps on one line of the grid.
fn holding_axis<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    size: f64,
    axes: [usize; 3],
) -> ([[F; 3]; 3], [F; 3]) {
    let spacing = grid::<F>(scene);
    let base = place(draw, scene, size);
    let steps = ((size / spacing / 4.0) as i64).clamp(1, 1 << 20);
    let line = [draw.integer(-steps, steps), draw.integer((steps + 1) / 2, steps)];
    let [first, second] = draw.pick(&[[1, 2], [2, -1], [-1, 1], [1, -2]]);
    let corner = |step: i64, along: f64| {
        let mut p = [0.0; 3];
        p[axes[0]] = base[axes[0]] + along;
        for k in [0, 1] {
            let axis = axes[k + 1];
            p[axis] = snapped(base[axis], spacing) + (step * line[k]) as f64 * spacing;
        }
        p.map(F::from_f64)
    };
    let along = loop {
        let along = [0.0, symmetric(draw) * size, symmetric(draw) * size];
        // Twice the area over the width of a step.
        let area = first as f64 * along[2] - second as f64 * along[1];
        if size < 2.0 * area.abs() {
            break along;
        }
    };
    let corners = [corner(0, along[0]), corner(first, along[1]), corner(second, along[2])];
    let mut flat = [F::zero(); 3];
    let length = match scene.direction {
        DirectionLength::Unit => 1.0,
        DirectionLength::Target => between_powers(draw, scene.edge),
    };
    flat[axes[0]] = F::from_f64(if draw.coin() { length } else { -length });
    (corners, flat)
}

/// A triangle at one height above a plane of two axes, and a direction in that plane.
fn level<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    size: f64,
    [i, j, k]: [usize; 3],
) -> ([[F; 3]; 3], [F; 3]) {
    let base = place(draw, scene, size);
    let mut frame = Frame { along: DVec3::ZERO, across: DVec3::ZERO, normal: DVec3::ZERO };
    let turned = loop {
        let (x, y) = (symmetric(draw), symmetric(draw));
        let square = x * x + y * y;
        if (0.0625..=1.0).contains(&square) {
            break [x / square.sqrt(), y / square.sqrt()];
        }
    };
    (frame.along[i], frame.along[j]) = (turned[0], turned[1]);
    (frame.across[i], frame.across[j]) = (-turned[1], turned[0]);
    frame.normal[k] = 1.0;
    let (x, y) = apex(draw, size);
    let corners = [base, base + frame.flat(size, 0.0), base + frame.flat(x, y)];
    let flat = in_plane(draw, &frame);
    let flat = match scene.direction {
        DirectionLength::Unit => unit::<f64>(flat.to_array()).map(F::from_f64),
        DirectionLength::Target => rounded(flat * between_powers(draw, scene.edge)),
    };
    (integer::shuffle(draw, corners).map(rounded), flat)
}

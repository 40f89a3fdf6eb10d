//! Rays almost and exactly parallel to the plane of a triangle.

use super::super::Made;
use super::Setup;
use super::draw::{any_direction, beside, between, between_powers, in_plane, inside, point_of};
use super::draw::{ray, rounded, wide};
use super::triangles::Parallel;
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Draw};
use glam::DVec3;

pub fn grazing<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let (triangle, frame) = setup.triangles.triangle(draw);
    // The coin is tossed in any case, so that the other draws stay the same.
    let is_inside = draw.coin() || setup.scene.aims_inside;
    let weights = if is_inside { inside(draw) } else { beside(draw) };
    let target = point_of(triangle, weights);
    let sine = match setup.scene.sine {
        Some(range) => between_powers(draw, range) * if draw.coin() { 1.0 } else { -1.0 },
        None => grazing_sine::<F>(draw),
    };
    let flat = in_plane(draw, &frame);
    let toward = flat * (1.0 - sine * sine).sqrt() + frame.normal * sine;
    let (start, direction) = ray(draw, setup.scene, target, toward);
    Made::One(Case::new(start, direction, triangle))
}

/// The sine of the angle to a plane, of either sign: from 1/8 down to an eighth of an ulp of 1, each
/// halving equally likely. On a generic plane the rounded direction has another: near the lower end
/// rounding decides it.
pub fn grazing_sine<F: Float>(draw: &mut Draw) -> f64 {
    let power = -(draw.integer(4, i64::from(F::DIGITS) + 2) as i32);
    let sine = scale_by_power_of_two(1.0 + draw.unit(), power);
    if draw.coin() { sine } else { -sine }
}

pub fn parallel<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let Parallel { triangle, direction, size } = setup.triangles.parallel(draw);
    let length = wide(direction).dot(wide(direction)).sqrt();
    let ahead = wide(direction) / length;
    let off = match draw.below(4) {
        0 => DVec3::ZERO,
        _ => any_direction(draw) * between_powers(draw, [size / 65536.0, size]),
    };
    let target = point_of(triangle, inside(draw)) + off;
    let start = target - ahead * between(draw, setup.scene.distance);
    let mut start: [F; 3] = rounded(start);
    if off == DVec3::ZERO {
        // Where the ray does not move, it starts as the plane's first vertex does, and so in the plane.
        let still = (0..3).filter(|axis| direction[*axis].is_zero());
        still.for_each(|axis| start[axis] = triangle[0][axis]);
    }
    Made::One(Case::new(start, direction, triangle))
}

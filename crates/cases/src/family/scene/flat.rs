//! Rays almost and exactly parallel to the plane of a triangle.

use super::super::CaseGroup;
use super::Setup;
use super::draw::{
    RayAxes, any_direction, beside, between, between_powers, in_plane, inside, point_of, ray,
    rounded, wide,
};
use super::triangles::Parallel;
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Draw, Scene};
use glam::DVec3;

pub fn grazing<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    CaseGroup::One(grazing_ray(setup, draw).0)
}

/// The case, and the sine that it has instead if no ray has the one that was drawn.
pub fn grazing_ray<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> (Case<F>, Option<f64>) {
    let (triangle, drawn) = setup.triangles.triangle(draw);
    // Rounding the vertices tilts the plane: the angle is that to the rounded triangle.
    let frame = RayAxes::of(triangle).unwrap_or(drawn);
    // The coin is tossed in any case, so that the other draws stay the same.
    let is_inside = draw.coin() || setup.scene.aims_inside;
    let weights = if is_inside {
        inside(draw)
    } else {
        beside(draw)
    };
    let target = point_of(triangle, weights);
    let sine = match setup.scene.sine {
        Some(range) => between_powers(draw, range) * if draw.coin() { 1.0 } else { -1.0 },
        None => grazing_sine::<F>(draw),
    };
    let ((start, direction), missed) = at_an_angle(draw, setup.scene, target, &frame, sine);
    (Case::new(start, direction, triangle), missed)
}

/// How many rays are tried for one at the angle that was drawn.
pub const TRIES: usize = 4096;

/// Sines below this many ulps of 1 are left to the rounding of the direction, unless the scene asks for them.
const LEAST_ULPS: f64 = 8.0;

/// A ray toward a target in a plane, at an angle of a sine. Rounding the origin and the direction changes the angle, so
/// rays are drawn until one has it within a tenth, from either side; if none of many has, the nearest is taken, and its
/// sine is returned too.
fn at_an_angle<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    target: DVec3,
    frame: &RayAxes,
    sine: f64,
) -> (([F; 3], [F; 3]), Option<f64>) {
    let is_free = scene.sine.is_none() && sine.abs() < LEAST_ULPS * F::EPSILON.to_f64();
    let mut nearest: Option<(f64, _, f64)> = None;
    for _ in 0..TRIES {
        let flat = in_plane(draw, frame);
        let toward = flat * (1.0 - sine * sine).sqrt() + frame.normal * sine;
        let made = ray::<F>(draw, scene, target, toward);
        let reached = sine_to(frame, made.1).abs();
        // A ratio; infinite for a ray in the plane.
        let off = reached.max(sine.abs()) / reached.min(sine.abs());
        if is_free || off <= 1.1 {
            return (made, None);
        }
        if nearest.is_none_or(|(other, ..)| off < other) {
            nearest = Some((off, made, reached));
        }
    }
    let (_, made, reached) = nearest.expect("one try at least");
    (made, Some(reached))
}

/// The sine of the angle between a direction and the plane of a frame.
fn sine_to<F: Float>(frame: &RayAxes, direction: [F; 3]) -> f64 {
    let direction = wide(direction);
    frame.normal.dot(direction) / direction.dot(direction).sqrt()
}

/// The sine of the angle to a plane, of either sign: from 1/8 down to an eighth of an ulp of 1, each
/// halving equally likely. On a generic plane the rounded direction has another: near the lower end
/// rounding decides it.
pub fn grazing_sine<F: Float>(draw: &mut Draw) -> f64 {
    let power = -(draw.integer(4, i64::from(F::DIGITS) + 2) as i32);
    let sine = scale_by_power_of_two(1.0 + draw.unit(), power);
    if draw.coin() { sine } else { -sine }
}

pub fn parallel<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let Parallel {
        triangle,
        direction,
        size,
    } = setup.triangles.parallel(draw);
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
    CaseGroup::One(Case::new(start, direction, triangle))
}

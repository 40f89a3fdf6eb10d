//! Rays almost and exactly parallel to the plane of a triangle.

use super::super::CaseGroup;
use super::Setup;
use super::draw::{
    RayAxes, any_direction, beside, between, between_powers, either_sign, in_plane, inside,
    point_of, ray, rounded, wide,
};
use super::triangles::Parallel;
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Draw, Scene};
use glam::DVec3;

pub fn grazing<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    CaseGroup::One(grazing_ray(setup, draw).case)
}

/// A case whose ray is almost parallel to its triangle.
pub struct GrazingRay<F: Float> {
    /// The case.
    pub case: Case<F>,
    /// The sine that the ray has, if no ray has the one that was drawn.
    pub missed_sine: Option<f64>,
}

/// A ray at a point of a triangle's plane, inside the triangle or beside it.
pub fn grazing_ray<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> GrazingRay<F> {
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
        Some(range) => {
            let size = between_powers(draw, range);
            either_sign(draw, size)
        }
        None => grazing_sine::<F>(draw),
    };
    let tried = at_an_angle(draw, setup.scene, target, &frame, sine);
    GrazingRay {
        case: Case::new(tried.origin, tried.direction, triangle),
        missed_sine: tried.missed_sine,
    }
}

/// How many rays are tried for one at the angle that was drawn.
pub const TRIES: usize = 4096;

/// Sines below this many ulps of 1 are left to the rounding of the direction, unless the scene asks for them.
const LEAST_ULPS: f64 = 8.0;

/// A ray that was drawn for an angle.
struct Tried<F> {
    origin: [F; 3],
    direction: [F; 3],
    /// The sine that the ray has, if it does not have the one that was drawn.
    missed_sine: Option<f64>,
    /// The larger of the two sines, divided by the smaller one: infinite for a ray in the plane.
    ratio: f64,
}

/// A ray toward a target in a plane, at an angle of a sine. Rounding the origin and the direction changes the angle, so
/// rays are drawn until one has it within a tenth, from either side; if none of many has, the nearest is taken.
fn at_an_angle<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    target: DVec3,
    frame: &RayAxes,
    sine: f64,
) -> Tried<F> {
    let is_free = scene.sine.is_none() && sine.abs() < LEAST_ULPS * F::EPSILON.to_f64();
    let mut nearest: Option<Tried<F>> = None;
    for _ in 0..TRIES {
        let flat = in_plane(draw, frame);
        let toward = flat * (1.0 - sine * sine).sqrt() + frame.normal * sine;
        let (origin, direction) = ray::<F>(draw, scene, target, toward);
        let reached = sine_to(frame, direction).abs();
        let ratio = reached.max(sine.abs()) / reached.min(sine.abs());
        let is_reached = is_free || ratio <= 1.1;
        let tried = Tried {
            origin,
            direction,
            missed_sine: (!is_reached).then_some(reached),
            ratio,
        };
        if is_reached {
            return tried;
        }
        if nearest.as_ref().is_none_or(|other| ratio < other.ratio) {
            nearest = Some(tried);
        }
    }
    nearest.expect("one try at least")
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
    let halvings = draw.integer(4, i64::from(F::DIGITS) + 2) as i32;
    let sine = scale_by_power_of_two(1.0 + draw.unit(), -halvings);
    either_sign(draw, sine)
}

pub fn parallel<F: Float>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let Parallel {
        triangle,
        direction,
        size,
    } = setup.triangles.parallel(draw);
    let length = wide(direction).dot(wide(direction)).sqrt();
    let ahead = wide(direction) / length;
    let off_plane = match draw.below(4) {
        0 => DVec3::ZERO,
        _ => any_direction(draw) * between_powers(draw, [size / 65536.0, size]),
    };
    let target = point_of(triangle, inside(draw)) + off_plane;
    let distance = between(draw, setup.scene.distance);
    let mut origin: [F; 3] = rounded(target - ahead * distance);
    if off_plane == DVec3::ZERO {
        // Where the ray does not move, it starts as the plane's first vertex does, and so in the plane.
        for axis in 0..3 {
            if direction[axis].is_zero() {
                origin[axis] = triangle[0][axis];
            }
        }
    }
    CaseGroup::One(Case::new(origin, direction, triangle))
}

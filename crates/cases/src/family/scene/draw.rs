//! The tools that the strata share: sizes, places, orientations, and the ray toward a target.

use super::super::integer::turned;
use super::super::unit;
use crate::arith::Float;
use crate::case::{DirectionLength, Draw, RayKind, Scene, Toward};
use glam::DVec3;
use std::ops::Neg;

/// A number between two positive ones, each doubling equally likely: 2^-8 of the range on a scale of
/// powers, and even within.
pub fn between_powers(draw: &mut Draw, [low, high]: [f64; 2]) -> f64 {
    let (mut low, mut high) = (low, high);
    let mut bits = draw.bits();
    for _ in 0..8 {
        let middle = low.sqrt() * high.sqrt();
        if bits & 1 == 0 {
            high = middle
        } else {
            low = middle
        }
        bits >>= 1;
    }
    low + (high - low) * draw.unit()
}

/// The length of a triangle's longest edge: half of them are below the median, where the scene has one.
pub fn edge_length(draw: &mut Draw, scene: &Scene) -> f64 {
    let [low, high] = scene.edge;
    match scene.median_edge {
        None => between_powers(draw, [low, high]),
        Some(median) => {
            let range = if draw.coin() {
                [low, median]
            } else {
                [median, high]
            };
            between_powers(draw, range)
        }
    }
}

pub fn between(draw: &mut Draw, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * draw.unit()
}

pub fn symmetric(draw: &mut Draw) -> f64 {
    2.0 * draw.unit() - 1.0
}

/// A number or its negative, as a coin falls.
pub fn either_sign<T: Neg<Output = T>>(draw: &mut Draw, x: T) -> T {
    if draw.coin() { x } else { -x }
}

/// A unit vector, uniform on the sphere.
pub fn any_direction(draw: &mut Draw) -> DVec3 {
    unit_vector(draw, 0.0625)
}

/// The same, made of a vector whose square is no less than that.
pub fn unit_vector(draw: &mut Draw, least: f64) -> DVec3 {
    loop {
        let v = DVec3::new(symmetric(draw), symmetric(draw), symmetric(draw));
        let square = v.dot(v);
        if (least..=1.0).contains(&square) {
            return v / square.sqrt();
        }
    }
}

/// Three axes at right angles.
pub struct RayAxes {
    /// In the plane.
    pub along: DVec3,
    /// In the plane, at a right angle to the first.
    pub across: DVec3,
    /// At a right angle to the plane.
    pub normal: DVec3,
}

impl RayAxes {
    /// Turned uniformly.
    pub fn draw(draw: &mut Draw) -> RayAxes {
        let normal = any_direction(draw);
        loop {
            let across = normal.cross(any_direction(draw));
            let square = across.dot(across);
            if 0.0625 < square {
                let across = across / square.sqrt();
                return RayAxes {
                    along: across.cross(normal),
                    across,
                    normal,
                };
            }
        }
    }

    /// Upright on two axes, the first two of three in cyclic order, and turned about the third by the angle of a
    /// vector of length 1.
    pub fn upright([i, j, k]: [usize; 3], [x, y]: [f64; 2]) -> RayAxes {
        let mut frame = RayAxes {
            along: DVec3::ZERO,
            across: DVec3::ZERO,
            normal: DVec3::ZERO,
        };
        (frame.along[i], frame.along[j]) = (x, y);
        (frame.across[i], frame.across[j]) = (-y, x);
        frame.normal[k] = 1.0;
        frame
    }

    /// Tilted about an axis of its own plane, by the angle of a sine.
    pub fn tilted(self, [x, y]: [f64; 2], sine: f64) -> RayAxes {
        let downhill = self.flat(x, y);
        let normal = self.normal * (1.0 - sine * sine).sqrt() + downhill * sine;
        let across = normal.cross(self.along);
        let across = across / across.dot(across).sqrt();
        RayAxes {
            along: across.cross(normal),
            across,
            normal,
        }
    }

    /// The frame of a triangle's plane, along its first edge; none if `f64` finds no normal.
    pub fn of<F: Float>(triangle: [[F; 3]; 3]) -> Option<RayAxes> {
        let [a, b, c] = triangle.map(wide);
        let (e, f) = (b - a, c - a);
        // Edges of about 1, so that products neither overflow nor underflow.
        let largest = e.abs().max(f.abs()).max_element();
        let along = (e / largest).normalize();
        let normal = (e / largest).cross(f / largest).normalize();
        let is_frame = along.is_finite() && normal.is_finite();
        is_frame.then(|| RayAxes {
            along,
            across: normal.cross(along),
            normal,
        })
    }

    /// The vector of coordinates along and across.
    pub fn flat(&self, x: f64, y: f64) -> DVec3 {
        self.along * x + self.across * y
    }
}

pub(crate) fn rounded<F: Float>(point: DVec3) -> [F; 3] {
    point.to_array().map(F::from_f64)
}

/// A point of either scalar, in double: exactly. Number by number, because an array that is written so and then read as a vector
/// keeps the processor waiting.
#[inline]
pub fn wide<F: Float>([x, y, z]: [F; 3]) -> DVec3 {
    DVec3::new(x.to_f64(), y.to_f64(), z.to_f64())
}

/// The point of given weights, in `f64`.
pub fn point_of<F: Float>(triangle: [[F; 3]; 3], [u, v]: [f64; 2]) -> DVec3 {
    let [a, b, c] = triangle.map(wide);
    a + (b - a) * u + (c - a) * v
}

/// Weights of b and c, uniform in the triangle.
pub fn inside(draw: &mut Draw) -> [f64; 2] {
    let (u, v) = (draw.unit(), draw.unit());
    if u + v > 1.0 {
        [1.0 - u, 1.0 - v]
    } else {
        [u, v]
    }
}

/// Weights of b and c, uniform in a rhomboid three times as large on each side, but outside; the rhomboid's
/// corner belongs to any of the three vertices.
pub fn beside(draw: &mut Draw) -> [f64; 2] {
    loop {
        let (u, v) = (3.0 * draw.unit() - 1.0, 3.0 * draw.unit() - 1.0);
        if u < 0.0 || v < 0.0 || 1.0 < u + v {
            let [_, v, w] = turned(draw, [1.0 - u - v, u, v]);
            return [v, w];
        }
    }
}

/// The ray that goes toward a target along a unit vector: its origin and its direction.
pub fn ray<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    target: DVec3,
    toward: DVec3,
) -> ([F; 3], [F; 3]) {
    let start = target - toward * between(draw, scene.distance);
    let stored: [F; 3] = rounded(start);
    let seen_from = match scene.ray {
        RayKind::Stored => wide(stored),
        RayKind::Generated => start,
    };
    (stored, direction(scene, target - seen_from, toward))
}

/// The direction along a way in a scene; along a unit vector if the way is too short. A coordinate that is 0 in that
/// vector stays 0 if the scene's rays go along axes.
pub fn direction<F: Float>(scene: &Scene, mut way: DVec3, toward: DVec3) -> [F; 3] {
    if scene.toward != Toward::Any {
        (0..3)
            .filter(|axis| toward[*axis] == 0.0)
            .for_each(|axis| way[axis] = 0.0);
    }
    // Nearer than the shortest edge, the target's own rounding would turn the ray.
    let is_short = way.dot(way) < scene.edge[0] * scene.edge[0];
    match scene.direction {
        DirectionLength::Target if is_short => rounded(toward * scene.edge[0]),
        DirectionLength::Target => rounded(way),
        DirectionLength::Unit | DirectionLength::Mixed if is_short => unit(rounded(toward)),
        DirectionLength::Unit | DirectionLength::Mixed => {
            unit::<f64>(way.to_array()).map(F::from_f64)
        }
    }
}

/// Coordinates in a plane, uniform over all directions, and their length.
pub fn circle(draw: &mut Draw) -> ([f64; 2], f64) {
    loop {
        let (x, y) = (symmetric(draw), symmetric(draw));
        let square = x * x + y * y;
        if (0.0625..=1.0).contains(&square) {
            return ([x, y], square.sqrt());
        }
    }
}

/// A unit vector in the plane of a frame, uniform on the circle.
pub fn in_plane(draw: &mut Draw, frame: &RayAxes) -> DVec3 {
    let ([x, y], length) = circle(draw);
    frame.flat(x, y) / length
}

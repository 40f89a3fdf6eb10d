//! The first step: distances in floats, and which of them rounding leaves in doubt.

use super::{Distances, Zeros, exponent_of, scaled};
use crate::case::Case;
use glam::DVec3;

/// The distances that floats find, and those that they leave in doubt.
#[derive(Clone, Copy)]
pub(super) struct Quick {
    pub distances: Distances,
    /// The divisor of lengths.
    pub unit: f64,
    /// Edges so near to the line that rounding could matter; none if the distance is certain.
    pub edges_in_doubt: [bool; 3],
    pub along_in_doubt: bool,
}

impl Quick {
    pub fn certain(self) -> Option<Distances> {
        let is_in_doubt = self.along_in_doubt || self.edges_in_doubt != [false; 3];
        (!is_in_doubt).then_some(self.distances)
    }

    /// Adds the distances along a line that crosses the plane, and is known to be at some of the ends there.
    fn add_along(&mut self, case: &Case<f64>, is_at: [bool; 3], longest: f64) {
        let [o, d, a, b, c] = case.vectors().map(DVec3::from);
        let n = (b - a).cross(c - a);
        let plane = n.dot(a - o);
        let speed = n.dot(d);
        let t = plane / speed;
        let length = d.length();
        // n is off by 8u times the square of the longest edge, products with it and their sums by 4u more:
        // in all by less than 2^-48. That holds for t where n·d is certain, and only then 0, which is an end
        // always, is far enough from t.
        let of_normal = scaled(longest * longest, -48);
        let error = of_normal * ((a - o).length() + t.abs() * length) / speed.abs();
        let ends = [0.0, case.ray.t_min, case.ray.t_max];
        for (i, end) in ends.into_iter().enumerate() {
            if is_at[i] {
                self.distances.along[i] = 0.0;
                continue;
            }
            let gap = (t - end).abs();
            let is_certain = gap > 1024.0 * error;
            self.along_in_doubt |= end.is_finite() && !is_certain;
            self.distances.along[i] = gap * length / self.unit;
        }
    }
}

/// The distances in floats, of a case whose lengths, and the ulp, were divided by 2^size; none where a square may
/// underflow.
pub(super) fn quick(case: &Case<f64>, size: i32, ulp: f64, zeros: &Zeros) -> Option<Quick> {
    let vectors = case.vectors();
    let [o, _, a, b, c] = vectors;
    let largest = scaled(1.0, exponent_of([o, a, b, c].as_flattened()));
    let [o, d, a, b, c] = vectors.map(DVec3::from);
    let edges = [b - a, c - b, a - c].map(DVec3::length_squared);
    let longest = edges.into_iter().fold(0.0, f64::max).sqrt();
    let is_point = a == b && b == c;
    // The square of a very short edge underflows.
    if longest < scaled(largest, -400) && !is_point {
        return None;
    }
    let unit = unit_of(longest, size);
    let length = d.length();
    let to_edges = squares_to_edges(o, d, [a, b, c]);
    let in_space = to_edges.into_iter().fold(f64::INFINITY, f64::min).sqrt() / length;
    let mut quick = Quick {
        distances: Distances {
            in_space: 0.0,
            along: [f64::NAN; 3],
            edge_in_ulps: unit / ulp,
        },
        unit,
        edges_in_doubt: [false; 3],
        along_in_doubt: false,
    };
    if !zeros.in_space {
        quick.distances.in_space = in_space / unit;
        // Let L be `largest` and u = 2^-53. Coordinates are below 2L, so p - o is below 4L in each, and its
        // rounding, that of two products and of their difference come to 24uL|d| in the cross product. The
        // difference of two of these, its product with s and the sum round by less than 40uL|d| together;
        // a rounded s only chooses another point of the edge. In all that is below 2^-46 L|d|.
        let near = scaled(largest, -36);
        if in_space < near || in_space.is_nan() {
            // An edge beyond twice that is not the nearest.
            let limit = 2.0 * near * length;
            quick.edges_in_doubt = to_edges.map(|square| square < limit * limit || square.is_nan());
        }
    }
    if let Some(is_at) = zeros.along {
        quick.add_along(case, is_at, longest);
    }
    Some(quick)
}

/// The divisor of distances: the longest edge, or a length of 1 if that is zero; lengths were
/// divided by 2^size.
fn unit_of(longest: f64, size: i32) -> f64 {
    if longest > 0.0 {
        longest
    } else {
        scaled(1.0, -size)
    }
}

/// The squares of the distances from a line to the edges, times the square of the direction's length.
fn squares_to_edges(o: DVec3, d: DVec3, corners: [DVec3; 3]) -> [f64; 3] {
    let offsets = corners.map(|p| (p - o).cross(d));
    [(0, 1), (1, 2), (2, 0)].map(|(p, q)| {
        let offset = offsets[p];
        let edge = offsets[q] - offset;
        let s = -offset.dot(edge) / edge.length_squared();
        // For an edge that is a point s is 0/0, and the larger of NaN and 0 is 0.
        let nearest = s.clamp(0.0, 1.0).max(0.0);
        (offset + edge * nearest).length_squared()
    })
}

//! A neighbour at a corner: a second triangle on the nearest edge, folded up on the side to which rays leave.

use crate::arith::Float;
use glam::DVec3;

/// The plane of a triangle that shares the edge nearest to a hit point, at an angle to it. A start behind that plane
/// has jumped over the neighbour: light leaks into the corner.
pub struct Neighbour {
    /// A point of the edge, and the unit vector in the triangle's plane from the edge inwards.
    edge: DVec3,
    inward: DVec3,
    /// The sine of the angle between the two triangles, on the side to which rays leave.
    sine: f64,
    cosine: f64,
}

impl Neighbour {
    /// At the edge of a triangle nearest to a point; the angle in degrees.
    pub fn new<F: Float>(vertices: [[F; 3]; 3], point: [F; 3], degrees: f64) -> Neighbour {
        let corners = vertices.map(|vertex| DVec3::from(vertex.map(F::to_f64)));
        let point = DVec3::from(point.map(F::to_f64));
        let of_edge = |i: usize| {
            let (from, to, other) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
            let along = (to - from).normalize_or_zero();
            let inward = other - from;
            (
                from,
                (inward - along * inward.dot(along)).normalize_or_zero(),
            )
        };
        let distance = |(edge, inward): &(DVec3, DVec3)| (point - *edge).dot(*inward);
        let edges = [0, 1, 2].map(of_edge).into_iter();
        let nearest = edges.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let (edge, inward) = nearest.expect("three edges");
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        Neighbour {
            edge,
            inward,
            sine,
            cosine,
        }
    }

    /// True if a start at a height over the triangle, in units of length, is behind the neighbour's plane.
    pub fn is_passed(&self, start: [f64; 3], height: f64) -> bool {
        let inside = (DVec3::from(start) - self.edge).dot(self.inward);
        // At the edge, seen from inside the triangle, the start is at a larger angle than the neighbour.
        0.0 < height * self.cosine - inside * self.sine
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_passes_a_neighbour_where_it_is_higher_than_the_fold_over_it() {
        let triangle = [[8.0f32, 0.0, 0.0], [8.0, 4.0, 0.0], [0.0, 0.0, 0.0]];
        // Nearest is the edge at x = 8, half a unit away.
        let point = [7.5f32, 1.0, 0.0];
        let passed = |degrees: f64, x: f64, height: f64| {
            Neighbour::new(triangle, point, degrees).is_passed([x, 1.0, height], height)
        };
        assert!(!passed(45.0, 7.5, 0.49) && passed(45.0, 7.5, 0.51));
        // tan 30 degrees is 0.577, half of it 0.289.
        assert!(!passed(30.0, 7.5, 0.288) && passed(30.0, 7.5, 0.289));
        // Along the normal nothing passes a wall at a right angle; beyond the edge everything does.
        assert!(!passed(90.0, 7.5, 1e9) && passed(90.0, 8.01, 1e-9));
        assert!(!passed(120.0, 8.01, 0.018) && passed(120.0, 8.01, 0.017));
    }
}

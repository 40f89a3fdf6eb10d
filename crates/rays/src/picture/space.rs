//! The region that a picture shows, in a scale in which nothing over- or underflows.

use glam::DVec3;
use hairline_scene::Triangle;

/// Coordinates beyond are not drawn: they would overflow in products.
const FARTHEST: f64 = 1e100;

/// The least radius of a region in which the largest coordinate is about 1: floats do not tell points apart that are nearer.
const LEAST: f64 = 1e-15;

/// A scale in which the largest coordinate of some points is about 1.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    factors: [f64; 2],
}

impl Scale {
    /// The scale of some points.
    pub fn of(points: impl Iterator<Item = [f64; 3]>) -> Scale {
        let sizes = points.flatten().map(f64::abs).filter(|it| it.is_finite());
        let largest = sizes.fold(0.0, f64::max);
        let exponent = match largest == 0.0 {
            true => 0,
            false => -largest.log2().floor() as i32,
        };
        // In two steps, since 2^1074 is no float.
        let half = exponent / 2;
        let factors = [half, exponent - half].map(|it| 2f64.powi(it));
        Scale { factors }
    }

    /// A point in the scale; infinite if it is far beyond all of its points.
    pub fn place(&self, point: [f64; 3]) -> DVec3 {
        let [one, other] = self.factors;
        DVec3::from(point) * one * other
    }
}

/// A ball around all that a picture has to show, which becomes the ball of radius 1 around 0.
pub(super) struct Region {
    scale: Scale,
    centre: DVec3,
    radius: f64,
}

impl Region {
    /// The ball around some points in a scale, and so much around each.
    pub fn around(scale: Scale, points: &[DVec3], margin: f64) -> Region {
        let mut min = DVec3::INFINITY;
        let mut max = DVec3::NEG_INFINITY;
        for point in points {
            min = min.min(*point);
            max = max.max(*point);
        }
        if points.is_empty() {
            min = DVec3::ZERO;
            max = DVec3::ZERO;
        }
        let radius = min.distance(max) / 2.0 + margin;
        Region {
            scale,
            centre: min.midpoint(max),
            radius: if radius == 0.0 {
                1.0
            } else {
                radius.max(LEAST)
            },
        }
    }

    /// A point in the region; none if it is too far away.
    pub fn place(&self, point: [f64; 3]) -> Option<DVec3> {
        let placed = self.place_scaled(self.scale.place(point));
        let is_near = placed.abs().max_element() < FARTHEST;
        (placed.is_finite() && is_near).then_some(placed)
    }

    /// A point of the scale in the region.
    pub fn place_scaled(&self, point: DVec3) -> DVec3 {
        (point - self.centre) / self.radius
    }

    /// A triangle in the region; none if a corner is too far away.
    pub fn place_triangle(&self, triangle: &Triangle<f64>) -> Option<[DVec3; 3]> {
        let [a, b, c] = triangle.map(|corner| self.place(corner));
        Some([a?, b?, c?])
    }

    /// A length of the scale in the region.
    pub fn length(&self, length: f64) -> f64 {
        length / self.radius
    }
}

/// The direction of a vector, whatever its length; the x axis if it has none.
pub(super) fn direction_of(vector: [f64; 3]) -> DVec3 {
    let scale = Scale::of([vector].into_iter());
    scale.place(vector).normalize_or(DVec3::X)
}

/// The length of a triangle's longest edge.
pub(super) fn longest_edge([a, b, c]: [DVec3; 3]) -> f64 {
    let edges = [a.distance(b), b.distance(c), c.distance(a)];
    edges.into_iter().fold(0.0, f64::max)
}

/// The direction across a triangle; zero if it has no area.
pub(super) fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    let to_edges = longest_edge([a, b, c]).recip();
    let across = ((b - a) * to_edges).cross((c - a) * to_edges);
    across.normalize_or_zero()
}

/// The point of a closed triangle that is nearest to a point (Ericson, Real-Time Collision Detection, 5.1.5).
pub(super) fn nearest_point(triangle: [DVec3; 3], point: DVec3) -> DVec3 {
    let [a, b, c] = triangle;
    let normal = normal(triangle);
    let is_left_of = |from: DVec3, to: DVec3| 0.0 <= (to - from).cross(point - from).dot(normal);
    let is_above = is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a);
    if is_above && normal != DVec3::ZERO {
        return point - (point - a).dot(normal) * normal;
    }
    let on_edges = [(a, b), (b, c), (c, a)].map(|(from, to)| nearest_on_edge(from, to, point));
    let mut nearest = on_edges[0];
    for other in on_edges {
        if other.distance(point) < nearest.distance(point) {
            nearest = other;
        }
    }
    nearest
}

fn nearest_on_edge(from: DVec3, to: DVec3, point: DVec3) -> DVec3 {
    let way = to - from;
    let along = (point - from).dot(way) / way.length_squared();
    // NaN for an edge that is a point.
    let along = if along.is_nan() { 0.0 } else { along };
    from + along.clamp(0.0, 1.0) * way
}

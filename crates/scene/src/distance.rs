//! Distances in floats, for what is said of wrong answers and decides no hit.

use crate::mesh::Triangle;
use glam::DVec3;

/// The length of a vector of any size: its square may over- or underflow.
pub(crate) fn length(vector: DVec3) -> f64 {
    let size = vector.abs().max_element();
    match size == 0.0 || !size.is_finite() {
        true => size,
        false => (vector / size).length() * size,
    }
}

/// The length of the longest edge.
pub(crate) fn longest_edge(triangle: &Triangle<f64>) -> f64 {
    let [a, b, c] = triangle.map(DVec3::from);
    let edges = [b - a, c - b, a - c].map(length);
    edges.into_iter().fold(0.0, f64::max)
}

/// A vector along the normal of a triangle, of no certain length; 0 without an area.
pub(crate) fn normal(triangle: &Triangle<f64>) -> DVec3 {
    let [a, b, c] = triangle.map(DVec3::from);
    of_size_1(b - a).cross(of_size_1(c - a))
}

/// A vector whose largest component is 1, or 0.
pub(crate) fn of_size_1(vector: DVec3) -> DVec3 {
    let size = vector.abs().max_element();
    match size == 0.0 || !size.is_finite() {
        true => DVec3::ZERO,
        false => vector / size,
    }
}

/// The distance of a point from a closed triangle (Ericson, Real-Time Collision Detection, 5.1.5).
pub(crate) fn distance_to(triangle: &Triangle<f64>, point: [f64; 3]) -> f64 {
    let [a, b, c] = triangle.map(DVec3::from);
    let point = DVec3::from(point);
    // Differences in units of the largest one, whose squares do not over- or underflow.
    let size = [b - a, c - a, point - a]
        .map(|vector| vector.abs().max_element())
        .into_iter()
        .fold(0.0, f64::max);
    if size == 0.0 || !size.is_finite() {
        return size;
    }
    let [b, c, point] = [b, c, point].map(|corner| (corner - a) / size);
    size * distance_to_corner_at_0([b, c], point)
}

/// The distance of a point from the triangle with corners 0, b and c.
fn distance_to_corner_at_0([b, c]: [DVec3; 2], point: DVec3) -> f64 {
    let a = DVec3::ZERO;
    let normal = of_size_1(b).cross(of_size_1(c));
    let is_left_of = |from: DVec3, to: DVec3| 0.0 <= (to - from).cross(point - from).dot(normal);
    let is_above = is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a);
    let height = point.dot(normal).abs() / normal.length();
    if is_above && height.is_finite() {
        return height;
    }
    let edges = [(a, b), (b, c), (c, a)];
    let to_edge = edges.map(|(from, to)| distance_to_segment(from, to, point));
    to_edge.into_iter().fold(f64::INFINITY, f64::min)
}

fn distance_to_segment(from: DVec3, to: DVec3, point: DVec3) -> f64 {
    let way = to - from;
    let along = (point - from).dot(way) / way.length_squared();
    // NaN for a segment that is a point.
    let along = if along.is_nan() { 0.0 } else { along };
    point.distance(from + along.clamp(0.0, 1.0) * way)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: Triangle<f64> = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

    #[test]
    fn distances_worked_out_by_hand() {
        assert_eq!(longest_edge(&TRIANGLE), 5.0);
        for (point, expected) in [
            ([1.0, 1.0, -2.0], 2.0),
            ([1.0, 1.0, 0.0], 0.0),
            ([2.0, -1.0, 0.0], 1.0),
            ([-3.0, -4.0, 0.0], 5.0),
            ([7.0, 0.0, 4.0], 5.0),
            // Beside the long edge, whose normal is (3, 4) / 5.
            ([2.6, 2.3, 0.0], 1.0),
        ] {
            let found = distance_to(&TRIANGLE, point);
            assert!((found - expected).abs() < 1e-15, "{point:?}: {found}");
            let [a, b, c] = TRIANGLE;
            assert!((distance_to(&[c, b, a], point) - expected).abs() < 1e-15);
        }
        // In any size.
        for size in [1e-300, 1e-160, 1e160, 1e300] {
            let scaled = TRIANGLE.map(|corner| corner.map(|x| x * size));
            let found = distance_to(&scaled, [2.6 * size, 2.3 * size, 0.0]);
            assert!((found / size - 1.0).abs() < 1e-14, "{size}: {found}");
            assert!((longest_edge(&scaled) / size - 5.0).abs() < 1e-14);
        }
        // A segment and a point.
        let [a, b, _] = TRIANGLE;
        assert_eq!(distance_to(&[a, b, b], [2.0, 0.0, 3.0]), 3.0);
        assert_eq!(distance_to(&[a, a, a], [0.0, 3.0, 4.0]), 5.0);
    }
}

//! Rays for tests that take a segment.

use hairline::internals::case::Case;

/// The direction of a case times the least power of two, 1 or more, that takes the segment from the
/// origin past every point of the triangle; and that power. No rounding: where the product would
/// overflow the direction stays as it is.
///
/// A point p of the triangle has |p - o| <= √3 m, with m the largest coordinate of the vertices seen from
/// the origin; so at p the ray's parameter is at most √3 m / max|d|, which the power exceeds twice over.
pub fn past_the_triangle(case: &Case<f32>) -> ([f32; 3], f32) {
    let [origin, direction, a, b, c] = case.vectors().map(|v| v.map(f64::from));
    let largest = |v: [f64; 3]| v.into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let reach = [a, b, c]
        .into_iter()
        .map(|v| largest(std::array::from_fn(|i| v[i] - origin[i])));
    let wanted = 4.0 * reach.fold(0.0, f64::max) / largest(direction);
    let mut scale = 1.0f32;
    while f64::from(scale) < wanted && scale < 2.0f32.powi(126) {
        scale *= 2.0;
    }
    let scaled: [f32; 3] = case.ray.direction.to_array().map(|x| x * scale);
    if scaled.iter().all(|x| x.is_finite()) {
        (scaled, scale)
    } else {
        (case.ray.direction.to_array(), 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_segment_ends_beyond_the_triangle_and_keeps_the_direction() {
        let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let case = Case::<f32>::new([1.0, 1.0, 3.0], [0.0, 0.25, -0.5], triangle);
        let (direction, scale) = past_the_triangle(&case);
        assert_eq!(direction, [0.0, 0.25 * scale, -0.5 * scale]);
        assert!(0.5 * scale > 2.0 * 4.0 && scale.log2().fract() == 0.0);
        let huge = Case::<f32>::new([f32::MAX; 3], [f32::MAX, 1.0, 1.0], triangle);
        assert_eq!(past_the_triangle(&huge), ([f32::MAX, 1.0, 1.0], 1.0));
    }
}

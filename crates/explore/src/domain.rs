//! The two sets of cases that are searched. They are kept apart because overflow and underflow win every
//! search that may use them.

use crate::arith::{Exact, Float, Real, Vector, scale_by_power_of_two};
use crate::case::{Case, Ray, Triangle};

named! {
    pub names
    /// The cases that count.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum SearchDomain {
        /// Ordinary cases:
        /// - every coordinate zero or from 2^-20 to 2^20 in size, and the default interval;
        /// - the longest edge at least 2^-10 of the largest coordinate of a point (not far away);
        /// - the triangle's height over its longest edge at least 2^-6 of that edge (no sliver);
        /// - the sine of the angle between ray and plane at least 2^-6 (not grazing);
        /// - the origin at least 2^-6 longest edges from where the line meets the plane.
        Moderate = "moderate",
        /// Every finite case whose direction is not zero and whose interval is not empty.
        Any = "any",
    }
}

impl SearchDomain {
    /// True if a case is in the domain, decided exactly.
    pub fn holds<F: Float>(self, case: &Case<F>) -> bool {
        if !self.allows_numbers(case) {
            return false;
        }
        if self == SearchDomain::Any {
            return true;
        }
        let (ray, triangle) = case.exact();
        is_healthy(&ray, &triangle, [FAR, SHARE].map(Exact::from_f64))
    }

    /// True if a case is in the domain, decided in `f64` and a little stricter, so that rounding lets none in.
    pub(super) fn holds_quickly<F: Float>(self, case: &Case<F>) -> bool {
        if !self.allows_numbers(case) {
            return false;
        }
        if self == SearchDomain::Any {
            return true;
        }
        let wide = case.widen();
        let stricter = [FAR, SHARE].map(|share| share * 1.001);
        is_healthy(&wide.ray, &wide.triangle, stricter)
    }

    fn allows_numbers<F: Float>(self, case: &Case<F>) -> bool {
        let vectors = case.vectors();
        let [_, direction, ..] = vectors;
        if direction.iter().all(F::is_zero) {
            return false;
        }
        let mut numbers = vectors.iter().flatten();
        let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
        match self {
            SearchDomain::Any => t_min <= t_max && numbers.all(F::is_finite),
            SearchDomain::Moderate => {
                let sizes = scale_by_power_of_two(1.0, -20)..=scale_by_power_of_two(1.0, 20);
                let is_default = t_min.is_zero() && t_max == F::infinity();
                is_default && numbers.all(|x| x.is_zero() || sizes.contains(&x.to_f64().abs()))
            }
        }
    }
}

/// The least share that the longest edge is of the largest coordinate.
const FAR: f64 = 1.0 / 1024.0;

/// The least share that the height and the distance are of the longest edge, and the least sine.
const SHARE: f64 = 1.0 / 64.0;

/// True if the longest edge is at least `far` of the largest coordinate, and height, sine and distance
/// at least `share`. All comparisons are of squares, so no root is taken.
fn is_healthy<V: Vector>(ray: &Ray<V>, triangle: &Triangle<V>, [far, share]: [V::Real; 2]) -> bool {
    let far_squared = far.clone() * &far;
    let share_squared = share.clone() * &share;
    let (origin, direction) = (&ray.origin, &ray.direction);
    let Triangle { a, b, c } = triangle;
    let mut largest = V::Real::zero();
    for point in [origin, a, b, c] {
        for axis in 0..3 {
            largest = larger(largest, point.at(axis).abs());
        }
    }
    let edges = [b.minus(a), c.minus(b), a.minus(c)];
    let mut longest_squared = V::Real::zero();
    for edge in &edges {
        longest_squared = larger(longest_squared, edge.dot(edge));
    }
    let normal = edges[0].cross(&c.minus(a));
    let normal_squared = normal.dot(&normal);
    let direction_squared = direction.dot(direction);
    // The line meets the plane at t = T/D.
    let capital_d = normal.dot(direction);
    let capital_t = normal.dot(&a.minus(origin));
    let d_squared = capital_d.clone() * &capital_d;
    let distance = capital_t.clone() * capital_t * &direction_squared;
    let least_distance = longest_squared.clone() * &d_squared * &share_squared;
    if !least_distance.is_at_most(&distance) {
        return false;
    }
    let least_edge = largest.clone() * largest * &far_squared;
    if !least_edge.is_at_most(&longest_squared) {
        return false;
    }
    let least_normal = longest_squared.clone() * &longest_squared * &share_squared;
    if !least_normal.is_at_most(&normal_squared) {
        return false;
    }
    let least_d = direction_squared * normal_squared * share_squared;
    least_d.is_at_most(&d_squared) && V::Real::zero().is_less(&d_squared)
}

/// The larger of two numbers; the first if one is NaN.
pub(super) fn larger<R: Real>(x: R, y: R) -> R {
    if x.is_less(&y) { y } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn down(origin: [f64; 3], direction: [f64; 3], triangle: [[f64; 3]; 3]) -> Case<f64> {
        Case::new(origin, direction, triangle)
    }

    #[test]
    fn each_condition_of_the_moderate_domain_excludes_a_case_of_its_own() {
        let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let (origin, direction) = ([1.0, 1.0, 1.0], [0.0, 0.0, -1.0]);
        let healthy = down(origin, direction, triangle);
        let far = triangle.map(|[x, y, z]| [x + 65536.0, y, z]);
        let sliver = [triangle[0], triangle[1], [2.0, 0.06, 0.0]];
        let strange = [
            down([1.0, 1.0, 2f64.powi(-21)], direction, triangle),
            healthy.on(0.5, f64::INFINITY),
            healthy.on(0.0, 9.0),
            down([65537.0, 1.0, 1.0], direction, far),
            down(origin, direction, sliver),
            down(origin, [1.0, 0.0, -0.015], triangle),
            down([1.0, 1.0, 0.08], direction, triangle),
            down(origin, [0.0; 3], triangle),
            down(origin, direction, [[0.0; 3]; 3]),
        ];
        assert!(
            SearchDomain::Moderate.holds(&healthy)
                && SearchDomain::Moderate.holds_quickly(&healthy)
        );
        for (i, case) in strange.iter().enumerate() {
            assert!(!SearchDomain::Moderate.holds(case), "{i}");
            assert!(!SearchDomain::Moderate.holds_quickly(case), "{i}");
            assert_eq!(SearchDomain::Any.holds(case), i != 7, "{i}");
        }
        assert!(!SearchDomain::Any.holds(&healthy.on(2.0, 1.0)));
        assert!(!SearchDomain::Any.holds(&down([f64::NAN, 0.0, 0.0], direction, triangle)));
    }
}

//! The two sets of cases that are searched. They are kept apart because overflow and underflow win every
//! search that may use them.

use crate::arith::{Exact, Float, Real, Vector, scale_by_power_of_two};
use crate::case::{Case, Ray, Triangle};

named! {
    pub names
    /// Which cases count.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum SearchDomain {
        /// Ordinary cases:
        /// - every coordinate zero or from 2^-20 to 2^20 in size, and the default interval;
        /// - the longest edge at least 2^-10 of the largest coordinate of a point (not far away);
        /// - the triangle's height over its longest edge at least 2^-6 of that edge (no sliver);
        /// - the sine of the angle between ray and plane at least 2^-6 (not grazing);
        /// - the origin at least 2^-6 longest edges from where the line meets the plane.
        Moderate = "moderate",
        /// Every finite case with a direction and an interval that is one.
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
        let mut numbers = vectors.iter().flatten();
        let has_direction = vectors[1].iter().any(|x| !x.is_zero());
        let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
        match self {
            SearchDomain::Any => has_direction && t_min <= t_max && numbers.all(F::is_finite),
            SearchDomain::Moderate => {
                let sizes = scale_by_power_of_two(1.0, -20)..=scale_by_power_of_two(1.0, 20);
                has_direction
                    && t_min.is_zero()
                    && t_max == F::infinity()
                    && numbers.all(|x| x.is_zero() || sizes.contains(&x.to_f64().abs()))
            }
        }
    }
}

/// The least share that the longest edge is of the largest coordinate.
const FAR: f64 = 1.0 / 1024.0;

/// The least of height, sine and distance, as shares of what they stand against.
const SHARE: f64 = 1.0 / 64.0;

/// True if the longest edge is at least `far` of the largest coordinate, and height, sine and distance
/// at least `share`. All comparisons are of squares: no root is taken.
fn is_healthy<V: Vector>(
    Ray {
        origin: o,
        direction: d,
        ..
    }: &Ray<V>,
    Triangle { a, b, c }: &Triangle<V>,
    shares: [V::Real; 2],
) -> bool {
    let [far, share] = shares.map(|share| share.clone() * &share);
    let larger = |x: V::Real, y: V::Real| if x.is_less(&y) { y } else { x };
    let square = |v: &V| v.dot(v);
    let numbers = [o, a, b, c]
        .into_iter()
        .flat_map(|p| [p.at(0), p.at(1), p.at(2)]);
    let largest = numbers.map(|x| x.abs()).fold(V::Real::zero(), larger);
    let edges = [b.minus(a), c.minus(b), a.minus(c)];
    let longest = edges.iter().map(square).fold(V::Real::zero(), larger);
    let n = edges[0].cross(&c.minus(a));
    let (n_squared, d_squared) = (square(&n), square(d));
    let capital_d = n.dot(d);
    let capital_t = n.dot(&a.minus(o));
    let d_d = capital_d.clone() * &capital_d;
    let near =
        (longest.clone() * &d_d * &share).is_at_most(&(capital_t.clone() * capital_t * &d_squared));
    near && (largest.clone() * largest * &far).is_at_most(&longest)
        && (longest.clone() * &longest * &share).is_at_most(&n_squared)
        && (d_squared * n_squared * share).is_at_most(&d_d)
        && V::Real::zero().is_less(&d_d)
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

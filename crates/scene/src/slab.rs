//! The box test of the tree. It never loses a box that holds a point of the ray, for any finite numbers.
//!
//! **Scale.** All happens in a scale of powers of two: positions are multiplied by 2^k, so that the largest coordinate of
//! the scene is in [1, 2), and the direction by 2^-e, so that its largest component is. From x = o + t·d follows
//! x·2^k = o·2^k + τ·(d·2^-e) with τ = t·2^(k+e). So boxes and τ know nothing of the sizes of the scene.
//!
//! **Plain axes.** An axis is plain if the scaled direction d is 0 there, or if |d| ≥ 2^-300 and the scaled origin o is 0
//! or within 2^-400 ≤ |o| ≤ 2^300. On an axis that is not plain the test does not look: its reciprocal is NaN, no
//! comparison with NaN holds, and so the axis bounds nothing. That loses time and no box. Coordinates of an `f32` scene
//! and ray lie within 2^-149 and 2^128, so with them all axes are plain.
//!
//! **A plain axis with d ≠ 0.** Scaling is exact: o and d stay normal numbers. The planes b of a box are `f32`, thus
//! multiples of 2^-149, and o is a multiple of 2^-452. So b - o is 0 or at least 2^-452, and at most 2^301; with
//! 1/2 < |1/d| ≤ 2^300 the product is 0 or within 2^-453 and 2^601. Nothing over- or underflows. Three roundings (1/d, the
//! difference, the product) make of an exact τ a computed one within τ·(1 ± u)^3, so within τ ± 4u|τ|.
//!
//! **A plain axis with d = 0.** 1/d is an infinity. If o is between the planes, the near end is -∞ and the far end ∞, or
//! NaN where o is on a plane; neither bounds anything. If o is outside the slab, both ends are the same infinity, and no
//! point of the line is in the box. (A scaled origin that over- or underflows keeps its order with the planes, or becomes
//! equal to one, which gives NaN.)
//!
//! **The test.** Let the ray have a point of the box at τ within [start, end]. The computed near end N is `start` or the
//! largest computed near plane, the far end F is `end` or the smallest computed far plane. Let n and f be the exact
//! numbers behind those two; then n ≤ τ ≤ f. `start` and `end` have no error, the planes are off by 4u|n| and 4u|f| at
//! most, so with C = 16u
//!
//! N - C|N| ≤ n ≤ τ ≤ f ≤ F + C|F|,
//!
//! where 16u covers 4u of the exact number in terms of the computed one, and the two roundings of each side. (C|N|
//! underflows only where N is `start`, and there N itself is the bound.) An infinite N or F of a box that is met is -∞ or
//! ∞: both sides then are that infinity. A box beside the line on an axis with d = 0 makes one side ∞ - ∞, a NaN, which
//! the comparison refuses.

use crate::aabb::{Aabb, exponent_of};
use crate::ray::Ray;
use hairline_core::arith::scale_by_power_of_two;

/// C of the proof: 16u.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// A ray in the scale of a tree.
pub struct TreeRay {
    origin: [f64; 3],
    reciprocal: [f64; 3],
    /// The plane at which the ray enters a slab: 0 for min, 1 for max.
    near_plane: [usize; 3],
    /// τ = t times 2 to this power.
    exponent: i32,
    start: f64,
    /// The end of the interval, or an upper bound on the nearest hit.
    end: f64,
}

impl TreeRay {
    /// A valid ray against boxes whose coordinates are multiplied by 2 to a power.
    pub fn new(ray: &Ray<f64>, scene_exponent: i32) -> TreeRay {
        let exponents = ray.direction.into_iter().filter_map(exponent_of);
        let longest = exponents.max().unwrap_or(0);
        let mut origin = [0.0; 3];
        let mut reciprocal = [0.0; 3];
        for axis in 0..3 {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            let scaled = scale_by_power_of_two(d, -longest);
            origin[axis] = scale_by_power_of_two(o, scene_exponent);
            reciprocal[axis] = if is_plain(o, origin[axis], d, scaled) {
                1.0 / scaled
            } else {
                f64::NAN
            };
        }
        let exponent = scene_exponent + longest;
        TreeRay {
            origin,
            reciprocal,
            near_plane: ray.direction.map(|x| usize::from(x.is_sign_negative())),
            exponent,
            start: -upper(-ray.t_min, exponent),
            end: upper(ray.t_max, exponent),
        }
    }

    /// From here on only hits up to t count.
    pub fn shorten(&mut self, t: f64) {
        self.end = self.end.min(upper(t, self.exponent));
    }

    /// A lower bound on τ of all points of the ray in a box; none if there are none.
    #[inline(always)]
    pub fn enters(&self, bounds: &Aabb) -> Option<f64> {
        let mut near = self.start;
        let mut far = self.end;
        let planes = [&bounds.min, &bounds.max];
        for axis in 0..3 {
            let at = |plane: f32| (f64::from(plane) - self.origin[axis]) * self.reciprocal[axis];
            let first = at(planes[self.near_plane[axis]][axis]);
            let last = at(planes[1 - self.near_plane[axis]][axis]);
            // A NaN is never taken.
            near = if first > near { first } else { near };
            far = if last < far { last } else { far };
        }
        let from = near - SLACK * near.abs();
        (from <= far + SLACK * far.abs()).then_some(from)
    }

    /// True if all points from this τ on are behind the end.
    #[inline(always)]
    pub fn ends_before(&self, from: f64) -> bool {
        self.end < from
    }
}

/// True if an axis is plain: its origin and direction, each as given and in the scale.
fn is_plain(o: f64, scaled_o: f64, d: f64, scaled_d: f64) -> bool {
    const LEAST_DIRECTION: f64 = power_of_two(-300);
    const LEAST_ORIGIN: f64 = power_of_two(-400);
    const LARGEST_ORIGIN: f64 = power_of_two(300);
    let size = scaled_o.abs();
    let origin_is_moderate = o == 0.0 || (LEAST_ORIGIN..=LARGEST_ORIGIN).contains(&size);
    d == 0.0 || (LEAST_DIRECTION <= scaled_d.abs() && origin_is_moderate)
}

/// 2 to a power within -1022 and 1023.
const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// At least t·2^exponent.
fn upper(t: f64, exponent: i32) -> f64 {
    let scaled = scale_by_power_of_two(t, exponent);
    let is_exact = scale_by_power_of_two(scaled, -exponent) == t;
    // An infinity that was finite is an upper bound already, or has the largest negative number above it.
    if is_exact { scaled } else { scaled.next_up() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn upper_bounds_are_above_what_underflows_and_near_it() {
        let tiny = f64::from_bits(1);
        assert_eq!(upper(3.0 * tiny, -1), 3.0 * tiny);
        assert_eq!(upper(tiny, -1), tiny);
        assert_eq!(upper(-tiny, -1), tiny);
        assert_eq!(upper(5.0 * tiny, -1), 3.0 * tiny);
        assert_eq!(upper(1.5, 700), 1.5 * 2f64.powi(700));
        assert_eq!(upper(1e300, 700), f64::INFINITY);
        assert_eq!(upper(-1e300, 700), f64::MIN);
        assert_eq!(upper(f64::NEG_INFINITY, -700), f64::NEG_INFINITY);
        assert_eq!(upper(f64::INFINITY, -700), f64::INFINITY);
    }
}

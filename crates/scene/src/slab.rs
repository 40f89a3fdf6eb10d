//! The box test of the tree, four boxes at a time in `f32`. It never loses a box that holds a point of the ray, for any finite
//! numbers.
//!
//! **Scale.** All happens in a scale of powers of two: positions are multiplied by 2^k, so that the largest coordinate of
//! the scene is in [1, 2), and the direction by 2^-e, so that its largest component is. From x = o + t·d follows
//! x·2^k = o·2^k + τ·(d·2^-e) with τ = t·2^(k+e). So boxes and τ know nothing of the sizes of the scene.
//!
//! **The origin is moved** along the line to about where that is nearest to 0: p = o + s·d, and σ = τ - s. So rays from far away lose
//! little by `f32`. With v = 2^-53 the sum is off by less than 4v(|o| + |s·d|), its last rounding included, and by less than 2^-126 where
//! something underflows. Both are added to it on one side and subtracted on the other, and the ends are rounded outwards: p is surely
//! between `f32` numbers. If s were beyond 2^60, it is 0.
//!
//! **Plain axes.** An axis is plain if the direction is 0 there, before it is scaled, or if |d| ≥ 2^-60 and the bounds of p are within 2^60. On an
//! axis that is not plain the test does not look: its reciprocal is NaN, no comparison with NaN holds, and so the axis bounds nothing.
//! That loses time and no box.
//!
//! **A plain axis with d ≠ 0.** A ray enters the slab through its near plane b at (b - p)/d, which is at least n = (b - p')/d with one of
//! the bounds p' of p, and it leaves through the far plane at f = (b - p'')/d at the latest, with the other bound. b and p' are `f32`
//! numbers; with u = 2^-24 the difference, the reciprocal and the product make of n a computed one that is off by less than 4u|n|, or
//! by 2^-150 where the product underflows. Nothing overflows: |b - p'| < 2^61 and |1/d| ≤ 2^60.
//!
//! **A plain axis with d = 0.** 1/d is an infinity. If p is between the planes, the near end is -∞ and the far end ∞, or
//! NaN where a bound of p is on a plane; neither bounds anything. If both bounds are outside the slab, both ends are the same infinity,
//! and no point of the line is in the box.
//!
//! **The test.** Let the ray have a point of the box at σ within [start, end]. The computed near end N is `start` or the
//! largest computed near plane, the far end F is `end` or the smallest computed far plane. Let n and f be the exact
//! numbers behind those two; then n ≤ σ ≤ f. `start` and `end` are rounded outwards, the planes are off by 5u|N| and 5u|F| and
//! 2^-149 at most, so with C = 16u
//!
//! N - (C|N| + 2^-126) ≤ n ≤ σ ≤ f ≤ F + (C|F| + 2^-126),
//!
//! where 16u covers three roundings of each side. An infinite N or F of a box that is met is -∞ or
//! ∞: both sides then are that infinity. A box beside the line on an axis with d = 0 makes one side ∞ - ∞, a
//! NaN, which the comparison refuses. So does a box without points, unless no axis is plain; no face is in it.

use crate::aabb::{Boxes, LANES, exponent_of};
use crate::ray::Ray;
use hairline_core::arith::scale_by_power_of_two;

/// C of the proof: 16u.
const SLACK: f32 = 8.0 * f32::EPSILON;

/// More than is lost by underflow: 2^-126.
const UNDERFLOW: f32 = f32::MIN_POSITIVE;

/// The largest number that is moved by, or of a bound of the origin.
const LARGEST: f64 = power_of_two(60);

/// A ray in the scale of a tree.
pub struct TreeRay {
    /// The origin by axis, as bounds: against near planes, and against far ones.
    origin: [[f32; 3]; 2],
    reciprocal: [f32; 3],
    /// The plane at which the ray enters a slab: 0 for min, 1 for max.
    near_plane: [usize; 3],
    /// τ = t times 2 to this power.
    exponent: i32,
    /// s: σ = τ - s.
    moved: f64,
    start: f32,
    /// The end of the interval, or an upper bound on the nearest hit.
    end: f32,
}

impl TreeRay {
    /// A valid ray against boxes whose coordinates are multiplied by 2 to a power.
    pub fn new(ray: &Ray<f64>, scene_exponent: i32) -> TreeRay {
        let exponents = ray.direction.into_iter().filter_map(exponent_of);
        let longest = exponents.max().unwrap_or(0);
        let direction = ray.direction.map(|x| scale_by_power_of_two(x, -longest));
        let position = ray.origin.map(|x| scale_by_power_of_two(x, scene_exponent));
        let moved = to_nearest(position, direction);
        let mut origin = [[0.0; 3]; 2];
        let mut reciprocal = [0.0; 3];
        for axis in 0..3 {
            let d = direction[axis];
            let step = moved * d;
            let sum = position[axis] + step;
            let error = 2.0 * f64::EPSILON * (position[axis].abs() + step.abs());
            let error = error + f64::from(UNDERFLOW);
            let [low, high] = [-above(-(sum - error)), above(sum + error)];
            let is_backward = ray.direction[axis].is_sign_negative();
            [origin[0][axis], origin[1][axis]] = match is_backward {
                true => [low, high],
                false => [high, low],
            };
            let is_moderate = sum.abs() + error <= LARGEST;
            let is_plain = is_moderate && power_of_two(-60) <= d.abs();
            reciprocal[axis] = match is_plain || ray.direction[axis] == 0.0 {
                true => (1.0 / d) as f32,
                false => f32::NAN,
            };
        }
        let exponent = scene_exponent + longest;
        TreeRay {
            origin,
            reciprocal,
            near_plane: ray.direction.map(|x| usize::from(x.is_sign_negative())),
            exponent,
            moved,
            start: -end(-ray.t_min, exponent, -moved),
            end: end(ray.t_max, exponent, moved),
        }
    }

    /// From here on only hits up to t count.
    pub fn shorten(&mut self, t: f64) {
        self.end = self.end.min(end(t, self.exponent, self.moved));
    }

    /// Which boxes the ray enters, and where.
    #[inline(always)]
    pub fn enters(&self, boxes: &Boxes) -> Entries {
        let mut near = [self.start; LANES];
        let mut far = [self.end; LANES];
        for axis in 0..3 {
            let near_planes = &boxes.planes[self.near_plane[axis]][axis];
            let far_planes = &boxes.planes[1 - self.near_plane[axis]][axis];
            let reciprocal = self.reciprocal[axis];
            let first = near_planes.map(|plane| (plane - self.origin[0][axis]) * reciprocal);
            let last = far_planes.map(|plane| (plane - self.origin[1][axis]) * reciprocal);
            // A NaN is never taken.
            near = lanes(|k| {
                if first[k] > near[k] {
                    first[k]
                } else {
                    near[k]
                }
            });
            far = lanes(|k| if last[k] < far[k] { last[k] } else { far[k] });
        }
        let from = near.map(|near| near - (SLACK * near.abs() + UNDERFLOW));
        let to = far.map(|far| far + (SLACK * far.abs() + UNDERFLOW));
        let bits = lanes(|k| u32::from(from[k] <= to[k]) << k);
        Entries {
            from,
            entered: bits[0] | bits[1] | bits[2] | bits[3],
        }
    }

    /// True if all points from this σ on are behind the end.
    #[inline(always)]
    pub fn ends_before(&self, from: f32) -> bool {
        self.end < from
    }
}

/// The boxes that a ray enters, one after the other.
pub struct Entries {
    /// Lower bounds on σ of all points of the ray in each box.
    pub from: [f32; LANES],
    /// A bit for each box that it enters and that is still to come.
    entered: u32,
}

impl Iterator for Entries {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let k = self.entered.trailing_zeros() as usize;
        self.entered &= self.entered.wrapping_sub(1);
        (k < LANES).then_some(k)
    }
}

#[inline(always)]
fn lanes<T>(of: impl Fn(usize) -> T) -> [T; LANES] {
    [of(0), of(1), of(2), of(3)]
}

/// s of about the point of a line that is nearest to 0; 0 if that is too far away.
fn to_nearest(position: [f64; 3], direction: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let moved = -dot(position, direction) / dot(direction, direction);
    match moved.abs() <= LARGEST {
        true => moved,
        false => 0.0,
    }
}

/// 2 to a power within -1022 and 1023.
const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// At least σ of a t.
fn end(t: f64, exponent: i32, moved: f64) -> f32 {
    above((upper(t, exponent) - moved).next_up())
}

/// The least `f32` that is at least x.
fn above(x: f64) -> f32 {
    let nearest = x as f32;
    match f64::from(nearest) < x {
        true => nearest.next_up(),
        false => nearest,
    }
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
    use crate::aabb::Aabb;
    use crate::rounded::rounded;
    use hairline_core::case::Draw;
    use num_rational::BigRational;
    use num_traits::Signed;

    /// x + t·y, exactly.
    fn sum(x: f64, t: f64, y: f64) -> BigRational {
        let [x, t, y] = [x, t, y].map(|x| BigRational::from_float(x).expect("a finite number"));
        x + t * y
    }

    /// A box around an exact point, as narrow as `f32` allows on most axes.
    fn around(point: &[BigRational; 3], draw: &mut Draw) -> Aabb {
        let bounds = point.each_ref().map(|x| {
            let near = rounded(x) as f32;
            let is_above = BigRational::from_float(near).is_some_and(|near| *x < near);
            let is_below = BigRational::from_float(near).is_some_and(|near| near < *x);
            let wider = draw.pick(&[0.0, 0.0, 1e-6, 0.5]);
            let min = if is_above { near.next_down() } else { near };
            let max = if is_below { near.next_up() } else { near };
            [min - wider, max + wider]
        });
        Aabb {
            min: bounds.map(|[min, _]| min),
            max: bounds.map(|[_, max]| max),
        }
    }

    #[test]
    fn no_box_that_holds_a_point_of_a_ray_is_lost() {
        let mut tried = 0;
        for index in 0..40_000 {
            let mut draw = Draw::new("slabs", 1, index);
            let coordinate = |draw: &mut Draw| {
                let size = draw.integer(-60, 0) as i32;
                let [any, unit]: [f64; 2] = [draw.with_exponent(size), draw.symmetric()];
                draw.pick(&[0.0, any, unit])
            };
            let target = [(); 3].map(|()| coordinate(&mut draw));
            let direction = [(); 3].map(|()| {
                let size = draw.pick(&[0, 0, -3, -40, -70]);
                let any: f64 = draw.with_exponent(size);
                draw.pick(&[0.0, -0.0, any, any, any])
            });
            let size = draw.pick(&[0, 0, 10, 40, 300]);
            let t = draw.with_exponent::<f64>(size).abs();
            let origin = [0, 1, 2].map(|i| target[i] - t * direction[i]);
            let ray = Ray::new(origin, direction);
            let ray = draw.pick(&[ray, ray.on(t, f64::INFINITY), ray.on(0.0, t)]);
            let Ok(ray) = ray.checked() else {
                continue;
            };
            let point = [0, 1, 2].map(|i| sum(origin[i], t, direction[i]));
            let two = BigRational::from_integer(2.into());
            if point.iter().any(|x| two < x.abs()) {
                continue;
            }
            let mut boxes = Boxes::EMPTY;
            let place = draw.below(LANES);
            boxes.set(place, &around(&point, &mut draw));
            // The tree's largest coordinate is in [1, 2): its scale is 1.
            let in_tree = TreeRay::new(&ray, 0);
            let entries = in_tree.enters(&boxes);
            let from = entries.from[place];
            assert_eq!(entries.collect::<Vec<_>>(), [place], "{ray:?} {boxes:?}");
            assert!(!in_tree.ends_before(from), "{ray:?}");
            tried += 1;
        }
        assert!(10_000 < tried, "{tried}");
    }

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

//! The first look at a face: in `f64`, each number with a bound on its error, for moderate numbers only.
//!
//! **Moderate.** All coordinates are 0 or within 2^-150 and 2^150; every `f32` is. Coordinates are then multiples of
//! 2^-202, so differences are 0 or at least 2^-202, products of three are 0 or at least 2^-606 and below 2^460: nothing
//! over- or underflows but a quotient, which has a term of its own.
//!
//! **Weights** (Möller and Trumbore 1997). With e = b-a, f = c-a and s = o-a the weights of b and c are s·(d×f) and
//! d·(s×e), and all three add up to e·(d×f). Each is a sum of six products of three numbers, each product with at most 7
//! roundings (two differences, a product, a difference, a product, two sums). It is therefore off by at most
//! ((1+u)^7 - 1)·6·|d|·|s|·|f| with the largest sizes of components, exact ones, which are computed ones within 1 ± u:
//! below 43u·|d||s||f|. The weight of a is a difference of all three, with 2 roundings more for two of them: below
//! 43u + 2·6u·(1 + 8u) < 56u of each product of sizes, and so is the difference of one weight and all three. All are below
//! 64u, which also covers the roundings of the bounds.
//!
//! **t = T/D** with N = e×f, T = N·(a-o) and D = N·d. D has 7 roundings, T has 8; in terms of the computed permanents (the
//! sums of absolute values, with as many roundings) the errors are below 8u and 16u, as in the filter of
//! `hairline_core`. With computed T̂, D̂, q = fl(T̂/D̂) and their errors, t is off from T̂/D̂ by at most
//! (T_error + |T̂/D̂|·D_error) / (|D̂| - D_error). Six roundings and those of q, below 16u relative, are added, for q and the
//! ends of the interval 4u·|q|, and 2^-1000 for a quotient that underflows.
//!
//! **Rounded vertices.** A mesh that a matrix puts into the world has vertices that are off by up to δ on each axis, so e, f, s
//! and a-o are off by 2δ more. All sizes above are then taken larger by E ≥ 1.5δ/u. A weight's six products of components below x
//! and y move by 12δ(x + y + 2δ) at most. Their bound grows by 64u·E(x + y + E), of which the roundings, as 56u, leave
//! 8u·E(x + y + E), and that is more. In D and T no rounding uses what E adds to the permanents, and 2δ ≤ 8u·E. A product
//! that underflows is off by some 2^-1074, which is nothing next to u·E² with E ≥ 2^-150.

use crate::bounds::Bounds;
use crate::mesh::Triangle;
use crate::ray::Ray;
use hairline_core::Facing;

const U: f64 = f64::EPSILON / 2.0;
/// More than a quotient loses by underflow: 2^-1000.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);

type Vector = [f64; 3];

/// How the line of a ray and a triangle surely meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sorted {
    /// Not at all.
    Misses,
    /// At one point inside the triangle.
    Crosses,
    /// The bounds do not tell.
    Unsure,
}

/// True if the filter's bounds hold for these numbers.
pub fn are_moderate(numbers: &[f64]) -> bool {
    const LEAST: f64 = f64::from_bits((1023 - 150) << 52);
    const MOST: f64 = f64::from_bits((1023 + 150) << 52);
    let is_moderate = |x: &f64| *x == 0.0 || (LEAST <= x.abs() && x.abs() <= MOST);
    numbers.iter().all(is_moderate)
}

/// Sorts a triangle by the signs of its weights. `direction_size` is the largest size of a component of the direction, and
/// `more` the E of rounded vertices.
#[inline(always)]
pub fn sort(ray: &Ray<f64>, direction_size: f64, [a, b, c]: &Triangle<f64>, more: f64) -> Sorted {
    let e = minus(b, a);
    let f = minus(c, a);
    let s = minus(&ray.origin, a);
    let p = cross(&ray.direction, &f);
    let all = dot(&e, &p);
    let weight_b = dot(&s, &p);
    let scale = 64.0 * U * direction_size;
    let (e_size, f_size, s_size) = (size(&e) + more, size(&f) + more, size(&s) + more);
    let error_b = scale * s_size * f_size;
    let error_all = scale * e_size * f_size;
    // Most faces are missed, and many are done here: the weight of b is surely less than nothing, or more than all.
    let (b_of_all, size_of_all) = if all < 0.0 {
        (-weight_b, -all)
    } else {
        (weight_b, all)
    };
    let is_outside = b_of_all < -error_b || error_b + error_all < b_of_all - size_of_all;
    if error_all < size_of_all && is_outside {
        return Sorted::Misses;
    }
    let weight_c = dot(&ray.direction, &cross(&s, &e));
    let weight_a = all - weight_b - weight_c;
    let error_c = scale * s_size * e_size;
    let error_a = error_b + error_c + error_all;
    let above =
        u8::from(error_a < weight_a) + u8::from(error_b < weight_b) + u8::from(error_c < weight_c);
    let below = u8::from(weight_a < -error_a)
        + u8::from(weight_b < -error_b)
        + u8::from(weight_c < -error_c);
    if 0 < above && 0 < below {
        Sorted::Misses
    } else if above == 3 || below == 3 {
        Sorted::Crosses
    } else {
        Sorted::Unsure
    }
}

/// The t at which a line meets the plane of a triangle, and the side from which; none if the line may be parallel, or if t
/// overflows. `more` is the E of rounded vertices.
#[inline(always)]
pub fn plane_t(ray: &Ray<f64>, [a, b, c]: &Triangle<f64>, more: f64) -> Option<(Bounds, Facing)> {
    let larger = |x: f64| x.abs() + more;
    let e = minus(b, a);
    let f = minus(c, a);
    let to_a = minus(a, &ray.origin);
    let normal = cross(&e, &f);
    let permanent = cross_permanent(&e.map(larger), &f.map(larger));
    let capital_d = dot(&ray.direction, &normal);
    let d_error = 8.0 * U * dot(&ray.direction.map(f64::abs), &permanent);
    let d_size = capital_d.abs();
    if d_size <= d_error {
        return None;
    }
    let capital_t = dot(&to_a, &normal);
    let t_error = 16.0 * U * dot(&to_a.map(larger), &permanent);
    let t = capital_t / capital_d;
    if t.is_infinite() {
        return None;
    }
    let error = (t_error + t.abs() * d_error) / (d_size - d_error);
    let error = error * (1.0 + 16.0 * U) + 4.0 * U * t.abs() + UNDERFLOW;
    let facing = if capital_d < 0.0 {
        Facing::Front
    } else {
        Facing::Back
    };
    let bounds = Bounds {
        lower: t - error,
        upper: t + error,
    };
    Some((bounds, facing))
}

#[inline(always)]
fn minus(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The cross product with sums, of vectors without a negative component.
#[inline(always)]
fn cross_permanent(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] + a[2] * b[1],
        a[2] * b[0] + a[0] * b[2],
        a[0] * b[1] + a[1] * b[0],
    ]
}

/// The largest size of a component.
#[inline(always)]
pub fn size(a: &Vector) -> f64 {
    a[0].abs().max(a[1].abs()).max(a[2].abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use hairline_core::case::Draw;
    use hairline_core::oracle::exact_values;
    use hairline_core::{Feature, Truth, truth};
    use num_rational::BigRational;

    /// A ray near the plane of a triangle but for rounding, its origin near a vertex; in every other case a little farther.
    fn drawn(draw: &mut Draw) -> (Ray<f64>, Triangle<f64>) {
        let [a, b, c]: [Vector; 3] = [(); 3].map(|()| draw.point());
        let near = 2f64.powi(-(draw.below(30) as i32));
        let mut along = |size: f64| {
            let [x, y] = [(); 2].map(|()| size * draw.symmetric::<f64>());
            [0, 1, 2].map(|i| x * (b[i] - a[i]) + y * (c[i] - a[i]))
        };
        let (step, mut direction) = (along(near), along(1.0));
        let lift = 2f64.powi(-(draw.below(50) as i32)) * draw.below(2) as f64;
        let aside: Vector = draw.point();
        direction = [0, 1, 2].map(|i| direction[i] + lift * aside[i]);
        let ray = Ray::new([0, 1, 2].map(|i| a[i] + step[i]), direction);
        (ray, [a, b, c])
    }

    #[test]
    fn what_is_sure_is_true_of_rays_that_all_but_lie_in_the_plane() {
        let (mut misses, mut crossings) = (0, 0);
        for index in 0..200_000 {
            let (ray, triangle) = drawn(&mut Draw::new("flat", 1, index));
            let direction = ray.direction;
            let Truth::Transversal(crossing) = truth(&ray.against(&triangle)) else {
                continue;
            };
            match sort(&ray, size(&direction), &triangle, 0.0) {
                Sorted::Misses => {
                    assert_eq!(crossing.feature, Feature::Outside, "{ray:?} {triangle:?}");
                    misses += 1;
                }
                Sorted::Crosses => {
                    assert_eq!(crossing.feature, Feature::Interior, "{ray:?} {triangle:?}");
                    crossings += 1;
                }
                Sorted::Unsure => {}
            }
        }
        assert!(1000 < misses && 100 < crossings, "{misses} {crossings}");
    }

    #[test]
    fn bounds_of_t_hold_t_in_all_sizes() {
        let (mut bounded, mut narrow) = (0, 0);
        for index in 0..20_000 {
            let mut draw = Draw::new("bounds", 1, index);
            let (ray, triangle) = drawn(&mut draw);
            // Every other one is moved far away, so that roundings are large.
            let [size, speed] = [(); 2].map(|()| 2f64.powi(draw.integer(-40, 40) as i32));
            let away: Vector = draw.point();
            let far = [0.0, 2f64.powi(draw.below(20) as i32)][draw.below(2)];
            let stretch = [(); 3].map(|()| 2f64.powi(-(draw.below(24) as i32)));
            let stretched = |v: Vector| [0, 1, 2].map(|i| stretch[i] * v[i]);
            let moved =
                |point: Vector| stretched([0, 1, 2].map(|i| size * (point[i] + far * away[i])));
            let direction = stretched(ray.direction.map(|x| speed * x));
            let ray = Ray::new(moved(ray.origin), direction);
            let triangle = triangle.map(moved);
            let case = ray.against(&triangle).on(f64::NEG_INFINITY, f64::INFINITY);
            let truth = truth(&case);
            let Some((bounds, facing)) = plane_t(&ray, &triangle, 0.0) else {
                continue;
            };
            let Truth::Transversal(crossing) = truth else {
                panic!("{ray:?} {triangle:?}");
            };
            assert_eq!(facing, crossing.facing, "{ray:?} {triangle:?}");
            let t = exact_values(&case, &truth).t.expect("a crossing");
            let float = |x: f64| BigRational::from_float(x).expect("a finite bound");
            assert!(float(bounds.lower) <= t, "{ray:?} {triangle:?}");
            assert!(t <= float(bounds.upper), "{ray:?} {triangle:?}");
            bounded += 1;
            narrow += u32::from(bounds.upper - bounds.lower < 1e-3 * bounds.upper.abs());
        }
        assert!(10_000 < bounded && 2_000 < narrow, "{bounded} {narrow}");
    }
}

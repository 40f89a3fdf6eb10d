//! `tinybvh` and `bvh`: the boxes of two libraries.
//!
//! Sources: J. Bikker, tinybvh (2026), `tinybvh_intersect_aabb` and `tinybvh_safercp`: a reciprocal beyond 2^100 (in `f64`
//! 2^1000) is that number with the sign of the component, minima and maxima are `a < b ? a : b` and `a > b ? a : b`.
//! `tinybvh-1e30` is that of 2024 and 2025: the reciprocal of a component below 1e-12 is 1e30, whatever its sign. The Rust crate
//! bvh (2026), `RayIntersection::ray_intersects_aabb`: a miss if any t is NaN, and a hit if far >= max(near, 0). Both
//! libraries make the direction a unit vector first; here it is used as it is given.

use super::growth::{AT_MOST, Comparison, compare};
use super::numbers::*;
use super::*;

pub struct TinyBvh;
pub struct TinyBvh1e30;
pub struct Bvh;

/// The gate of the ray's ends, or of a NaN.
const FIXED: usize = 1;

const TINY_BVH_GATES: &[Gate] = &[
    AT_MOST,
    Gate::fixed(Role::T, "!(near < t_max && far >= t_min)"),
];

impl Kernel<Boxes> for TinyBvh {
    const INFO: KernelInfo = info(
        "tinybvh",
        "J. Bikker, tinybvh, tinybvh_intersect_aabb, https://github.com/jbikker/tinybvh, 2026",
        contract(Extent::Interval, Boundary::Free),
        TINY_BVH_GATES,
        PLAIN[1],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        tiny_bvh(bounds, ray, limited_reciprocal, sink)
    }
}

impl Kernel<Boxes> for TinyBvh1e30 {
    const INFO: KernelInfo = info(
        "tinybvh-1e30",
        "J. Bikker, tinybvh, tinybvh_intersect_aabb, https://github.com/jbikker/tinybvh, 2024 and 2025",
        contract(Extent::Interval, Boundary::Free),
        TINY_BVH_GATES,
        PLAIN[1],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        tiny_bvh(bounds, ray, safe_reciprocal, sink)
    }
}

#[inline(always)]
fn tiny_bvh<V: Vector, S: Sink<V::Real>>(
    bounds: &Bounds<V>,
    ray: &Ray<V>,
    reciprocal: fn(V::Real) -> V::Real,
    sink: &mut S,
) -> Option<Hit<V::Real>> {
    let [x, y, z] = each_axis(|i| {
        let axis = Axis {
            origin: ray.origin.at(i),
            direction: reciprocal(ray.direction.at(i)),
        };
        let slab = turned::<Multiplied, V>(bounds, &axis, i, false);
        slab.sorted(minps, maxps)
    });
    let both = x.and(y, maxps, minps);
    let Slab { near, far } = both.and(z, maxps, minps);
    compare(sink, Comparison::AtMost, &near, &far)?;
    let starts_before_the_end = near.is_less(&ray.t_max);
    let ends_after_the_start = ray.t_min.is_at_most(&far);
    sink.fixed(FIXED, starts_before_the_end && ends_after_the_start)?;
    Some(Hit::at(near))
}

/// The reciprocal, or of what is too near 0 a large number with its sign.
#[inline(always)]
fn limited_reciprocal<R: Real>(direction: R) -> R {
    let is_negative = direction.is_sign_negative();
    let reciprocal = R::one() / direction;
    let mut most = R::number(f64::from_bits((1023 + 1000) << 52));
    if !most.is_less(&R::infinity()) {
        most = R::number(f64::from_bits((1023 + 100) << 52));
    }
    if reciprocal.abs().is_at_most(&most) {
        return reciprocal;
    }
    if is_negative { -most } else { most }
}

/// The reciprocal, or 1e30 of what is too near 0.
#[inline(always)]
fn safe_reciprocal<R: Real>(direction: R) -> R {
    if R::number(1e-12).is_less(&direction.abs()) {
        R::one() / direction
    } else {
        R::number(1e30)
    }
}

impl Kernel<Boxes> for Bvh {
    const INFO: KernelInfo = info(
        "bvh",
        "Rust crate bvh, RayIntersection::ray_intersects_aabb, https://github.com/svenstaro/bvh, 2026",
        contract(Extent::Ray, Boundary::Closed),
        &[AT_MOST, Gate::fixed(Role::Other, "any t is NaN")],
        PLAIN[1],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let slabs = each_axis(|i| unsorted::<Multiplied, V>(bounds, ray, i));
        let has_nan = |slab: &Slab<V::Real>| slab.near.is_nan() || slab.far.is_nan();
        sink.fixed(FIXED, !slabs.iter().any(has_nan))?;
        let [x, y, z] = slabs.map(|slab| slab.sorted(minps, maxps));
        let both = x.and(y, maxps, minps);
        let Slab { near, far } = both.and(z, maxps, minps);
        let near = maxps(near, V::Real::zero());
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
    }
}

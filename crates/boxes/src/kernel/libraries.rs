//! `tinybvh` and `bvh`: the boxes of two libraries.
//!
//! Sources: J. Bikker, tinybvh, `tinybvh_intersect_aabb`: the reciprocal of a component below 1e-12 is 1e30, minima and
//! maxima are `a < b ? a : b` and `a > b ? a : b`. The Rust crate bvh, `Ray::intersects_aabb` on nalgebra: componentwise
//! `a <= b ? a : b` and `a >= b ? a : b`, then `f32::max` and `f32::min`, and a hit only if far is above near, so that a
//! flat box is missed.

use super::growth::{AT_MOST, BELOW, Comparison, compare};
use super::numbers::*;
use super::*;

pub struct TinyBvh;
pub struct Bvh;

const END: usize = 1;

impl Kernel<Boxes> for TinyBvh {
    const INFO: KernelInfo = info(
        "tinybvh",
        "J. Bikker, tinybvh, tinybvh_intersect_aabb, https://github.com/jbikker/tinybvh",
        contract(Extent::Interval, Boundary::Free),
        &[
            AT_MOST,
            Gate::fixed(Role::T, "!(near < t_max && far >= t_min)"),
        ],
        PLAIN[1],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [x, y, z] = each_axis(|i| {
            let axis = Axis {
                origin: ray.origin.at(i),
                direction: safe_reciprocal(ray.direction.at(i)),
            };
            let slab = turned::<Multiplied, V>(bounds, &axis, i, false);
            slab.sorted(minps, maxps)
        });
        let both = x.and(y, maxps, minps);
        let Slab { near, far } = both.and(z, maxps, minps);
        compare(sink, Comparison::AtMost, &near, &far)?;
        let starts_before_the_end = near.is_less(&ray.t_max);
        let ends_after_the_start = ray.t_min.is_at_most(&far);
        sink.fixed(END, starts_before_the_end && ends_after_the_start)?;
        Some(Hit::at(near))
    }
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
        "Rust crate bvh, Ray::intersects_aabb, https://docs.rs/bvh",
        contract(Extent::Ray, Boundary::Free),
        &[BELOW],
        PLAIN[0],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [x, y, z] = each_axis(|i| {
            let slab = unsorted::<Multiplied, V>(bounds, ray, i);
            slab.sorted(meet, join)
        });
        let both = x.and(y, fmax, fmin);
        let Slab { near, far } = both.and(z, fmax, fmin);
        let near = fmax(near, V::Real::zero());
        compare(sink, Comparison::Below, &near, &far)?;
        Some(Hit::at(near))
    }
}

/// `a <= b ? a : b`.
#[inline(always)]
fn meet<R: Real>(a: R, b: R) -> R {
    if a.is_at_most(&b) { a } else { b }
}

/// `a >= b ? a : b`.
#[inline(always)]
fn join<R: Real>(a: R, b: R) -> R {
    if b.is_at_most(&a) { a } else { b }
}

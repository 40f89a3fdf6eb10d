//! `pbrt`, `pbrt-precomputed`, `embree-fast`, `embree-robust` and `aila-laine`: the boxes of ray tracers' hierarchies.
//!
//! Sources: pbrt-v3 and pbrt-v4, `Bounds3::IntersectP`, both overloads: each axis's far t is multiplied by
//! 1 + 2·gamma(3), gamma(3) = 3u / (1 - 3u), which rounds to `1 + 3*EPSILON`. Intel Embree, node intersectors: the
//! fast one computes b·rdir - org·rdir with fused operations, the robust one (b - org)·rdir, and compares
//! (1 - 2ulp)·near with (1 + 2ulp)·far; both replace components of the direction below 1e-18 by 1e-18. Embree's
//! reciprocal is an estimate with a Newton step; here it is rounded correctly. T. Aila and S. Laine, "Understanding the
//! Efficiency of Ray Traversal on GPUs", HPG 2009, kernels: fused operations, directions kept from 0 by 2^-80.

use super::growth::{AT_MOST, Comparison, GROWTH, NOT_ABOVE, compare, everything, grown};
use super::numbers::*;
use super::pairwise::{by_reciprocal, overlapping};
use super::*;
use std::mem;

pub struct Pbrt;
pub struct PbrtPrecomputed;
pub struct EmbreeFast;
pub struct EmbreeRobust;
pub struct AilaLaine;

const END: usize = 1;

impl Kernel<Boxes> for Pbrt {
    const INFO: KernelInfo = info(
        "pbrt",
        "M. Pharr, W. Jakob and G. Humphreys, pbrt-v3 and pbrt-v4, Bounds3::IntersectP(ray, hitt0, hitt1)",
        contract(Extent::Interval, Boundary::Closed),
        &[NOT_ABOVE, Gate::fixed(Role::T, "near > t_max")],
        &[EpsilonSet {
            name: "source",
            values: &["-3*EPSILON", "0"],
        }],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let mut near = ray.t_min.clone();
        let mut fars = Vec::with_capacity(3);
        for i in 0..3 {
            let mut slab = unsorted::<Multiplied, V>(bounds, ray, i);
            if slab.far.is_less(&slab.near) {
                mem::swap(&mut slab.near, &mut slab.far);
            }
            near = near.larger(slab.near);
            // `far = last < far ? last : far` leaves a NaN out.
            if !slab.far.is_nan() {
                fars.push(slab.far);
            }
            for far in &fars {
                compare(sink, Comparison::NotAbove, &near, far)?;
            }
            let is_beyond = ray.t_max.is_less(&near);
            sink.fixed(END, !is_beyond)?;
        }
        Some(Hit::at(near))
    }
}

impl Kernel<Boxes> for PbrtPrecomputed {
    const INFO: KernelInfo = info(
        "pbrt-precomputed",
        "M. Pharr, W. Jakob and G. Humphreys, pbrt-v3 and pbrt-v4, Bounds3::IntersectP(ray, invDir, dirIsNeg)",
        contract(Extent::Interval, Boundary::Open),
        &[
            NOT_ABOVE,
            Gate::fixed(Role::T, "!(near < t_max && far > t_min)"),
        ],
        &[EpsilonSet {
            name: "source",
            values: &["-3*EPSILON", "0"],
        }],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [x, y, z] = each_axis(|i| by_reciprocal(bounds, ray, i));
        overlapping(x, [y, z], ray, sink)
    }
}

/// A direction away from 0, as Embree keeps it: the least number is positive whatever the sign.
#[inline(always)]
fn zero_fixed<R: Real>(direction: R) -> R {
    let least = R::number(1e-18);
    if direction.abs().is_less(&least) {
        least
    } else {
        direction
    }
}

/// The ends of what the ray and the box have in common, in Embree's order.
#[inline(always)]
fn embree<A: Formula, V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>) -> Slab<V::Real> {
    let [x, y, z] = each_axis(|i| {
        let direction = zero_fixed(ray.direction.at(i));
        let axis = A::prepare(ray.origin.at(i), direction);
        let is_forward = V::Real::zero().is_at_most(&axis.direction);
        turned::<A, V>(bounds, &axis, i, !is_forward)
    });
    let ends = z.and(interval(ray), maxps, minps);
    x.and(y, maxps, minps).and(ends, maxps, minps)
}

impl Kernel<Boxes> for EmbreeFast {
    const INFO: KernelInfo = info(
        "embree-fast",
        "Intel Embree, intersectNode with AVX2: b*rdir - org*rdir, fused",
        contract(Extent::Interval, Boundary::Closed),
        &[AT_MOST],
        PLAIN[0],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let common = embree::<Fused, V>(bounds, ray);
        common.hit(sink, Comparison::AtMost)
    }
}

impl Kernel<Boxes> for EmbreeRobust {
    const INFO: KernelInfo = info(
        "embree-robust",
        "Intel Embree, intersectNodeRobust: (b - org)*rdir, and (1 - 2ulp)*near <= (1 + 2ulp)*far",
        contract(Extent::Interval, Boundary::Closed),
        &[Gate::signed(Role::Edge, "!((1 + e)*near <= (1 - e)*far)", 0, 0).named("growth")],
        &[EpsilonSet {
            name: "source",
            values: &["-2*EPSILON"],
        }],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let Slab { near, far } = embree::<Multiplied, V>(bounds, ray);
        let accepts = |epsilon: &V::Real| {
            let near = grown(&near, &-epsilon.clone());
            near.is_at_most(&grown(&far, epsilon))
        };
        sink.rounded(GROWTH, accepts, || both_grown(&near, &far))?;
        Some(Hit::at(near))
    }
}

/// The largest epsilon at which `(1 + e)·near <= (1 - e)·far` without rounding.
fn both_grown<R: Real>(near: &R, far: &R) -> R {
    let zero = R::zero();
    let sum = near.clone() + far;
    let is_behind = near.is_less(&zero) || far.is_less(&zero);
    if is_behind || !zero.is_less(&sum) {
        return everything(near.is_at_most(far));
    }
    let share = (far.clone() - near) / &sum;
    if share.is_nan() {
        Comparison::AtMost.threshold(near, far)
    } else {
        share
    }
}

impl Kernel<Boxes> for AilaLaine {
    const INFO: KernelInfo = info(
        "aila-laine",
        "T. Aila and S. Laine, Understanding the Efficiency of Ray Traversal on GPUs, HPG 2009, kernels of 2012 \
         (NVIDIA Technical Report NVR-2012-02)",
        contract(Extent::Interval, Boundary::Closed),
        &[AT_MOST],
        PLAIN[0],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let mut common = interval(ray);
        for i in 0..3 {
            let direction = kept_from_zero(ray.direction.at(i));
            let axis = Fused::prepare(ray.origin.at(i), direction);
            let slab = turned::<Fused, V>(bounds, &axis, i, false);
            let sorted = slab.sorted(fmin, fmax);
            common = sorted.and(common, fmax, fmin);
        }
        common.hit(sink, Comparison::AtMost)
    }
}

/// A direction of at least 2^-80, with its sign.
#[inline(always)]
fn kept_from_zero<R: Real>(direction: R) -> R {
    let least = R::number(f64::from_bits((1023 - 80) << 52));
    if least.is_less(&direction.abs()) {
        return direction;
    }
    if direction.is_sign_negative() {
        -least
    } else {
        least
    }
}

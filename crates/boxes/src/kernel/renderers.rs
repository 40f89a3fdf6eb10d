//! `pbrt`, `pbrt-precomputed`, `embree-fast`, `embree-robust` and `aila-laine`: the boxes of ray tracers' hierarchies.
//!
//! Sources: pbrt-v3 and pbrt-v4, `Bounds3::IntersectP`, both overloads: each axis's far t is multiplied by
//! 1 + 2·gamma(3), gamma(3) = 3u / (1 - 3u), which rounds to `1 + 3*EPSILON`. Intel Embree, node intersectors: the
//! fast one computes b·rdir - org·rdir with fused operations; the robust one, of Embree 3 and 4 (`TravRayBase<N, true>`),
//! (b - org)·((1 - 3ulp)·rdir) at near planes and (b - org)·((1 + 3ulp)·rdir) at far ones. Both replace components of the
//! direction below 1e-18 by 1e-18. The fast one's reciprocal is an estimate with a Newton step; here it is rounded
//! correctly. T. Aila and S. Laine, "Understanding the
//! Efficiency of Ray Traversal on GPUs", HPG 2009, kernels: fused operations, directions kept from 0 by 2^-80.

use super::growth::{AT_MOST, Comparison, GROWTH, NOT_ABOVE, compare, everything};
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
        "Intel Embree 3 and 4, intersectNodeRobust: (b - org)*rdir_near and (b - org)*rdir_far, \
         https://github.com/RenderKit/embree",
        contract(Extent::Interval, Boundary::Closed),
        &[Gate::signed(
            Role::Edge,
            "!(near*(1 + e) <= far*(1 - e)), in the reciprocals",
            0,
            0,
        )
        .named("growth")],
        &[EpsilonSet {
            name: "source",
            values: &["-3*EPSILON"],
        }],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let accepts = |epsilon: &V::Real| {
            let Slab { near, far } = robust(bounds, ray, epsilon);
            near.is_at_most(&far)
        };
        sink.rounded(GROWTH, accepts, || reciprocals_grown(bounds, ray))?;
        Some(Hit::at(robust(bounds, ray, &V::Real::zero()).near))
    }
}

/// The ends of what the ray and the box have in common, with an epsilon in the reciprocals.
#[inline(always)]
fn robust<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>, epsilon: &V::Real) -> Slab<V::Real> {
    let [x, y, z] = each_axis(|i| robust_slab(bounds, ray, i, epsilon));
    let ends = z.and(interval(ray), maxps, minps);
    x.and(y, maxps, minps).and(ends, maxps, minps)
}

/// One slab. A t below 0 is left as it is, and an epsilon beyond one half counts as one half: so a larger epsilon never
/// accepts more. Neither matters to a ray with t_min >= 0 and an epsilon that anybody would choose.
#[inline(always)]
fn robust_slab<V: Vector>(
    bounds: &Bounds<V>,
    ray: &Ray<V>,
    i: usize,
    epsilon: &V::Real,
) -> Slab<V::Real> {
    let zero = V::Real::zero();
    let half = V::Real::number(0.5);
    let epsilon = epsilon.clone().smaller(half.clone()).larger(-half);
    let reciprocal = V::Real::one() / zero_fixed(ray.direction.at(i));
    let is_forward = zero.is_at_most(&reciprocal);
    let (min, max) = (bounds.min.at(i), bounds.max.at(i));
    let (entry, exit) = if is_forward { (min, max) } else { (max, min) };
    let origin = ray.origin.at(i);
    let to_entry = entry - &origin;
    let to_exit = exit - &origin;
    let near = to_entry.clone() * &reciprocal;
    let far = to_exit.clone() * &reciprocal;
    let shorter = (V::Real::one() + &epsilon) * &reciprocal;
    let longer = (V::Real::one() - &epsilon) * &reciprocal;
    Slab {
        near: if near.is_less(&zero) {
            near
        } else {
            to_entry * &shorter
        },
        far: if far.is_less(&zero) {
            far
        } else {
            to_exit * &longer
        },
    }
}

/// The largest epsilon at which the robust test accepts, without rounding: where (1 + e)·near <= (1 - e)·far,
/// (1 + e)·near <= t_max and t_min <= (1 - e)·far.
fn reciprocals_grown<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>) -> V::Real {
    let (zero, one) = (V::Real::zero(), V::Real::one());
    let plain = |i: usize| robust_slab(bounds, ray, i, &zero);
    let both = plain(0).and(plain(1), maxps, minps);
    let Slab { near, far } = both.and(plain(2), maxps, minps);
    let common = Slab {
        near: near.clone(),
        far: far.clone(),
    };
    let Slab {
        near: start,
        far: end,
    } = common.and(interval(ray), maxps, minps);
    if far.is_less(&zero) || ray.t_max.is_less(&ray.t_min) {
        return everything(start.is_at_most(&end));
    }
    let mut most = one.clone() - ray.t_min.clone() / &far;
    if zero.is_less(&near) {
        most = most.smaller(ray.t_max.clone() / &near - &one);
        most = most.smaller((far.clone() - &near) / (far + &near));
    }
    let half = V::Real::number(0.5);
    if most.is_nan() {
        return everything(start.is_at_most(&end));
    }
    if half.is_at_most(&most) {
        return everything(true);
    }
    if most.is_less(&-half) {
        return everything(false);
    }
    most
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

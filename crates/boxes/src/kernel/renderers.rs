//! `pbrt`, `pbrt-precomputed`, `embree-fast`, `embree-robust` and `aila-laine`: the boxes of ray tracers' hierarchies.
//!
//! Sources: pbrt-v3 and pbrt-v4, `Bounds3::IntersectP`, both overloads: each axis's far t is multiplied by
//! 1 + 2·gamma(3), gamma(3) = 3u / (1 - 3u), which rounds to `1 + 3*EPSILON`. Intel Embree, node intersectors: the
//! fast one computes b·rdir - org·rdir with fused operations, the robust one (b - org)·rdir, and compares
//! (1 - 2ulp)·near with (1 + 2ulp)·far; both replace components of the direction below 1e-18 by 1e-18. Embree's
//! reciprocal is an estimate with a Newton step; here it is rounded correctly. T. Aila and S. Laine, "Understanding the
//! Efficiency of Ray Traversal on GPUs", HPG 2009, kernels: fused operations, directions kept from 0 by 2^-80.

use super::branchless::planes;
use super::growth::{AT_MOST, Comparison, GROWTH, NOT_ABOVE, compare, everything, grown};
use super::numbers::{Axis, Formula, Multiplied, axis, fmax, fmin, maxps, minps};
use super::{PLAIN, contract, info};
use crate::case::{Bounds, Boxes};
use hairline_core::arith::{Real, Vector};
use hairline_core::{Boundary, EpsilonSet, Extent, Gate, Hit, Kernel, KernelInfo, Ray, Role, Sink};

pub(super) struct Pbrt;
pub(super) struct PbrtPrecomputed;
pub(super) struct EmbreeFast;
pub(super) struct EmbreeRobust;
pub(super) struct AilaLaine;

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
        let mut fars: Vec<V::Real> = Vec::with_capacity(3);
        for i in 0..3 {
            let [first, last] = planes::<Multiplied, V>(bounds, ray, i);
            let is_turned = last.is_less(&first);
            let [first, last] = if is_turned {
                [last, first]
            } else {
                [first, last]
            };
            near = near.larger(first);
            // `far = last < far ? last : far` leaves a NaN out.
            if !last.is_nan() {
                fars.push(last);
            }
            for far in &fars {
                compare(sink, Comparison::NotAbove, &near, far)?;
            }
            sink.fixed(END, !ray.t_max.is_less(&near))?;
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
        let slabs = [0, 1, 2].map(|i| {
            let axis = axis::<Multiplied, V>(ray, i);
            let [min, max] = [bounds.min.at(i), bounds.max.at(i)];
            let is_backward = axis.direction.is_less(&V::Real::zero());
            let [near, far] = if is_backward { [max, min] } else { [min, max] };
            [Multiplied::t(&axis, near), Multiplied::t(&axis, far)]
        });
        let [[mut near, mut far], y, z] = slabs;
        for [first, last] in [y, z] {
            compare(sink, Comparison::NotAbove, &near, &last)?;
            compare(sink, Comparison::NotAbove, &first, &far)?;
            near = near.larger(first);
            far = far.smaller(last);
        }
        sink.fixed(END, near.is_less(&ray.t_max) && ray.t_min.is_less(&far))?;
        Some(Hit::at(near))
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

/// The t of the planes of an axis by Embree, near and far by the sign of the reciprocal.
#[inline(always)]
fn embree_planes<V: Vector>(
    bounds: &Bounds<V>,
    ray: &Ray<V>,
    i: usize,
    t: fn(&Axis<V::Real>, V::Real) -> V::Real,
) -> [V::Real; 2] {
    let axis = Axis {
        origin: ray.origin.at(i),
        direction: V::Real::one() / zero_fixed(ray.direction.at(i)),
    };
    let is_forward = V::Real::zero().is_at_most(&axis.direction);
    let [min, max] = [bounds.min.at(i), bounds.max.at(i)];
    let [near, far] = if is_forward { [min, max] } else { [max, min] };
    [t(&axis, near), t(&axis, far)]
}

/// `b·rdir - org·rdir`, the second product rounded.
#[inline(always)]
fn fused_t<R: Real>(axis: &Axis<R>, plane: R) -> R {
    let product = axis.origin.clone() * &axis.direction;
    R::fused(&plane, &axis.direction, &-product.clone())
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
        let [x, y, z] = [0, 1, 2].map(|i| embree_planes(bounds, ray, i, fused_t));
        let [near, far] = embree_ends(ray, [x, y, z]);
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
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
        let [x, y, z] = [0, 1, 2].map(|i| embree_planes(bounds, ray, i, Multiplied::t));
        let [near, far] = embree_ends(ray, [x, y, z]);
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
    if near.is_less(&zero) || far.is_less(&zero) || !zero.is_less(&sum) {
        return everything(near.is_at_most(far));
    }
    let share = (far.clone() - near) / &sum;
    if share.is_nan() {
        Comparison::AtMost.threshold(near, far)
    } else {
        share
    }
}

/// The ends of the common range, in Embree's order.
#[inline(always)]
fn embree_ends<V: Vector>(ray: &Ray<V>, [x, y, z]: [[V::Real; 2]; 3]) -> [V::Real; 2] {
    let [[near_x, far_x], [near_y, far_y], [near_z, far_z]] = [x, y, z];
    let near = maxps(maxps(near_x, near_y), maxps(near_z, ray.t_min.clone()));
    let far = minps(minps(far_x, far_y), minps(far_z, ray.t_max.clone()));
    [near, far]
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
        let [mut near, mut far] = [ray.t_min.clone(), ray.t_max.clone()];
        for i in 0..3 {
            let axis = Axis {
                origin: ray.origin.at(i),
                direction: V::Real::one() / kept_from_zero(ray.direction.at(i)),
            };
            let low = fused_t(&axis, bounds.min.at(i));
            let high = fused_t(&axis, bounds.max.at(i));
            near = fmax(fmin(low.clone(), high.clone()), near);
            far = fmin(fmax(low, high), far);
        }
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
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

//! `padded-box`: the division test on a box that is grown on all sides before the ray is seen.
//!
//! Source: common practice, such as a bounding box that is padded by a constant when a hierarchy is built. The epsilon is
//! the padding with the sign turned, a length: raising it makes the box smaller. Its margin on a case is the greatest
//! epsilon at which the box is met, so the negative of the least padding.

use super::growth::GROWTH;
use super::numbers::{Divided, Formula, axis, maxps, minps};
use super::{contract, info};
use crate::case::{Bounds, Boxes};
use hairline_core::arith::{Real, Vector};
use hairline_core::{Boundary, EpsilonSet, Extent, Gate, Hit, Kernel, KernelInfo, Ray, Role, Sink};

pub(super) struct PaddedBox;

impl Kernel<Boxes> for PaddedBox {
    const INFO: KernelInfo = info(
        "padded-box",
        "a box padded by a constant before the test with (b - o) / d",
        contract(Extent::Interval, Boundary::Closed),
        &[Gate::signed(Role::Edge, "misses [min + e, max - e]", 1, 0).named("padding")],
        &[EpsilonSet {
            name: "zero",
            values: &["0"],
        }],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        sink.rounded(
            GROWTH,
            |epsilon| ends(bounds, ray, epsilon).is_some(),
            || threshold(bounds, ray),
        )?;
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    }
}

/// The near and the far end on the box that an epsilon leaves, if they are in order.
#[inline(always)]
fn ends<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>, epsilon: &V::Real) -> Option<[V::Real; 2]> {
    let [mut near, mut far] = [ray.t_min.clone(), ray.t_max.clone()];
    for i in 0..3 {
        let min = bounds.min.at(i) + epsilon;
        let max = bounds.max.at(i) - epsilon;
        let axis = axis::<Divided, V>(ray, i);
        if axis.direction.is_zero() {
            if axis.origin.is_less(&min) || max.is_less(&axis.origin) {
                return None;
            }
            continue;
        }
        let is_backward = axis.direction.is_sign_negative();
        let [first, last] = if is_backward { [max, min] } else { [min, max] };
        near = maxps(Divided::t(&axis, first), near);
        far = minps(Divided::t(&axis, last), far);
    }
    near.is_at_most(&far).then_some([near, far])
}

/// The greatest epsilon without rounding: the least of what each pair of conditions allows.
///
/// With near, far and size as in the truth's filter, the line enters slab i before it leaves slab j if
/// (near_i + e)/size_i <= (far_j - e)/size_j, so e <= (far_j·size_i - near_i·size_j) / (size_i + size_j).
fn threshold<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>) -> V::Real {
    let zero = V::Real::zero();
    let mut least = V::Real::infinity();
    let mut slabs = Vec::with_capacity(3);
    for i in 0..3 {
        let direction = ray.direction.at(i);
        let from_min = bounds.min.at(i) - ray.origin.at(i);
        let from_max = bounds.max.at(i) - ray.origin.at(i);
        if direction.is_zero() {
            least = least.smaller(from_max).smaller(-from_min);
        } else if zero.is_less(&direction) {
            slabs.push([from_min, from_max, direction]);
        } else {
            slabs.push([-from_max, -from_min, -direction]);
        }
    }
    for [near, far, size] in &slabs {
        for [_, other_far, other_size] in &slabs {
            let both = other_far.clone() * size - near.clone() * other_size;
            least = least.smaller(both / (size.clone() + other_size));
        }
        least = least.smaller(ray.t_max.clone() * size - near);
        least = least.smaller(far.clone() - ray.t_min.clone() * size);
    }
    least
}

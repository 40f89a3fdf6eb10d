//! `padded-box`: the division test on a box that is grown on all sides before the ray is seen.
//!
//! Source: common practice, such as a bounding box that is padded by a constant when a hierarchy is built. The epsilon is
//! the padding with the sign turned, a length: raising it makes the box smaller. Its margin on a case is the greatest
//! epsilon at which the box is met, so the negative of the least padding.

use super::growth::GROWTH;
use super::numbers::*;
use super::*;

pub struct PaddedBox;

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
            |epsilon| meets(bounds, ray, epsilon),
            || threshold(bounds, ray),
        )?;
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    }
}

/// True if the ray meets the box that an epsilon leaves.
#[inline(always)]
fn meets<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>, epsilon: &V::Real) -> bool {
    let mut common = interval(ray);
    let all = V::new(epsilon.clone(), epsilon.clone(), epsilon.clone());
    let padded = Bounds {
        min: bounds.min.plus(&all),
        max: bounds.max.minus(&all),
    };
    for i in 0..3 {
        let origin = ray.origin.at(i);
        if ray.direction.at(i).is_zero() {
            if padded.is_beside(i, &origin) {
                return false;
            }
            continue;
        }
        let slab = crossed::<Divided, V>(&padded, ray, i);
        common = slab.and(common, maxps, minps);
    }
    common.near.is_at_most(&common.far)
}

/// The greatest epsilon without rounding: the least of what each pair of conditions allows.
///
/// With near, far and size as in the truth's filter, the line enters slab i before it leaves slab j if
/// (near_i + e)/size_i <= (far_j - e)/size_j, so e <= (far_j·size_i - near_i·size_j) / (size_i + size_j).
fn threshold<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>) -> V::Real {
    let mut least = V::Real::infinity();
    let mut slabs = Vec::with_capacity(3);
    for i in 0..3 {
        let origin = ray.origin.at(i);
        let size = ray.direction.at(i);
        let from_min = bounds.min.at(i) - &origin;
        let from_max = bounds.max.at(i) - &origin;
        if size.is_zero() {
            least = least.smaller(from_max);
            least = least.smaller(-from_min);
        } else if size.is_less(&V::Real::zero()) {
            slabs.push([-from_max, -from_min, -size]);
        } else {
            slabs.push([from_min, from_max, size]);
        }
    }
    for [near, far, size] in &slabs {
        for [_, other_far, other_size] in &slabs {
            let leaves = other_far.clone() * size;
            let enters = near.clone() * other_size;
            let sizes = size.clone() + other_size;
            least = least.smaller((leaves - enters) / sizes);
        }
        let end = ray.t_max.clone() * size;
        least = least.smaller(end - near);
        let start = ray.t_min.clone() * size;
        least = least.smaller(far.clone() - start);
    }
    least
}

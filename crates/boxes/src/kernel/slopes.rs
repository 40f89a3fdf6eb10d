//! `eisemann-slopes`: the line against the box's outline, without any t.
//!
//! Source: M. Eisemann, M. Magnor, T. Grosch and S. Müller, "Fast Ray/Axis-Aligned Bounding Box Overlap Tests using Ray
//! Slopes", Journal of Graphics Tools 12(4), 2007. A ray's class is the signs of its direction. Its origin must not be
//! beyond the far planes, and where it leaves a slab it must have entered each other one. Its slopes are products with a
//! reciprocal, as the source computes them for each ray.

use super::{contract, info};
use crate::case::{Bounds, Boxes};
use hairline_core::arith::{Real, Vector};
use hairline_core::{
    Boundary, EpsilonSet, Extent, Gate, Hit, Kernel, KernelInfo, Ray, Refuse, Role, Sink,
};

pub(super) struct EisemannSlopes;

const EDGE: usize = 0;
const END: usize = 1;
const PARALLEL: usize = 2;

impl Kernel<Boxes> for EisemannSlopes {
    const INFO: KernelInfo = info(
        "eisemann-slopes",
        "M. Eisemann, M. Magnor, T. Grosch and S. Müller, Fast Ray/Axis-Aligned Bounding Box Overlap Tests using Ray \
         Slopes, Journal of Graphics Tools 12(4), 2007",
        contract(Extent::Ray, Boundary::Closed),
        &[
            Gate::signed(Role::Edge, "slope*far - near + c < e", 1, 0),
            Gate::fixed(Role::T, "o beyond far"),
            Gate::fixed(Role::Parallel, "d == 0 && (o < min || o > max)"),
        ],
        &[EpsilonSet {
            name: "source",
            values: &["0", "0", "0"],
        }],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let zero = V::Real::zero();
        for i in 0..3 {
            let [origin, direction] = [ray.origin.at(i), ray.direction.at(i)];
            let is_below = origin.is_less(&bounds.min.at(i));
            let is_above = bounds.max.at(i).is_less(&origin);
            if direction.is_zero() {
                sink.fixed(PARALLEL, !is_below && !is_above)?;
            } else {
                let is_forward = zero.is_less(&direction);
                let is_beyond = if is_forward { is_above } else { is_below };
                sink.fixed(END, !is_beyond)?;
            }
        }
        for leaves in 0..3 {
            for enters in 0..3 {
                let directions = [ray.direction.at(leaves), ray.direction.at(enters)];
                if leaves == enters || directions.iter().any(Real::is_zero) {
                    continue;
                }
                let inside = inside(bounds, ray, leaves, enters);
                sink.one(EDGE, Refuse::Below, &inside)?;
            }
        }
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    }
}

/// How far the line is beyond the near plane of one slab where it leaves another.
#[inline(always)]
fn inside<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>, leaves: usize, enters: usize) -> V::Real {
    let zero = V::Real::zero();
    let is_forward = |i: usize| zero.is_less(&ray.direction.at(i));
    let inverse = V::Real::one() / ray.direction.at(leaves);
    let slope = ray.direction.at(enters) * &inverse;
    let offset = ray.origin.at(enters) - slope.clone() * ray.origin.at(leaves);
    if is_forward(leaves) {
        let at_far = slope * bounds.max.at(leaves);
        return oriented(bounds, enters, is_forward(enters), at_far, offset);
    }
    let at_far = slope * bounds.min.at(leaves);
    oriented(bounds, enters, is_forward(enters), at_far, offset)
}

#[inline(always)]
fn oriented<V: Vector>(
    bounds: &Bounds<V>,
    enters: usize,
    is_forward: bool,
    at_far: V::Real,
    offset: V::Real,
) -> V::Real {
    if is_forward {
        at_far - bounds.min.at(enters) + offset
    } else {
        -(at_far - bounds.max.at(enters) + offset)
    }
}

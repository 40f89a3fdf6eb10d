//! `kay-kajiya`, `smits` and `williams`: axis by axis, with a miss as soon as two slabs do not overlap.
//!
//! Sources: T. Kay and J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986, doi:10.1145/15922.15916, with planes
//! perpendicular to the axes, as E. Haines lists it in "An Introduction to Ray Tracing", 1989, chapter 2: parallel slabs
//! have a test of their own. B. Smits, "Efficiency Issues for Ray Tracing", Journal of Graphics Tools 3(2), 1998, which
//! lets a division by zero make an infinity and asks for the sign of the direction. A. Williams, S. Barrus, R. Morley
//! and P. Shirley, "An Efficient and Robust Ray-Box Intersection Algorithm", Journal of Graphics Tools 10(1), 2005, which
//! asks for the sign of the reciprocal, so that a direction of -0 counts as negative.

use super::growth::{Comparison, NOT_ABOVE, compare};
use super::numbers::{Axis, Divided, Formula, Multiplied, axis};
use super::{PLAIN, contract, info};
use crate::case::{Bounds, Boxes};
use hairline_core::arith::{Real, Vector};
use hairline_core::{Boundary, Extent, Gate, Hit, Kernel, KernelInfo, Ray, Role, Sink};

pub(super) struct KayKajiya;
pub(super) struct Smits;
pub(super) struct Williams;

const END: usize = 1;
const PARALLEL: usize = 2;

/// The t of the two planes of a slab, the nearer one first.
struct Slab<R> {
    near: R,
    far: R,
}

impl Kernel<Boxes> for KayKajiya {
    const INFO: KernelInfo = info(
        "kay-kajiya",
        "T. Kay and J. Kajiya, Ray Tracing Complex Scenes, SIGGRAPH 1986, doi:10.1145/15922.15916, as E. Haines lists \
         it in An Introduction to Ray Tracing, 1989",
        contract(Extent::Ray, Boundary::Closed),
        &[
            NOT_ABOVE,
            Gate::fixed(Role::T, "far < 0"),
            Gate::fixed(Role::Parallel, "d == 0 && (o < min || o > max)"),
        ],
        PLAIN[2],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let mut near = -V::Real::infinity();
        let mut far = V::Real::infinity();
        for i in 0..3 {
            let [min, max] = [bounds.min.at(i), bounds.max.at(i)];
            let ray = axis::<Divided, V>(ray, i);
            if ray.direction.is_zero() {
                let is_beside = ray.origin.is_less(&min) || max.is_less(&ray.origin);
                sink.fixed(PARALLEL, !is_beside)?;
                continue;
            }
            let [t1, t2] = [Divided::t(&ray, min), Divided::t(&ray, max)];
            let is_turned = t2.is_less(&t1);
            let [t1, t2] = if is_turned { [t2, t1] } else { [t1, t2] };
            near = near.larger(t1);
            far = far.smaller(t2);
            compare(sink, Comparison::NotAbove, &near, &far)?;
            sink.fixed(END, !far.is_less(&V::Real::zero()))?;
        }
        Some(Hit::at(near))
    }
}

impl Kernel<Boxes> for Smits {
    const INFO: KernelInfo = info(
        "smits",
        "B. Smits, Efficiency Issues for Ray Tracing, Journal of Graphics Tools 3(2), 1998",
        contract(Extent::Interval, Boundary::Open),
        &[
            NOT_ABOVE,
            Gate::fixed(Role::T, "!(near < t_max && far > t_min)"),
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
        let slabs = [0, 1, 2].map(|i| {
            let axis = axis::<Divided, V>(ray, i);
            let is_forward = V::Real::zero().is_at_most(&axis.direction);
            slab::<Divided, V>(&axis, bounds, i, is_forward)
        });
        overlapping(slabs, ray, sink)
    }
}

impl Kernel<Boxes> for Williams {
    const INFO: KernelInfo = info(
        "williams",
        "A. Williams, S. Barrus, R. Morley and P. Shirley, An Efficient and Robust Ray-Box Intersection Algorithm, \
         Journal of Graphics Tools 10(1), 2005",
        contract(Extent::Interval, Boundary::Open),
        &[
            NOT_ABOVE,
            Gate::fixed(Role::T, "!(near < t_max && far > t_min)"),
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
        let slabs = [0, 1, 2].map(|i| {
            let axis = axis::<Multiplied, V>(ray, i);
            let is_forward = !axis.direction.is_less(&V::Real::zero());
            slab::<Multiplied, V>(&axis, bounds, i, is_forward)
        });
        overlapping(slabs, ray, sink)
    }
}

#[inline(always)]
fn slab<A: Formula, V: Vector>(
    axis: &Axis<V::Real>,
    bounds: &Bounds<V>,
    i: usize,
    is_forward: bool,
) -> Slab<V::Real> {
    let [min, max] = [bounds.min.at(i), bounds.max.at(i)];
    let [near, far] = if is_forward { [min, max] } else { [max, min] };
    Slab {
        near: A::t(axis, near),
        far: A::t(axis, far),
    }
}

/// The comparisons of Smits, which Williams and others kept.
#[inline(always)]
fn overlapping<V: Vector, S: Sink<V::Real>>(
    [x, y, z]: [Slab<V::Real>; 3],
    ray: &Ray<V>,
    sink: &mut S,
) -> Option<Hit<V::Real>> {
    let Slab { mut near, mut far } = x;
    for slab in [y, z] {
        compare(sink, Comparison::NotAbove, &near, &slab.far)?;
        compare(sink, Comparison::NotAbove, &slab.near, &far)?;
        near = near.larger(slab.near);
        far = far.smaller(slab.far);
    }
    sink.fixed(END, near.is_less(&ray.t_max) && ray.t_min.is_less(&far))?;
    Some(Hit::at(near))
}

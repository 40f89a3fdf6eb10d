//! `kay-kajiya`, `smits` and `williams`: axis by axis, with a miss as soon as two slabs do not overlap.
//!
//! Sources: T. Kay and J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986, doi:10.1145/15922.15916, with planes
//! perpendicular to the axes, as E. Haines lists it in "An Introduction to Ray Tracing", 1989, chapter 2: parallel slabs
//! have a test of their own. B. Smits, "Efficiency Issues for Ray Tracing", Journal of Graphics Tools 3(2), 1998, which
//! lets a division by zero make an infinity and asks for the sign of the direction. A. Williams, S. Barrus, R. Morley
//! and P. Shirley, "An Efficient and Robust Ray-Box Intersection Algorithm", Journal of Graphics Tools 10(1), 2005, which
//! asks for the sign of the reciprocal, so that a direction of -0 counts as negative.

use super::growth::{Comparison, NOT_ABOVE, compare};
use super::numbers::*;
use super::*;

pub struct KayKajiya;
pub struct Smits;
pub struct Williams;

const END: usize = 1;
const PARALLEL: usize = 2;

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
            let axis = axis::<Divided, V>(ray, i);
            if axis.direction.is_zero() {
                let is_beside = bounds.is_beside(i, &axis.origin);
                sink.fixed(PARALLEL, !is_beside)?;
                continue;
            }
            let t = turned::<Divided, V>(bounds, &axis, i, false);
            let is_backward = t.far.is_less(&t.near);
            let slab = turned::<Divided, V>(bounds, &axis, i, is_backward);
            near = near.larger(slab.near);
            far = far.smaller(slab.far);
            compare(sink, Comparison::NotAbove, &near, &far)?;
            let is_behind = far.is_less(&V::Real::zero());
            sink.fixed(END, !is_behind)?;
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
        let [x, y, z] = each_axis(|i| {
            let axis = axis::<Divided, V>(ray, i);
            let is_forward = V::Real::zero().is_at_most(&axis.direction);
            turned::<Divided, V>(bounds, &axis, i, !is_forward)
        });
        overlapping(x, [y, z], ray, sink)
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
        let [x, y, z] = each_axis(|i| by_reciprocal(bounds, ray, i));
        overlapping(x, [y, z], ray, sink)
    }
}

/// The slab of an axis, near and far as the reciprocal of the direction is below 0 or not.
#[inline(always)]
pub fn by_reciprocal<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>, i: usize) -> Slab<V::Real> {
    let axis = axis::<Multiplied, V>(ray, i);
    let is_backward = axis.direction.is_less(&V::Real::zero());
    turned::<Multiplied, V>(bounds, &axis, i, is_backward)
}

/// The comparisons of Smits, which Williams and others kept.
#[inline(always)]
pub fn overlapping<V: Vector, S: Sink<V::Real>>(
    first: Slab<V::Real>,
    others: [Slab<V::Real>; 2],
    ray: &Ray<V>,
    sink: &mut S,
) -> Option<Hit<V::Real>> {
    let Slab { mut near, mut far } = first;
    for slab in others {
        compare(sink, Comparison::NotAbove, &near, &slab.far)?;
        compare(sink, Comparison::NotAbove, &slab.near, &far)?;
        near = near.larger(slab.near);
        far = far.smaller(slab.far);
    }
    let starts_before_the_end = near.is_less(&ray.t_max);
    let ends_after_the_start = ray.t_min.is_less(&far);
    sink.fixed(END, starts_before_the_end && ends_after_the_start)?;
    Some(Hit::at(near))
}

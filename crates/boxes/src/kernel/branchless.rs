//! `majercik`, `barnes-2011`, `barnes-2015`, `barnes-2022`, `plane-first` and `plane-last`: minima and maxima alone.
//!
//! Sources: A. Majercik, C. Crassin, P. Shirley and M. McGuire, "A Ray-Box Intersection Algorithm and Efficient Dynamic
//! Voxel Rendering", Journal of Computer Graphics Techniques 7(3), 2018, listing of the slab test, with GLSL's min and max;
//! it tests the whole line. T. Barnes, "Fast, Branchless Ray/Bounding Box Intersections", tavianator.com, 2011, part 2
//! ("NaNs") of 2015 and part 3 ("Boundaries") of 2022, with SSE's min and max. `plane-first` and `plane-last` are the two
//! orders of arguments that programs have: SSE's `max(plane, near)` drops a NaN of the plane, and `max(near, plane)`
//! takes it and loses what it had.

use super::growth::{AT_MOST, BELOW, Comparison, compare};
use super::numbers::{Formula, Multiplied, axis, maxps, minps};
use super::{PLAIN, contract, info};
use crate::case::{Bounds, Boxes};
use hairline_core::arith::{Real, Vector};
use hairline_core::{Boundary, Extent, Hit, Kernel, KernelInfo, Ray, Sink};

pub(super) struct Majercik;
pub(super) struct Barnes2011;
pub(super) struct Barnes2015;
pub(super) struct Barnes2022;
pub(super) struct PlaneFirst;
pub(super) struct PlaneLast;

const BARNES: &str = "T. Barnes, Fast, Branchless Ray/Bounding Box Intersections, https://tavianator.com/2011/ray_box.html";
const BARNES_2015: &str = "T. Barnes, Fast, Branchless Ray/Bounding Box Intersections, Part 2: NaNs, \
                           https://tavianator.com/2015/ray_box_nan.html";
const BARNES_2022: &str = "T. Barnes, Fast, Branchless Ray/Bounding Box Intersections, Part 3: Boundaries, \
                           https://tavianator.com/2022/ray_box_boundary.html";

/// The t of the planes at min and at max of an axis, in this order.
#[inline(always)]
pub(super) fn planes<A: Formula, V: Vector>(
    bounds: &Bounds<V>,
    ray: &Ray<V>,
    i: usize,
) -> [V::Real; 2] {
    let axis = axis::<A, V>(ray, i);
    [bounds.min.at(i), bounds.max.at(i)].map(|plane| A::t(&axis, plane))
}

impl Kernel<Boxes> for Majercik {
    const INFO: KernelInfo = info(
        "majercik",
        "A. Majercik, C. Crassin, P. Shirley and M. McGuire, A Ray-Box Intersection Algorithm and Efficient Dynamic \
         Voxel Rendering, Journal of Computer Graphics Techniques 7(3), 2018",
        contract(Extent::Line, Boundary::Closed),
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
        let slabs = [0, 1, 2].map(|i| planes::<Multiplied, V>(bounds, ray, i));
        let [x, y, z] = slabs.clone().map(|[t0, t1]| t0.smaller(t1));
        let near = x.larger(y).larger(z);
        let [x, y, z] = slabs.map(|[t0, t1]| t0.larger(t1));
        let far = x.smaller(y).smaller(z);
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
    }
}

impl Kernel<Boxes> for Barnes2011 {
    const INFO: KernelInfo = info(
        "barnes-2011",
        BARNES,
        contract(Extent::Line, Boundary::Closed),
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
        let [t1, t2] = planes::<Multiplied, V>(bounds, ray, 0);
        let mut near = minps(t1.clone(), t2.clone());
        let mut far = maxps(t1, t2);
        for i in 1..3 {
            let [t1, t2] = planes::<Multiplied, V>(bounds, ray, i);
            near = maxps(near, minps(t1.clone(), t2.clone()));
            far = minps(far, maxps(t1, t2));
        }
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
    }
}

impl Kernel<Boxes> for Barnes2015 {
    const INFO: KernelInfo = info(
        "barnes-2015",
        BARNES_2015,
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
        let [t1, t2] = planes::<Multiplied, V>(bounds, ray, 0);
        let mut near = minps(t1.clone(), t2.clone());
        let mut far = maxps(t1, t2);
        for i in 1..3 {
            let [t1, t2] = planes::<Multiplied, V>(bounds, ray, i);
            let first = minps(minps(t1.clone(), t2.clone()), far.clone());
            near = maxps(near, first);
            let last = maxps(maxps(t1, t2), near.clone());
            far = minps(far, last);
        }
        let near = maxps(near, V::Real::zero());
        compare(sink, Comparison::Below, &near, &far)?;
        Some(Hit::at(near))
    }
}

impl Kernel<Boxes> for Barnes2022 {
    const INFO: KernelInfo = info(
        "barnes-2022",
        BARNES_2022,
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
            let [t1, t2] = planes::<Multiplied, V>(bounds, ray, i);
            let [near1, near2] = [t1.clone(), t2.clone()].map(|t| maxps(t, near.clone()));
            let [far1, far2] = [t1, t2].map(|t| minps(t, far.clone()));
            near = minps(near1, near2);
            far = maxps(far1, far2);
        }
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
    }
}

impl Kernel<Boxes> for PlaneFirst {
    const INFO: KernelInfo = info(
        "plane-first",
        "the common branchless slab test with SSE's max(plane, near) and min(plane, far), near and far by the sign of \
         the reciprocal",
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
            let [first, last] = crossed::<Multiplied, V>(bounds, ray, i);
            near = maxps(first, near);
            far = minps(last, far);
        }
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
    }
}

impl Kernel<Boxes> for PlaneLast {
    const INFO: KernelInfo = info(
        "plane-last",
        "the common branchless slab test with SSE's max(near, plane) and min(far, plane), near and far by the sign of \
         the reciprocal",
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
            let [first, last] = crossed::<Multiplied, V>(bounds, ray, i);
            near = maxps(near, first);
            far = minps(far, last);
        }
        compare(sink, Comparison::AtMost, &near, &far)?;
        Some(Hit::at(near))
    }
}

/// The t of the planes of an axis, the one first that the sign of the direction says is nearer.
#[inline(always)]
pub(super) fn crossed<A: Formula, V: Vector>(
    bounds: &Bounds<V>,
    ray: &Ray<V>,
    i: usize,
) -> [V::Real; 2] {
    let axis = axis::<A, V>(ray, i);
    let [min, max] = [bounds.min.at(i), bounds.max.at(i)];
    let is_backward = axis.direction.is_sign_negative();
    let [near, far] = if is_backward { [max, min] } else { [min, max] };
    [A::t(&axis, near), A::t(&axis, far)]
}

//! `majercik`, `barnes-2011`, `barnes-2015`, `barnes-2022`, `plane-first` and `plane-last`: minima and maxima alone.
//!
//! Sources: A. Majercik, C. Crassin, P. Shirley and M. McGuire, "A Ray-Box Intersection Algorithm and Efficient Dynamic
//! Voxel Rendering", Journal of Computer Graphics Techniques 7(3), 2018, listing of the slab test, with GLSL's min and max;
//! it tests the whole line. T. Barnes, "Fast, Branchless Ray/Bounding Box Intersections", tavianator.com, 2011, part 2
//! ("NaNs") of 2015 and part 3 ("Boundaries") of 2022, with SSE's min and max. `plane-first` and `plane-last` are the two
//! orders of arguments that programs have: SSE's `max(plane, near)` drops a NaN of the plane, and `max(near, plane)`
//! takes it and loses what it had.

use super::growth::{AT_MOST, BELOW, Comparison, compare};
use super::numbers::*;
use super::*;

pub struct Majercik;
pub struct Barnes2011;
pub struct Barnes2015;
pub struct Barnes2022;
pub struct PlaneFirst;
pub struct PlaneLast;

const BARNES: &str = "T. Barnes, Fast, Branchless Ray/Bounding Box Intersections, https://tavianator.com/2011/ray_box.html";
const BARNES_2015: &str = "T. Barnes, Fast, Branchless Ray/Bounding Box Intersections, Part 2: NaNs, \
                           https://tavianator.com/2015/ray_box_nan.html";
const BARNES_2022: &str = "T. Barnes, Fast, Branchless Ray/Bounding Box Intersections, Part 3: Boundaries, \
                           https://tavianator.com/2022/ray_box_boundary.html";

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
        let [x, y, z] = each_axis(|i| {
            let slab = unsorted::<Multiplied, V>(bounds, ray, i);
            slab.sorted(Real::smaller, Real::larger)
        });
        let both = x.and(y, Real::larger, Real::smaller);
        let common = both.and(z, Real::larger, Real::smaller);
        common.hit(sink, Comparison::AtMost)
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
        let slab = |i: usize| unsorted::<Multiplied, V>(bounds, ray, i);
        let mut common = slab(0).sorted(minps, maxps);
        for i in 1..3 {
            let sorted = slab(i).sorted(minps, maxps);
            common = common.and(sorted, maxps, minps);
        }
        common.hit(sink, Comparison::AtMost)
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
        let slab = |i: usize| unsorted::<Multiplied, V>(bounds, ray, i);
        let Slab { mut near, mut far } = slab(0).sorted(minps, maxps);
        for i in 1..3 {
            let sorted = slab(i).sorted(minps, maxps);
            let first = minps(sorted.near, far.clone());
            near = maxps(near, first);
            let last = maxps(sorted.far, near.clone());
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
        let Slab { mut near, mut far } = interval(ray);
        for i in 0..3 {
            let t = unsorted::<Multiplied, V>(bounds, ray, i);
            let first = maxps(t.near.clone(), near.clone());
            let second = maxps(t.far.clone(), near);
            near = minps(first, second);
            let first = minps(t.near, far.clone());
            let second = minps(t.far, far);
            far = maxps(first, second);
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
        let mut common = interval(ray);
        for i in 0..3 {
            let slab = crossed::<Multiplied, V>(bounds, ray, i);
            common = slab.and(common, maxps, minps);
        }
        common.hit(sink, Comparison::AtMost)
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
        let mut common = interval(ray);
        for i in 0..3 {
            let slab = crossed::<Multiplied, V>(bounds, ray, i);
            common = common.and(slab, maxps, minps);
        }
        common.hit(sink, Comparison::AtMost)
    }
}

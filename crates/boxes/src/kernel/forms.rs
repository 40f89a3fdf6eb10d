//! `divided`, `multiplied`, `fused` and `ize`: one slab test in the three formulas of t, with the growth of the far end.
//!
//! Source: T. Ize, "Robust BVH Ray Traversal", Journal of Computer Graphics Techniques 2(2), 2013: near and far by the sign
//! of the reciprocal, minima and maxima in the order that drops a NaN, and the far end times a number just above 1. The
//! listing has 1.00000024, which is `1 + 2*EPSILON`; its error analysis allows three roundings on each side,
//! 1 + 2·gamma(3), which rounds to `1 + 3*EPSILON`. It computes (b-o)·inv. The other formulas are set into the same test.

use super::growth::{AT_MOST, Comparison};
use super::numbers::*;
use super::*;
use std::marker::PhantomData;

/// The test in one formula.
pub struct Slabs<A>(PhantomData<A>);
pub struct Ize;

const IZE: &str =
    "T. Ize, Robust BVH Ray Traversal, Journal of Computer Graphics Techniques 2(2), 2013";

/// How a formula is called.
pub trait Named: Formula {
    const NAME: &'static str;
    const ABOUT: &'static str;
}

impl Named for Divided {
    const NAME: &'static str = "divided";
    const ABOUT: &'static str = "Ize's order of minima and maxima with (b - o) / d, without growth";
}

impl Named for Multiplied {
    const NAME: &'static str = "multiplied";
    const ABOUT: &'static str =
        "Ize's order of minima and maxima with (b - o) * (1 / d), without growth";
}

impl Named for Fused {
    const NAME: &'static str = "fused";
    const ABOUT: &'static str =
        "Ize's order of minima and maxima with fma(b, 1 / d, -(o * (1 / d))), without growth";
}

impl<A: Named> Kernel<Boxes> for Slabs<A> {
    const INFO: KernelInfo = info(
        A::NAME,
        A::ABOUT,
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
        slabs::<A, V, S>(bounds, ray, sink)
    }
}

impl Kernel<Boxes> for Ize {
    const INFO: KernelInfo = info(
        "ize",
        IZE,
        contract(Extent::Interval, Boundary::Closed),
        &[AT_MOST],
        &[
            EpsilonSet {
                name: "source",
                values: &["-2*EPSILON"],
            },
            EpsilonSet {
                name: "gamma3",
                values: &["-3*EPSILON"],
            },
        ],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        slabs::<Multiplied, V, S>(bounds, ray, sink)
    }
}

#[inline(always)]
fn slabs<A: Formula, V: Vector, S: Sink<V::Real>>(
    bounds: &Bounds<V>,
    ray: &Ray<V>,
    sink: &mut S,
) -> Option<Hit<V::Real>> {
    let mut common = interval(ray);
    for i in 0..3 {
        let slab = crossed::<A, V>(bounds, ray, i);
        common = slab.and(common, maxps, minps);
    }
    common.hit(sink, Comparison::AtMost)
}

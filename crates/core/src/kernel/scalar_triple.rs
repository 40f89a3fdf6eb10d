//! `scalar-triple`, `scalar-triple-shared`, `scalar-triple-two-sided`: the signs of three scalar
//! triple products.
//!
//! Source: A. Lelievre, "Triangle Intersection", a chapter of the course Introduction to Modern
//! Rendering, <https://github.com/alelievr/Modern-Rendering-Introduction>: its three listings, after
//! C. Ericson, Real-Time Collision Detection (2005), section 5.3.4. The listings call the weights of
//! a, b and c u, v and w. Here a hit reports the weights of b and c. The listings compute no t, so they
//! test a line, not a ray.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Demand, Extent, Sides};

pub(super) struct ScalarTriple;
pub(super) struct ScalarTripleShared;
pub(super) struct ScalarTripleTwoSided;

const EDGE: usize = 0;

/// The source, and which of its listings.
macro_rules! lelievre {
    ($listing:literal) => {
        concat!(
            "A. Lelievre, Triangle Intersection, ",
            $listing,
            ", https://github.com/alelievr/Modern-Rendering-Introduction"
        )
    };
}

const fn info(name: &'static str, source: &'static str, two_sided: bool) -> KernelInfo {
    const ONE_SIDED: &[Gate] = &[Gate::signed(Role::Edge, "u < e, v < e, w < e", 2, 1)];
    const TWO_SIDED: &[Gate] = &[Gate::signed(
        Role::Edge,
        "!(both > e or both < -e) for (u, v) and (u, w)",
        2,
        1,
    )];
    let (sides, boundary) = if two_sided {
        (Sides::Both, Boundary::Open)
    } else {
        (Sides::Front, Boundary::Closed)
    };
    KernelInfo {
        name,
        source,
        contract: Contract::of_kernel(Extent::Line, sides, boundary)
            .with_flat(Demand::Free, Demand::Free),
        gates: if two_sided { TWO_SIDED } else { ONE_SIDED },
        epsilon_sets: &[EpsilonSet {
            name: "source",
            values: &["0"],
        }],
        gives: Gives {
            t: false,
            uv: true,
            facing: false,
        },
        polygons: false,
    }
}

/// `ScalarTriple(a, b, c)` of the source: `dot(cross(a, b), c)`.
#[inline(always)]
fn scalar_triple<V: Vector>(a: &V, b: &V, c: &V) -> V::Real {
    a.cross(b).dot(c)
}

/// The weights of b and c from the three products, as every listing normalises them.
#[inline(always)]
fn weights<R: Real>(u: R, v: R, w: R) -> Option<Hit<R>> {
    let scale = R::one() / (u + &v + &w);
    Some(Hit {
        t: None,
        uv: Some((v * &scale, w * &scale)),
        facing: None,
    })
}

impl Kernel for ScalarTriple {
    const INFO: KernelInfo = info("scalar-triple", lelievre!("first listing"), false);

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin: p,
            direction: d,
            ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [pa, pb, pc] = [a.minus(p), b.minus(p), c.minus(p)];
        let u = scalar_triple(d, &pc, &pb);
        sink.one(EDGE, Refuse::Below, &u)?;
        let v = scalar_triple(d, &pa, &pc);
        sink.one(EDGE, Refuse::Below, &v)?;
        let w = scalar_triple(d, &pb, &pa);
        sink.one(EDGE, Refuse::Below, &w)?;
        weights(u, v, w)
    }
}

impl Kernel for ScalarTripleShared {
    const INFO: KernelInfo = info(
        "scalar-triple-shared",
        lelievre!("second listing (one shared cross product)"),
        false,
    );

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin: p,
            direction: d,
            ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [pa, pb, pc] = [a.minus(p), b.minus(p), c.minus(p)];
        let m = d.cross(&pc);
        let u = pb.dot(&m);
        sink.one(EDGE, Refuse::Below, &u)?;
        let v = -pa.dot(&m);
        sink.one(EDGE, Refuse::Below, &v)?;
        let w = scalar_triple(d, &pb, &pa);
        sink.one(EDGE, Refuse::Below, &w)?;
        weights(u, v, w)
    }
}

impl Kernel for ScalarTripleTwoSided {
    const INFO: KernelInfo = info(
        "scalar-triple-two-sided",
        lelievre!("listing with SameSign"),
        true,
    );

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin: p,
            direction: d,
            ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [pa, pb, pc] = [a.minus(p), b.minus(p), c.minus(p)];
        let m = d.cross(&pc);
        let u = pb.dot(&m);
        let v = -pa.dot(&m);
        let minus_u = -u.clone();
        sink.gate(
            EDGE,
            Refuse::UnlessAbove,
            [[&u, &v], [&minus_u, &-v.clone()]],
        )?;
        let w = scalar_triple(d, &pb, &pa);
        sink.gate(
            EDGE,
            Refuse::UnlessAbove,
            [[&u, &w], [&minus_u, &-w.clone()]],
        )?;
        weights(u, v, w)
    }
}

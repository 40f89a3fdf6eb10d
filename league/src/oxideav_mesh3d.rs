//! oxideav-mesh3d 0.0.7: its Möller–Trumbore, and its watertight test after Woop, Benthin and Wald.

use crate::{ENTRANT, Entrant, PROMISE, Run};
use hairline::internals::case::Case;
use hairline::internals::contract::{Across, Contract, Extent};
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo};
use hairline::internals::truth::Facing;
use oxideav_mesh3d::ray::intersect_triangle;
use oxideav_mesh3d::{PreparedRay, Ray, TriangleTest};

pub const OXIDEAV: Entrant = Entrant {
    name: MOLLER_TRUMBORE.name,
    package: "oxideav-mesh3d",
    version: "0.0.7",
    function: "oxideav_mesh3d::ray::intersect_triangle",
    claim: &[
        "Returns `Some((t, u, v, front_face))` when the ray strikes the triangle, `None` when it \
            misses (parallel, behind the origin, or outside the triangle's barycentric simplex).",
        "`t_max` is the upper bound on the ray parameter",
        "an absolute `1e-8` determinant epsilon rejects very small triangles.",
        "A degenerate triangle (`|det| ≤ epsilon`, i.e. the ray is parallel to the triangle plane or the \
            triangle itself has zero area) is silently treated as a miss",
    ],
    page: "https://docs.rs/oxideav-mesh3d/0.0.7/oxideav_mesh3d/ray/fn.intersect_triangle.html",
    note: "The third sentence is of `TriangleTest`. Below that determinant no hit is owed, and by the fourth \
        a miss is.",
    run: Run::Here(moller_trumbore),
    ..ENTRANT
};

pub const OXIDEAV_WATERTIGHT: Entrant = Entrant {
    name: WATERTIGHT.name,
    package: "oxideav-mesh3d",
    version: "0.0.7",
    function: "oxideav_mesh3d::PreparedRay::intersect_triangle, TriangleTest::Watertight",
    claim: &[
        "the three 2-D edge functions are evaluated with the exact same arithmetic for a shared edge \
            on both adjacent triangles, so no ray leaks through a closed mesh.",
        "No epsilon is involved.",
    ],
    page: "https://docs.rs/oxideav-mesh3d/0.0.7/oxideav_mesh3d/ray/enum.TriangleTest.html#variant.Watertight",
    note: "Taken to mean that of triangles that share an edge at least one is hit.",
    run: Run::Here(watertight),
    ..ENTRANT
};

const CONTRACT: Contract = Contract {
    extent: Extent::Interval,
    ..PROMISE
};

const GIVES: Gives = Gives {
    t: true,
    uv: true,
    facing: true,
};

const MOLLER_TRUMBORE: KernelInfo = KernelInfo {
    source: "oxideav-mesh3d 0.0.7, ray::intersect_triangle",
    gives: GIVES,
    ..KernelInfo::own(
        "oxideav-mesh3d",
        Contract {
            least_determinant: 1e-8,
            ..PROMISE
        },
    )
};

const WATERTIGHT: KernelInfo = KernelInfo {
    source: "oxideav-mesh3d 0.0.7, PreparedRay::intersect_triangle",
    gives: GIVES,
    ..KernelInfo::own(
        "oxideav-mesh3d-watertight",
        Contract {
            across: Across::AtLeastOne,
            ..CONTRACT
        },
    )
};

fn moller_trumbore() -> Entry {
    Entry::new(&MOLLER_TRUMBORE).f32(|case: &Case<f32>, _: &[f32]| {
        let [o, d, a, b, c] = case.vectors();
        intersect_triangle(Ray::new(o, d), a, b, c, f32::INFINITY).map(hit)
    })
}

fn watertight() -> Entry {
    Entry::new(&WATERTIGHT).f32(|case: &Case<f32>, _: &[f32]| {
        let [o, d, a, b, c] = case.vectors();
        let ray = PreparedRay::new(Ray::new(o, d));
        let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
        ray.intersect_triangle(TriangleTest::Watertight, a, b, c, t_min, t_max)
            .map(hit)
    })
}

fn hit((t, u, v, front): (f32, f32, f32, bool)) -> Hit<f32> {
    let facing = if front { Facing::Front } else { Facing::Back };
    Hit {
        uv: Some((u, v)),
        facing: Some(facing),
        ..Hit::at(t)
    }
}

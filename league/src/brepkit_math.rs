//! brepkit-math 4.6.20: `watertight_ray_triangle_intersect`.

use crate::{ENTRANT, Entrant, PROMISE, Run};
use brepkit_math::ray_triangle::watertight_ray_triangle_intersect;
use brepkit_math::vec::{Point3, Vec3};
use hairline::internals::case::Case;
use hairline::internals::contract::{Across, Contract};
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo};

pub const BREPKIT_MATH: Entrant = Entrant {
    name: INFO.name,
    package: "brepkit-math",
    version: "4.6.20",
    function: "brepkit_math::ray_triangle::watertight_ray_triangle_intersect",
    claim: &[
        "Tests whether a ray from `origin` in direction `dir` hits the triangle `(v0, v1, \
            v2)`.",
        "This algorithm guarantees watertight results on shared edges: a ray hitting a shared \
            edge between two triangles will report exactly one intersection, with no cracks or \
            double-hits.",
    ],
    page: "https://docs.rs/brepkit-math/4.6.20/brepkit_math/ray_triangle/fn.watertight_ray_triangle_intersect.html",
    note: "",
    run: Run::Here(entry),
    findings: &["brepkit-math.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "brepkit-math 4.6.20, ray_triangle::watertight_ray_triangle_intersect",
    gives: Gives {
        t: true,
        uv: true,
        facing: false,
    },
    ..KernelInfo::own(
        "brepkit-math",
        Contract {
            across: Across::ExactlyOne,
            ..PROMISE
        },
    )
};

fn entry() -> Entry {
    Entry::new(&INFO).f64(|case: &Case<f64>, _: &[f64]| {
        let [o, d, a, b, c] = case.vectors();
        let [o, a, b, c] = [o, a, b, c].map(|[x, y, z]| Point3::new(x, y, z));
        let hit = watertight_ray_triangle_intersect(o, Vec3::new(d[0], d[1], d[2]), a, b, c)?;
        Some(Hit {
            uv: Some((hit.u, hit.v)),
            ..Hit::at(hit.t)
        })
    })
}

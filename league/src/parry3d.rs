//! parry3d and parry3d-f64 0.31.1: `query::details`' triangle test.

use crate::{ENTRANT, Entrant, PROMISE, Run};
use hairline::internals::case::Case;
use hairline::internals::contract::{Boundary, Contract};
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo};

pub const PARRY3D: Entrant = Entrant {
    name: INFO.name,
    package: "parry3d, parry3d-f64",
    version: "0.31.1",
    function: "parry3d::query::details::local_ray_intersection_with_triangle",
    claim: &[
        "Computes the intersection between a triangle and a ray.",
        "If an intersection is found, the time of impact, the normal and the barycentric \
            coordinates of the intersection point are returned.",
        "The direction vector (does NOT need to be normalized)",
        "`origin + dir * t` for `t ≥ 0`.",
    ],
    page: "https://docs.rs/parry3d/0.31.1/parry3d/query/details/fn.local_ray_intersection_with_triangle.html",
    note: "A ray has its start, t = 0, by the last sentence (on `Ray`), so a start on the \
        triangle is a hit.",
    run: Run::Here(entry),
    findings: &["parry3d.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "parry3d, parry3d-f64 0.31.1, local_ray_intersection_with_triangle",
    gives: Gives {
        t: true,
        uv: true,
        facing: false,
    },
    ..KernelInfo::own(
        "parry3d",
        Contract {
            ends: Boundary::Closed,
            ..PROMISE
        },
    )
};

fn entry() -> Entry {
    Entry::new(&INFO).f32(test_f32).f64(test_f64)
}

fn test_f32(case: &Case<f32>, _: &[f32]) -> Option<Hit<f32>> {
    use parry3d::{math::Vector, query::Ray, query::details::local_ray_intersection_with_triangle};
    let [o, d, a, b, c] = case.vectors().map(|[x, y, z]| Vector::new(x, y, z));
    let (hit, weights) = local_ray_intersection_with_triangle(a, b, c, &Ray::new(o, d))?;
    let uv = Some((weights.y, weights.z));
    Some(Hit {
        uv,
        ..Hit::at(hit.time_of_impact)
    })
}

fn test_f64(case: &Case<f64>, _: &[f64]) -> Option<Hit<f64>> {
    use parry3d_f64::{
        math::Vector, query::Ray, query::details::local_ray_intersection_with_triangle,
    };
    let [o, d, a, b, c] = case.vectors().map(|[x, y, z]| Vector::new(x, y, z));
    let (hit, weights) = local_ray_intersection_with_triangle(a, b, c, &Ray::new(o, d))?;
    let uv = Some((weights.y, weights.z));
    Some(Hit {
        uv,
        ..Hit::at(hit.time_of_impact)
    })
}

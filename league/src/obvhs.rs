//! obvhs 0.4.0: `Triangle::intersect` and `Triangle::intersect_embree`. `RtTriangle` has the same two
//! formulas with the edges stored.

use crate::{ENTRANT, Entrant, PROMISE, Run};
use hairline::internals::case::Case;
use hairline::internals::contract::{Contract, Extent};
use hairline::internals::kernel::{Entry, Hit, KernelInfo};
use obvhs::ray::Ray;
use obvhs::triangle::Triangle;

pub const OBVHS: Entrant = Entrant {
    name: INTERSECT.name,
    package: "obvhs",
    version: "0.4.0",
    function: "obvhs::triangle::Triangle::intersect",
    claim: &[
        "Find the distance (t) of the intersection of the `Ray` and this Triangle.",
        "Returns f32::INFINITY for miss.",
    ],
    page: "https://docs.rs/obvhs/0.4.0/obvhs/triangle/struct.Triangle.html#method.intersect",
    note: "The interval is the ray's tmin and tmax; the very ends are left to it.",
    run: Run::Here(intersect),
    findings: &["obvhs.md"],
    ..ENTRANT
};

pub const OBVHS_EMBREE: Entrant = Entrant {
    name: INTERSECT_EMBREE.name,
    package: "obvhs",
    version: "0.4.0",
    function: "obvhs::triangle::Triangle::intersect_embree",
    claim: &[],
    page: "https://docs.rs/obvhs/0.4.0/obvhs/triangle/struct.Triangle.html#method.intersect_embree",
    note: "Not documented; taken to return what `Triangle::intersect` does.",
    run: Run::Here(intersect_embree),
    findings: &["obvhs-embree.md"],
    ..ENTRANT
};

const CONTRACT: Contract = Contract {
    extent: Extent::Interval,
    ..PROMISE
};

const INTERSECT: KernelInfo = KernelInfo {
    source: "obvhs 0.4.0, Triangle::intersect",
    ..KernelInfo::own("obvhs", CONTRACT)
};

const INTERSECT_EMBREE: KernelInfo = KernelInfo {
    source: "obvhs 0.4.0, Triangle::intersect_embree",
    ..KernelInfo::own("obvhs-embree", CONTRACT)
};

fn intersect() -> Entry {
    Entry::new(&INTERSECT).f32(|case: &Case<f32>, _: &[f32]| {
        let (triangle, ray) = convert(case);
        hit(triangle.intersect(&ray))
    })
}

fn intersect_embree() -> Entry {
    Entry::new(&INTERSECT_EMBREE).f32(|case: &Case<f32>, _: &[f32]| {
        let (triangle, ray) = convert(case);
        hit(triangle.intersect_embree(&ray))
    })
}

fn convert(case: &Case<f32>) -> (Triangle, Ray) {
    let [origin, direction, v0, v1, v2] = case.vectors().map(glam::Vec3A::from);
    (
        Triangle { v0, v1, v2 },
        Ray::new(origin, direction, case.ray.t_min, case.ray.t_max),
    )
}

fn hit(t: f32) -> Option<Hit<f32>> {
    (t != f32::INFINITY).then(|| Hit::at(t))
}

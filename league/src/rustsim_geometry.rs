//! rustsim-geometry 0.0.1: `Triangle3::intersect_ray`.

use crate::{ENTRANT, Entrant, PROMISE, Run};
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, Hit, KernelInfo};
use rustsim_geometry::{Ray3, Triangle3};

pub const RUSTSIM_GEOMETRY: Entrant = Entrant {
    name: INFO.name,
    package: "rustsim-geometry",
    version: "0.0.1",
    function: "rustsim_geometry::Triangle3::intersect_ray",
    claim: &[
        "Möller–Trumbore ray-triangle intersection. Returns non-negative `t`.",
        "3-D ray with an origin and a (not necessarily unit) direction.",
    ],
    page: "https://docs.rs/rustsim-geometry/0.0.1/rustsim_geometry/triangle/struct.Triangle3.html#method.intersect_ray",
    run: Run::Here(entry),
    findings: &["rustsim-geometry.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "rustsim-geometry 0.0.1, Triangle3::intersect_ray",
    ..KernelInfo::own("rustsim-geometry", PROMISE)
};

fn entry() -> Entry {
    Entry::new(&INFO).f64(|case: &Case<f64>, _: &[f64]| {
        let [origin, dir, a, b, c] = case.vectors();
        Triangle3 { a, b, c }
            .intersect_ray(&Ray3 { origin, dir })
            .map(Hit::at)
    })
}

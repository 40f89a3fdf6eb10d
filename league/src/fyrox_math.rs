//! fyrox-math 1.0.1: `Ray::triangle_intersection`, which takes a ray for the segment o to o + d.

use crate::segment::past_the_triangle;
use crate::{ENTRANT, Entrant, PROMISE, Run};
use fyrox_math::ray::Ray;
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, Hit, KernelInfo};
use nalgebra_0_34::Vector3;

pub const FYROX_MATH: Entrant = Entrant {
    name: INFO.name,
    package: "fyrox-math",
    version: "1.0.1",
    function: "fyrox_math::ray::Ray::triangle_intersection",
    claim: &[],
    page: "https://docs.rs/fyrox-math/1.0.1/fyrox_math/ray/struct.Ray.html#method.triangle_intersection",
    note: "Not documented; its test in the source accepts t in [0, 1]. The direction goes in \
        times a power of two, so that the segment ends beyond the triangle: nothing is \
        rounded by that.",
    run: Run::Here(entry),
    skip: &["range-ends"],
    findings: &["fyrox-math.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "fyrox-math 1.0.1, Ray::triangle_intersection",
    ..KernelInfo::own("fyrox-math", PROMISE)
};

fn entry() -> Entry {
    Entry::new(&INFO).f32(|case: &Case<f32>, _: &[f32]| {
        let [o, _, a, b, c] = case.vectors().map(Vector3::from);
        let (direction, scale) = past_the_triangle(case);
        let (t, _) = Ray::new(o, Vector3::from(direction)).triangle_intersection(&[a, b, c])?;
        Some(Hit::at(t * scale))
    })
}

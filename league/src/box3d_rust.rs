//! box3d-rust 0.5.0: `intersect_ray_triangle`, from a start by a delta.

use crate::segment::past_the_triangle;
use crate::{ENTRANT, Entrant, PROMISE, Run};
use box3d_rust::math_functions::{Vec3, intersect_ray_triangle};
use hairline::internals::case::Case;
use hairline::internals::contract::{Contract, Sides};
use hairline::internals::kernel::{Entry, Hit, KernelInfo};

pub const BOX3D_RUST: Entrant = Entrant {
    name: INFO.name,
    package: "box3d-rust",
    version: "0.5.0",
    function: "box3d_rust::math_functions::intersect_ray_triangle",
    claim: &[
        "Intersect a ray with a triangle. Returns the hit fraction in (0, 1], or 1.0 on miss.",
    ],
    page: "https://docs.rs/box3d-rust/0.5.0/box3d_rust/math_functions/fn.intersect_ray_triangle.html",
    note: "In the source back faces are a miss. The delta is the direction times a power of \
        two, so that it ends beyond the triangle: nothing is rounded by that.",
    run: Run::Here(entry),
    skip: &["range-ends"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "box3d-rust 0.5.0, math_functions::intersect_ray_triangle",
    ..KernelInfo::own(
        "box3d-rust",
        Contract {
            sides: Sides::Front,
            ..PROMISE
        },
    )
};

fn entry() -> Entry {
    Entry::new(&INFO).f32(|case: &Case<f32>, _: &[f32]| {
        let (direction, scale) = past_the_triangle(case);
        let [o, _, a, b, c] = case.vectors();
        let [o, d, a, b, c] = [o, direction, a, b, c].map(|[x, y, z]| Vec3 { x, y, z });
        let fraction = intersect_ray_triangle(o, d, a, b, c);
        (fraction != 1.0).then(|| Hit::at(fraction * scale))
    })
}

//! oxiphysics-geometry 0.1.2: `boolean_ops::ray_triangle_intersect`.

use crate::PROMISE;
use hairline::internals::case::Case;
use hairline::internals::contract::{Contract, Sides};
use hairline::internals::kernel::{Entry, Hit, KernelInfo};
use oxiphysics_geometry::boolean_ops::ray_triangle_intersect;

const INFO: KernelInfo = KernelInfo {
    source: "oxiphysics-geometry 0.1.2, boolean_ops::ray_triangle_intersect",
    ..KernelInfo::own(
        "oxiphysics-geometry",
        Contract {
            sides: Sides::Front,
            ..PROMISE
        },
    )
};

pub fn entry() -> Entry {
    Entry::new(&INFO).f64(|case: &Case<f64>, _: &[f64]| {
        let [o, d, a, b, c] = case.vectors();
        ray_triangle_intersect(o, d, a, b, c).map(Hit::at)
    })
}

//! The test as a kernel, beside others in an audit. There a triangle and a ray are made ready for each case anew.

use super::{DRay, DTriangle, Hit, Ray, Triangle};
use crate::arith::Float;
use crate::case::Case;
use crate::contract::{Across, Boundary, Contract, Extent, Sides};
use crate::kernel::{self, Entry, Gives, KernelInfo};
use crate::truth::Facing;

/// Its name on the command line.
pub const NAME: &str = "hairline-exact";

const INFO: KernelInfo = KernelInfo {
    source: "hairline_core::exact, include/hairline_prepared.h; docs/design/margin.md",
    gives: Gives {
        t: true,
        uv: true,
        facing: true,
    },
    ..KernelInfo::own(
        NAME,
        Contract::of_kernel(Extent::Interval, Sides::Both, Boundary::Free)
            .with_across(Across::ExactlyOne),
    )
};

/// The test in both scalars, chosen by its name alone.
pub fn entry() -> Entry {
    let f32 = |case: &Case<f32>, _: &[f32]| {
        let [o, d, a, b, c] = case.vectors();
        let ray = Ray::new(o, d);
        told(Triangle::new(a, b, c).hit(&ray, case.ray.t_min, case.ray.t_max))
    };
    let f64 = |case: &Case<f64>, _: &[f64]| {
        let [o, d, a, b, c] = case.vectors();
        let ray = DRay::new(o, d);
        told(DTriangle::new(a, b, c).hit(&ray, case.ray.t_min, case.ray.t_max))
    };
    Entry::new(&INFO)
        .f32(f32)
        .f64(f64)
        .chosen_by("--kernel hairline-exact")
}

fn told<F: Float>(hit: Option<Hit<F>>) -> Option<kernel::Hit<F>> {
    hit.map(|hit| kernel::Hit {
        t: Some(hit.t),
        uv: Some((hit.u, hit.v)),
        facing: Some(match hit.is_front {
            true => Facing::Front,
            false => Facing::Back,
        }),
    })
}

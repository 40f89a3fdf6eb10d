//! The exact test of hairline-core has no finding on any family, in a room, and at edges and vertices that triangles share: every
//! verdict is right, and where triangles meet exactly one is hit.

use hairline::internals::case::Case;
use hairline::internals::contract::{Across, Boundary, Contract, Extent, Sides};
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo};
use hairline_core::Facing;
use hairline_core::exact::{DRay, DTriangle, Edges, Ray, Triangle};

const ONCE: KernelInfo = KernelInfo {
    gives: Gives {
        // Its values in f64 are as near as it says, and not as near as rounding allows.
        t: false,
        uv: false,
        facing: true,
    },
    ..KernelInfo::own(
        "exact-once",
        of_edges(Boundary::Free).with_across(Across::ExactlyOne),
    )
};

const CLOSED: KernelInfo = KernelInfo {
    gives: ONCE.gives,
    ..KernelInfo::own("exact-closed", of_edges(Boundary::Closed))
};

const OPEN: KernelInfo = KernelInfo {
    gives: ONCE.gives,
    ..KernelInfo::own("exact-open", of_edges(Boundary::Open))
};

const fn of_edges(boundary: Boundary) -> Contract {
    Contract {
        ends: Boundary::Closed,
        ..Contract::of_kernel(Extent::Interval, Sides::Both, boundary)
    }
}

fn entry(info: &'static KernelInfo, edges: Edges) -> Entry {
    macro_rules! hit {
        ($triangle:ident, $ray:ident) => {
            move |case: &Case<_>, _: &[_]| {
                let [o, d, a, b, c] = case.vectors();
                let ray = &case.ray;
                let hit = $triangle::new(a, b, c).hit_with(
                    &$ray::new(o, d),
                    ray.t_min,
                    ray.t_max,
                    edges,
                )?;
                let facing = match hit.is_front {
                    true => Facing::Front,
                    false => Facing::Back,
                };
                Some(Hit {
                    facing: Some(facing),
                    ..Hit::at(hit.t)
                })
            }
        };
    }
    Entry::new(info)
        .f32(hit!(Triangle, Ray))
        .f64(hit!(DTriangle, DRay))
}

#[test]
fn it_is_right_on_every_family_and_in_a_room() {
    for (info, edges) in [
        (&ONCE, Edges::Once),
        (&CLOSED, Edges::Closed),
        (&OPEN, Edges::Open),
    ] {
        let kernel = entry(info, edges);
        hairline::audit(&kernel).count(2000).assert_conforms();
        hairline::audit(&kernel)
            .scene("room")
            .count(500)
            .assert_conforms();
    }
}

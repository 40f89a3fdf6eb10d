//! bevy_picking 0.20.1: `ray_mesh_intersection` on a mesh of one triangle.
//!
//! It takes the ray into the mesh's space by the inverse of its transform, here the identity, and
//! normalises the direction once more. That rounds: of random unit vectors it changes some by an ulp,
//! and the ray that is tested is then not quite the ray that was asked about.

use crate::{PROMISE, UNIT};
use bevy_math::{Affine3A, Dir3, Vec3};
use bevy_picking::mesh_picking::ray_cast::{Backfaces, ray_mesh_intersection};
use bevy_shape::Ray3d;
use hairline::internals::case::Case;
use hairline::internals::contract::Contract;
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo};

const INFO: KernelInfo = KernelInfo {
    source: "bevy_picking 0.20.1, ray_mesh_intersection, Backfaces::Include",
    gives: Gives {
        t: true,
        uv: true,
        facing: false,
    },
    ..KernelInfo::own(
        "bevy_picking",
        Contract {
            direction: UNIT,
            ..PROMISE
        },
    )
};

pub fn entry() -> Entry {
    Entry::new(&INFO).f32(test)
}

fn test(case: &Case<f32>, _: &[f32]) -> Option<Hit<f32>> {
    let [origin, direction, a, b, c] = case.vectors();
    let direction = Vec3::from(direction);
    // As it is if it is a unit vector, which is all that is promised anything for.
    let direction = match direction.is_normalized() {
        true => Dir3::new_unchecked(direction),
        false => Dir3::new(direction).ok()?,
    };
    let hit = ray_mesh_intersection::<u32>(
        Ray3d::new(Vec3::from(origin), direction),
        &Affine3A::IDENTITY,
        &[a, b, c],
        None,
        None,
        None,
        Backfaces::Include,
    )?;
    let uv = Some((hit.barycentric_coords.y, hit.barycentric_coords.z));
    Some(Hit {
        uv,
        ..Hit::at(hit.distance)
    })
}

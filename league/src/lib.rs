//! Ray–triangle kernels that are published as Rust crates, as kernels of hairline: one file a crate,
//! each with what it calls and what its documentation promises.
//!
//! The program `league` is hairline with these kernels in it; `league-table` makes docs/league.md.

pub mod edition;

mod entrant;
#[cfg(doctest)]
mod findings;
mod foreign;
mod model;
mod segment;

mod box3d_rust;
mod brepkit_math;
mod bvh;
mod fyrox_math;
mod manifold_rust;
mod maths_rs;
mod mesh_geometry;
mod ncollide3d;
mod obvhs;
mod oxideav_mesh3d;
mod parry3d;
mod rayx;
mod rustsim_geometry;
mod tri_mesh;
mod vek;

use std::sync::OnceLock;

pub use entrant::{ENTRANT, Entrant, PROMISE, Run, UNIT};

/// Every entrant, those of other languages last.
pub fn entrants() -> Vec<Entrant> {
    let crates = [
        vec![parry3d::PARRY3D, ncollide3d::NCOLLIDE3D, bvh::BVH],
        vec![
            obvhs::OBVHS,
            obvhs::OBVHS_EMBREE,
            rayx::RAYX,
            rayx::RAYX_MOLLER_TRUMBORE,
        ],
        vec![manifold_rust::MANIFOLD_RUST, brepkit_math::BREPKIT_MATH],
        vec![tri_mesh::TRI_MESH, mesh_geometry::MESH_GEOMETRY],
        vec![fyrox_math::FYROX_MATH, box3d_rust::BOX3D_RUST],
        vec![oxideav_mesh3d::OXIDEAV, oxideav_mesh3d::OXIDEAV_WATERTIGHT],
        vec![
            vek::VEK,
            maths_rs::MATHS_RS,
            rustsim_geometry::RUSTSIM_GEOMETRY,
        ],
    ];
    crates
        .concat()
        .into_iter()
        .chain(foreign::ENTRANTS.iter().copied())
        .collect()
}

/// The entrants that are built into this program, as kernels.
pub fn kernels() -> Vec<hairline::internals::kernel::Entry> {
    let here = |entrant: &Entrant| match entrant.run {
        Run::Here(entry) => Some(entry()),
        _ => None,
    };
    entrants().iter().filter_map(here).collect()
}

/// Makes them known by their names, once for the whole program, whichever thread asks first.
pub fn register() -> Result<(), String> {
    static DONE: OnceLock<Result<(), String>> = OnceLock::new();
    let all = || {
        kernels()
            .into_iter()
            .try_for_each(|kernel| hairline::internals::kernel::register(kernel).map(drop))
    };
    DONE.get_or_init(all).clone()
}

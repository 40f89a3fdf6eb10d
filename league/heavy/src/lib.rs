//! The kernels of bevy_picking, truck-meshalgo and oxiphysics-geometry, which are built here because their
//! dependencies are several times those of the league.

mod bevy_picking;
// What an entrant promises of which nothing is said.
#[allow(dead_code, reason = "the league's own use of it is the rest")]
#[path = "../../src/entrant.rs"]
mod entrant;
mod oxiphysics_geometry;
mod truck_meshalgo;

use entrant::{PROMISE, UNIT};

/// What the program `league-heavy` knows.
pub fn kernels() -> Vec<hairline::internals::kernel::Entry> {
    vec![
        bevy_picking::entry(),
        truck_meshalgo::entry(),
        oxiphysics_geometry::entry(),
    ]
}

/// The code of the pages about them, which `cargo test --release` runs.
#[cfg(doctest)]
mod findings {
    #[doc = include_str!("../../findings/bevy_picking.md")]
    mod bevy_picking {}
    #[doc = include_str!("../../findings/truck-meshalgo.md")]
    mod truck_meshalgo {}
    #[doc = include_str!("../../findings/oxiphysics-geometry.md")]
    mod oxiphysics_geometry {}
}

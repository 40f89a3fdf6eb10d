//! What takes part: a published function, what is promised for it, and how it is called.

use hairline::internals::contract::{Boundary, Contract, Demand, Direction, Extent, Sides};
use hairline::internals::kernel::Entry;

/// A published ray–triangle test.
#[derive(Clone, Copy, Debug)]
pub struct Entrant {
    /// The kernel's name on the command line.
    pub name: &'static str,
    /// The package and its version.
    pub package: &'static str,
    /// The function that is called.
    pub function: &'static str,
    /// Where its contract comes from: what is documented, at that version.
    pub promise: &'static str,
    /// The kernel, if it is built into this program.
    pub kernel: Option<fn() -> Entry>,
}

/// What a ray–triangle test promises whose documentation says nothing but that: a hit where the ray
/// passes through the inside of the triangle at t > 0, and a miss where the line misses the triangle or
/// meets it behind the ray. Edges, vertices, t = 0, rays in the triangle's plane, triangles without area
/// and numbers that are not finite are left to the kernel.
pub const PROMISE: Contract = Contract {
    extent: Extent::Ray,
    sides: Sides::Both,
    boundary: Boundary::Free,
    ends: Boundary::Free,
    coplanar: Demand::Free,
    degenerate: Demand::Free,
    invalid: Demand::Free,
    ..Contract::CLOSED_RAY
};

/// For a test that asks for unit directions: as they come out of a normalisation, which leaves a length
/// within some ulps of 1.
pub const UNIT: Direction = Direction::Unit { ulps: 4 };

//! What takes part: a published function, what its documentation promises, and how it is called.

use hairline::internals::contract::{Boundary, Contract, Demand, Direction, Extent, Sides};
use hairline::internals::kernel::Entry;

/// A published ray–triangle test.
#[derive(Clone, Copy, Debug)]
pub struct Entrant {
    /// The kernel's name on the command line.
    pub name: &'static str,
    /// The package, as its registry calls it.
    pub package: &'static str,
    pub version: &'static str,
    /// The function that is called.
    pub function: &'static str,
    /// The sentences of its documentation that the contract is made of, word for word. Without one
    /// nothing is promised, and the contract is the minimal one, [`PROMISE`].
    pub claim: &'static [&'static str],
    /// Whether those sentences are about triangles that share an edge and nothing else.
    pub only_shared: bool,
    /// Where they stand, or what is documented instead.
    pub page: &'static str,
    /// What is to be known about the call or the contract.
    pub note: &'static str,
    pub run: Run,
    /// Whether it asks for unit directions; of a kernel in this program its contract says so.
    pub unit: bool,
    /// Families that cannot be put to it as a question.
    pub skip: &'static [&'static str],
    /// Pages in findings/.
    pub findings: &'static [&'static str],
}

impl Entrant {
    /// Whether it is audited with unit directions.
    pub fn takes_unit_directions(&self) -> bool {
        match self.run {
            Run::Here(kernel) => kernel().info.contract.direction != Direction::Any,
            _ => self.unit,
        }
    }

    /// The program that knows it.
    pub fn program(&self) -> &'static str {
        match self.run {
            Run::Here(_) => "league",
            Run::Heavy => "league-heavy",
            Run::Process { .. } => "hairline",
        }
    }

    /// The flags that choose it.
    pub fn selector(&self) -> Vec<&'static str> {
        match self.run {
            Run::Process { arguments, .. } => arguments.to_vec(),
            _ => vec!["--kernel", self.name],
        }
    }
}

/// Where a kernel runs.
#[derive(Clone, Copy, Debug)]
pub enum Run {
    /// In this program.
    Here(fn() -> Entry),
    /// In heavy/, which has the dependencies that take long to build.
    Heavy,
    /// In a process of its own, by these arguments of `league audit`, from the project's root. `needs` is
    /// a file that is there if it is installed.
    Process {
        arguments: &'static [&'static str],
        needs: &'static str,
    },
}

/// What most entrants have in common.
pub const ENTRANT: Entrant = Entrant {
    name: "",
    package: "",
    version: "",
    function: "",
    claim: &[],
    only_shared: false,
    page: "",
    note: "",
    run: Run::Heavy,
    unit: false,
    skip: &[],
    findings: &[],
};

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

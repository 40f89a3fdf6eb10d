//! The slab tests, each written once for every arithmetic, and the table of them.
//!
//! To add one: write its file, and give it a row in [`KERNELS`]. A minimum, a maximum and the last comparison are those of
//! the source, since they decide what a NaN does. Every far end can grow: see `growth.rs`.

/// The preparation of all slab tests: nothing is computed ahead of a ray.
macro_rules! stores_box {
    () => {
        type Prepared<V: Vector> = Bounds<V>;

        fn prepare<V: Vector>(bounds: &Bounds<V>) -> Bounds<V> {
            bounds.clone()
        }
    };
}

mod branchless;
mod forms;
mod growth;
mod libraries;
mod numbers;
mod padded;
mod pairwise;
mod renderers;
mod slopes;

use crate::case::{Bounds, Boxes, each_axis};
use forms::Slabs;
use hairline_core::arith::{Real, Vector};
use hairline_core::contract::Sides;
use hairline_core::kernel::{Entry, Table};
use hairline_core::{Boundary, Contract, Demand, EpsilonSet, Extent, Gate, Hit};
use hairline_core::{Kernel, KernelInfo, Ray, Refuse, Role, Sink};

/// Every built-in slab test, in the order of reports.
pub static KERNELS: &[Entry<Boxes>] = &[
    Entry::of::<pairwise::KayKajiya>(),
    Entry::of::<pairwise::Smits>(),
    Entry::of::<pairwise::Williams>(),
    Entry::of::<slopes::EisemannSlopes>(),
    Entry::of::<forms::Ize>(),
    Entry::of::<branchless::Majercik>(),
    Entry::of::<renderers::Pbrt>(),
    Entry::of::<renderers::PbrtPrecomputed>(),
    Entry::of::<renderers::EmbreeFast>(),
    Entry::of::<renderers::EmbreeRobust>(),
    Entry::of::<renderers::AilaLaine>(),
    Entry::of::<branchless::Barnes2011>(),
    Entry::of::<branchless::Barnes2015>(),
    Entry::of::<branchless::Barnes2022>(),
    Entry::of::<branchless::PlaneFirst>(),
    Entry::of::<branchless::PlaneLast>(),
    Entry::of::<libraries::TinyBvh>(),
    Entry::of::<libraries::TinyBvh1e30>(),
    Entry::of::<libraries::Bvh>(),
    Entry::of::<Slabs<numbers::Divided>>(),
    Entry::of::<Slabs<numbers::Multiplied>>(),
    Entry::of::<Slabs<numbers::Fused>>(),
    Entry::of::<padded::PaddedBox>(),
];

/// A row of the table.
pub type BoxEntry = Entry<Boxes>;

/// The table of slab tests: it finds them by name, in other arithmetics too, and takes those of a program.
pub static TABLE: Table<Boxes> = Table::new(KERNELS);

/// The epsilons of a source that has none: `PLAIN[n]` is for n gates besides the last comparison.
const PLAIN: [&[EpsilonSet]; 3] = [
    &[EpsilonSet {
        name: "source",
        values: &["0"],
    }],
    &[EpsilonSet {
        name: "source",
        values: &["0", "0"],
    }],
    &[EpsilonSet {
        name: "source",
        values: &["0", "0", "0"],
    }],
];

/// The promise of a slab test. A box stands for what is in it, so its boundary must be hit, and so must a flat box and a
/// ray inside the plane of a face; only the ends of a ray are as the source has them.
const fn contract(extent: Extent, ends: Boundary) -> Contract {
    let closed = Contract::of_kernel(extent, Sides::Both, Boundary::Closed);
    Contract {
        ends,
        ..closed.with_flat(Demand::Hit, Demand::Hit)
    }
}

/// The description of a slab test.
const fn info(
    name: &'static str,
    source: &'static str,
    contract: Contract,
    gates: &'static [Gate],
    epsilon_sets: &'static [EpsilonSet],
) -> KernelInfo {
    KernelInfo {
        source,
        gates,
        epsilon_sets,
        ..KernelInfo::own(name, contract)
    }
}

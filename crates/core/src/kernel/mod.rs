//! Floor 2: the kernels. The trait, gates and margins, the registry, and one algorithm a file.
//!
//! Architecture invariant: nothing here knows the oracle.
//!
//! A kernel that is written for every arithmetic also runs as other machines would compute it, under a
//! name such as `moller-trumbore+fma`; any kernel with a small change around it, as `moller-trumbore+sorted`.
//!
//! To add a kernel: write its file, and give it a row in `registry.rs`. A program of your own adds
//! its kernels with [`Entry`] and `hairline::cli::main_with`.

#![forbid(unsafe_code)]

/// The preparation of most kernels: nothing is computed ahead of a ray.
#[doc(hidden)]
#[macro_export]
macro_rules! stores_triangle {
    () => {
        type Prepared<V: Vector> = Triangle<V>;

        fn prepare<V: Vector>(triangle: &Triangle<V>) -> Triangle<V> {
            triangle.clone()
        }
    };
}
#[doc(hidden)]
pub use stores_triangle;

mod changed;
mod entry;
mod epsilon_text;
pub mod gate;
mod generic;
mod margins;
#[cfg(feature = "margins")]
mod one_test;
mod preset;
mod recording;
mod registry;
mod runs;
#[cfg(feature = "margins")]
mod shown;
mod subject;
mod verdict;

mod baldwin_weber;
mod cramer;
mod half_space;
mod havel_herout;
mod moller_trumbore;
mod plane_inside_out;
mod plane_unit_normal;
mod plucker;
mod scalar_triple;
mod woop_watertight;

pub use changed::{Change, has_size, refuses_at};
pub use entry::Entry;
pub use epsilon_text::EpsilonText;
pub use gate::{Deciding, Dimension, Gate, Measuring, Refuse, Role, Sink, Tunable, refused_by};
pub use generic::Generic;
pub use margins::{by_running, open_epsilons, values_of};
pub use preset::{PRESETS, Preset, PresetEntry};
pub use recording::{Acceptance, Compared, Path};
pub use registry::kept;
pub use registry::{
    KERNELS, Scalar, TRIANGLES, Table, all, changed, check_name, find, forms, in_arithmetic,
    register, unnamed,
};
pub use runs::{ExactRun, Measured, TrackedRun};
pub use subject::verdicts_of;
pub use subject::{Gated, KernelIn, Test};
pub use verdict::{Failure, Verdict};

use crate::arith::{Real, Vector};
use crate::case::{Ray, Target, Triangles};
use crate::contract::Contract;
use crate::truth::Facing;

/// A kernel, written once for every arithmetic: a ray–triangle test, or a test of another target.
pub trait Kernel<T: Target = Triangles>: Sync + 'static {
    /// The description of the kernel, with its promise.
    const INFO: KernelInfo;
    /// The data that it stores for a shape.
    type Prepared<V: Vector>;

    /// Computes what the source computes for each shape ahead of any ray.
    fn prepare<V: Vector>(shape: &T::Shape<V>) -> Self::Prepared<V>;

    /// The test of the source, in its order of operations and with its comparisons. A sink that does not
    /// stop at a refusal gets every margin; the result then does not say whether the ray hits.
    fn test<V: Vector, S: Sink<V::Real>>(
        prepared: &Self::Prepared<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>>;

    /// The same for a planar convex polygon, if the kernel takes polygons.
    fn test_polygon<V: Vector, S: Sink<V::Real>>(
        _vertices: &[V],
        _ray: &Ray<V>,
        _sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        None
    }
}

/// The values that a kernel reports of a hit. The weights of a, b and c are 1-u-v, u and v.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit<R> {
    /// The ray's parameter, in units of the direction.
    pub t: Option<R>,
    /// The weights of b and c.
    pub uv: Option<(R, R)>,
    /// The side hit.
    pub facing: Option<Facing>,
}

impl<R> Hit<R> {
    /// A hit that reports its t alone.
    pub fn at(t: R) -> Hit<R> {
        Hit {
            t: Some(t),
            uv: None,
            facing: None,
        }
    }

    /// The numbers that it reports.
    fn numbers(&self) -> impl Iterator<Item = &R> {
        self.t
            .iter()
            .chain(self.uv.iter().flat_map(|(u, v)| [u, v]))
    }

    /// The same in another arithmetic, number by number.
    pub fn map<S>(self, number: impl Fn(R) -> S) -> Hit<S> {
        let Hit { t, uv, facing } = self;
        Hit {
            t: t.map(&number),
            uv: uv.map(|(u, v)| (number(u), number(v))),
            facing,
        }
    }
}

/// The description of a kernel: its name, its source, its promise and its gates.
#[derive(Debug)]
pub struct KernelInfo {
    /// The name on the command line.
    pub name: &'static str,
    /// Author, title, year and address of its source.
    pub source: &'static str,
    /// The promise of its source.
    pub contract: Contract,
    /// Its gates, in the order of the test.
    pub gates: &'static [Gate],
    /// The epsilon sets of the default plan, one epsilon a gate.
    pub epsilon_sets: &'static [EpsilonSet],
    /// Which values of a hit it reports.
    pub gives: Gives,
    /// True if it takes planar convex polygons too.
    pub polygons: bool,
}

impl KernelInfo {
    /// For a kernel of your own: it has no epsilons, and only t of its hits is judged. Set other fields by
    /// `KernelInfo { gives: …, ..KernelInfo::own(name, contract) }`.
    pub const fn own(name: &'static str, contract: Contract) -> KernelInfo {
        KernelInfo {
            name,
            source: "your own",
            contract,
            gates: &[],
            epsilon_sets: &[EpsilonSet {
                name: "own",
                values: &[],
            }],
            gives: Gives {
                t: true,
                uv: false,
                facing: false,
            },
            polygons: false,
        }
    }
}

/// One epsilon a gate, as decimal text, or as a multiple of the scalar's distance from 1 to the next
/// number: `EPSILON`, `16*EPSILON`. Fixed gates ignore theirs.
#[derive(Clone, Copy, Debug)]
pub struct EpsilonSet {
    /// The name of the set in a report: `source`, `zero`, a value.
    pub name: &'static str,
    /// In the order of the gates.
    pub values: &'static [&'static str],
}

/// Which values a kernel reports.
#[derive(Clone, Copy, Debug)]
pub struct Gives {
    /// The ray's parameter.
    pub t: bool,
    /// The weights of b and c.
    pub uv: bool,
    /// The side hit.
    pub facing: bool,
}

impl Gives {
    /// No value.
    pub const NOTHING: Gives = Gives {
        t: false,
        uv: false,
        facing: false,
    };
}

/// `facing` from a number that is positive when the ray comes from the front.
fn facing_of<R: Real>(front_if_positive: &R) -> Option<Facing> {
    if R::zero().is_less(front_if_positive) {
        Some(Facing::Front)
    } else if front_if_positive.is_less(&R::zero()) {
        Some(Facing::Back)
    } else {
        None
    }
}

/// An interval's end times a determinant; an end of zero stays zero whatever the determinant, as
/// where a source compares with 0.
#[inline(always)]
fn end_times<R: Real>(end: &R, determinant: &R) -> R {
    if end.is_zero() {
        R::zero()
    } else {
        end.clone() * determinant
    }
}

/// `a - b`, and zero where a = b even if both are infinite: its sign is the outcome of the source's
/// comparison of a and b.
#[inline(always)]
fn gap<R: Real>(a: &R, b: &R) -> R {
    if a.is_at_most(b) && b.is_at_most(a) {
        R::zero()
    } else {
        a.clone() - b
    }
}

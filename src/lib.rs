//! Audits ray–triangle kernels: floating-point tests and their epsilons against exact predicates,
//! on the cases where they break.
//!
//! ```text
//! Case ──► Kernel ──► Verdict ─┐
//!   │                          ├─► judge ──► Finding ──► Tally ──► Record ──► text, JSON, HTML, …
//!   └────► Oracle ──► Truth ───┘
//!                       ▲
//!              Contract ┘  (what the kernel promises: must hit, must miss, free)
//! ```
//!
//! The library does four things:
//!
//! - **The truth of a case.** [`truth()`] says exactly where a ray's line meets a triangle, for every finite
//!   `f32` and `f64`; [`truths`] and [`Batch`] do so for many cases.
//! - **An audit of your kernel.** [`audit()`] runs a kernel on the families of hard cases and compares each
//!   verdict with what its [`Contract`] demands; `assert_conforms` makes it a test.
//! - **Writing a kernel.** A closure is enough ([`Entry::f32`]); a [`Kernel`] that is written once for every
//!   arithmetic also gets its margins, its exact runs and its runs on other machines' arithmetic.
//! - **Strategies** for proptest, one a family, in `strategy` (feature `proptest`).
//!
//! `cli::main_with` (feature `cli`) is the whole program with your kernels in it.
//!
//! DESIGN.md has the picture of the modules behind this; a test compares it with their `use` lines.

// Some of the modules' items serve only this project's own tests, through `internals`.
#![cfg_attr(not(feature = "internals"), allow(dead_code, unused_imports))]

/// An enum whose values have names.
macro_rules! named {
    ($methods:vis names $(#[$about:meta])* $visible:vis enum $type:ident {
        $($(#[$doc:meta])* $value:ident = $name:literal,)*
    }) => {
        $(#[$about])*
        $visible enum $type {
            $($(#[$doc])* $value,)*
        }

        impl $type {
            /// All of them, in their order.
            $methods const ALL: [$type; [$($name),*].len()] = [$($type::$value),*];

            /// The name in files, in reports and on the command line.
            $methods const fn name(self) -> &'static str {
                match self {
                    $($type::$value => $name,)*
                }
            }
        }
    };
}

/// Does the same with whichever scalar's value an [`AnyScalar`](crate::case::AnyScalar) holds.
#[cfg(feature = "studies")]
macro_rules! either_scalar {
    ($any:expr, $value:pat => $do:expr) => {
        match $any {
            $crate::case::AnyScalar::F32($value) => $do,
            $crate::case::AnyScalar::F64($value) => $do,
        }
    };
}

/// Does something in the scalar of a name, which is one of the two.
macro_rules! in_named_scalar {
    ($name:expr, $scalar:ident => $do:expr) => {
        if $name == <f32 as $crate::arith::Float>::NAME {
            type $scalar = f32;
            $do
        } else {
            type $scalar = f64;
            $do
        }
    };
}

// The floors, from the ground up: each module uses only those above it in this list.
mod arith;
mod engine;

mod case;
mod contract;
mod plot;
mod suggest;
mod truth;

mod corpus;
mod family;
mod kernel;
mod mesh;
mod oracle;

mod judge;

mod audit;
#[cfg(feature = "studies")]
mod epsilon;
#[cfg(feature = "studies")]
mod explore;
#[cfg(feature = "studies")]
mod map;
#[cfg(feature = "studies")]
mod orientation;
#[cfg(feature = "studies")]
mod prove;
#[cfg(feature = "studies")]
mod selfcheck;
#[cfg(feature = "studies")]
mod spawn;
#[cfg(feature = "studies")]
mod vectors;

mod report;

mod conformance;
#[cfg(feature = "cli")]
mod descriptors;
#[cfg(feature = "cli")]
mod expect;
#[cfg(feature = "cli")]
mod plugin;

#[cfg(feature = "cli")]
pub mod cli;

pub use case::{Case, Parameters, Ray, Triangle};
pub use oracle::{Batch, Layers, UnequalColumns, truth, truths};
pub use truth::{Contact, ContactKind, Crossing, Facing, Feature, Place, Truth};

pub use contract::{
    Across, Band, BandUnit, Boundary, Contract, Demand, Direction, Extent, NAMED, NamedContract,
    Sides,
};

pub use arith::{Float, Real, Vector};
pub use kernel::{
    Dimension, Entry, EpsilonSet, Failure, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role,
    Scalar, Sink, Subject, Test, Tunable, Verdict, find,
};

pub use audit::PlanError;
pub use conformance::{Outcome, Request, audit};
pub use report::{Example, FindingPart, Rate, SeverityPart};
#[cfg(feature = "studies")]
pub use spawn::{HitPoint, Offset, Scheme, Start, register as register_scheme};

#[cfg(feature = "proptest")]
pub use explore::strategy;

#[cfg(feature = "internals")]
#[doc(hidden)]
pub mod internals;

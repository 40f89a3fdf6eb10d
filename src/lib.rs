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
#![cfg_attr(
    not(all(feature = "internals", feature = "cli")),
    allow(dead_code, unused_imports)
)]

// What stands below: the words, the numbers, the kernels, the truth; the proofs; cases, counts and studies; kernels of others.
#[macro_use(either_scalar, in_named_scalar)]
extern crate hairline_core;
#[cfg(feature = "studies")]
use hairline_advice::{advised, epsilon, offset};
#[cfg(feature = "studies")]
use hairline_cases::corpus;
use hairline_cases::{family, mesh};
#[cfg(feature = "cli")]
use hairline_command as command;
use hairline_core::{arith, case, contract, engine, kernel, oracle, printable, suggest};
#[cfg(feature = "cli")]
use hairline_expect as expect;
#[cfg(feature = "studies")]
use hairline_explore as explore;
use hairline_files as files;
#[cfg(feature = "cli")]
use hairline_plugin as plugin;
#[cfg(feature = "studies")]
use hairline_prove as prove;
use hairline_record as record;
#[cfg(feature = "studies")]
use hairline_report as report;
use hairline_study::{audit, judge};
#[cfg(feature = "studies")]
use hairline_study::{map, selfcheck, studied};
#[cfg(feature = "studies")]
use hairline_vectors as vectors;

#[cfg(feature = "cli")]
#[macro_use]
extern crate hairline_command;
#[cfg(feature = "studies")]
#[macro_use(part)]
extern crate hairline_record;
#[cfg(feature = "studies")]
#[macro_use]
extern crate macro_rules_attribute;

// The floors, from the ground up: each module uses only those above it in this list.
mod conformance;

#[cfg(feature = "cli")]
pub mod cli;

pub use case::{Case, Parameters, Ray, Triangle};
pub use hairline_core::{Error, ErrorKind, truth};
pub use oracle::{Batch, Layers, UnequalColumns, truths, truths_of_rows};
pub use truth::{Contact, ContactKind, Crossing, Facing, Feature, Place, Truth};

pub use contract::{
    Across, Band, BandUnit, Boundary, Contract, Demand, Direction, Extent, NAMED, NamedContract,
    Sides,
};

pub use arith::{Float, Real, ScalarName, Vector};
pub use kernel::{
    Dimension, Entry, EpsilonSet, Failure, Gate, Gives, Hit, Kernel, KernelIn, KernelInfo, Refuse,
    Role, Scalar, Sink, Test, Tunable, Verdict, find,
};

pub use conformance::{Outcome, Request, audit};
#[cfg(feature = "studies")]
pub use offset::{HitPoint, Offset, Scheme, Start, register as register_scheme};
pub use record::{Example, FindingKind, FindingPart, Rate, SeverityPart};

#[cfg(feature = "proptest")]
pub use hairline_explore::{prop_assert_conforms, prop_assert_conforms_together, strategy};

#[cfg(feature = "internals")]
#[doc(hidden)]
pub mod internals;

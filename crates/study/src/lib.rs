//! Tests ray–triangle kernels on hard cases. Families make the cases, the oracle of `hairline-core` says what is
//! true, `judge` compares a kernel's verdicts with it, and studies count: audits, epsilons, meshes, new rays, maps,
//! searches.
//!
//! It is the library behind the program `hairline`, whose interface is stable; this one changes with it.

#![cfg_attr(not(feature = "pictures"), allow(dead_code, unused_imports))]

#[macro_use(either_scalar, in_named_scalar, named)]
extern crate hairline_core;
use hairline_core::{arith, case, contract, engine, kernel, oracle, printable, suggest, truth};
use hairline_files as files;
#[cfg(feature = "studies")]
use hairline_prove as prove;

// The floors, from the ground up: each module uses only those above it in this list.
pub mod plot;

#[cfg(feature = "studies")]
pub mod corpus;
pub mod family;
pub mod mesh;

pub mod judge;

pub mod audit;
#[cfg(feature = "studies")]
pub mod epsilon;
#[cfg(feature = "studies")]
pub mod map;
#[cfg(feature = "studies")]
pub mod offset;
#[cfg(feature = "studies")]
pub mod selfcheck;

#[cfg(feature = "studies")]
pub mod studied;

#[doc(hidden)]
pub use hairline_core::kernel::Scalar;
pub use hairline_core::{Case, Contract};
#[cfg(feature = "studies")]
pub use offset::{HitPoint, Offset, Scheme, Start, register as register_scheme};

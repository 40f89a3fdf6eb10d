//! Kernels on hard cases: the judge, and counts. `hairline-cases` makes the cases, the oracle of `hairline-core` says what is
//! true, `judge` compares a kernel's verdicts with it, and audits count.
//!
//! It is the library behind the program `hairline`, whose interface is stable; this one changes with it.

#![cfg_attr(not(feature = "pictures"), allow(dead_code, unused_imports))]

#[macro_use(named)]
extern crate hairline_core;
use hairline_cases::{family, mesh};
use hairline_core::{arith, case, contract, engine, kernel, oracle, printable, suggest, truth};
use hairline_files as files;

// The floors, from the ground up: each module uses only those above it in this list.
pub mod plot;

pub mod judge;

pub mod audit;
#[cfg(feature = "studies")]
pub mod map;
#[cfg(feature = "studies")]
pub mod selfcheck;

#[cfg(feature = "studies")]
pub mod studied;

#[doc(hidden)]
pub use hairline_core::kernel::Scalar;
pub use hairline_core::{Case, Contract};

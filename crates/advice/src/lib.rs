//! Numbers to type: which epsilons a kernel should have on a scene, and where a new ray should start that leaves a hit point.
//! Both are counted on the cases of `hairline-cases`, by the judge of `hairline-study`.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#[macro_use(named)]
extern crate hairline_core;
use hairline_cases::{family, mesh};
use hairline_core::{arith, case, contract, engine, kernel, oracle, suggest, truth};
use hairline_prove as prove;
use hairline_study::{audit, judge};

// The floors, from the ground up: each module uses only those above it in this list.
pub mod epsilon;
pub mod offset;

pub mod advised;

#[doc(hidden)]
pub use hairline_core::kernel::Scalar;
pub use hairline_core::{Case, Contract};
pub use offset::{HitPoint, Offset, Scheme, Start, register as register_scheme};

//! Searches among cases. Moves ([`mutate`]), simplifications ([`Simplification`]) and
//! signatures of findings are shared; on top of them stand the search for the worst case
//! ([`worst`]), the descent to the simplest ([`shrink`]), fuzz campaigns ([`campaign`]), the inputs of
//! fuzz targets ([`inputs`]) and strategies for proptest.
//!
//! Architecture invariant: everything is a function of its arguments. Seeds and counts decide, never
//! a clock or the number of threads.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![forbid(unsafe_code)]

#[macro_use(either_scalar, in_named_scalar, named)]
extern crate hairline_core;
use hairline_cases::{corpus, family};
#[cfg(feature = "proptest")]
use hairline_core::contract;
use hairline_core::{arith, case, engine, kernel, oracle, truth};
use hairline_files as files;
use hairline_study::{audit, judge};

mod decimal;
mod domain;
mod moves;
mod objective;
mod shorten;
mod shrink;
mod signature;
mod simplify;
mod snippet;

pub mod inputs;
#[cfg(feature = "proptest")]
pub mod strategy;
pub mod worst;

pub mod campaign;
pub mod studied;

pub use decimal::Decimal;
pub use domain::SearchDomain;
pub use hairline_core::{Case, Contract};
pub use moves::mutate;
pub use objective::{Objective, Scorer, SearchTarget, scale, verdict_and_finding};
pub use shorten::shorten;
pub use shrink::{KEPT_SHARE, Shrunk, shrink, shrink_finding, shrink_scored, shrink_within};
pub use signature::Signature;
pub use simplify::{SIMPLIFICATIONS, ScaleBy, SimplerNumber, Simplification, Size};
pub use snippet::{c_snippet, rust_snippet};
pub use worst::{
    FoundWorst, LANES, Update, WorstEntry, WorstGoal, WorstTable, exact_score, family_case,
    find_worst, replay, search,
};

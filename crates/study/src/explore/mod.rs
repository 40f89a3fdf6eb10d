//! Floor 4: searches among cases. Moves ([`mutate`]), simplifications ([`Simplification`]) and
//! signatures of findings are shared; on top of them stand the descent to the simplest case ([`shrink`]), fuzz campaigns
//! ([`campaign`]), the inputs of fuzz targets ([`inputs`]) and strategies for proptest.
//!
//! Architecture invariant: everything is a function of its arguments. Seeds and counts decide, never
//! a clock or the number of threads.

#![forbid(unsafe_code)]

mod decimal;
mod moves;
mod shrink;
mod signature;
mod simplify;
mod snippet;
mod verdict;

pub mod campaign;
pub mod inputs;
#[cfg(feature = "proptest")]
pub mod strategy;

pub use decimal::Decimal;
pub use moves::mutate;
pub use shrink::{Shrunk, shrink, shrink_finding, shrink_within};
pub use signature::Signature;
pub use simplify::{SIMPLIFICATIONS, ScaleBy, SimplerNumber, Simplification, Size};
pub use snippet::{c_snippet, rust_snippet};
pub use verdict::{scale, verdict_and_finding};

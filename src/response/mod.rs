//! Floor 4: what a kernel does at every epsilon.
//!
//! A gate accepts up to its margin, so the margins of one pass over the cases decide every epsilon.
//! They are counted in cells; at the edges of the cells, at marks and at the decisive margins the
//! counts are exact, in between they are bracketed.

#![forbid(unsafe_code)]

mod axis;
mod curve;
mod relative;
mod run;

pub use axis::Axis;
pub use curve::{Bracket, Cell, Curve, Question};
pub use relative::{scale_free_form, unit_of_length};
pub use run::{Request, Response, SourceResponse, run, tunable_gates};

//! Floor 4: what a kernel does at every epsilon.
//!
//! A gate accepts up to its margin, so the margins of one pass over the cases decide every epsilon.
//! Margins are counted in cells. The counts are exact at the edges of the cells, at marks and at the
//! decisive margins; between these they are bracketed.

#![forbid(unsafe_code)]

mod advice;
mod axis;
mod curve;
mod duty;
mod relative;
mod run;
pub mod scene;
mod sketch;
mod study;

pub use advice::{Side, Trade, candidates, decades, total};
pub use axis::Axis;
pub use curve::{Bracket, Cell, Curve, Question};
pub use duty::Duty;
pub use relative::scale_free_form;
pub use run::{Request, Response, SourceResponse, floor, run, tunable_gates};
pub use sketch::{SPANNING, Sketch, few, sketch};
pub use study::{GateStudy, LEAST_SUM, Price, Study, StudyPlan, own_false_hits, study};

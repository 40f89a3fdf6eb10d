//! Rays and points at whole meshes, for people: what they meet, and what another program answered, judged. Which answers are
//! wrong, how far off, and who lost the hits: a triangle test, a box test, or an end of the interval.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![forbid(unsafe_code)]

#[macro_use(named)]
extern crate hairline_core;
#[macro_use(part)]
extern crate hairline_record;
#[macro_use]
extern crate macro_rules_attribute;
use hairline_cases::corpus;
use hairline_core::{arith, case, kernel, oracle};
use hairline_files as files;
use hairline_record as record;
use hairline_report as report;
use hairline_study::audit;

// The floors, from the ground up: each module uses only those above it in this list.
mod single;
mod transform;

mod asked;
mod made;
mod picture;
mod plain;
mod result;
mod text;

mod given;
mod reading;
mod run;

mod blame;
mod told;

mod found;
mod found_all;
mod judged;
mod one;
mod page;
mod points;
mod summary;

mod scalar;

pub use asked::{AnswerKind, Answers, Asked, BadRay};
pub use found::FoundHits;
pub use found_all::AllHits;
pub use given::GivenSteps;
pub use made::MadeRays;
pub use one::RayTold;
pub use plain::PlainProgram;
pub use points::LocatedPoints;
pub use result::{RaysResult, mesh_label};
pub use run::{JudgedRun, Judgements, Tally};
pub use scalar::RaysScalar;
pub use text::{Text, answers, ray_of_words};
pub use told::pictured;

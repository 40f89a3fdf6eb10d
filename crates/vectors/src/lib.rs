//! Test vectors for programs that do not run hairline: rays, triangles and what is right, as data; and what such a program
//! answers to them, judged.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![forbid(unsafe_code)]

#[macro_use(either_scalar, in_named_scalar, named)]
extern crate hairline_core;
#[macro_use(part)]
extern crate hairline_record;
#[macro_use]
extern crate macro_rules_attribute;
use hairline_cases::{corpus, family};
use hairline_core::{arith, case, contract, kernel, oracle, truth};
use hairline_files as files;
use hairline_record as record;
use hairline_report as report;
use hairline_study::{audit, judge};

// The floors, from the ground up: each module uses only those above it in this list.
mod flags;
mod number;

mod test;

mod profile;
mod set;

pub mod csv;
pub mod json;

mod answer;

mod verified;

mod results;

pub use profile::Profile;
pub use results::{BadResults, verify};
pub use set::{StoredCases, VectorTopic, core, numbered};
pub use test::{DIGITS, VectorTest, digest, in_scalar};
pub use verified::VerifyResult;

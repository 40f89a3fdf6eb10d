//! Small changes to a kernel and what they mend ([`smaller`]), and the kernel that says hit, miss or ask as source code
//! ([`source_code`]).
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![forbid(unsafe_code)]

#[macro_use(named)]
extern crate hairline_core;
use hairline_cases::family;
use hairline_core::{arith, contract, engine, kernel};
use hairline_prove as prove;
use hairline_study::{audit, judge};

// The floors, from the ground up: each module uses only those above it in this list.
mod language;

mod nodes;

mod code;

mod frame;

mod asks;
mod candidates;
mod tried;

pub mod smaller;

pub use asks::Asks;
pub use frame::{function_name, source_code};
pub use language::Language;

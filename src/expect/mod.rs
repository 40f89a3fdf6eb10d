//! Floor 6: expectations, the known disagreements of a project, and how a run compares with them.
//!
//! By default no finding is expected, and a file lists the exceptions. An entry that no longer occurs is
//! stale, and that fails too. So the file shrinks as kernels get better, and never hides that they got
//! worse.

#![forbid(unsafe_code)]

mod bless;
mod compare;
mod file;

pub use bless::{NetChange, Unblessable, bless};
pub use compare::compare;
pub use file::read;

use crate::report::Key;
use std::collections::BTreeMap;

/// The schema's name and version.
pub const SCHEMA: &str = "hairline-expectations/1";

/// The contents of a file of expectations.
#[derive(Clone, Debug, Default)]
pub struct Expectations {
    /// The hash of the plan whose counts they are.
    pub plan: String,
    /// The expectation for each class of disagreement. Every other class is expected not to occur.
    pub entries: BTreeMap<Key, Entry>,
}

/// What is expected of a class of disagreement.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The line of the file, counted from 1.
    pub line: usize,
    /// How much of it.
    pub amount: Amount,
    /// Why.
    pub why: Option<String>,
    /// Where more is to be read.
    pub url: Option<String>,
}

/// How much of a disagreement is expected.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// So many, as a run found them.
    Count {
        /// How many.
        count: u64,
        /// Of how many.
        of: Option<u64>,
        /// Of the set of cases.
        digest: Option<String>,
    },
    /// At most this share, but more than zero.
    Rate(f64),
}

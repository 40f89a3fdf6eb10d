//! Expectations, the known disagreements of a project, and how a run compares with them, or with another run.
//!
//! By default no finding is expected, and a file lists the exceptions: counts by family, with reasons, for
//! people to review. A lock file beside it has the cases behind the counts, for each target. An entry that no
//! longer occurs is stale, and that fails too. So the files shrink as kernels get better, and never hide that
//! they got worse.

#![forbid(unsafe_code)]

#[macro_use(in_named_scalar)]
extern crate hairline_core;
use hairline_cases::family;
use hairline_core::{case, kernel, suggest};
use hairline_study::audit;

mod accuracy;
mod bless;
mod changed;
mod compare;
mod difference;
mod difference_page;
mod file;
mod files;
mod known;
mod lock;
mod named;
mod rows;
mod scene;
mod trend;

pub use accuracy::HitErrors;
pub use bless::{BlessError, bless};
pub use compare::compare;
pub use difference::{Difference, RecordComparison, difference};
pub use file::read;
pub use files::{Written, blessed, lock_of, open};
pub use lock::{Lock, LockedCases, LockedTarget, RowSettings};
pub use named::difference_of;
pub use trend::Trend;

use hairline_record::Key;
use std::collections::BTreeMap;

/// The schema's name and version.
pub const SCHEMA: &str = "hairline-expectations/2";

/// The expectations of a project.
#[derive(Clone, Debug, Default)]
pub struct Expectations {
    /// The hash of what chooses the cases that are counted.
    pub cases: String,
    /// The flags that choose these cases, where a command line wrote the file.
    pub sources: Option<String>,
    /// The numbers of the scene that these cases come from, as case ids have them.
    pub scene: Option<String>,
    /// The expectation for each finding on a family, of all classes together. Every other finding is
    /// expected not to occur.
    pub entries: BTreeMap<Key, ExpectedEntry>,
    /// The cases behind the counts; none if there is no such file.
    pub lock: Option<Lock>,
}

impl Expectations {
    /// Leaves out some.
    pub fn without(mut self, is_left_out: impl Fn(&Key) -> bool) -> Expectations {
        self.entries.retain(|key, _| !is_left_out(key));
        let targets = self
            .lock
            .iter_mut()
            .flat_map(|lock| lock.targets.values_mut());
        targets.for_each(|target| target.cases.retain(|key, _| !is_left_out(key)));
        self
    }
}

/// The expectation for a disagreement.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedEntry {
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
        /// The number of cases among which, and the digest of their set; for one class, as the lock file has it.
        cases: Option<(u64, String)>,
    },
    /// At most this share, but more than zero.
    Rate(f64),
}

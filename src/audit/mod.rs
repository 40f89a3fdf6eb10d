//! Floor 4: plans, runs and sums.
//!
//! A plan names kernels with their epsilons and sources of cases; a run sends each case once to the
//! oracle and once to each kernel, lets `judge` compare, and adds up. The sums do not depend on the
//! number of threads.

#![forbid(unsafe_code)]

mod accuracy;
mod answers;
mod attribution;
mod by_finding;
mod causes;
mod chunk;
mod command;
mod digest;
mod histogram;
mod interval;
mod judging;
mod plan;
mod run;
mod severity;
mod shard;
mod source;
mod stored;
mod tally;
mod trials;

pub(crate) use accuracy::values;
pub use accuracy::{Accuracy, Errors};
pub use answers::{Answers, Given};
pub use attribution::{Attribution, attribute};
pub use by_finding::ByFinding;
pub use causes::Causes;
pub use chunk::SourceSummary;
pub(crate) use chunk::{CHUNK, Chunk};
pub use command::quoted;
pub use digest::Digest;
pub use histogram::Histogram;
pub use interval::Interval;
pub(crate) use plan::did_you_mean;
pub use plan::{EpsilonChoice, EpsilonText, Plan, PlanError, Row};
pub(crate) use run::verdicts_of;
pub use run::{Audit, Cell, Observer, finish, run, run_scalar, sum};
pub use severity::{Severity, exact_severity};
pub use shard::Shard;
pub use source::{CorpusSet, Source};
pub use stored::{StoredPlan, StoredSource};
pub use tally::{
    ClassCount, Examples, GroupCount, Place, PolygonCount, SelfHits, Severities, Tally,
};
pub use trials::{RayProducts, Trials};

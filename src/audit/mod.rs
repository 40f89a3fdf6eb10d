//! Floor 4: plans, runs and sums.
//!
//! A plan names kernels with their epsilons and sources of cases; a run sends each case once to the
//! oracle and once to each kernel, lets `judge` compare, and adds up. The sums do not depend on the
//! number of threads.

#![forbid(unsafe_code)]

mod accuracy;
mod answers;
mod attribution;
mod causes;
mod chunk;
mod histogram;
mod interval;
mod plan;
mod run;
mod severity;
mod source;
mod tally;

pub use accuracy::{Accuracy, Errors};
pub use answers::{Answers, Given};
pub use attribution::{Attribution, attribute};
pub use causes::Causes;
pub use chunk::SourceSummary;
pub(crate) use chunk::{CHUNK, Chunk};
pub use histogram::Histogram;
pub use interval::{Interval, clopper_pearson};
pub(crate) use plan::did_you_mean;
pub use plan::{EpsilonChoice, EpsilonText, Plan, PlanError, Row};
pub use run::{Audit, Cell, Observer, run, run_scalar};
pub use severity::{Severity, exact_severity};
pub use source::{CorpusSet, Source, quoted};
pub use tally::{
    ClassCount, Examples, GroupCount, Place, PolygonCount, SelfHits, Severities, Tally,
};

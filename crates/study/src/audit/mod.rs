//! Floor 4: plans, runs and sums.
//!
//! A plan names kernels with their epsilons and sources of cases; a run sends each case once to the
//! oracle and once to each kernel, lets `judge` compare, and adds up. The sums do not depend on the
//! number of threads.

#![forbid(unsafe_code)]

mod accuracy;
mod aimed;
mod attribution;
mod by_finding;
mod causes;
mod choice;
mod chunk;
mod corpus_set;
#[cfg(feature = "studies")]
mod coverage;
mod digest;
mod forms;
mod group_count;
mod groups;
mod histogram;
mod interval;
mod judging;
mod neighbours;
mod places;
mod plan;
mod relations;
mod row;
mod rows;
mod run;
mod severity;
mod shard;
mod sketch;
mod source;
mod stored;
mod tally;
mod trials;

pub use crate::engine::{Observer, Unobserved};
pub use crate::kernel::EpsilonText;
pub use accuracy::{Accuracy, Errors};
pub use accuracy::{t_of, values};
pub use aimed::{Aimed, CLASSES};
pub use attribution::attribute_with;
pub use attribution::{Attribution, attribute, attribute_by_running};
pub use by_finding::ByFinding;
pub use causes::Causes;
pub use choice::EpsilonChoice;
pub use chunk::Chunk;
pub use chunk::SourceSummary;
pub use corpus_set::CorpusSet;
#[cfg(feature = "studies")]
pub use coverage::{ASPECTS, Aspect, coverage};
pub use digest::{CasePlace, Digest};
pub use group_count::GroupCount;
pub use group_count::JudgedGroup;
pub use histogram::{Histogram, Octave};
pub use interval::{Interval, clopper_pearson};
pub use judging::polygon_verdict;
pub use places::{FaultCount, PlaceFault};
pub use plan::Plan;
pub use relations::{Related, Relations};
pub use row::flags;
pub use row::{Row, RowSpec, is_one_command, quoted, shell_word};
pub use run::{Audit, SourceCell, finish, run, run_scalar, sum};
pub use severity::{Severity, exact_severity, severity_of_instance};
pub use shard::MOST_SHARDS;
pub use shard::Shard;
pub use source::{CHUNK, Source, Stock, is_of_mesh, kind_of, words};
pub use stored::{StoredPlan, StoredStock};
pub use tally::{ClassCount, Examples, PolygonCount, SelfHits, Severities, Tally};
pub use trials::{RayProducts, Trials};

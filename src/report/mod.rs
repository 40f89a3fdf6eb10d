//! Floor 5: one versioned record a command, and in `formats` one exporter a format.

#![forbid(unsafe_code)]

#[cfg(feature = "studies")]
mod answered;
mod build;
#[cfg(feature = "studies")]
mod chart;
mod conformance;
mod disagreement;
mod distribution;
#[cfg(feature = "studies")]
pub(crate) mod elsewhere;
#[cfg(feature = "studies")]
pub mod epsilon;
#[cfg(feature = "studies")]
pub mod explain;
#[cfg(feature = "studies")]
pub mod formats;
mod illustration;
#[cfg(feature = "studies")]
mod json;
#[cfg(feature = "studies")]
pub mod mesh;
#[cfg(feature = "studies")]
pub mod page;
mod rate;
mod record;
#[cfg(feature = "studies")]
mod shard;

#[cfg(feature = "studies")]
pub use answered::{AnsweredTest, Asked, Product, answered};
pub use build::{Context, build};
pub use conformance::*;
pub(crate) use disagreement::counts_alone;
pub use disagreement::{ALL_CLASSES, Disagreement, Key, disagreements, rate_of};
#[cfg(feature = "studies")]
pub use formats::{FORMATS, Format, HTML, ON_FAILURE, Style};
pub use illustration::{Illustrations, ProofPart, ProvedGate};
#[cfg(feature = "cli")]
pub use json::JSON_SCHEMA;
#[cfg(feature = "studies")]
pub use json::write_json;
pub(crate) use rate::{interval_of, percent};
pub use record::*;
#[cfg(feature = "studies")]
pub use shard::{Mergeable, ShardError, mergeable, merged, shard_part};

pub(crate) use crate::plot::group_digits;
/// `3 findings`, `1 finding`.
pub(crate) fn number_of(count: u64, one: &str, many: &str) -> String {
    format!("{} {}", group_digits(count), if count == 1 { one } else { many })
}

#[cfg(test)]
pub(crate) mod tests {
    pub mod schema;
}

//! Floor 5: one versioned record a command, and in `formats` one exporter a format.

#![forbid(unsafe_code)]

mod build;
#[cfg(feature = "studies")]
mod chart;
mod conformance;
mod disagreement;
mod distribution;
#[cfg(feature = "studies")]
mod drawing;
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
pub mod mesh;
#[cfg(feature = "studies")]
pub mod page;
mod rate;
mod record;
#[cfg(feature = "studies")]
mod segments;
#[cfg(feature = "studies")]
mod shard;
#[cfg(feature = "studies")]
mod surface;

pub use build::{Context, build, provenance_of};
pub use conformance::*;
pub(crate) use disagreement::counts_alone;
pub use disagreement::{ALL_CLASSES, Disagreement, Key, disagreements, rate_of};
#[cfg(feature = "studies")]
pub use drawing::{MeshDrawing, drawing, places};
#[cfg(feature = "studies")]
pub use formats::{
    FORMATS, Format, HTML, JunitCase, ON_FAILURE, Style, severity, write_json, write_junit,
};
#[cfg(feature = "cli")]
pub use formats::{JSON_SCHEMA, write_json_line};
pub use illustration::{Illustrations, ProofPart, ProvedGate};
pub(crate) use rate::{interval_of, percent};
pub use record::*;
#[cfg(feature = "cli")]
pub(crate) use segments::short_length;
#[cfg(feature = "studies")]
pub use segments::{SegmentEndPart, SegmentKindPart, SegmentsPart};
#[cfg(feature = "studies")]
pub use shard::{Mergeable, ShardError, mergeable, merged, shard_part};

pub(crate) use crate::plot::{group_digits, number_of};

/// Names in a sentence; of many the first, and how many more there are.
#[cfg(feature = "studies")]
pub(crate) fn listed(names: &[impl AsRef<str>], most: usize) -> String {
    let shown: Vec<&str> = names.iter().take(most).map(AsRef::as_ref).collect();
    match names.len().saturating_sub(most) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

/// Each thing with those after it that are like it.
#[cfg(feature = "studies")]
pub(crate) fn alike<T>(
    all: impl IntoIterator<Item = T>,
    is_like: impl Fn(&T, &T) -> bool,
) -> Vec<(T, Vec<T>)> {
    let mut groups: Vec<(T, Vec<T>)> = Vec::new();
    for one in all {
        match groups.iter_mut().find(|(first, _)| is_like(first, &one)) {
            Some((_, like)) => like.push(one),
            None => groups.push((one, Vec::new())),
        }
    }
    groups
}

#[cfg(test)]
pub(crate) mod tests {
    pub mod schema;
}

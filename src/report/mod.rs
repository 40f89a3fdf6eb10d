//! Floor 5: one versioned record, and one exporter a format.
//!
//! To add a format: write its file with a `write` function from a [`Record`], and give it a row in
//! [`FORMATS`].

#![forbid(unsafe_code)]

mod build;
mod close_up;
mod columns;
mod conformance;
mod disagreement;
mod distribution;
#[cfg(feature = "studies")]
pub mod epsilon;
mod extremes;
#[cfg(feature = "cli")]
mod html;
#[cfg(feature = "cli")]
mod illustrate;
mod illustration;
mod json;
mod jsonl;
mod junit;
mod lines;
mod markdown;
#[cfg(feature = "studies")]
pub mod mesh;
mod net;
mod next;
mod pool;
mod rate;
mod record;
mod row_view;
mod sarif;
#[cfg(feature = "studies")]
pub mod scene;
mod screen;
mod shard;
mod text;
#[cfg(test)]
pub(crate) mod tests {
    pub mod schema;
}
mod verdict;
mod why;
mod worst;

pub use build::{Context, build};
pub use conformance::*;
pub(crate) use disagreement::counts_alone;
use disagreement::kinds_of;
pub use disagreement::{ALL_CLASSES, Disagreement, FINDING_KINDS, Key, disagreements, rate_of};
#[cfg(feature = "cli")]
pub use illustrate::illustrations;
pub use illustration::{Illustrations, MapPart, ResponsePart};
#[cfg(feature = "cli")]
pub use json::JSON_SCHEMA;
pub use json::write_json;
pub use markdown::{LIMIT as MARKDOWN_LIMIT, within as markdown_within};
pub(crate) use rate::{interval_of, percent};
pub use record::*;
pub use shard::{Mergeable, PartialPart, ShardError, ShardPart, mergeable, merged, shard_part};

pub(crate) use crate::plot::group_digits;
use std::io::{self, Write};

/// How people-facing formats look.
#[derive(Clone, Copy, Debug, Default)]
pub struct Style {
    /// Whether to use terminal colours.
    pub color: bool,
    /// Whether to print everything: the tables by scalar, and every class of finding of every kernel.
    pub details: bool,
}

/// A format that a record can be written in.
pub struct Format {
    /// The name on the command line.
    pub name: &'static str,
    /// Writes a record.
    pub write: fn(&Record, Style, &mut dyn Write) -> io::Result<()>,
}

/// The format that shows pictures.
pub const HTML: &str = "html";

/// One row per format.
pub const FORMATS: &[Format] = &[
    Format { name: "text", write: text::write },
    Format { name: "json", write: json::write },
    Format { name: "jsonl", write: jsonl::write },
    Format { name: "junit", write: junit::write },
    Format { name: "sarif", write: sarif::write },
    Format { name: "markdown", write: markdown::write },
    #[cfg(feature = "cli")]
    Format { name: HTML, write: html::write },
];

/// `3 findings`, `1 finding`.
pub(crate) fn number_of(count: u64, one: &str, many: &str) -> String {
    format!("{} {}", group_digits(count), if count == 1 { one } else { many })
}

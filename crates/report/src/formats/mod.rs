//! A record for people and for other programs: one exporter a format.
//!
//! To add a format: write its file with a `write` function from a record, and give it a row in
//! [`FORMATS`].

mod close_up;
mod columns;
mod extremes;
mod headline;
mod junit;
mod kernel;
mod lines;
mod page;
mod pool;
mod ranking;
mod relations;
mod remedies;
mod row_view;
mod sarif;
mod screen;
mod standing;
mod verdict;
mod why;
mod worst;

pub use junit::{JunitCase, write_junit};
pub use worst::severity;

use crate::format::Format;
use std::io::{self, Write};

/// Writes that there is no record, with the exit code and the message.
type WriteFailure = fn(u8, &str, &mut dyn Write) -> io::Result<()>;

/// The formats that a CI reads after the run, by name: without them it would show an older run's.
pub const ON_FAILURE: &[(&str, WriteFailure)] = &[
    ("junit", junit::write_failure),
    ("sarif", sarif::write_failure),
];

/// The format that shows pictures.
pub const HTML: &str = "html";

/// One row per format.
pub const FORMATS: &[Format] = &[
    Format::TEXT,
    Format::JSON,
    Format {
        name: "junit",
        write: junit::write,
    },
    Format {
        name: "sarif",
        write: sarif::write,
    },
    Format::MARKDOWN,
    #[cfg(feature = "pages")]
    Format::HTML,
];

/// A text with a large first letter.
fn capitalised(text: &str) -> String {
    let (first, rest) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
    format!("{}{rest}", first.to_uppercase())
}

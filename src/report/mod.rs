//! Floor 5: one versioned record, and one exporter a format.
//!
//! To add a format: write its file with a `write` function from a [`Record`], and give it a row in
//! [`FORMATS`].

#![forbid(unsafe_code)]

mod build;
mod distribution;
pub mod epsilon;
mod json;
mod record;
mod text;
mod why;

pub use build::{Context, build};
pub use record::*;
pub(crate) use text::interval_of;

use std::io::{self, Write};

/// How people-facing formats look.
#[derive(Clone, Copy, Debug, Default)]
pub struct Style {
    /// Whether to use terminal colours.
    pub color: bool,
    /// Whether to list every class of finding of every kernel.
    pub details: bool,
}

/// A format that a record can be written in.
pub struct Format {
    /// The name on the command line.
    pub name: &'static str,
    /// Writes a record.
    pub write: fn(&Record, Style, &mut dyn Write) -> io::Result<()>,
}

/// One row per format.
pub const FORMATS: &[Format] =
    &[Format { name: "text", write: text::write }, Format { name: "json", write: json::write }];

/// Digits in groups of three.
pub(crate) fn group_digits(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

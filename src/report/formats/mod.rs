//! A record for people and for other programs: one exporter a format.
//!
//! To add a format: write its file with a `write` function from a [`Record`], and give it a row in
//! [`FORMATS`].

mod close_up;
mod columns;
mod extremes;
mod junit;
mod kernel;
mod lines;
mod page;
mod pool;
mod ranking;
mod relations;
mod row_view;
mod sarif;
mod screen;
mod standing;
mod verdict;
mod why;
mod worst;

pub use junit::{JunitCase, write_junit};
pub use worst::severity;

use super::disagreement::kinds_of;
use super::*;
use super::{disagreement, rate, record};
use crate::printable::is_obeyed;
use serde::Serialize;
use std::io::{self, Write};

/// How people-facing formats look.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// True if terminal colours are used.
    pub color: bool,
    /// True if everything is printed: the tables by scalar, and every class of finding of every kernel.
    pub details: bool,
    /// The most characters of a line of text, but for commands to paste.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Style {
        Style {
            color: false,
            details: false,
            width: Style::WIDTH,
        }
    }
}

impl Style {
    /// The width where there is no terminal.
    pub const WIDTH: usize = 80;
    /// The most that is used of a terminal's.
    pub const WIDEST: usize = 160;
}

/// A format that a record can be written in.
pub struct Format<R: 'static = Record> {
    /// The name on the command line.
    pub name: &'static str,
    /// Writes a record.
    pub write: fn(&R, Style, &mut dyn Write) -> io::Result<()>,
}

impl<R: Serialize> Format<R> {
    /// One JSON value over several lines.
    pub const JSON: Format<R> = Format {
        name: "json",
        write: |record, _, out| write_json(record, out),
    };
}

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

/// The JSON Schema of the record. The tests derive it from the types; the program only prints it.
#[cfg(feature = "cli")]
pub const JSON_SCHEMA: &str = include_str!("../../../docs/schema/record.json");

/// Writes one value over several lines, and a newline.
///
/// Only strings hold characters that a terminal obeys, and there an escape means the same.
pub fn write_json(value: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    let text = serde_json::to_string_pretty(value)?;
    write_json_text(&text, out)
}

/// Writes one value on one line.
#[cfg(feature = "cli")]
pub fn write_json_line(value: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    let text = serde_json::to_string(value)?;
    write_json_text(&text, out)
}

/// Writes JSON and a newline, with escapes for what a terminal obeys: it stands in strings only, where they mean the same.
fn write_json_text(text: &str, out: &mut dyn Write) -> io::Result<()> {
    let mut rest = text;
    while let Some(at) = rest.find(|c| c != '\n' && is_obeyed(c)) {
        let (before, order_and_rest) = rest.split_at(at);
        let mut chars = order_and_rest.chars();
        let order = chars.next().map_or(0, u32::from);
        write!(out, "{before}\\u{order:04x}")?;
        rest = chars.as_str();
    }
    writeln!(out, "{rest}")
}

/// A text with a large first letter.
fn capitalised(text: &str) -> String {
    let (first, rest) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
    format!("{}{rest}", first.to_uppercase())
}

//! A format: its name, and a function that writes a record in it; how much of it people see, and how wide; JSON.

use crate::printable::is_obeyed;
use hairline_record::Record;
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

/// Writes one value over several lines, and a newline.
///
/// Only strings hold characters that a terminal obeys, and there an escape means the same.
pub fn write_json(value: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    let text = serde_json::to_string_pretty(value)?;
    write_json_text(&text, out)
}

/// Writes one value on one line.
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

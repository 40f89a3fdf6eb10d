//! The record as JSON, one object.

use super::{Record, Style};
use std::io::{self, Write};

/// Writes the record and a newline.
pub(super) fn write(record: &Record, _: Style, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, record)?;
    writeln!(out)
}

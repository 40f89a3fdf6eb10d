//! Records as JSON, one object.

use serde::Serialize;
use std::io::{self, Write};

/// The JSON Schema of the record. The tests derive it from the types; the program only prints it.
#[cfg(feature = "cli")]
pub const JSON_SCHEMA: &str = include_str!("../../docs/schema/record.json");

/// Writes one value over several lines, and a newline.
pub fn write_json(value: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    writeln!(out)
}

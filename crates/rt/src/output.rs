//! Standard output, and files.

use crate::failure::Failure;
use serde::Serialize;
use std::fmt::Display;
use std::fs;
use std::io::{self, ErrorKind, Write};

/// Prints a text. A reader that has seen enough, as `head`, is no error.
pub fn print(text: &impl Display) -> Result<(), Failure> {
    match io::stdout().write_all(text.to_string().as_bytes()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|error| Failure::of_file("standard output", &error)),
    }
}

/// Writes data as JSON into a file.
pub fn write_json(path: &str, data: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(data).expect("numbers and names") + "\n";
    write_file(path, text.as_bytes()).map_err(|error| Failure::of_file(path, &error))
}

/// Writes a file: beside it, and renamed.
pub fn write_file(path: &str, bytes: &[u8]) -> io::Result<()> {
    let beside = format!("{path}.part");
    fs::write(&beside, bytes)?;
    fs::rename(&beside, path)
}

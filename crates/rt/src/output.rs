//! Standard output, and files.

use crate::failure::Failure;
use serde::Serialize;
use std::fmt::Display;
use std::fs;
use std::io::{self, ErrorKind, IsTerminal, Write};

/// Says on a terminal what is being done, in a line that the next one replaces; an empty one clears it.
pub fn progress(doing: &str) {
    let mut terminal = io::stderr();
    if terminal.is_terminal() {
        // Nothing depends on it.
        let _ = write!(terminal, "\r\x1b[K{doing}");
    }
}

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

/// Writes a file: beside it, and renamed. What is no file, as a device or a pipe, is written to; a link stays one.
pub fn write_file(path: &str, bytes: &[u8]) -> io::Result<()> {
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.into());
    if fs::metadata(&place).is_ok_and(|old| !old.is_file()) {
        return fs::write(place, bytes);
    }
    let mut beside = place.clone().into_os_string();
    beside.push(".part");
    let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, &place));
    if written.is_err() {
        // What is left of it helps nobody.
        let _ = fs::remove_file(&beside);
    }
    written
}

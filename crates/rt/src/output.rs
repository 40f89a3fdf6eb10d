//! Standard output, and files.

use crate::failure::Failure;
use serde::Serialize;
use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};

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
        written => written.map_err(|error| Failure::of_output("standard output", &error)),
    }
}

/// Writes data as JSON into a file.
pub fn write_json(path: &str, data: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(data).expect("numbers and names") + "\n";
    write_file(path, text.as_bytes())
}

/// Refuses an output that could not be written, before the work whose result it would hold.
pub fn check_output(path: &str) -> Result<(), Failure> {
    let place = place_of(path);
    let checked = match (place.is_dir(), is_stream(&place)) {
        (true, _) => Err(ErrorKind::IsADirectory.into()),
        (false, true) => Ok(()),
        (false, false) => {
            let beside = beside(&place);
            File::create(&beside).and_then(|_| fs::remove_file(&beside))
        }
    };
    checked.map_err(|error| Failure::of_output(path, &error))
}

/// Writes a file: beside it, and renamed. What is no file, as a device or a pipe, is written to; a link stays one.
pub fn write_file(path: &str, bytes: &[u8]) -> Result<(), Failure> {
    let place = place_of(path);
    let written = match is_stream(&place) {
        true => fs::write(place, bytes),
        false => {
            let beside = beside(&place);
            let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, &place));
            if written.is_err() {
                // What is left of it helps nobody.
                let _ = fs::remove_file(&beside);
            }
            written
        }
    };
    written.map_err(|error| Failure::of_output(path, &error))
}

/// The file that a link leads to.
fn place_of(path: &str) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.into())
}

/// True of a device, a pipe or a folder.
fn is_stream(place: &Path) -> bool {
    fs::metadata(place).is_ok_and(|old| !old.is_file())
}

fn beside(place: &Path) -> PathBuf {
    let mut beside = place.as_os_str().to_owned();
    beside.push(".part");
    beside.into()
}

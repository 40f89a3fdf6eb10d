//! Floor 2: cases on disk, and meshes. Takes readers and writers; opens no file itself.

#![forbid(unsafe_code)]

#[cfg(feature = "studies")]
pub mod case_json;
mod fan;
#[cfg(feature = "studies")]
mod found_by;
#[cfg(feature = "studies")]
pub mod json;
#[cfg(feature = "studies")]
pub mod json_lines;
#[cfg(feature = "studies")]
pub mod lines;
pub mod mesh;
#[cfg(feature = "studies")]
pub mod number;
#[cfg(feature = "studies")]
mod plain_json;
mod polygon;
#[cfg(feature = "studies")]
mod stored_case;
#[cfg(feature = "studies")]
mod stored_truth;
#[cfg(feature = "studies")]
pub mod text_lines;
#[cfg(feature = "studies")]
pub mod truth_json;

pub use fan::{is_without_area, winds_once};
#[cfg(feature = "studies")]
pub use found_by::FoundBy;

use std::{fmt, io};

/// An error in an input, and its place.
#[derive(Debug)]
pub struct InputError {
    /// The file's name as the user gave it; `-` for standard input.
    pub file: String,
    /// Counted from 1.
    pub line: Option<usize>,
    /// The message, in one line: what was found and what was expected.
    pub message: String,
    /// True if reading failed, whatever the data are.
    pub unreadable: bool,
}

impl InputError {
    /// With a line number.
    pub fn at(file: &str, line: usize, message: impl Into<String>) -> InputError {
        InputError {
            line: Some(line),
            ..InputError::of(file, message)
        }
    }

    /// About the file as a whole.
    pub fn of(file: &str, message: impl Into<String>) -> InputError {
        InputError {
            file: file.to_owned(),
            line: None,
            message: message.into(),
            unreadable: false,
        }
    }

    /// An error of reading itself, at a line if it is known.
    pub fn reading(file: &str, line: Option<usize>, error: &io::Error) -> InputError {
        let unread = InputError::of(file, format!("cannot read: {error}"));
        InputError {
            line,
            unreadable: true,
            ..unread
        }
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file, self.message),
            None => write!(f, "{}: {}", self.file, self.message),
        }
    }
}

impl std::error::Error for InputError {}

/// Bytes as lower-case hexadecimal digits.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

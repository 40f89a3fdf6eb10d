//! An error in a file of somebody else, and its place.

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

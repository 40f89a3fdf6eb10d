//! Exit codes, and the errors that lead to them.

#![forbid(unsafe_code)]

use crate::files::InputError;
use hairline_core::Error;
use std::io;
use std::path::Path;

/// How the program ends. The README's table is tested against this one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It ran.
    Success = 0,
    /// Unexpected disagreements.
    Disagreements = 1,
    /// Wrong usage or configuration.
    Usage = 2,
    /// Stale expectations.
    Stale = 3,
    /// Nothing was selected.
    NothingSelected = 4,
    /// Bad input data.
    BadInput = 65,
    /// The tool's own self-check failed.
    SelfCheck = 70,
    /// Input or output failed.
    InputOutput = 74,
}

/// Why a command stops.
#[derive(Debug)]
pub enum Failure {
    /// With a message of one line.
    Message(Status, String),
    /// The reader of the output has closed it, which is no error.
    ClosedPipe,
}

impl Failure {
    /// Wrong usage or configuration.
    pub fn usage(message: impl Into<String>) -> Failure {
        Failure::Message(Status::Usage, message.into())
    }

    /// Nothing was selected.
    pub fn nothing(message: impl Into<String>) -> Failure {
        Failure::Message(Status::NothingSelected, message.into())
    }

    /// Bad input data.
    pub fn bad_input(message: impl Into<String>) -> Failure {
        Failure::Message(Status::BadInput, message.into())
    }

    /// A fault of this program.
    pub fn self_check(message: impl Into<String>) -> Failure {
        Failure::Message(Status::SelfCheck, message.into())
    }

    /// The message for the user.
    pub fn message(&self) -> Option<&str> {
        match self {
            Failure::Message(_, message) => Some(message),
            Failure::ClosedPipe => None,
        }
    }

    /// The exit code.
    pub fn status(&self) -> Status {
        match self {
            Failure::Message(status, _) => *status,
            Failure::ClosedPipe => Status::Success,
        }
    }

    /// An error of reading or writing at a path.
    pub fn of_path(path: &Path, error: &io::Error) -> Failure {
        Failure::of_file(&path.display().to_string(), error)
    }

    /// An error of reading or writing a file.
    pub fn of_file(file: &str, error: &io::Error) -> Failure {
        if error.kind() == io::ErrorKind::BrokenPipe {
            return Failure::ClosedPipe;
        }
        Failure::Message(Status::InputOutput, format!("{file}: {error}"))
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Failure {
        Failure::usage(error.to_string())
    }
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Failure {
        let status = if error.unreadable {
            Status::InputOutput
        } else {
            Status::BadInput
        };
        Failure::Message(status, error.to_string())
    }
}

impl From<io::Error> for Failure {
    /// An error of writing to standard output.
    fn from(error: io::Error) -> Failure {
        Failure::of_file("standard output", &error)
    }
}

//! Why something could not be done, and the exit code that says so.

use hairline_files::InputError;
use std::fmt::Display;
use std::io;

/// A failure of the program.
pub struct Failure {
    /// The exit code, one of sysexits.h.
    pub code: u8,
    /// The reason, in one line.
    pub message: String,
}

impl Failure {
    /// The input is wrong.
    pub fn data(message: impl Into<String>) -> Failure {
        Failure {
            code: 65,
            message: message.into(),
        }
    }

    /// There is no device that can do it.
    pub fn unavailable(message: impl Display) -> Failure {
        Failure {
            code: 69,
            message: message.to_string().replace('\n', "; "),
        }
    }

    /// A file cannot be written.
    pub fn of_output(path: &str, error: &io::Error) -> Failure {
        Failure {
            code: 74,
            message: format!("{path}: {error}"),
        }
    }

    /// A file cannot be read.
    pub fn of_file(path: &str, error: &io::Error) -> Failure {
        let code = match error.kind() {
            io::ErrorKind::NotFound => 66,
            _ => 74,
        };
        Failure {
            code,
            message: format!("{path}: {error}"),
        }
    }
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Failure {
        Failure::data(error.to_string())
    }
}

//! Floor 0: the error of everything that reads words or makes plans of them.

#![forbid(unsafe_code)]

use std::fmt;

/// Why something cannot be done: one line for people, which says what is wrong and what was expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error(pub String);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

impl From<String> for Error {
    fn from(line: String) -> Error {
        Error(line)
    }
}

impl From<Error> for String {
    fn from(Error(line): Error) -> String {
        line
    }
}

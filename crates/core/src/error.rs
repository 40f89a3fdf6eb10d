//! Floor 0: the error of everything that reads words, makes plans of them, or opens files for a caller.

#![forbid(unsafe_code)]

use std::fmt;
use std::sync::Arc;

/// Why something cannot be done: a kind for programs, and one line for people, which says what is wrong and what was
/// expected.
#[derive(Clone, Debug)]
pub struct Error {
    kind: ErrorKind,
    line: String,
    source: Option<Arc<dyn std::error::Error + Send + Sync>>,
}

/// The kinds of an [`Error`], which a program can tell without reading its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A text has another form than was expected.
    Syntax,
    /// Nothing has this name.
    UnknownName,
    /// Something is given twice.
    Repeated,
    /// A number is outside what is allowed, or a scalar cannot hold it.
    OutOfRange,
    /// The kernel cannot do that: it runs in the other scalar alone, or has no such gate, or shows no formula.
    Unsupported,
    /// Two settings exclude each other.
    Conflict,
    /// There is no case, or no triangle, to ask about.
    Nothing,
    /// A file cannot be read or written; [`source`](std::error::Error::source) says why.
    File,
    /// A file holds something else than was expected.
    Data,
}

impl Error {
    /// An error of a kind, with its line.
    pub fn new(kind: ErrorKind, line: impl Into<String>) -> Error {
        Error {
            kind,
            line: line.into(),
            source: None,
        }
    }

    /// A text that has another form than was expected.
    pub fn syntax(line: impl Into<String>) -> Error {
        Error::new(ErrorKind::Syntax, line)
    }

    /// A file that cannot be read or written.
    pub fn of_file(name: &str, source: std::io::Error) -> Error {
        let line = format!("{name}: {source}");
        Error {
            source: Some(Arc::new(source)),
            ..Error::new(ErrorKind::File, line)
        }
    }

    /// The kind.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The error with the name of what it is about before its line: `band: '4' is …`.
    pub fn about(self, what: &str) -> Error {
        Error {
            line: format!("{what}: {}", self.line),
            ..self
        }
    }
}

/// Two are equal if they say the same.
impl PartialEq for Error {
    fn eq(&self, other: &Error) -> bool {
        (self.kind, &self.line) == (other.kind, &other.line)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.line)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        let source = self.source.as_deref()?;
        Some(source)
    }
}

impl From<Error> for String {
    fn from(error: Error) -> String {
        error.line
    }
}

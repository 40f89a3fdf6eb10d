//! Files that people name, or that somebody else has put where they are looked for.
//!
//! A named pipe without a writer keeps a reader waiting for ever, and a device gives bytes without end: neither is read. What
//! is read whole has a limit, so that no file fills the memory.

#![forbid(unsafe_code)]

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// The most bytes that are read of a kind of file.
#[derive(Clone, Copy, Debug)]
pub struct SizeLimit {
    kind: &'static str,
    mebibytes: u64,
}

impl SizeLimit {
    /// A record, or a product's answers.
    pub const RECORD: SizeLimit = SizeLimit {
        kind: "a record",
        mebibytes: 256,
    };
    /// hairline.toml, and what a campaign was begun with.
    pub const SETTINGS: SizeLimit = SizeLimit {
        kind: "settings",
        mebibytes: 1,
    };
    /// Expectations, and their lock.
    pub const EXPECTATIONS: SizeLimit = SizeLimit {
        kind: "expectations",
        mebibytes: 64,
    };
    /// A certificate; its checker takes no larger one.
    pub const CERTIFICATE: SizeLimit = SizeLimit {
        kind: "a certificate",
        mebibytes: 4,
    };
    /// Cases: finds, witnesses, inputs of a fuzzer.
    pub const CASES: SizeLimit = SizeLimit {
        kind: "a file of cases",
        mebibytes: 256,
    };

    fn bytes(self) -> u64 {
        self.mebibytes << 20
    }
}

/// Opens a file. A stream that a shell has opened, as for `<(command)`, is one too, and so is nothing.
pub fn open(path: &Path) -> io::Result<File> {
    let is_open_already = ["/dev/fd", "/proc/self/fd"]
        .iter()
        .any(|folder| path.starts_with(folder))
        || ["/dev/stdin", "/dev/null"].contains(&&*path.to_string_lossy());
    let metadata = fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(io::Error::from(io::ErrorKind::IsADirectory));
    }
    if !metadata.is_file() && !is_open_already {
        let message = "no ordinary file: a pipe may have no end; standard input is named -";
        return Err(io::Error::other(message));
    }
    File::open(path)
}

/// Reads a file whole.
pub fn read(path: &Path, limit: SizeLimit) -> io::Result<Vec<u8>> {
    read_within(open(path)?, limit)
}

/// Reads a stream whole.
pub fn read_within(stream: impl Read, limit: SizeLimit) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(limit.bytes() + 1).read_to_end(&mut bytes)?;
    if limit.bytes() < bytes.len() as u64 {
        let SizeLimit { kind, mebibytes } = limit;
        let message = format!("more than {mebibytes} MiB, the most that {kind} may have");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

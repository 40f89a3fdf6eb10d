//! Which file a name on the command line stands for: itself, what a link leads to, or an open file.

#![forbid(unsafe_code)]

use std::fs;
use std::path::{Path, PathBuf};

/// The file of a name: `a`, `./a` and a link to it are one.
pub fn place_of(path: &str) -> PathBuf {
    match linked(Path::new(path)) {
        path if is_standard_output(&path) => "-".into(),
        path => std::path::absolute(&path).unwrap_or(path),
    }
}

/// Where a path leads if it is a link, also to a file that is yet to be made.
pub fn linked(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    // As many links as Linux follows.
    for _ in 0..40 {
        match fs::read_link(&path) {
            Ok(target) if !is_descriptor(&path) => {
                path.pop();
                path.push(target);
            }
            _ => break,
        }
    }
    path
}

/// True if a path, links followed, names standard output.
pub fn is_standard_output(path: &Path) -> bool {
    ["-", "/dev/fd/1", "/proc/self/fd/1"]
        .iter()
        .any(|name| path == Path::new(name))
}

/// True if a path names an open file, as that of `/dev/stdout` does.
pub fn is_descriptor(path: &Path) -> bool {
    path.starts_with("/proc") || path.starts_with("/dev/fd")
}

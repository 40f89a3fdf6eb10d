//! Standard input and output: an error if one was not open when the program started.
//!
//! Rust opens `/dev/null` in the place of a closed descriptor before `main`, and takes an error about one
//! that is open the wrong way for success; so they are looked at before that.

#![allow(unsafe_code)]

use std::io;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

static READABLE: AtomicBool = AtomicBool::new(true);
static WRITABLE: AtomicBool = AtomicBool::new(true);

/// An error if standard input cannot be read.
pub fn standard_input() -> io::Result<()> {
    let closed = || io::Error::other("closed, or not open for reading");
    READABLE.load(Relaxed).then_some(()).ok_or_else(closed)
}

/// An error if standard output cannot be written.
pub fn standard_output() -> io::Result<()> {
    let closed = || io::Error::other("closed, or not open for writing");
    WRITABLE.load(Relaxed).then_some(()).ok_or_else(closed)
}

#[cfg(target_os = "linux")]
extern "C" fn look() {
    for (descriptor, usable, wrong) in [
        (0, &READABLE, libc::O_WRONLY),
        (1, &WRITABLE, libc::O_RDONLY),
    ] {
        // SAFETY: it reads the flags of a descriptor, and fails for one that is closed.
        let flags = unsafe { libc::fcntl(descriptor, libc::F_GETFL) };
        usable.store(flags != -1 && flags & libc::O_ACCMODE != wrong, Relaxed);
    }
}

/// The function that the loader calls before `main`.
// SAFETY: the section holds addresses of functions, and `look` needs nothing of Rust's runtime.
#[cfg(target_os = "linux")]
#[used]
#[unsafe(link_section = ".init_array")]
static LOOK: extern "C" fn() = look;

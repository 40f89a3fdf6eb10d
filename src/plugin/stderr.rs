//! Passes on what a kernel's processes write to standard error, up to a number of lines, so that a kernel
//! that prints on every case does not bury everything else.

#![forbid(unsafe_code)]

use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::ChildStderr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;

/// So many lines of all processes of a kernel are passed on.
pub(super) const MOST_LINES: u64 = 50;

/// The most bytes of a line.
const LONGEST: u64 = 4096;

/// How many lines came from all processes of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct Lines(Arc<AtomicU64>);

impl Lines {
    /// True if some lines were left out.
    pub fn are_too_many(&self) -> bool {
        MOST_LINES < self.0.load(Ordering::Relaxed)
    }

    /// Passes on what a process writes, until it ends; then the other side of the channel is gone.
    pub fn pass_on(&self, from: ChildStderr) -> Receiver<()> {
        let (lives, ended) = sync_channel(0);
        let count = Arc::clone(&self.0);
        thread::spawn(move || {
            let (mut from, mut line) = (BufReader::new(from), Vec::new());
            while let Ok(1..) = from.by_ref().take(LONGEST).read_until(b'\n', &mut line) {
                if count.fetch_add(1, Ordering::Relaxed) < MOST_LINES {
                    let _ = io::stderr().write_all(&line);
                }
                line.clear();
            }
            drop(lives);
        });
        ended
    }
}

//! Passes on what a kernel's processes write to standard error, each line once and up to a number of lines, so that a
//! kernel that prints on every case does not bury everything else.

#![forbid(unsafe_code)]

use std::collections::HashSet;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::ChildStderr;
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// So many lines of all processes of a kernel are passed on.
pub(super) const MOST_LINES: usize = 50;

/// The most bytes of a line.
const LONGEST: u64 = 4096;

/// The different lines that came from all processes of a program, until there were too many.
#[derive(Clone, Debug, Default)]
pub(super) struct StderrLines(Arc<Mutex<HashSet<Vec<u8>>>>);

impl StderrLines {
    /// True if there were some.
    pub fn are_some(&self) -> bool {
        !self
            .0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .is_empty()
    }

    /// True if some lines were left out.
    pub fn are_too_many(&self) -> bool {
        MOST_LINES < self.0.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// True if a line is to be passed on: it is new, and one of the first.
    fn add(&self, line: &[u8]) -> bool {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.len() <= MOST_LINES && known.insert(line.to_owned()) && known.len() <= MOST_LINES
    }

    /// Passes on what a process writes, until it ends; then the other side of the channel is gone.
    pub fn pass_on(&self, from: ChildStderr) -> Receiver<()> {
        let (lives, ended) = sync_channel(0);
        let known = self.clone();
        thread::spawn(move || {
            let (mut from, mut line) = (BufReader::new(from), Vec::new());
            while let Ok(1..) = from.by_ref().take(LONGEST).read_until(b'\n', &mut line) {
                if known.add(&line) {
                    let _ = io::stderr().write_all(&line);
                }
                line.clear();
            }
            drop(lives);
        });
        ended
    }
}

//! One process a campaign directory.
//!
//! The system holds the lock, on an open file, and releases it when the process ends in whatever way.
//! The file names the process for others to read; it is empty when nobody holds the lock.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::Path;

/// Held until it is dropped.
pub struct FolderLock {
    file: File,
}

/// Why there is no lock.
pub enum LockError {
    /// Another process holds it.
    Held(String),
    /// The file system reports an error.
    Io(io::Error),
}

impl FolderLock {
    /// Takes the lock at a path; true if the last process to hold it was killed.
    pub fn take(path: &Path) -> Result<(FolderLock, bool), LockError> {
        let file = File::options().create(true).truncate(false).write(true).open(path);
        let mut file = file.map_err(LockError::Io)?;
        let holder = || fs::read_to_string(path).unwrap_or_default();
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::Error(error)) => return Err(LockError::Io(error)),
            Err(TryLockError::WouldBlock) => {
                let message = format!("another campaign writes here: {}", holder().trim_end());
                return Err(LockError::Held(message));
            }
        }
        let was_killed = !holder().is_empty();
        let owner = format!("process {} on {}\n", std::process::id(), host());
        let written = file.set_len(0).and_then(|()| file.write_all(owner.as_bytes()));
        written.map_err(LockError::Io)?;
        Ok((FolderLock { file }, was_killed))
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        let _ = self.file.set_len(0);
    }
}

/// The machine's name, where the system tells it in a file.
fn host() -> String {
    let name = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let name = name.trim();
    if name.is_empty() { "this machine".to_owned() } else { name.to_owned() }
}

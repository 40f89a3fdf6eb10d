//! One process a campaign directory.
//!
//! The system holds the lock, on an open file, and releases it when the process ends in whatever way.
//! The file names the process for others to read; it is empty when nobody holds the lock.

use crate::cli::exit::{Failure, Status};
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::Path;

/// Held until it is dropped.
pub struct FolderLock {
    file: File,
}

impl FolderLock {
    /// Takes the lock of a folder, and tells if the last process to hold it was killed.
    pub fn take(folder: &Path) -> Result<FolderLock, Failure> {
        let path = folder.join("lock");
        let failed = |error: io::Error| Failure::of_path(&path, &error);
        let file = File::options().create(true).truncate(false).write(true).open(&path);
        let mut file = file.map_err(failed)?;
        let holder = || fs::read_to_string(&path).unwrap_or_default();
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::Error(error)) => return Err(failed(error)),
            Err(TryLockError::WouldBlock) => {
                let (folder, holder) = (folder.display(), holder());
                let message =
                    format!("{folder}: another campaign writes here: {}", holder.trim_end());
                return Err(Failure::Message(Status::InputOutput, message));
            }
        }
        if !holder().is_empty() {
            eprintln!("{}: its process is gone; the campaign goes on here", path.display());
        }
        let owner = format!("process {} on {}\n", std::process::id(), host());
        let written = file.set_len(0).and_then(|()| file.write_all(owner.as_bytes()));
        written.map_err(failed)?;
        Ok(FolderLock { file })
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

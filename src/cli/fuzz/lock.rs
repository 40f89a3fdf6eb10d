//! One process a campaign directory.
//!
//! The lock is a file that names its owner: host, process and when that process began. It is made
//! beside its place and linked there, so that it is never seen empty. The lock of a process that is
//! gone is taken over.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Held until it is dropped.
pub struct Lock {
    path: PathBuf,
}

/// Why there is no lock.
pub enum LockError {
    /// Another process holds it.
    Held(String),
    /// The file system says no.
    Io(io::Error),
}

impl Lock {
    /// Takes the lock at a path, also from a process that is gone; true if it was.
    pub fn take(path: &Path) -> Result<(Lock, bool), LockError> {
        if let Some(lock) = Lock::try_take(path)? {
            return Ok((lock, false));
        }
        // Who takes over holds a lock on taking over: two at once would remove each other's.
        let takeover = path.with_extension("takeover");
        let guard = match Lock::try_take(&takeover)? {
            Some(guard) => guard,
            None => return Err(held(path, &takeover)?),
        };
        let owner = match fs::read_to_string(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
            owner => owner.map_err(LockError::Io)?,
        };
        if !is_gone(&owner) {
            return Err(held(path, path)?);
        }
        let _ = fs::remove_file(path);
        let lock = Lock::try_take(path)?;
        drop(guard);
        match lock {
            Some(lock) => Ok((lock, true)),
            None => Err(held(path, path)?),
        }
    }

    /// Takes a lock that nobody has; none if somebody has it.
    fn try_take(path: &Path) -> Result<Option<Lock>, LockError> {
        let beside = path.with_extension(format!("{}.tmp", std::process::id()));
        fs::write(&beside, owner()).map_err(LockError::Io)?;
        let linked = fs::hard_link(&beside, path);
        let _ = fs::remove_file(&beside);
        match linked {
            Ok(()) => Ok(Some(Lock { path: path.to_owned() })),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(None),
            Err(error) => Err(LockError::Io(error)),
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// The error for a lock that somebody holds.
fn held(path: &Path, holder: &Path) -> Result<LockError, LockError> {
    let owner = fs::read_to_string(holder).map_err(LockError::Io)?;
    let mut words = owner.split_whitespace();
    let (process, host) = (words.next().unwrap_or("?"), words.nth(1).unwrap_or("?"));
    let message = format!(
        "another campaign writes here: process {process} on {host}; if it is gone, remove {}",
        if holder == path { path.display() } else { holder.display() }
    );
    Ok(LockError::Held(message))
}

/// This process: its number, when it began, and the machine.
fn owner() -> String {
    let process = std::process::id();
    let began = began(process).unwrap_or_else(|| "?".to_owned());
    format!("{process} {began} {}\n", host())
}

fn host() -> String {
    let name = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let name = name.trim();
    if name.is_empty() { "?".to_owned() } else { name.to_owned() }
}

/// When a process began, in the system's ticks; none where the system does not say, or it is gone.
fn began(process: u32) -> Option<String> {
    let status = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name, in parentheses, may hold spaces; the start is the twentieth word after it.
    let (_, after) = status.rsplit_once(')')?;
    let mut words = after.split_whitespace();
    let is_dead = words.next() == Some("Z");
    words.nth(18).filter(|_| !is_dead).map(str::to_owned)
}

/// Whether an owner is known to be gone: of this machine, and no such process began then.
fn is_gone(owner: &str) -> bool {
    let words: Vec<&str> = owner.split_whitespace().collect();
    match words[..] {
        [] => true,
        [process, then, on] if on == host() && began(std::process::id()).is_some() => {
            process.parse().map_or(true, |process| began(process).as_deref() != Some(then))
        }
        _ => false,
    }
}

//! The two files of expectations together: read, and written after a run. Who calls opens and writes them.

use super::{Expectations, Lock, Unblessable, bless, read};
use crate::corpus::InputError;
use crate::report::{Conformance, Record};
use std::path::Path;

/// The name of the file of the cases.
pub fn lock_of(file: &str) -> String {
    format!("{file}.lock")
}

/// The expectations for a record, and their cases; none if the file is not there and may be missing. `text`
/// reads a file.
pub fn open<E: From<InputError>>(
    file: &str,
    may_be_missing: bool,
    record: &Record,
    blessing: bool,
    text: impl Fn(&str) -> Result<String, E>,
) -> Result<Option<Expectations>, E> {
    let lock = lock_of(file);
    let has_lock = Path::new(&lock).exists();
    if may_be_missing && !Path::new(file).exists() {
        if has_lock {
            let message = format!(
                "{file}, whose cases these are, is missing: restore it, or remove this file too"
            );
            return Err(InputError::of(&lock, message).into());
        }
        return Ok(None);
    }
    let mut expectations = read(&text(file)?, file, &kernels_of(record))?;
    if has_lock {
        expectations.lock = Some(Lock::read(&text(&lock)?, &lock)?);
    }
    if !blessing {
        expectations.agree(file)?;
    }
    Ok(Some(expectations))
}

/// What a record is blessed to.
pub struct Written {
    /// As it will be read again.
    pub expectations: Expectations,
    /// The two files, by name.
    pub texts: [(String, String); 2],
    /// The targets whose counts are of other cases, and are left out.
    pub dropped: Vec<String>,
}

/// The expectations that a record meets, written out and read again.
pub fn blessed(
    record: &Record,
    old: &Expectations,
    compared: &Conformance,
    file: &str,
) -> Result<Written, BlessError> {
    let (result, target) = (&record.result, &record.provenance.target);
    let blessed = bless(result, target, old, compared).map_err(BlessError::Outside)?;
    let lock = lock_of(file);
    let read_again = || {
        let mut expectations = read(&blessed.file, file, &kernels_of(record))?;
        expectations.lock = Some(Lock::read(&blessed.lock, &lock)?);
        expectations.agree(file)?;
        Ok(expectations)
    };
    let expectations = read_again().map_err(BlessError::Unread)?;
    let texts = [(file.to_owned(), blessed.file), (lock, blessed.lock)];
    Ok(Written { expectations, texts, dropped: blessed.dropped })
}

/// Why a record is not blessed.
#[derive(Debug)]
pub enum BlessError {
    /// Entries would be lost.
    Outside(Unblessable),
    /// What was written cannot be read.
    Unread(InputError),
}

/// The kernels of a record: those of one's own need not be here.
fn kernels_of(record: &Record) -> Vec<&str> {
    record.result.plan.rows.iter().map(|row| row.kernel.as_str()).collect()
}

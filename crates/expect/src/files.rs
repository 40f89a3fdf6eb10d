//! The two files of expectations together: read, and written after a run. Who calls opens and writes them.

use super::{BlessError, Expectations, Lock, bless, read};
use crate::family::{FAMILIES, Stratum};
use hairline_files::InputError;
use hairline_record::{Conformance, Record, disagreements};
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
        expectations.are_about(record, file)?;
        expectations.are_of_the_scene(record, file)?;
    }
    Ok(Some(expectations.following(&record.result.plan)))
}

/// Where the cases of a family come from: families, a scene, or a mesh or a file of stored cases, which has its own name.
fn origin(family: &str) -> &str {
    match family {
        _ if FAMILIES.iter().any(|known| known.name == family) => "families",
        _ if Stratum::named(family).is_some() => "scene",
        name => name,
    }
}

impl Expectations {
    /// Checks that some of the expectations are about what was run: else each finding would be unexpected.
    ///
    /// Errors: what the file is about, and what to run.
    fn are_about(&self, record: &Record, file: &str) -> Result<(), InputError> {
        let result = &record.result;
        let origins: Vec<&str> = result
            .plan
            .sources
            .iter()
            .map(|source| origin(&source.family))
            .collect();
        let mut about: Vec<&str> = self.entries.keys().map(|key| key.family.as_str()).collect();
        let is_about = |family: &&str| origins.contains(&origin(family));
        if about.is_empty() || about.iter().any(is_about) || disagreements(result).is_empty() {
            return Ok(());
        }
        about.sort_unstable();
        about.dedup();
        let about = about.join(", ");
        let message = match (&self.sources, &record.provenance.plan_flags) {
            (Some(flags), _) => format!(
                "its cases are of `{flags}` ({about}), and this run has none of them: run `hairline check \
                 {flags}`, or put it into hairline.toml"
            ),
            (None, Some(_)) => format!(
                "its cases are of {about}, and this run has none of them: run these (as hairline.toml or flags \
                 name them), or move the file away and let `hairline check --bless` write one for this run"
            ),
            (None, None) => format!(
                "its cases are of {about}, and this test has none of them: give each test a file of its own"
            ),
        };
        Err(InputError::of(file, message))
    }
}

/// The expectations that blessing a record writes.
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
    let ([text, text_of_lock], dropped) = bless(record, old, compared)?;
    let lock = lock_of(file);
    let read_again = || {
        let mut expectations = read(&text, file, &kernels_of(record))?;
        expectations.lock = Some(Lock::read(&text_of_lock, &lock)?);
        expectations.agree(file)?;
        Ok(expectations)
    };
    let expectations = read_again().map_err(BlessError::Unread)?;
    let texts = [(file.to_owned(), text), (lock, text_of_lock)];
    Ok(Written {
        expectations,
        texts,
        dropped,
    })
}

/// The kernels of a record: those of one's own need not be here.
fn kernels_of(record: &Record) -> Vec<&str> {
    record
        .result
        .plan
        .rows
        .iter()
        .map(|row| row.kernel.as_str())
        .collect()
}

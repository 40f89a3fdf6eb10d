//! An audit from a test, held to a reviewed file of expectations.

use crate::command::named_file::{self, SizeLimit};
use crate::expect::{self, BlessError};
use crate::files::InputError;
use crate::record::Record;
use hairline_core::{Error, ErrorKind};
use std::fs::File;
use std::path::Path;
use std::{env, fs, io};

/// The environment variable that lets a test write its expectations.
const VARIABLE: &str = "HAIRLINE_BLESS";

/// Compares a record with a file, and says so in it. With the variable the file is written first, unless
/// something got worse.
pub(super) fn hold(record: &mut Record, file: &str) -> Result<(), Error> {
    let wish = env::var(VARIABLE).unwrap_or_default();
    let [blesses, accepts_worse] = match wish.as_str() {
        "" | "0" | "false" => [false, false],
        "1" | "true" => [true, false],
        "worse" => [true, true],
        _ => {
            let message = format!("{VARIABLE}: expected 1 or worse, not '{wish}'");
            return Err(Error::syntax(message));
        }
    };
    let text = |name: &str| {
        let bytes = named_file::read(Path::new(name), SizeLimit::EXPECTATIONS);
        let text = bytes.and_then(|bytes| String::from_utf8(bytes).map_err(io::Error::other));
        text.map_err(|error| InputError::reading(name, None, &error))
    };
    let _lock = blesses.then(|| locked(file));
    let said = |error: InputError| Error::new(ErrorKind::Data, error.to_string());
    let old = expect::open(file, true, record, blesses, text).map_err(said)?;
    if old.is_none() && !blesses {
        let line = format!(
            "{file}: there is no such file. `{VARIABLE}=1 cargo test` writes it and {}; review and \
             commit both",
            expect::lock_of(file)
        );
        return Err(Error::new(ErrorKind::File, line));
    }
    let (is_new, old) = (old.is_none(), old.unwrap_or_default());
    let target = record.provenance.target.clone();
    let mut compared = expect::compare(&record.result, &target, &old, Some(file));
    let may_be_written = is_new || accepts_worse || !compared.is_worse();
    if blesses && may_be_written {
        let written = expect::blessed(record, &old, &compared, file).map_err(|error| {
            match error {
                BlessError::Outside(count) => {
                    let line = format!(
                        "{file}: {count} expectations of kernels, scalars or families that this test does not \
                         run would be lost: give each test a file of its own"
                    );
                    Error::new(ErrorKind::Conflict, line)
                }
                BlessError::Unread(error) => said(error),
            }
        })?;
        for (name, text) in &written.texts {
            write(name, text).map_err(|error| Error::of_file(name, error))?;
        }
        compared = expect::compare(&record.result, &target, &written.expectations, Some(file));
    } else if blesses {
        compared.note = Some(format!(
            "{file} stays as it is: {}; {VARIABLE}=worse writes it all the same",
            compared.change
        ));
    }
    record.conformance = Some(compared);
    Ok(())
}

/// Held while expectations are read and written, so that of two programs that bless at once the second reads what
/// the first wrote; released when dropped. None where a folder cannot be locked, as on Windows.
pub(crate) fn locked(file: &str) -> Option<File> {
    let folder = Path::new(file)
        .parent()
        .filter(|folder| *folder != Path::new(""));
    let folder = File::open(folder.unwrap_or(Path::new("."))).ok()?;
    folder.lock().ok().map(|()| folder)
}

/// Beside its place, and then into it. Who writes holds the folder's lock, so what a killed run left is written over.
fn write(name: &str, text: &str) -> io::Result<()> {
    let beside = format!("{name}.tmp");
    let written = fs::write(&beside, text).and_then(|()| fs::rename(&beside, Path::new(name)));
    if written.is_err() {
        let _ = fs::remove_file(&beside);
    }
    written
}

//! The inputs of triage: campaign directories, corpora, cargo-fuzz artifacts.

use crate::audit::Row;
use crate::cli::exit::Failure;
use crate::cli::fuzz::directory::{CAMPAIGN, FINDS, read_begun, read_finds};
use crate::cli::input::files_under;
use crate::command::named_file::{self, SizeLimit};
use crate::corpus::lines::{self, AnyCase, StoredCase};
use crate::explore::campaign::Find;
use crate::explore::inputs;
use crate::files::InputError;
use std::fs;
use std::path::Path;

/// Targets whose bytes are a kernel, its epsilons and a case.
const WITH_INPUTS: [&str; 4] = ["kernels", "pinned", "response", "oracle"];

/// Targets whose inputs hold no case.
const WITHOUT_CASES: [&str; 2] = ["mesh", "settings"];

/// Adds what the rows get wrong in a file or folder.
pub fn read_path(path: &Path, rows: &[Row], finds: &mut Vec<Find>) -> Result<(), Failure> {
    fs::metadata(path).map_err(|error| Failure::of_path(path, &error))?;
    let is_campaign = |path: &Path| path.join(CAMPAIGN).exists();
    files_under(path, is_campaign)?
        .iter()
        .try_for_each(|path| match is_campaign(path) {
            true => read_campaign(path, finds),
            false => read_file(path, rows, finds),
        })
}

/// The finds of a campaign, also while it runs: a last line that is not whole yet is left out.
fn read_campaign(directory: &Path, finds: &mut Vec<Find>) -> Result<(), Failure> {
    read_begun(directory)?;
    let (name, mut bytes) = read_bytes(&directory.join(FINDS))?;
    let whole = bytes
        .iter()
        .rposition(|byte| *byte == b'\n')
        .map_or(0, |end| end + 1);
    if whole < bytes.len() {
        eprintln!("{name}: the last line is cut short and left out");
    }
    bytes.truncate(whole);
    add_finds(&bytes, &name, finds)
}

/// A file of finds.
pub fn read_finds_file(path: &Path, finds: &mut Vec<Find>) -> Result<(), Failure> {
    let (name, bytes) = read_bytes(path)?;
    add_finds(&bytes, &name, finds)
}

fn add_finds(text: &[u8], file: &str, finds: &mut Vec<Find>) -> Result<(), Failure> {
    finds.extend(
        read_finds(text, file)?
            .into_iter()
            .map(|find| named(find, file)),
    );
    Ok(())
}

/// A corpus, the lines of a fuzz target's input, or its bytes. Which target it is of, the folder says.
fn read_file(path: &Path, rows: &[Row], finds: &mut Vec<Find>) -> Result<(), Failure> {
    let (name, bytes) = read_bytes(path)?;
    let is_corpus = path
        .extension()
        .is_some_and(|extension| extension == "jsonl");
    let target = path
        .parent()
        .and_then(Path::file_name)
        .unwrap_or_default()
        .to_string_lossy();
    if !is_corpus && WITHOUT_CASES.contains(&&*target) {
        eprintln!("{name}: an input of the target {target} holds no case; left out");
        return Ok(());
    }
    if !is_corpus && WITH_INPUTS.contains(&&*target) {
        let (row, case) = either_scalar!(inputs::from_bytes(&bytes), input => {
            (input.row(), AnyCase::from(input.case))
        });
        finds.extend(of_rows(&[row], case, &name));
        return Ok(());
    }
    if !is_corpus && !bytes.trim_ascii_start().starts_with(b"{") {
        let message = format!(
            "is neither a corpus (JSON lines), nor a campaign's directory, nor in a folder called as a fuzz target: {}",
            WITH_INPUTS.join(", ")
        );
        return Err(Failure::bad_input(format!("{name}: {message}")));
    }
    for stored in lines::read(&bytes[..], &name) {
        match stored {
            Ok(stored) => read_case(&stored, rows, &name, finds)?,
            // A fuzz target's input may be broken on purpose.
            Err(error) if is_corpus => return Err(error.into()),
            Err(error) => eprintln!("{error}; left out"),
        }
    }
    Ok(())
}

/// A find as it is; any other case under each row.
fn read_case(
    stored: &StoredCase,
    rows: &[Row],
    file: &str,
    finds: &mut Vec<Find>,
) -> Result<(), Failure> {
    if stored.found.is_none() {
        rows.iter()
            .try_for_each(|row| row.check_in(stored.case.scalars()))?;
        finds.extend(of_rows(rows, stored.case, file));
        return Ok(());
    }
    let find = Find::of_stored(stored);
    let find = find.map_err(|message| InputError::at(file, stored.line, message))?;
    finds.push(named(find, file));
    Ok(())
}

fn of_rows(rows: &[Row], case: AnyCase, file: &str) -> impl Iterator<Item = Find> {
    rows.iter()
        .filter_map(move |row| Find::of(row, case))
        .map(move |find| named(find, file))
}

/// With the file that it comes from, if it does not say.
fn named(mut find: Find, file: &str) -> Find {
    find.found.from.get_or_insert_with(|| file.to_owned());
    find
}

fn read_bytes(path: &Path) -> Result<(String, Vec<u8>), Failure> {
    let bytes =
        named_file::read(path, SizeLimit::CASES).map_err(|error| Failure::of_path(path, &error))?;
    Ok((path.display().to_string(), bytes))
}

//! `hairline truth`: the exact truth of cases, one JSON line each.

use super::exit::{Failure, Status};
use super::input::open;
use super::output::write_result;
use crate::corpus::InputError;
use crate::corpus::lines::{self, StoredCase, StoredTruth};
use crate::corpus::truth_json::TruthLine;
use crate::oracle;
use clap::Args;
use rayon::prelude::*;
use std::io::{self, BufReader};

/// Which cases.
#[derive(Args)]
pub struct TruthArguments {
    /// A corpus file (JSON lines), or - for standard input
    #[arg(value_name = "FILE")]
    file: String,

    /// Add t, u and v, and the ends of contacts, as exact fractions; some twenty times slower
    #[arg(long)]
    exact: bool,

    /// Where to write; - is standard output
    #[arg(short, long, default_value = "-", value_name = "FILE")]
    output: String,
}

/// Lines that are decided at once, by all threads: at most this many, and about as many bytes.
const CHUNK: usize = 4096;
const CHUNK_BYTES: usize = 1 << 21;

/// Runs the command. A line that is no case ends it with an error; a stored truth is checked.
pub fn run(arguments: &TruthArguments) -> Result<Status, Failure> {
    let file = &arguments.file;
    let mut texts = lines::texts(BufReader::with_capacity(1 << 16, open(file)?), file).peekable();
    if texts.peek().is_none() {
        return Err(Failure::Message(Status::NothingSelected, format!("{file}: no cases in it")));
    }
    let decided = |text: Text| -> Result<Vec<u8>, InputError> {
        let (number, text) = text?;
        let stored = lines::case_of(&text, number, file)?;
        let line = line(&stored, arguments.exact);
        let line = line.map_err(|message| InputError::at(file, number, message))?;
        let mut bytes = serde_json::to_vec(&line).unwrap_or_default();
        bytes.push(b'\n');
        Ok(bytes)
    };
    // An input error stops the writing, and must come out as itself.
    let mut bad_input: Option<InputError> = None;
    let written = write_result(&arguments.output, |out| {
        loop {
            let chunk = chunk(&mut texts);
            if chunk.is_empty() {
                return Ok(());
            }
            let all: Vec<Result<Vec<u8>, InputError>> =
                chunk.into_par_iter().map(decided).collect();
            for line in all {
                match line {
                    Ok(line) => out.write_all(&line)?,
                    Err(error) => {
                        bad_input = Some(error);
                        return Err(io::Error::other("stopped"));
                    }
                }
            }
        }
    });
    match bad_input {
        Some(error) => Err(error.into()),
        None => written.map(|()| Status::Success),
    }
}

/// A line's number and its text.
type Text = Result<(usize, String), InputError>;

/// The next lines, up to the first that cannot be read.
fn chunk(texts: &mut impl Iterator<Item = Text>) -> Vec<Text> {
    let (mut chunk, mut bytes) = (Vec::new(), 0);
    while chunk.len() < CHUNK && bytes < CHUNK_BYTES {
        let Some(text) = texts.next() else { break };
        bytes += text.as_ref().map_or(CHUNK_BYTES, |(_, text)| text.len());
        chunk.push(text);
    }
    chunk
}

/// What the command prints of a case, and an error if its stored truth is another.
fn line(stored: &StoredCase, exact: bool) -> Result<TruthLine, String> {
    let name = stored.name.as_deref();
    let fast = || {
        let truth = either_scalar!(&stored.case, case => oracle::truth(case));
        TruthLine::without_fractions(name, &truth)
    };
    let is_stored_exactly = stored.truth.as_ref().is_some_and(StoredTruth::has_fractions);
    let line = if exact || is_stored_exactly { stored.truth_line() } else { fast() };
    stored.truth.as_ref().map_or(Ok(()), |truth| truth.check(&line))?;
    Ok(if is_stored_exactly && !exact { fast() } else { line })
}

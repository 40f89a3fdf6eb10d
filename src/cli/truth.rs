//! `hairline truth`: the exact truth of cases, one JSON line each.

use super::exit::{Failure, Status};
use super::input::{open, truth_line};
use super::output::write_result;
use crate::corpus::InputError;
use crate::corpus::lines::{self, StoredCase};
use clap::Args;
use std::io::{self, BufReader};

/// Which cases.
#[derive(Args)]
pub struct TruthArguments {
    /// A corpus file (JSON lines), or - for standard input
    #[arg(value_name = "FILE")]
    file: String,

    /// Where to write; - is standard output
    #[arg(short, long, default_value = "-", value_name = "FILE")]
    output: String,
}

/// Runs the command. A line that is no case ends it with an error; a stored truth is checked.
pub fn run(arguments: &TruthArguments) -> Result<Status, Failure> {
    let file = &arguments.file;
    let checked = |stored: Result<StoredCase, InputError>| {
        let stored = stored?;
        let line = truth_line(&stored);
        let wrong = stored.truth.as_ref().map_or(Ok(()), |truth| truth.check(&line));
        wrong.map_err(|message| InputError::at(file, stored.line, message))?;
        Ok(line)
    };
    let mut truths = lines::read(BufReader::new(open(file)?), file).map(checked).peekable();
    if truths.peek().is_none() {
        return Err(Failure::Message(Status::NothingSelected, format!("{file}: no cases in it")));
    }
    // An input error stops the writing, and must come out as itself.
    let mut bad_input: Option<InputError> = None;
    let written = write_result(&arguments.output, |out| {
        for truth in truths {
            match truth {
                Ok(line) => {
                    serde_json::to_writer(&mut *out, &line)?;
                    writeln!(out)?;
                }
                Err(error) => {
                    bad_input = Some(error);
                    return Err(io::Error::other("stopped"));
                }
            }
        }
        Ok(())
    });
    match bad_input {
        Some(error) => Err(error.into()),
        None => written.map(|()| Status::Success),
    }
}

//! `hairline truth`: the exact truth of cases, one JSON line each.

use super::exit::{Failure, Status};
use super::input::{open, truth_line};
use super::output::write_result;
use crate::corpus::{InputError, lines};
use clap::Args;
use std::cell::RefCell;
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
    let reader = BufReader::new(open(file)?);
    // An input error stops the writing, and must come out as itself.
    let bad_input: RefCell<Option<InputError>> = RefCell::new(None);
    let mut printed = 0u64;
    let written = write_result(&arguments.output, |out| {
        for stored in lines::read(reader, file) {
            let checked = stored.and_then(|stored| {
                let line = truth_line(&stored);
                let wrong = stored.truth.as_ref().map_or(Ok(()), |truth| truth.check(&line));
                wrong.map_err(|message| InputError::at(file, stored.line, message))?;
                Ok(line)
            });
            match checked {
                Ok(line) => {
                    serde_json::to_writer(&mut *out, &line)?;
                    writeln!(out)?;
                    printed += 1;
                }
                Err(error) => {
                    bad_input.replace(Some(error));
                    // To a file: nothing half-written. To a stream: what came before stands.
                    return if arguments.output == "-" {
                        out.flush()
                    } else {
                        Err(io::Error::other("stopped"))
                    };
                }
            }
        }
        Ok(())
    });
    if let Some(error) = bad_input.into_inner() {
        return Err(error.into());
    }
    written?;
    if printed == 0 {
        return Err(Failure::Message(Status::NothingSelected, format!("{file}: no cases in it")));
    }
    Ok(Status::Success)
}

//! `hairline truth`: the exact truth of cases, one JSON line each.

use super::exit::{Failure, Status};
use super::input::open;
use super::output::write_result;
use crate::corpus::lines::{self, LONGEST_LINE, StoredCase, StoredTruth};
use crate::corpus::truth_json::TruthLine;
use crate::corpus::{InputError, text_lines::TextLines};
use clap::Args;
use rayon::prelude::*;
use std::io::{self, BufRead, BufReader, Read};

/// Which cases.
#[derive(Args)]
pub struct TruthArguments {
    /// A corpus file (JSON lines), or - for standard input
    #[arg(value_name = "FILE")]
    file: String,

    /// Add t, u and v, and the ends of contacts, as exact fractions; some five times slower
    #[arg(long)]
    exact: bool,

    /// Where to write; - is standard output
    #[arg(short, long, default_value = "-", value_name = "FILE")]
    output: String,
}

/// The bytes that one thread decides at once, or a line more.
const BLOCK: u64 = 1 << 16;
/// The blocks that are read before they are decided, by all threads.
const BLOCKS: usize = 64;

/// Runs the command. A line that is no case ends it with an error; a stored truth is checked.
pub fn run(arguments: &TruthArguments) -> Result<Status, Failure> {
    let file = &arguments.file;
    let mut reader = BufReader::with_capacity(1 << 16, open(file)?);
    // What is wrong with the input stops the writing, and must come out as itself.
    let mut bad_input: Option<Failure> = None;
    let (mut lines_before, mut cases) = (0, 0);
    let written = write_result(&arguments.output, |out| {
        let mut stop = |failure| {
            bad_input = Some(failure);
            Err(io::Error::other("stopped"))
        };
        loop {
            let blocks = read_blocks(&mut reader);
            if blocks.is_empty() {
                let message = format!("{file}: no cases in it");
                let failure = || Failure::Message(Status::NothingSelected, message);
                return if cases > 0 { Ok(()) } else { stop(failure()) };
            }
            let decide = |block| decide(block, file, arguments.exact);
            for decided in blocks.into_par_iter().map(decide).collect::<Vec<_>>() {
                out.write_all(&decided.truths)?;
                if let Some(mut error) = decided.error {
                    error.line = error.line.map(|line| lines_before + line);
                    return stop(error.into());
                }
                lines_before += decided.lines;
                cases += decided.cases;
            }
        }
    });
    match bad_input {
        Some(failure) => Err(failure),
        None => written.map(|()| Status::Success),
    }
}

/// Whole lines, and a failure to read on behind them.
struct Block {
    bytes: Vec<u8>,
    failure: Failing,
}

/// The next blocks; none at the end.
fn read_blocks(reader: &mut impl BufRead) -> Vec<Block> {
    let mut blocks = Vec::new();
    while blocks.len() < BLOCKS {
        // A line more, as a rule; grown step by step it would be copied again and again.
        let mut bytes = Vec::with_capacity(BLOCK as usize + (1 << 12));
        let start = reader.by_ref().take(BLOCK).read_to_end(&mut bytes);
        // The rest of a line, unless it is too long for one.
        let mut rest = || reader.take(LONGEST_LINE as u64 + 1).read_until(b'\n', &mut bytes);
        let failure = start.and_then(|_| rest()).err();
        // At the end, where reading fails, and where a line is too long: that is said before more is read.
        let is_last = bytes.last() != Some(&b'\n') || failure.is_some();
        if failure.is_some() || !bytes.is_empty() {
            blocks.push(Block { bytes, failure: Failing(failure) });
        }
        if is_last {
            break;
        }
    }
    blocks
}

/// A reader that fails once, if there is an error for it.
struct Failing(Option<io::Error>);

impl Read for Failing {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        self.0.take().map_or(Ok(0), Err)
    }
}

/// What became of a block.
#[derive(Default)]
struct Decided {
    lines: usize,
    cases: usize,
    /// One line a case.
    truths: Vec<u8>,
    /// What ended it, with the line in the block.
    error: Option<InputError>,
}

fn decide(block: Block, file: &str, exact: bool) -> Decided {
    // A truth is about as long as its case.
    let truths = Vec::with_capacity(block.bytes.len() * 5 / 4);
    let mut decided = Decided { truths, ..Decided::default() };
    let reader = block.bytes.chain(BufReader::new(block.failure));
    let mut texts = TextLines::new(reader, file, LONGEST_LINE);
    for text in texts.by_ref() {
        let truth = text.and_then(|(number, text)| {
            let stored = lines::case_of(&text, number, file)?;
            line(&stored, exact).map_err(|message| InputError::at(file, number, message))
        });
        match truth {
            Ok(truth) => {
                // Nothing fails that is written to memory, and a truth is always JSON.
                let _ = serde_json::to_writer(&mut decided.truths, &truth);
                decided.truths.push(b'\n');
                decided.cases += 1;
            }
            Err(error) => {
                decided.error = Some(error);
                break;
            }
        }
    }
    decided.lines = texts.lines_read();
    decided
}

/// What the command prints of a case, and an error if its stored truth is another.
fn line(stored: &StoredCase, exact: bool) -> Result<TruthLine, String> {
    let is_stored_exactly = stored.truth.as_ref().is_some_and(StoredTruth::has_fractions);
    let mut line = stored.truth_line(exact || is_stored_exactly);
    if let Some(truth) = &stored.truth {
        truth.check(&line)?;
    }
    if !exact {
        line.leave_out_fractions();
    }
    Ok(line)
}

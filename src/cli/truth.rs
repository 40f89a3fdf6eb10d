//! `hairline truth`: the exact truth of cases, one JSON line each.

use super::exit::{Failure, Status};
use super::input::open;
use super::output::write_result;
use crate::corpus::lines::{self, LONGEST_LINE, StoredCase, StoredTruth};
use crate::corpus::truth_json::TruthLine;
use crate::files::json_lines::JsonLines;
use crate::files::{InputError, text_lines::TextLines};
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
/// The blocks of a batch.
const BLOCKS: usize = 64;

/// Runs the command. A line that is no case ends it with an error; a stored truth is checked.
pub fn run(arguments: &TruthArguments) -> Result<Status, Failure> {
    let file = &arguments.file;
    let mut reader = JsonLines::new(BufReader::with_capacity(1 << 16, open(file)?));
    // What is wrong with the input stops the writing, and must come out as itself.
    let mut bad_input: Option<Failure> = None;
    let (mut lines_before, mut cases) = (0, 0);
    let written = write_result(&arguments.output, |out| {
        let mut stop = |failure: Failure| {
            bad_input = Some(failure);
            io::Error::other("stopped")
        };
        // While all threads decide one batch, this one writes what they decided before and reads the next.
        let mut batch = read_batch(&mut reader);
        let mut before: Vec<Decided> = Vec::new();
        while !(batch.blocks.is_empty() && before.is_empty()) {
            let BlockBatch { blocks, is_last } = batch;
            let mut decided = Vec::new();
            batch = rayon::in_place_scope(|scope| {
                let decide = |block| decide(block, file, arguments.exact);
                let decided = &mut decided;
                scope.spawn(move |_| blocks.into_par_iter().map(decide).collect_into_vec(decided));
                for block in before {
                    out.write_all(&block.truths)?;
                    if let Some(mut error) = block.error {
                        error.line = error.line.map(|line| lines_before + line);
                        return Err(stop(error.into()));
                    }
                    lines_before += block.lines;
                    cases += block.cases;
                }
                Ok(if is_last {
                    BlockBatch::default()
                } else {
                    read_batch(&mut reader)
                })
            })?;
            before = decided;
        }
        let message = format!("{file}: no cases in it");
        let failure = Failure::nothing(message);
        if cases > 0 {
            Ok(())
        } else {
            Err(stop(failure))
        }
    });
    match bad_input {
        Some(failure) => Err(failure),
        None => written.map(|()| Status::Success),
    }
}

/// Whole lines, and a failure to read on behind them.
struct LineBlock {
    bytes: Vec<u8>,
    failure: Failing,
}

/// The blocks that are decided together; none at the end.
#[derive(Default)]
struct BlockBatch {
    blocks: Vec<LineBlock>,
    /// True if nothing more is read: at the end, where reading fails, and where a line is too long.
    is_last: bool,
}

fn read_batch(reader: &mut impl BufRead) -> BlockBatch {
    let mut batch = BlockBatch::default();
    while batch.blocks.len() < BLOCKS && !batch.is_last {
        // A line more, as a rule; grown step by step it would be copied again and again.
        let mut bytes = Vec::with_capacity(BLOCK as usize + (1 << 12));
        let start = reader.by_ref().take(BLOCK).read_to_end(&mut bytes);
        // The rest of a line, unless it is too long for one.
        let mut rest = || {
            reader
                .take(LONGEST_LINE as u64 + 1)
                .read_until(b'\n', &mut bytes)
        };
        let failure = start.and_then(|_| rest()).err();
        batch.is_last = bytes.last() != Some(&b'\n') || failure.is_some();
        if failure.is_some() || !bytes.is_empty() {
            batch.blocks.push(LineBlock {
                bytes,
                failure: Failing(failure),
            });
        }
    }
    batch
}

/// A reader that fails once, if there is an error for it.
struct Failing(Option<io::Error>);

impl Read for Failing {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        self.0.take().map_or(Ok(0), Err)
    }
}

/// The results of a block.
#[derive(Default)]
struct Decided {
    lines: usize,
    cases: usize,
    /// One line a case.
    truths: Vec<u8>,
    /// The error that ended it, with the line in the block.
    error: Option<InputError>,
}

fn decide(block: LineBlock, file: &str, exact: bool) -> Decided {
    // A truth is about as long as its case.
    let truths = Vec::with_capacity(block.bytes.len() * 5 / 4);
    let mut decided = Decided {
        truths,
        ..Decided::default()
    };
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

/// The line that the command prints for a case; an error if its stored truth is another.
fn line(stored: &StoredCase, exact: bool) -> Result<TruthLine, String> {
    let is_stored_exactly = stored
        .truth
        .as_ref()
        .is_some_and(StoredTruth::has_fractions);
    let mut line = stored.truth_line(exact || is_stored_exactly);
    if let Some(truth) = &stored.truth {
        truth.check(&line)?;
    }
    if !exact {
        line.leave_out_fractions();
    }
    Ok(line)
}

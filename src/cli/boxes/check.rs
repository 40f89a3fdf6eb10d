//! `hairline boxes check`: slab tests against their known wrong answers, which a file holds.

use super::audit::RunArguments;
use crate::cli::exit::{Failure, Status};
use crate::cli::known::{Blessing, KnownCounts, KnownSubject};
use crate::expect::RecordComparison;
use clap::Args;

/// Which slab tests, on which boxes, and which file holds what is known.
#[derive(Args)]
pub struct CheckArguments {
    #[command(flatten)]
    run: RunArguments,

    /// The file of the known wrong answers
    #[arg(long, value_name = "FILE", default_value = "hairline-boxes.toml")]
    known: String,

    #[command(flatten)]
    blessing: Blessing,
}

/// The file of slab tests.
const SUBJECT: KnownSubject = KnownSubject {
    schema: "hairline-boxes/1",
    about: "Known wrong answers of slab tests: `hairline boxes check` fails if there are others. --bless writes them.",
    parts: "tests, families or scalars",
    is_name: |_| true,
    choice: "-n and --seed say how many of which",
};

/// Runs the command.
pub fn run(arguments: &CheckArguments) -> Result<Status, Failure> {
    let outputs = arguments.run.output.pairs(RecordComparison::FORMATS)?;
    let known = KnownCounts::open(&SUBJECT, &arguments.known, &arguments.blessing)?;
    let result = arguments.run.record()?.result;
    known.compare(result, &arguments.run.output, outputs)
}

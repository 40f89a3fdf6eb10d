//! `hairline diff`: two records side by side.

use super::exit::{Failure, Status};
use super::input::read_record;
use super::output::OutputArguments;
use crate::expect::{Trend, difference};
use crate::report::Format;
use clap::Args;

/// The arguments of `diff`: the records to compare, and how to report.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help("text, json, markdown or html, or several separated by commas")
}))]
pub struct DiffArguments {
    /// The earlier record, as `--format json` wrote it
    old: String,

    /// The later record
    new: String,

    /// Exit with 1 if something got worse
    #[arg(long)]
    exit_code: bool,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &DiffArguments) -> Result<Status, Failure> {
    let pairs = arguments.output.pairs(Format::OF_PAGE)?;
    let (old, new) = (read_record(&arguments.old)?, read_record(&arguments.new)?);
    let comparison = difference(&old.result, &new.result);
    if comparison.common == 0 {
        let message = "nothing to compare: the records have no kernel with its epsilons on a family in common";
        return Err(Failure::Message(Status::NothingSelected, message.to_owned()));
    }
    arguments.output.write(pairs, &comparison)?;
    let is_worse = comparison.differences.iter().any(|found| found.change == Trend::Worse);
    Ok(if arguments.exit_code && is_worse { Status::Disagreements } else { Status::Success })
}

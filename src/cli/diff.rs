//! `hairline diff`: two records side by side.

use super::exit::{Failure, Status};
use super::input::read_record;
use super::output::write_result;
use crate::expect::{Trend, difference};
use crate::report::write_json;
use clap::{Args, ValueEnum};

/// The arguments of `diff`: the records to compare, and how to report.
#[derive(Args)]
pub struct DiffArguments {
    /// The earlier record, as `--format json` wrote it
    old: String,

    /// The later record
    new: String,

    /// Exit with 1 if something got worse
    #[arg(long)]
    exit_code: bool,

    /// The format of the output
    #[arg(long, value_enum, default_value_t)]
    format: DiffFormat,

    /// Where to write; - is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: String,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum DiffFormat {
    #[default]
    Text,
    Json,
}

/// Runs the command.
pub fn run(arguments: &DiffArguments) -> Result<Status, Failure> {
    let (old, new) = (read_record(&arguments.old)?, read_record(&arguments.new)?);
    let comparison = difference(&old.result, &new.result);
    let nothing = comparison.common == 0;
    // It is printed, but no file becomes a comparison of nothing.
    if !nothing || arguments.output == "-" {
        write_result(&arguments.output, |out| match arguments.format {
            DiffFormat::Text => comparison.write(out),
            DiffFormat::Json => write_json(&comparison, out),
        })?;
    }
    if nothing {
        let message = "nothing to compare: the records have no kernel with its epsilons on a family in common";
        return Err(Failure::Message(Status::NothingSelected, message.to_owned()));
    }
    let is_worse = comparison.differences.iter().any(|found| found.change == Trend::Worse);
    Ok(if arguments.exit_code && is_worse { Status::Disagreements } else { Status::Success })
}

//! `hairline audit`: kernels on families of cases, a mesh or a corpus.

use super::exit::{Failure, Status};
use super::plugins;
use super::reporting::{ReportArguments, execute, parse_shard, self_check};
use super::select::KernelArguments;
use super::sources::{SourceArguments, scalars_in_use, set_threads};
use crate::audit::Plan;
use clap::Args;

/// What to run, and how to report it.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    #[command(flatten)]
    sources: SourceArguments,

    /// How many examples of each class of finding to keep
    #[arg(long, default_value_t = 3, value_name = "N")]
    examples: usize,

    /// How many findings of each class of each family, the first by index, to attribute to a cause,
    /// and on how many indices to measure the values of hits; 0 for none
    #[arg(long, default_value_t = 100, value_name = "N")]
    attribute: usize,

    /// Run part K of N only, counted from 0; `hairline merge` makes one record of all
    #[arg(long, value_name = "K/N")]
    shard: Option<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    #[command(flatten)]
    report: ReportArguments,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs = arguments.report.outputs()?;
    let plan = arguments.plan()?;
    let threads = set_threads(arguments.threads)?;
    let shard = parse_shard(arguments.shard.as_deref())?;
    let record = execute(&plan, shard, threads, arguments.report.quiet)?;
    plugins::check()?;
    outputs.write(&record)?;
    self_check(&record)?;
    Ok(Status::Success)
}

impl AuditArguments {
    fn plan(&self) -> Result<Plan, Failure> {
        let rows = self.kernels.rows()?;
        let scalars = scalars_in_use(&rows, self.sources.scalars()?)?;
        let sources = self.sources.sources(self.report.quiet, |_| true)?;
        let (examples, attribute) = (self.examples, self.attribute);
        Ok(Plan { rows, sources, scalars, examples, attribute })
    }
}

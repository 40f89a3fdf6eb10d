//! `hairline audit`: kernels on families of cases, a mesh or a corpus.

use super::exit::{Failure, Status};
use super::plugins;
use super::progress::Progress;
use super::reports::ReportArguments;
use super::select::KernelArguments;
use super::sources::{SourceArguments, scalars_in_use, set_threads, total_indices};
use crate::audit::{self, Plan, Source};
use crate::report::{Context, Record, build};
use clap::Args;

/// What to run, and how to report it.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    #[command(flatten)]
    sources: SourceArguments,

    #[command(flatten)]
    reports: ReportArguments,

    /// How many findings of each class of each family, the first by index, to attribute to a cause,
    /// and on how many indices to measure the values of hits; 0 for none
    #[arg(long, default_value_t = 100, value_name = "N")]
    attribute: usize,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    /// No progress, no notes
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs = arguments.reports.outputs()?;
    let plan = arguments.plan()?;
    let threads = set_threads(arguments.threads)?;
    let total = total_indices(&plan.sources, plan.scalars)?;
    if !arguments.quiet {
        let (rows, sources) = (plan.rows.len(), plan.sources.len());
        let scalars = arguments.sources.scalar_names(" and ");
        eprintln!(
            "{rows} kernel rows on {sources} sources of cases in {scalars}: {total} indices, {threads} threads"
        );
    }
    let progress = Progress::new(total, "indices", arguments.quiet);
    let sums = audit::run(&plan, &progress);
    progress.finish();
    let seconds = progress.seconds();
    plugins::check()?;
    let record = build(&plan, &sums, &Context { seconds, threads });
    arguments.reports.write(&outputs, &record)?;
    self_check(&plan, &record)
}

/// A family that breaks its own promise is a fault of this tool.
fn self_check(plan: &Plan, record: &Record) -> Result<Status, Failure> {
    let promising: Vec<String> =
        plan.sources.iter().filter(|source| source.promises()).map(Source::name).collect();
    let broken = record
        .result
        .sources
        .iter()
        .find(|source| source.promise_broken > 0 && promising.contains(&source.family));
    match broken {
        None => Ok(Status::Success),
        Some(source) => {
            let first = source.first_broken.as_deref().unwrap_or("-");
            let message = format!(
                "self-check: family '{}' breaks its promise, first at {first}",
                source.family
            );
            Err(Failure::Message(Status::SelfCheck, message))
        }
    }
}

impl AuditArguments {
    fn plan(&self) -> Result<Plan, Failure> {
        let rows = self.kernels.rows()?;
        let scalars = scalars_in_use(&rows, self.sources.scalars()?)?;
        let sources = self.sources.sources(self.quiet, |_| true)?;
        let (examples, attribute) = (self.reports.examples, self.attribute);
        Ok(Plan { rows, sources, scalars, examples, attribute })
    }
}

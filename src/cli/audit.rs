//! `hairline audit`: kernels on families of cases, a mesh or a corpus.

use super::exit::{Failure, Status};
use super::output::{ColorChoice, paired_outputs, write_result};
use super::progress::Progress;
use super::select::KernelArguments;
use super::sources::{SourceArguments, set_threads, total_indices};
use crate::audit::{self, Plan, Source};
use crate::report::{Context, FORMATS, Record, Style, build};
use clap::Args;

/// What to run, and how to report it.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    #[command(flatten)]
    sources: SourceArguments,

    /// text or json, or both separated by commas
    #[arg(long, value_delimiter = ',', value_name = "FORMAT", default_value = "text")]
    format: Vec<String>,

    /// Where to write, once for each format; - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Vec<String>,

    /// How many examples of each class of finding to keep
    #[arg(long, default_value_t = 3, value_name = "N")]
    examples: usize,

    /// How many findings of each class of each family, the first by index, to attribute to a cause,
    /// and on how many indices to measure the values of hits; 0 for none
    #[arg(long, default_value_t = 100, value_name = "N")]
    attribute: usize,

    /// List the worst finding of every class, not only of every kind
    #[arg(long)]
    details: bool,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    /// When to colour the text
    #[arg(long, value_enum, default_value_t)]
    color: ColorChoice,

    /// No progress, no notes
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs =
        paired_outputs(FORMATS, |format| format.name, &arguments.format, &arguments.output)?;
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
    let record = build(&plan, &sums, &Context { seconds, threads });
    for (format, path) in outputs {
        let style =
            Style { color: arguments.color.enabled(path == "-"), details: arguments.details };
        write_result(path, |out| (format.write)(&record, style, out))?;
    }
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
        Ok(Plan {
            rows: self.kernels.rows()?,
            sources: self.sources.sources(self.quiet, |_| true)?,
            scalars: self.sources.scalars()?,
            examples: self.examples,
            attribute: self.attribute,
        })
    }
}

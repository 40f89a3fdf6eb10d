//! How a record is made from a plan, and written: what `audit`, `check` and `merge` share.

use super::exit::{Failure, Status};
use super::output::{ColorChoice, paired_outputs, write_result};
use super::progress::Progress;
use super::sources::total_indices;
use crate::audit::{self, Plan, Shard};
use crate::report::{Context, FORMATS, Format, PartialPart, Record, Style, build, shard_part};
use clap::Args;

/// The flags that say how to report.
#[derive(Args)]
pub struct ReportArguments {
    /// text, json, jsonl, junit, sarif or markdown, or several separated by commas
    #[arg(long, value_delimiter = ',', value_name = "FORMAT", default_value = "text")]
    format: Vec<String>,

    /// Where to write, once for each format; - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Vec<String>,

    /// Leave nothing out of the text: the worst finding of every class, all deviations
    #[arg(long)]
    details: bool,

    /// When to colour the text
    #[arg(long, value_enum, default_value_t)]
    color: ColorChoice,

    /// No progress, no notes
    #[arg(long, short)]
    pub quiet: bool,
}

/// Where a record goes.
pub struct Outputs<'a> {
    pairs: Vec<(&'static Format, &'a str)>,
    details: bool,
    color: ColorChoice,
}

impl ReportArguments {
    /// Checks the flags, before anything runs.
    pub fn outputs(&self) -> Result<Outputs<'_>, Failure> {
        let pairs = paired_outputs(FORMATS, |format| format.name, &self.format, &self.output)?;
        Ok(Outputs { pairs, details: self.details, color: self.color })
    }
}

impl Outputs<'_> {
    /// Writes a record to each.
    pub fn write(&self, record: &Record) -> Result<(), Failure> {
        for (format, path) in &self.pairs {
            let style = Style { color: self.color.enabled(*path == "-"), details: self.details };
            write_result(path, |out| (format.write)(record, style, out))?;
        }
        Ok(())
    }
}

/// The part of a run that `--shard` names; all of it if none.
pub fn parse_shard(text: Option<&str>) -> Result<Option<Shard>, Failure> {
    let shard = text.map(str::parse).transpose();
    shard.map_err(|error| Failure::usage(format!("--shard: {error}")))
}

/// Runs a plan, or a part of it, and makes its record.
pub fn execute(
    plan: &Plan,
    shard: Option<Shard>,
    threads: usize,
    quiet: bool,
) -> Result<Record, Failure> {
    let total = total_indices(&plan.sources, plan.scalars)?;
    if !quiet {
        let (rows, sources) = (plan.rows.len(), plan.sources.len());
        let names = ["f32", "f64"];
        let scalars: Vec<&str> =
            names.into_iter().zip(plan.scalars).filter(|pair| pair.1).map(|pair| pair.0).collect();
        eprintln!(
            "{rows} kernel rows on {sources} sources of cases in {}: {total} indices{}, {threads} threads",
            scalars.join(" and "),
            shard.map_or(String::new(), |shard| format!(", of them shard {shard}"))
        );
    }
    let progress = Progress::new(total, "indices", quiet);
    let mut sums = audit::sum(plan, shard.unwrap_or(Shard::WHOLE), &progress);
    let part = shard.map(|_| shard_part(plan, &sums));
    audit::finish(plan, &progress, &mut sums);
    progress.finish();
    let seconds = progress.seconds();
    let mut record = build(plan, &sums, &Context { seconds, threads });
    (record.result.partial, record.shard) = (shard.map(PartialPart::from), part);
    Ok(record)
}

/// A family that breaks its own promise is a fault of this tool.
pub fn self_check(record: &Record) -> Result<(), Failure> {
    let broken = |source: &&crate::report::SourcePart| source.promises && source.promise_broken > 0;
    match record.result.sources.iter().find(broken) {
        None => Ok(()),
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

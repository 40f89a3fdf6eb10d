//! `hairline boxes audit`.

use super::record::{BoxesResult, BoxesRow};
use super::select::{CaseArguments, TestArguments};
use crate::cli::before::set_threads;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::OutputArguments;
use crate::cli::progress::Progress;
use crate::record::{Context, Record, provenance_of};
use crate::report::Format;
use clap::Args;
use hairline_boxes::{FamilyScalar, Setup, Source, audit};
use hairline_core::kernel::Scalar;
use std::slice;
use std::time::Instant;

/// Which slab tests, on which boxes, and how to report.
#[derive(Args)]
pub struct RunArguments {
    #[command(flatten)]
    tests: TestArguments,

    #[command(flatten)]
    cases: CaseArguments,

    #[command(flatten)]
    pub output: OutputArguments,
}

/// A run, and what it says to a build.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    run: RunArguments,

    /// Exit with 1 if a test loses a ray that it has to hit; hits of boxes that a ray passes by only cost time
    #[arg(long)]
    exit_code: bool,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs = arguments.run.output.pairs(Format::OF_PAGE)?;
    let record = arguments.run.record()?;
    arguments.run.output.write(outputs, &record)?;
    Ok(if arguments.exit_code && record.result.is_losing() {
        Status::Disagreements
    } else {
        Status::Success
    })
}

impl RunArguments {
    /// The record of the run.
    pub fn record(&self) -> Result<Record<BoxesResult>, Failure> {
        let setups = self.tests.setups()?;
        let sources = self.cases.sources(self.output.quiet)?;
        let scalars = self.cases.scalars()?;
        let (count, seed) = (self.cases.count, self.cases.seed);
        let threads = set_threads(self.cases.threads)?;
        let start = Instant::now();
        let runs = scalars.iter().filter(|is_chosen| **is_chosen).count() * sources.len();
        let progress = Progress::new(runs as u64 * count, "boxes", self.output.quiet);
        let run = AuditRun {
            setups: &setups,
            count,
            seed,
            progress: &progress,
        };
        let mut rows = Vec::new();
        for source in &sources {
            if scalars[0] {
                rows.extend(run.rows_of::<f32>(source));
            }
            if scalars[1] {
                rows.extend(run.rows_of::<f64>(source));
            }
        }
        progress.finish();
        let result = BoxesResult {
            count,
            seed,
            sources: sources.iter().map(ToString::to_string).collect(),
            rows,
        };
        let provenance = provenance_of(&Context {
            seconds: start.elapsed().as_secs_f64(),
            threads,
        });
        Ok(Record::new(result, provenance))
    }
}

/// The run of all sources.
struct AuditRun<'a> {
    setups: &'a [Setup],
    count: u64,
    seed: u64,
    progress: &'a Progress,
}

impl AuditRun<'_> {
    fn rows_of<F: FamilyScalar + Scalar>(&self, source: &Source) -> Vec<BoxesRow> {
        let sources = slice::from_ref(source);
        let found = audit::<F>(self.setups, sources, self.count, self.seed, self.progress);
        found
            .iter()
            .map(|row| BoxesRow::new::<F>(row, source, self.seed))
            .collect()
    }
}

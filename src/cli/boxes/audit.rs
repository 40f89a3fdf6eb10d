//! `hairline boxes audit`.

use super::record::{BoxesResult, BoxesRow};
use super::select::{CaseArguments, TestArguments};
use crate::cli::before::set_threads;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::OutputArguments;
use crate::cli::progress::Progress;
use crate::report::{Context, Format, Record, provenance_of};
use clap::Args;
use hairline_boxes::{Made, Setup, Source, audit};
use hairline_core::kernel::Scalar;
use std::slice;
use std::time::Instant;

/// Which slab tests, on which boxes, and how to report.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    tests: TestArguments,

    #[command(flatten)]
    cases: CaseArguments,

    /// Exit with 1 if a test loses a ray that it has to hit; hits of boxes that a ray passes by only cost time
    #[arg(long)]
    exit_code: bool,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let setups = arguments.tests.setups()?;
    let sources = arguments.cases.sources(arguments.output.quiet)?;
    let scalars = arguments.cases.scalars()?;
    let (count, seed) = (arguments.cases.count, arguments.cases.seed);
    let threads = set_threads(arguments.cases.threads)?;
    let start = Instant::now();
    let runs = scalars.iter().filter(|is_chosen| **is_chosen).count() * sources.len();
    let progress = Progress::new(runs as u64 * count, "boxes", arguments.output.quiet);
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
    let is_losing = result.is_losing();
    let provenance = provenance_of(&Context {
        seconds: start.elapsed().as_secs_f64(),
        threads,
    });
    let record = Record::new(result, provenance).sealed();
    arguments.output.write(outputs, &record)?;
    Ok(if arguments.exit_code && is_losing {
        Status::Disagreements
    } else {
        Status::Success
    })
}

/// The run of all sources.
struct AuditRun<'a> {
    setups: &'a [Setup],
    count: u64,
    seed: u64,
    progress: &'a Progress,
}

impl AuditRun<'_> {
    fn rows_of<F: Made + Scalar>(&self, source: &Source) -> Vec<BoxesRow> {
        let sources = slice::from_ref(source);
        let found = audit::<F>(self.setups, sources, self.count, self.seed, self.progress);
        found
            .iter()
            .map(|row| BoxesRow::new::<F>(row, source, self.seed))
            .collect()
    }
}

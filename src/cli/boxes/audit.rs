//! `hairline boxes audit`.

use super::record::{BoxesResult, BoxesRow};
use super::select::{CaseArguments, TestArguments};
use crate::cli::before::set_threads;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::OutputArguments;
use crate::cli::progress::Progress;
use crate::report::{Context, Format, Record, provenance_of};
use clap::Args;
use hairline_boxes::Row;
use std::time::Instant;

/// Which slab tests, on which boxes, and how to report.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    tests: TestArguments,

    #[command(flatten)]
    cases: CaseArguments,

    /// Exit with 1 if a test loses a ray that it must hit, or hits a box that it must miss
    #[arg(long)]
    exit_code: bool,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let setups = arguments.tests.setups()?;
    let sources = arguments.cases.sources()?;
    let scalars = arguments.cases.scalars()?;
    let (count, seed) = (arguments.cases.count, arguments.cases.seed);
    let threads = set_threads(arguments.cases.threads)?;
    let start = Instant::now();
    let runs = scalars.iter().filter(|is_chosen| **is_chosen).count() * sources.len();
    let progress = Progress::new(runs as u64 * count, "boxes", arguments.output.quiet);
    let mut rows = Vec::new();
    for source in &sources {
        let one = std::slice::from_ref(source);
        if scalars[0] {
            let found = hairline_boxes::audit::<f32>(&setups, one, count, seed, &progress);
            rows.extend(
                found
                    .iter()
                    .map(|row: &Row| BoxesRow::new::<f32>(row, source, seed)),
            );
        }
        if scalars[1] {
            let found = hairline_boxes::audit::<f64>(&setups, one, count, seed, &progress);
            rows.extend(
                found
                    .iter()
                    .map(|row: &Row| BoxesRow::new::<f64>(row, source, seed)),
            );
        }
    }
    progress.finish();
    let result = BoxesResult {
        count,
        seed,
        sources: sources.iter().map(ToString::to_string).collect(),
        rows,
    };
    let is_wrong = result.is_wrong();
    let provenance = provenance_of(&Context {
        seconds: start.elapsed().as_secs_f64(),
        threads,
    });
    let record = Record::new(result, provenance).sealed();
    arguments.output.write(outputs, &record)?;
    Ok(if arguments.exit_code && is_wrong {
        Status::Disagreements
    } else {
        Status::Success
    })
}

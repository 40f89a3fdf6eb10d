//! `hairline audit`: kernels on families of cases, a mesh or a corpus.

use super::exit::{Failure, Status};
use super::flags::JUDGING;
use super::reporting::{MEASURED, Outputs, RunArguments, self_check};
use crate::audit::Plan;
use clap::Args;

/// The flags of `audit`: the run, and how it is reported.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    run: RunArguments,

    /// How many findings of each class of each family to attribute to a cause; 0 for none, and for no errors of t, u and v
    #[arg(long, default_value_t = 30, value_name = "N", help_heading = JUDGING)]
    attribute: usize,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs = arguments.run.report.outputs()?;
    outputs.told(audited(arguments, &outputs))
}

fn audited(arguments: &AuditArguments, outputs: &Outputs<'_>) -> Result<Status, Failure> {
    let measured = if arguments.attribute == 0 {
        0
    } else {
        MEASURED
    };
    let mut plan = Plan {
        measured,
        ..arguments.run.plan(arguments.attribute)?
    };
    plan.rows.extend(arguments.run.kernels.exact_row()?);
    let record = arguments.run.execute(&plan, outputs.illustrate())?;
    self_check(&record)?;
    outputs.write(&record)?;
    Ok(Status::Success)
}

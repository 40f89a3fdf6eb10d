//! `hairline explain`: one case, its exact truth, and what each gate of each kernel made of it.

use super::case::CaseArguments;
use super::exit::{Failure, Status};
use super::flags::{matrix, placed};
use super::output::OutputArguments;
use super::select::KernelArguments;
use crate::arith::Float;
use crate::case::Instance;
use crate::report::Format;
use crate::report::explain::{Together, explain};
use clap::Args;

/// The flags of the command.
#[derive(Args)]
pub struct ExplainArguments {
    #[command(flatten)]
    case: CaseArguments,

    /// Where an instance puts the triangle: a 3x4 matrix row by row, as "m00, …, m23". The case's ray is of the world, and the
    /// kernel gets it by the rounded inverse
    #[arg(long, value_name = "MATRIX", allow_hyphen_values = true)]
    instance: Option<String>,

    #[command(flatten)]
    kernels: KernelArguments,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &ExplainArguments) -> Result<Status, Failure> {
    let pairs = arguments.output.pairs(Format::OF_PAGE)?;
    let rows = arguments.kernels.rows()?;
    let cases = arguments.case.cases_and_instances()?;
    for row in &rows {
        row.check_in(cases.scalars())?;
    }
    let record = either_scalar!(&cases, group => {
        let given = instance_of(arguments)?;
        if given.is_some() && group.instance.is_some() {
            return Err(Failure::usage("--instance: the case's id has an instance of its own"));
        }
        let together = Together {
            cases: &group.cases,
            grouping: group.grouping,
            neighbours: group.neighbours.as_deref(),
            instance: given.as_ref().or(group.instance.as_ref()),
        };
        explain(&arguments.case.case, together, &rows)
    });
    arguments.output.write(pairs, &record)?;
    Ok(Status::Success)
}

/// The instance of `--instance`, if it is given.
fn instance_of<F: Float>(arguments: &ExplainArguments) -> Result<Option<Instance<F>>, Failure> {
    let Some(text) = &arguments.instance else {
        return Ok(None);
    };
    // A run reads doubles at first too, so both have the same numbers.
    let wide = matrix(text)?;
    placed(wide.map(|row| row.map(F::from_f64))).map(Some)
}

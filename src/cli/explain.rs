//! `hairline explain`: one case, its exact truth, and what each gate of each kernel made of it.

use super::case::CaseArguments;
use super::exit::{Failure, Status};
use super::flags::{matrix, placed};
use super::output::OutputArguments;
use super::select::KernelArguments;
use crate::arith::Float;
use crate::report::Format;
use crate::report::explain::{Together, explain};
use clap::Args;

/// Which case, and which kernels.
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
    let name = &arguments.case.case;
    rows.iter()
        .try_for_each(|row| row.check_in(cases.scalars()))?;
    let record = either_scalar!(&cases, group => {
        // As a run reads it, whose numbers are doubles at first.
        let narrow = |text| placed(matrix(text)?.map(|row| row.map(Float::from_f64)));
        let given = arguments.instance.as_deref().map(narrow).transpose()?;
        if given.is_some() && group.instance.is_some() {
            return Err(Failure::usage("--instance: the case's id has an instance of its own"));
        }
        let (cases, neighbours) = (&group.cases[..], group.neighbours.as_deref());
        let instance = given.as_ref().or(group.instance.as_ref());
        let group = Together { cases, grouping: group.grouping, neighbours, instance };
        explain(name, group, &rows)
    });
    arguments.output.write(pairs, &record)?;
    Ok(Status::Success)
}

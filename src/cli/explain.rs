//! `hairline explain`: one case, its exact truth, and what each gate of each kernel made of it.

use super::case::CaseArguments;
use super::exit::{Failure, Status};
use super::output::OutputArguments;
use super::select::KernelArguments;
use crate::report::Format;
use crate::report::explain::{Together, explain};
use clap::Args;

/// Which case, and which kernels.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help("text, json, markdown or html, or several separated by commas")
}))]
pub struct ExplainArguments {
    #[command(flatten)]
    case: CaseArguments,

    #[command(flatten)]
    kernels: KernelArguments,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &ExplainArguments) -> Result<Status, Failure> {
    let pairs = arguments.output.pairs(Format::OF_PAGE)?;
    let rows = arguments.kernels.rows()?;
    let cases = arguments.case.cases()?;
    let name = &arguments.case.case;
    rows.iter().try_for_each(|row| row.check_in(cases.scalars()))?;
    let record = either_scalar!(&cases, group => {
        let (cases, neighbours) = (&group.cases[..], group.neighbours.as_deref());
        explain(name, Together { cases, grouping: group.grouping, neighbours }, &rows)
    });
    arguments.output.write(pairs, &record)?;
    Ok(Status::Success)
}

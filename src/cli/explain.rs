//! `hairline explain`: one case, its exact truth, and what each gate of each kernel made of it.

use super::case::CaseArguments;
use super::exit::{Failure, Status};
use super::output::OutputArguments;
use super::select::KernelArguments;
use crate::arith::Float;
use crate::case::Instance;
use crate::corpus::number;
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
    let cases = arguments.case.cases()?;
    let name = &arguments.case.case;
    rows.iter().try_for_each(|row| row.check_in(cases.scalars()))?;
    let record = either_scalar!(&cases, group => {
        let (cases, neighbours) = (&group.cases[..], group.neighbours.as_deref());
        let group = Together { cases, grouping: group.grouping, neighbours };
        let instance = arguments.instance.as_deref().map(instance).transpose()?;
        explain(name, group, instance.as_ref(), &rows)
    });
    arguments.output.write(pairs, &record)?;
    Ok(Status::Success)
}

/// Reads a matrix in a scalar.
fn instance<F: Float>(text: &str) -> Result<Instance<F>, Failure> {
    let wrong = |message: String| Failure::usage(format!("--instance: {message}"));
    let words = text.split([',', ' ', ';', '\n']).filter(|word| !word.is_empty());
    let numbers = words.map(number::parse).collect::<Result<Vec<F>, _>>().map_err(wrong)?;
    let (rows, []) = numbers.as_chunks::<4>() else { return Err(wrong(count_of(&numbers))) };
    let rows = rows.try_into().map_err(|_| wrong(count_of(&numbers)))?;
    let singular = || format!("its inverse is not finite in {}", F::NAME);
    Instance::new(rows).ok_or_else(|| wrong(singular()))
}

fn count_of<F>(numbers: &[F]) -> String {
    format!("expected 12 numbers, row by row, found {}", numbers.len())
}

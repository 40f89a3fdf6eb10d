//! `hairline fuzz shrink`: the simplest case with the same finding, to paste into a test.

use crate::audit::Row;
use crate::case::Case;
use crate::cli::case::CaseArguments;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::write_lines;
use crate::cli::select::KernelArguments;
use crate::corpus::lines::{StoredCase, write_case};
use crate::explore::{
    SIMPLIFICATIONS, Shrunk, Signature, Size, c_snippet, rust_snippet, shrink_finding,
};
use crate::kernel::Scalar;
use crate::oracle;
use clap::Args;
use std::io::{self, Write};

/// Which case, and whose finding.
#[derive(Args)]
pub struct ShrinkArguments {
    #[command(flatten)]
    case: CaseArguments,

    #[command(flatten)]
    kernels: KernelArguments,
}

/// Runs the command.
pub fn run(arguments: &ShrinkArguments) -> Result<Status, Failure> {
    let rows = arguments.kernels.rows()?;
    let cases = arguments.case.cases()?;
    rows.iter()
        .try_for_each(|row| row.check_in(cases.scalars()))?;
    either_scalar!(&cases, group => shrink(&rows, arguments.case.one(group)?))
}

fn shrink<F: Scalar>(rows: &[Row], case: &Case<F>) -> Result<Status, Failure> {
    let row = row_with_finding(rows, case)?;
    let (signature, shrunk) = shrink_finding(row, case).ok_or_else(|| no_finding(rows))?;
    write_lines(|out| write(out, row, case, &signature, &shrunk))?;
    Ok(Status::Success)
}

/// The one row that shows a finding on the case.
fn row_with_finding<'a, F: Scalar>(rows: &'a [Row], case: &Case<F>) -> Result<&'a Row, Failure> {
    let found: Vec<&Row> = rows
        .iter()
        .filter(|row| Signature::of(row, case).is_some())
        .collect();
    match found[..] {
        [] => Err(no_finding(rows)),
        [row] => Ok(row),
        _ => {
            let rows: Vec<String> = found.iter().map(|row| row.label()).collect();
            let rows = rows.join(", ");
            Err(Failure::usage(format!(
                "{} rows have a finding on the case: {rows}; choose one by --kernel and --epsilon",
                found.len()
            )))
        }
    }
}

fn no_finding(rows: &[Row]) -> Failure {
    let rows: Vec<String> = rows.iter().map(Row::label).collect();
    let message = format!(
        "nothing to shrink: on this case {} does as its contract asks",
        if let [row] = &rows[..] {
            row
        } else {
            "every chosen kernel"
        }
    );
    Failure::nothing(message)
}

fn write<F: Scalar>(
    out: &mut dyn Write,
    row: &Row,
    case: &Case<F>,
    signature: &Signature,
    shrunk: &Shrunk<F>,
) -> io::Result<()> {
    let (before, after) = (Size::of(case), Size::of(&shrunk.case));
    writeln!(out, "kept     {signature}")?;
    writeln!(out, "contract {}", row.contract.describe())?;
    writeln!(out, "truth    {}", oracle::truth(&shrunk.case))?;
    let (steps, tried) = (shrunk.steps, shrunk.tried);
    if steps == 0 {
        writeln!(
            out,
            "size     {} bits in {} different values: as simple as it was ({tried} simpler cases tried)",
            after.bits, after.values
        )?;
    } else {
        writeln!(
            out,
            "size     {} bits in {} different values -> {} bits in {} ({steps} steps, {tried} cases tried)",
            before.bits, before.values, after.bits, after.values
        )?;
    }
    writeln!(
        out,
        "minimum  local: no single simplification keeps the finding, of {SIMPLIFICATIONS}"
    )?;
    let stored = StoredCase {
        why: Some(signature.to_string()),
        ..StoredCase::of(shrunk.case)
    };
    let line = write_case(&stored.with_truth());
    writeln!(out, "\nJSON, a line of a corpus file\n\n{line}")?;
    // The snippet finds its kernel in the library, where only built-in ones are.
    if row.entry.is_built_in() {
        write!(
            out,
            "\nRust\n\n{}",
            rust_snippet(row, &shrunk.case, signature)
        )?;
    }
    write!(out, "\nC\n\n{}", c_snippet(row, &shrunk.case, signature))
}

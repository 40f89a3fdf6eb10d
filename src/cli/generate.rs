//! `hairline generate`: cases as lines for a kernel that runs where hairline does not.

use super::before::total_indices;
use super::exit::{Failure, Status};
use super::output::write_result;
use super::sources::SourceArguments;
use crate::arith::ScalarName;
use crate::audit::Source;
use crate::kernel::Scalar;
use crate::plugin::text;
use clap::Args;
use std::io::{self, Write};

/// Which cases.
#[derive(Args)]
pub struct GenerateArguments {
    #[command(flatten)]
    sources: SourceArguments,

    /// Where to write; - is standard output
    #[arg(short, long, default_value = "-", value_name = "FILE")]
    output: String,
}

/// Runs the command.
pub fn run(arguments: &GenerateArguments) -> Result<Status, Failure> {
    let scalars = arguments.sources.scalars()?;
    let sources = arguments.sources.sources(true)?;
    total_indices(&sources, scalars)?;
    write_result(&arguments.output, |out| {
        let mut cases = 0;
        for source in &sources {
            for name in ScalarName::among(scalars) {
                cases += in_named_scalar!(name, F => write_cases::<F>(out, source))?;
            }
        }
        out.write_all(text::end_line(cases).as_bytes())
    })?;
    Ok(Status::Success)
}

/// Writes all cases of a source in one scalar; returns how many.
fn write_cases<F: Scalar>(out: &mut dyn Write, source: &Source) -> io::Result<u64> {
    let mut written = 0;
    for index in 0..source.count::<F>() {
        let made = source.make::<F>(index);
        let several = made.cases().len() > 1;
        for (k, case) in made.cases().iter().enumerate() {
            // A name in a corpus may have blanks, and an id in a line has none.
            let id = source
                .id::<F>(index, several.then_some(k))
                .replace(char::is_whitespace, "_");
            out.write_all(text::case_line(id, &case.numbers()).as_bytes())?;
            written += 1;
        }
        // An audit asks about these if the kernel reports none of a group.
        let mut around = Vec::new();
        if several && source.has_neighbours() && source.instance::<F>().is_none() {
            source.add_neighbours(index, made.cases(), &mut around);
        }
        for (k, case) in around.iter().enumerate() {
            let id = format!("{}/around.{k}", source.id::<F>(index, None));
            out.write_all(text::case_line(id, &case.numbers()).as_bytes())?;
            written += 1;
        }
    }
    Ok(written)
}

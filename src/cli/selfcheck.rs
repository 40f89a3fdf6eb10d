//! `hairline selfcheck`: the oracle against its definition and against integer arithmetic.

use super::exit::{Failure, Status};
use super::output::write_result;
use super::progress::Progress;
use crate::audit::Observer;
use crate::family::{FAMILIES, LATTICE_SIZE};
use crate::oracle::Layers;
use crate::selfcheck::{Check, family, lattice, whole_range};
use clap::Args;
use std::io::{self, Write};

/// How much to check.
#[derive(Args)]
pub struct SelfcheckArguments {
    /// Indices of each family in each scalar
    #[arg(long, short = 'n', default_value_t = 2000, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    cases: u64,

    /// Which random cases
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Leave out the 3^15 lattice cases
    #[arg(long)]
    no_lattice: bool,

    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command: a line a check, then which layer decided how often.
pub fn run(arguments: &SelfcheckArguments) -> Result<Status, Failure> {
    let &SelfcheckArguments { cases, seed, no_lattice, quiet } = arguments;
    let lattice_size = if no_lattice { 0 } else { LATTICE_SIZE };
    let checks = 2 * (FAMILIES.len() as u64 + 1);
    let progress = Progress::new(lattice_size + checks * cases, "cases", quiet);
    let advance = |count: u64| progress.advance(count);
    let mut results: Vec<(String, Check)> = Vec::new();
    if !no_lattice {
        results.push(("all 3^15 lattice cases, integers".to_owned(), lattice(&advance)));
    }
    for row in FAMILIES {
        results.push((format!("{} f32", row.name), family::<f32>(row, seed, cases, &advance)));
        results.push((format!("{} f64", row.name), family::<f64>(row, seed, cases, &advance)));
    }
    results.push(("any finite f32".to_owned(), whole_range::<f32>(seed, cases, &advance)));
    results.push(("any finite f64".to_owned(), whole_range::<f64>(seed, cases, &advance)));
    progress.finish();
    let seconds = progress.seconds();
    write_result("-", |out| write(out, &results, seconds))?;
    let wrong: u64 = results.iter().map(|(_, check)| check.differences).sum();
    if wrong > 0 {
        let message = format!("self-check: the oracle is wrong on {wrong} cases");
        return Err(Failure::Message(Status::SelfCheck, message));
    }
    Ok(Status::Success)
}

fn write(out: &mut dyn Write, results: &[(String, Check)], seconds: f64) -> io::Result<()> {
    writeln!(out, "{:<34} {:>10} {:>12}", "checked against num-rational", "cases", "differences")?;
    let (mut layers, mut cases) = (Layers::default(), 0);
    for (name, check) in results {
        writeln!(out, "{name:<34} {:>10} {:>12}", check.cases, check.differences)?;
        if let Some((index, message)) = &check.first {
            writeln!(out, "    first at index {index}: {message}")?;
        }
        layers.merge(&check.layers);
        cases += check.cases;
    }
    writeln!(out, "\n{cases} cases in {seconds:.1} s; decided by")?;
    for (name, count) in layers.named() {
        writeln!(out, "    {name:<16} {count:>10}  {:.2} %", 100.0 * count as f64 / cases as f64)?;
    }
    Ok(())
}

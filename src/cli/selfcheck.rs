//! `hairline selfcheck`: the oracle against its definition and against a separate checker in integers.

use super::exit::{Failure, Status};
use super::output::write_lines;
use super::progress::Progress;
use crate::arith::ScalarName;
use crate::family::{FAMILIES, LATTICE_SIZE};
use crate::oracle::Layers;
use crate::selfcheck::{Check, Reference, lattice, thresholds};
use crate::studied::Studied;
use clap::Args;
use std::io::{self, Write};

/// How many times the indices of another set the cases at the layers' thresholds get.
const THRESHOLDS: u64 = 10;

/// How much to check.
#[derive(Args)]
pub struct SelfcheckArguments {
    /// How many indices of each family in each scalar to compare with the definition
    #[arg(long, short = 'n', default_value_t = 2000, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    cases: u64,

    /// How many indices of all sets together to compare with a separate checker in integers too; 52500000
    /// are a hundred million cases and take minutes
    #[arg(long, default_value_t = 1_000_000, value_name = "N")]
    integers: u64,

    /// Seed of the random cases
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Leave out the 3^15 lattice cases
    #[arg(long)]
    no_lattice: bool,

    /// Check for seconds: 100 indices with the definition, 200,000 with integers, no lattice, up to the
    /// first set with a difference; enough to notice a bound or a sign in the oracle that is wrong by much
    #[arg(long, conflicts_with_all = ["cases", "integers", "no_lattice"])]
    quick: bool,

    /// Print no progress
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command: a line a check, then which layer decided how often.
pub fn run(arguments: &SelfcheckArguments) -> Result<Status, Failure> {
    let &SelfcheckArguments {
        cases,
        integers,
        seed,
        no_lattice,
        quick,
        quiet,
    } = arguments;
    let (cases, integers) = if quick {
        (100, 200_000)
    } else {
        (cases, integers)
    };
    let no_lattice = no_lattice || quick;
    let lattice_size = if no_lattice { 0 } else { LATTICE_SIZE };
    let sets = 2 * (FAMILIES.len() as u64 + 1) + THRESHOLDS;
    let runs = [
        (Reference::Integers, "integers", integers.div_ceil(sets)),
        (Reference::Definition, "num-rational", cases),
    ];
    let random: u64 = runs.iter().map(|(.., indices)| sets * indices).sum();
    let progress = Progress::new(lattice_size + random, "cases", quiet);
    let (mut results, mut wrong): (Vec<(String, Check)>, u64) = (Vec::new(), 0);
    let mut add = |set: String, check: &dyn Fn() -> Check| {
        if !quick || wrong == 0 {
            let check = check();
            wrong += check.differences;
            results.push((set, check));
        }
    };
    if !no_lattice {
        add("all 3^15 lattice cases, integers".to_owned(), &|| {
            lattice(&progress)
        });
    }
    for (reference, held_to, n) in runs.into_iter().filter(|(.., n)| *n != 0) {
        let (p, many) = (&progress, THRESHOLDS * n);
        let set = |name: &str| format!("{name}, {held_to}");
        add(set("thresholds f64"), &|| {
            thresholds(reference, seed, many, p)
        });
        add(set("any finite f32"), &|| {
            f32::check_range(reference, seed, n, p)
        });
        add(set("any finite f64"), &|| {
            f64::check_range(reference, seed, n, p)
        });
        for row in FAMILIES {
            let of = |scalar: ScalarName| set(&format!("{} {scalar}", row.name));
            add(of(ScalarName::F32), &|| {
                f32::check_family(row, reference, seed, n, p)
            });
            add(of(ScalarName::F64), &|| {
                f64::check_family(row, reference, seed, n, p)
            });
        }
    }
    progress.finish();
    let seconds = progress.seconds();
    write_lines(|out| write(out, &results, seconds))?;
    if wrong > 0 {
        let message = format!("self-check: the oracle is wrong on {wrong} cases");
        return Err(Failure::self_check(message));
    }
    Ok(Status::Success)
}

fn write(out: &mut dyn Write, results: &[(String, Check)], seconds: f64) -> io::Result<()> {
    writeln!(
        out,
        "{:<36} {:>10} {:>12}",
        "set, and what it is held to", "cases", "differences"
    )?;
    let (mut layers, mut cases) = (Layers::default(), 0);
    for (name, check) in results {
        writeln!(
            out,
            "{name:<36} {:>10} {:>12}",
            check.cases, check.differences
        )?;
        if let Some((index, message)) = &check.first {
            writeln!(out, "    first at index {index}: {message}")?;
        }
        layers.merge(&check.layers);
        cases += check.cases;
    }
    writeln!(out, "\n{cases} cases in {seconds:.1} s; decided by")?;
    for (name, count) in layers.named() {
        writeln!(
            out,
            "    {name:<16} {count:>10}  {:.2} %",
            100.0 * count as f64 / cases as f64
        )?;
    }
    Ok(())
}

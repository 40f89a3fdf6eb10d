//! `hairline list`: the tables that the other commands take names from.

use super::exit::{Failure, Status};
use super::output::write_result;
use super::plugins::PluginArguments;
use crate::arith::Arithmetic;
use crate::audit::{ASPECTS, Aspect, EpsilonText, coverage};
use crate::contract::NAMED;
use crate::family::{FAMILIES, Family, STRATA};
use crate::kernel::{self, KernelInfo, PRESETS, PresetValue, Tunable};
use crate::spawn::{PUBLISHED, describe};
use clap::{Args, ValueEnum};
use std::io::{self, Write};

/// The arguments of `list`.
#[derive(Args)]
pub struct ListArguments {
    #[arg(value_enum)]
    what: What,

    /// For families: the share of the cases, in percent, that meet each corner, edge and side, each orientation of
    /// plane and ray, each size, distance and place of t; of the strata in the scene room. '.' is none
    #[arg(long)]
    coverage: bool,

    #[command(flatten)]
    plugins: PluginArguments,
}

#[derive(Clone, Copy, ValueEnum)]
enum What {
    /// Kernels with their sources, contracts, gates and epsilons
    Kernels,
    /// Case families with their promises
    Families,
    /// Contracts that all kernels can be judged by
    Contracts,
    /// Epsilons of published libraries
    Presets,
    /// Offset schemes of new rays with their sources
    Schemes,
    /// Arithmetics that kernels can be run in
    Arithmetics,
}

/// Runs the command.
pub fn run(arguments: &ListArguments) -> Result<Status, Failure> {
    arguments.plugins.entries()?;
    if arguments.coverage {
        return match arguments.what {
            What::Families => {
                write_result("-", write_coverage)?;
                Ok(Status::Success)
            }
            _ => Err(Failure::usage("--coverage: only families have it")),
        };
    }
    write_result("-", |out| match arguments.what {
        What::Kernels => kernel::all().iter().try_for_each(|entry| write_kernel(out, entry.info)),
        What::Families => FAMILIES
            .iter()
            .chain(STRATA)
            .try_for_each(|family| writeln!(out, "{:<18} {}", family.name, family.promise)),
        What::Contracts => {
            writeln!(out, "{:<18} each kernel by what its own source states (the default)", "own")?;
            NAMED.iter().try_for_each(|named| {
                writeln!(
                    out,
                    "{:<18} {}\n{:<18} {}",
                    named.name,
                    named.about,
                    "",
                    named.contract.describe()
                )
            })
        }
        What::Presets => presets(out),
        What::Schemes => schemes(out),
        What::Arithmetics => Arithmetic::ALL
            .iter()
            .try_for_each(|a| writeln!(out, "{:<18} {}", a.name(), a.describe())),
    })?;
    Ok(Status::Success)
}

/// Writes the kinds of cases in each family, in tables that fit 100 columns.
fn write_coverage(out: &mut dyn Write) -> io::Result<()> {
    const INDICES: u64 = 500;
    const WIDTH: usize = 100;
    let of_family = |family: &'static Family| (family.name, coverage(family, INDICES));
    let rows: Vec<(&str, Vec<f64>)> = FAMILIES.iter().chain(STRATA).map(of_family).collect();
    let kinds: Vec<&[Aspect]> = ASPECTS.chunk_by(|a, b| a.kind == b.kind).collect();
    let mut first = 0;
    while first < kinds.len() {
        let width = |kind: &&[Aspect]| {
            kind.iter().map(|cell| cell.name.len().max(4) + 2).sum::<usize>() + 1
        };
        let mut taken = 1;
        while first + taken < kinds.len()
            && 18 + kinds[first..=first + taken].iter().map(width).sum::<usize>() <= WIDTH
        {
            taken += 1;
        }
        let block = &kinds[first..first + taken];
        let start: usize = kinds[..first].iter().map(|kind| kind.len()).sum();
        write!(out, "{:<18}", "")?;
        for kind in block {
            write!(out, "   {:<1$}", kind[0].kind, width(kind) - 3)?;
        }
        write!(out, "\n{:<18}", "family")?;
        for cells in block {
            write!(out, " ")?;
            cells.iter().try_for_each(|cell| write!(out, "  {:>4}", cell.name))?;
        }
        writeln!(out)?;
        for (name, shares) in &rows {
            write!(out, "{name:<18}")?;
            let mut shares = shares[start..].iter();
            for cells in block {
                write!(out, " ")?;
                for (cell, share) in cells.iter().zip(&mut shares) {
                    write!(out, "  {:>1$}", percent_in_three(*share), cell.name.len().max(4))?;
                }
            }
            writeln!(out)?;
        }
        writeln!(out)?;
        first += taken;
    }
    Ok(())
}

/// `.`, `<1`, `37`, `100`.
fn percent_in_three(share: f64) -> String {
    match share * 100.0 {
        0.0 => ".".to_owned(),
        percent if percent < 1.0 => "<1".to_owned(),
        percent => format!("{percent:.0}"),
    }
}

fn write_kernel(out: &mut dyn Write, info: &KernelInfo) -> io::Result<()> {
    writeln!(
        out,
        "{}\n    source: {}\n    contract: {}",
        info.name,
        info.source,
        info.contract.describe()
    )?;
    for (i, gate) in info.gates.iter().enumerate() {
        let refuses = gate.refuses;
        if gate.epsilon == Tunable::Fixed {
            writeln!(out, "    test {}: refuses where {refuses}; takes no epsilon", gate.name)?;
            continue;
        }
        let sets: Vec<String> = info
            .epsilon_sets
            .iter()
            .map(|set| format!("{} ({})", set.values[i], set.name))
            .collect();
        writeln!(
            out,
            "    gate {}: refuses where {refuses}; dimension length^{} direction^{}; e = {}",
            gate.name,
            gate.dimension.length,
            gate.dimension.direction,
            sets.join(", ")
        )?;
    }
    Ok(())
}

fn schemes(out: &mut dyn Write) -> io::Result<()> {
    for published in PUBLISHED {
        let (name, source) = (published.name, published.source);
        writeln!(out, "{name}{}\n    source: {source}", describe(name))?;
        if let Some(parameter) = published.parameter {
            writeln!(out, "    {name}=VALUE: {} [{}]", parameter.what, parameter.default)?;
        }
    }
    Ok(())
}

fn presets(out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{:<16} as each kernel's source has them (the default)", "source")?;
    for preset in PRESETS {
        writeln!(out, "{:<16} {}", preset.name, preset.source)?;
        for entry in preset.entries {
            let value = match entry.value {
                PresetValue::Decimal(text) => text.to_owned(),
                PresetValue::MachineEpsilon(k) => EpsilonText::MachineEpsilon(k).to_string(),
            };
            writeln!(
                out,
                "{:<16} gate {}={value}, dimension length^{} direction^{}: {}",
                "", entry.gate, entry.dimension.length, entry.dimension.direction, entry.form
            )?;
        }
    }
    Ok(())
}

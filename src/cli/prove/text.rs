//! Proofs as text.

use super::record::{GatePart, Record};
use super::scenes::scene_text;
use crate::prove::{Scene, units};
use std::io::{self, Write};

/// All kernels: a line a gate.
pub fn table(record: &Record, scene: Option<&Scene>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "No float of the domain makes a gate more wrong than its bound; the witness is the worst known."
    )?;
    writeln!(out, "{}", domain(record, scene))?;
    let has_scalar = |name: &str| record.gates.iter().any(|gate| gate.scalar == name);
    for (scalar, unit) in
        [("f32", "2^-24"), ("f64", "2^-53")].into_iter().filter(|s| has_scalar(s.0))
    {
        writeln!(out, "\n{scalar}; u = {unit}")?;
        let width = record.gates.iter().map(|gate| gate.kernel.len()).max().unwrap_or(0);
        writeln!(
            out,
            "{:width$}  {:8}  {:>9}  {:>9}  {:>6}  supposes a bound of",
            "kernel", "gate", "bound, u", "witness", "factor"
        )?;
        for gate in record.gates.iter().filter(|gate| gate.scalar == scalar) {
            row(gate, width, out)?;
        }
    }
    let watertight: Vec<String> = record
        .kernels
        .iter()
        .filter(|kernel| kernel.watertight)
        .map(|kernel| format!("{} ({})", kernel.kernel, kernel.scalar))
        .collect();
    if !watertight.is_empty() {
        writeln!(
            out,
            "\nWatertight at edges, at an epsilon of 0, proved: {}",
            watertight.join(", ")
        )?;
    }
    writeln!(out, "\nWhat follows for epsilons: hairline prove --kernel NAME")
}

fn row(gate: &GatePart, width: usize, out: &mut dyn Write) -> io::Result<()> {
    let (kernel, name) = (&gate.kernel, gate.gate);
    if let Some(why) = &gate.why {
        return writeln!(out, "{kernel:width$}  {name:8}  no bound: {why}");
    }
    let number = |x: Option<f64>, up: bool| x.map_or("-".to_owned(), |x| units(x, up));
    writeln!(
        out,
        "{kernel:width$}  {name:8}  {:>9}  {:>9}  {:>6}  {}",
        number(gate.bound_units, true),
        number(gate.witness.as_ref().map(|w| w.units), false),
        gate.factor.map_or("-".to_owned(), |x| format!("{x:.2}")),
        gate.supposes.join(", ")
    )
}

/// One kernel: the sentences; `rays` are the flags of `epsilon` that choose such rays.
pub fn kernel(
    record: &Record,
    scene: Option<&Scene>,
    rays: &str,
    out: &mut dyn Write,
) -> io::Result<()> {
    for (i, kernel) in record.kernels.iter().enumerate() {
        let unit = if kernel.scalar == "f32" { "2^-24" } else { "2^-53" };
        let gap = if i > 0 { "\n" } else { "" };
        writeln!(out, "{gap}{} in {}; u = {unit}", kernel.kernel, kernel.scalar)?;
        if i == 0 {
            writeln!(out, "{}", domain(record, scene))?;
        }
        for gate in record.gates.iter().filter(|gate| gate.scalar == kernel.scalar) {
            writeln!(out, "\n  {}: {}", gate.gate, gate.compares)?;
            for statement in &gate.statements {
                paragraph(statement, out)?;
            }
        }
        writeln!(out, "\n  edges")?;
        paragraph(kernel.edges, out)?;
    }
    let name = record.kernels.first().map_or("K", |kernel| &kernel.kernel);
    writeln!(
        out,
        "\nWhat epsilons do to your rays, and which to use: hairline epsilon --kernel {name} {rays}"
    )
}

/// A sentence of a gate.
fn paragraph(text: &str, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", wrapped(text, 4))
}

/// Words in lines of at most 100 columns; the lines after the first are indented by two more.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines = vec![" ".repeat(indent)];
    for word in text.split(' ') {
        let line = lines.last_mut().expect("one at least");
        if line.trim().is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() > 100 {
            lines.push(" ".repeat(indent + 2) + word);
        } else {
            line.push(' ');
            line.push_str(word);
        }
    }
    lines.join("\n")
}

fn domain(record: &Record, scene: Option<&Scene>) -> String {
    match scene {
        Some(scene) => wrapped(&format!("Scene: {}", scene_text(scene)), 0),
        None => {
            let part = &record.domain;
            format!(
                "Unit domain: coordinates of points and of their differences up to {:.3}, of d up to {}. Where a \
                 kernel divides,\ndivisors of {} and more (the largest coordinate of d too), quotients up to {}. A \
                 bound supposes, and its\nwitness keeps, only what the gate's numbers use. Powers of two scale it: \
                 lengths by s scale det by s^2.",
                part.edge, part.direction, part.divisor_at_least, part.quotient_at_most
            )
        }
    }
}

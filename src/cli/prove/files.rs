//! Certificates, and programs for other people's tools.

use super::{OutputFormat, ProveArguments};
use crate::cli::exit::{Failure, Status};
use crate::cli::input::read_text;
use crate::cli::output::write_result;
use crate::corpus::InputError;
use crate::kernel::{self, Entry, Path, Scalar};
use crate::prove::certificate::{self, Claim, Heading, heading, program};
use crate::prove::{
    Domain, Effort, Format, Quantity, Searched, Summary, checker, each_quantity, format_of, fpcore,
    gappa, is_impossible, paths_of,
};
use crate::report::number_of;
use num_traits::ToPrimitive;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Writes the certificate of one kernel in one scalar.
pub fn certify(
    entries: &[&'static Entry],
    scalars: [bool; 2],
    domains: (Domain, &[Domain]),
    path: &str,
) -> Result<Status, Failure> {
    let ([entry], [true, false] | [false, true]) = (entries, scalars) else {
        return Err(Failure::usage("--certificate is of one --kernel in one --scalar"));
    };
    let text = if scalars[0] {
        certificate_of::<f32>(entry, domains)
    } else {
        certificate_of::<f64>(entry, domains)
    };
    let text = text.map_err(|why| {
        let message = format!("{}: no certificate: {why}", entry.info.name);
        Failure::Message(Status::NothingSelected, message)
    })?;
    write_result(path, |out| out.write_all(text.as_bytes()))?;
    Ok(Status::Success)
}

fn certificate_of<F: Searched + Scalar>(
    entry: &Entry,
    (domain, parts): (Domain, &[Domain]),
) -> Result<String, String> {
    let effort = Effort { evaluations: 0, seed: 1 };
    let summary = Summary::<F>::new(entry, domain, parts, &[], effort)?;
    let head = Heading { kernel: entry.info.name, scalar: F::NAME, format: summary.format };
    let mut text = heading(&head);
    let mut stated = None;
    for quantity in summary.proof.quantities.iter().filter(|q| q.bound.is_ok()) {
        let claim = Claim { gate: entry.info.gates[quantity.gate].name, place: quantity.place };
        if stated != Some(quantity.domain) {
            text.push_str(&certificate::domain(&quantity.domain));
            stated = Some(quantity.domain);
        }
        text.push_str(&program(&summary.proof.paths[quantity.path], &quantity.lemmas, &[claim]));
    }
    if stated.is_none() { Err("no gate has a bound in this domain".to_owned()) } else { Ok(text) }
}

/// Checks certificates, and says what they prove.
pub fn check(arguments: &ProveArguments) -> Result<Status, Failure> {
    let lines: Vec<String> =
        arguments.check.par_iter().map(|file| checked(file)).collect::<Result<_, _>>()?;
    write_result(&arguments.output, |out| {
        lines.iter().try_for_each(|line| writeln!(out, "{line}"))
    })?;
    Ok(Status::Success)
}

fn checked(file: &str) -> Result<String, Failure> {
    let text = read_text(file)?;
    let proved = checker::check(&text)
        .map_err(|refusal| InputError::at(file, refusal.line, refusal.message))?;
    let bounds = number_of(proved.len() as u64, "bound", "bounds");
    // The largest error of each gate.
    let mut gates: BTreeMap<&str, f64> = BTreeMap::new();
    for claim in &proved {
        let error = claim.bound.error.to_f64().unwrap_or(f64::INFINITY);
        let most = gates.entry(&claim.gate).or_default();
        *most = most.max(error);
    }
    let gates: Vec<String> = gates.iter().map(|(gate, x)| format!("{gate} {x:.3e}")).collect();
    // The checker has read this line.
    let kernel = text.lines().nth(1).unwrap_or_default().trim_start_matches("kernel ");
    let (name, scalar) = kernel.split_once(' ').unwrap_or_default();
    let recorded =
        kernel::find(name).map(|entry| in_named_scalar!(scalar, F => recorded::<F>(entry)));
    let count = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
    let has_limits = 0 < count("at-least ") + count("at-most ") || 1 < count("domain ");
    let whose = match recorded {
        None => "no kernel of that name is here to compare".to_owned(),
        Some(Err(why)) => format!("not compared with the kernel: {why}"),
        Some(Ok(recorded)) => {
            let found = programs_of(&text);
            if let Some((line, _)) =
                found.iter().find(|(_, program)| !recorded.contains_key(program))
            {
                let message = format!(
                    "{file}:{line}: the proof is right, but {name} has no such program here: write its certificate again"
                );
                return Err(Failure::Message(Status::Disagreements, message));
            }
            let missing: BTreeSet<&str> = recorded
                .iter()
                .filter(|(program, _)| found.iter().all(|(_, known)| known != *program))
                .map(|(_, gate)| *gate)
                .collect();
            match missing.is_empty() {
                true if has_limits => {
                    "for inputs as its lines domain, at-least and at-most say".to_owned()
                }
                true => "all that the kernel compares".to_owned(),
                false => format!("without all of {}", Vec::from_iter(missing).join(", ")),
            }
        }
    };
    Ok(format!("{file}: {bounds} proved of {kernel}: {} ({whose})", gates.join(", ")))
}

/// The programs of a certificate without their lemmas, each with its line.
fn programs_of(certificate: &str) -> Vec<(usize, String)> {
    let mut programs: Vec<(usize, String)> = Vec::new();
    for (i, line) in certificate.lines().enumerate() {
        match (line.split(' ').next(), programs.last_mut()) {
            (Some("program"), _) => programs.push((i + 1, format!("{line}\n"))),
            (Some("op" | "decision" | "claim" | "end"), Some((_, program))) => {
                program.push_str(line);
                program.push('\n');
            }
            _ => {}
        }
    }
    programs
}

/// The programs of all that a kernel's gates compare, as certificates have them, each with its gate.
fn recorded<F: Scalar>(entry: &Entry) -> Result<HashMap<String, &'static str>, String> {
    let mut paths = paths_of::<F>(entry)?;
    paths.retain(|path| !is_impossible(path));
    let mut programs = HashMap::new();
    each_quantity(&paths, None, Domain::UNIT, format_of::<F>(), |path, compared, place, _| {
        let gate = entry.info.gates[compared.gate].name;
        programs.insert(program(&paths[path], &[], &[Claim { gate, place }]), gate);
    });
    Ok(programs)
}

/// The programs of all quantities, or of those of one gate, or (if true) of its worst one.
fn programs<F: Searched + Scalar>(
    entry: &Entry,
    domain: Domain,
    only: Option<(usize, bool)>,
    text: &mut String,
    write: impl Fn(&Path, &Quantity, Domain, Format, &str) -> Option<String>,
) -> Result<(), String> {
    let effort = Effort { evaluations: 0, seed: 1 };
    let summary = Summary::<F>::new(entry, domain, &[], &[], effort)?;
    let mut numbers = vec![0; entry.info.gates.len()];
    let one = only.filter(|(_, one)| *one).and_then(|(gate, _)| summary.proof.gate(gate)?.ok());
    for quantity in &summary.proof.quantities {
        numbers[quantity.gate] += 1;
        let is_other = one.is_some_and(|one| !std::ptr::eq(one, quantity));
        if is_other || only.is_some_and(|(gate, _)| gate != quantity.gate) {
            continue;
        }
        let (gate, number) = (entry.info.gates[quantity.gate].name, numbers[quantity.gate]);
        let name = format!("{} {} {gate} {number}", entry.info.name, F::NAME);
        let path = &summary.proof.paths[quantity.path];
        if let Some(program) = write(path, quantity, summary.domain, summary.format, &name) {
            text.push_str(&program);
            text.push('\n');
        }
    }
    Ok(())
}

/// Writes the programs of the chosen kernels in a language of other tools.
pub fn export(
    arguments: &ProveArguments,
    entries: &[&'static Entry],
    scalars: [bool; 2],
    domain: Domain,
) -> Result<Status, Failure> {
    let write = |path: &Path, quantity: &Quantity, domain: Domain, format: Format, name: &str| {
        match arguments.format {
            OutputFormat::Gappa => {
                let goal = quantity.bound.as_ref().ok().map(|bound| bound.error);
                gappa(path, quantity.place, domain, format, name, goal).ok()
            }
            _ => Some(fpcore(path, quantity.place, domain, format, name)),
        }
    };
    let is_one = entries.len() == 1 && scalars[0] != scalars[1] && arguments.gate.is_some();
    if arguments.format == OutputFormat::Gappa && !is_one {
        return Err(Failure::usage(
            "--format gappa is of one --kernel, one --scalar and one --gate",
        ));
    }
    let mut text = String::new();
    for entry in entries {
        let gate = arguments.gate_of(entry)?;
        let only = gate.map(|gate| (gate, arguments.format == OutputFormat::Gappa));
        let of_f32 = scalars[0].then(|| programs::<f32>(entry, domain, only, &mut text, write));
        let of_f64 = scalars[1].then(|| programs::<f64>(entry, domain, only, &mut text, write));
        let failed = [of_f32, of_f64].into_iter().flatten().find_map(Result::err);
        if let Some(why) = failed.filter(|_| !arguments.quiet) {
            eprintln!("{}: no program: {why}", entry.info.name);
        }
    }
    if text.is_empty() {
        let message = "no chosen kernel has such a program".to_owned();
        return Err(Failure::Message(Status::NothingSelected, message));
    }
    write_result(&arguments.output, |out| out.write_all(text.as_bytes()))?;
    Ok(Status::Success)
}

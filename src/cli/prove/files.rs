//! Writes certificates, and programs for other people's tools.

use super::{OutputFormat, ProveArguments};
use crate::cli::exit::{Failure, Status};
use crate::cli::output::write_result;
use crate::kernel::{Entry, Path, Scalar};
use crate::prove::certificate::{self, Claim, Heading, heading, program};
use crate::prove::{Domain, Effort, Format, Quantity, Searched, Summary, fpcore, gappa};

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
        let path = &summary.proof.paths[quantity.path];
        let claim = Claim::new(&entry.info.gates[quantity.gate], path, quantity.place);
        if stated != Some(quantity.domain) {
            text.push_str(&certificate::domain(&quantity.domain));
            stated = Some(quantity.domain);
        }
        text.push_str(&program(path, &quantity.lemmas, &[claim]));
    }
    if stated.is_none() { Err("no gate has a bound in this domain".to_owned()) } else { Ok(text) }
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

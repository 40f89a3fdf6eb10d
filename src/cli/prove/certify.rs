//! Writes the certificate of one kernel in one scalar: each number that a gate compares, and the bound that is proved of it.

use crate::audit::shell_word;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::write_result;
use crate::kernel::{Entry, Scalar};
use crate::prove::certificate::{self, Claim};
use crate::prove::{Domain, Effort, Quantity, Searched, Summary};
use crate::record::number_of;

/// Writes the certificate of one kernel in one scalar.
pub fn certify(
    entries: &[&'static Entry],
    scalars: [bool; 2],
    domains: (Domain, &[Domain]),
    (path, quiet): (&str, bool),
) -> Result<Status, Failure> {
    let ([entry], [true, false] | [false, true]) = (entries, scalars) else {
        return Err(Failure::usage(
            "--certificate is of one --kernel in one --scalar",
        ));
    };
    let text = match scalars[0] {
        true => certificate_of::<f32>(entry, domains),
        false => certificate_of::<f64>(entry, domains),
    };
    let text = text.map_err(|why| {
        let message = format!("{}: no certificate: {why}", entry.info.name);
        Failure::nothing(message)
    })?;
    write_result(path, |out| out.write_all(text.as_bytes()))?;
    if !quiet {
        let bounds = text
            .lines()
            .filter(|line| line.starts_with("claim "))
            .count() as u64;
        let bounds = number_of(bounds, "bound", "bounds");
        let check = format!("check it: hairline prove --check {}", shell_word(path));
        eprintln!(
            "{path}: {bounds} of what {} compares; {check}",
            entry.info.name
        );
    }
    Ok(Status::Success)
}

fn certificate_of<F: Searched + Scalar>(
    entry: &Entry,
    (domain, parts): (Domain, &[Domain]),
) -> Result<String, String> {
    let summary = Summary::<F>::new(entry, domain, parts, &[], Effort::NONE)?;
    let mut text = certificate::heading(entry.info.name, F::NAME, summary.format);
    let mut stated = None;
    for quantity in summary.proof.quantities.iter().filter(|q| q.bound.is_ok()) {
        let path = &summary.proof.paths[quantity.path];
        let Quantity {
            place,
            orders,
            also,
            ..
        } = quantity;
        let gate = &entry.info.gates[quantity.gate];
        let symmetry = certificate::symmetry_at(gate, path, *place);
        let claim = Claim {
            gate: gate.name,
            place: *place,
            symmetry,
            orders,
            also,
        };
        if stated != Some(quantity.domain) {
            text.push_str(&certificate::domain(&quantity.domain));
            stated = Some(quantity.domain);
        }
        text.push_str(&certificate::program(path, &quantity.lemmas, &claim));
    }
    if stated.is_none() {
        Err("no gate has a bound in this domain".to_owned())
    } else {
        Ok(text)
    }
}

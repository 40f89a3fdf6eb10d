//! What changed from one edition to the next: entrants, versions, contracts and what became of the claims.

use super::tables::{claim, row};
use super::{EntrantResult, names, results};
use std::path::Path;

/// The changes of an edition against the one before it in the same folder, as a list in Markdown.
pub fn changes(editions: &Path, name: &str) -> Result<String, String> {
    let names = names(editions)?;
    let place = names
        .iter()
        .position(|other| other == name)
        .ok_or(format!("no edition {name}"))?;
    let Some(before) = place.checked_sub(1).map(|i| &names[i]) else {
        return Ok(String::new());
    };
    let old = results(&editions.join(before))?;
    let new = results(&editions.join(name))?;
    let of = |results: &[EntrantResult], name: &str| -> Option<EntrantResult> {
        results.iter().find(|result| result.kernel == name).cloned()
    };
    let mut lines: Vec<String> = Vec::new();
    for entrant in &new {
        let EntrantResult {
            kernel,
            version,
            contract,
            ..
        } = entrant;
        let Some(old) = of(&old, kernel) else {
            lines.push(format!("{kernel} {version} is new."));
            continue;
        };
        if old.version != *version {
            lines.push(format!(
                "{kernel}: version {} became {version}.",
                old.version
            ));
        }
        let [added, dropped] =
            [(contract, &old.contract), (&old.contract, contract)].map(|(one, other)| {
                let words = one
                    .split(", ")
                    .filter(|word| other.split(", ").all(|also| also != *word));
                words.collect::<Vec<_>>().join(", ")
            });
        let has_another_contract = *contract != old.contract;
        if has_another_contract {
            let dropped = if dropped.is_empty() {
                dropped
            } else {
                format!(" in place of \"{dropped}\"")
            };
            lines.push(format!(
                "{kernel} is judged by \"{added}\"{dropped}, as its documentation says."
            ));
        }
        for (scalar, result) in &entrant.scalars {
            let Some(was) = old.scalars.get(scalar) else {
                continue;
            };
            if claim(was) != claim(result) {
                lines.push(format!(
                    "{kernel} in {scalar}: {} became {}.",
                    claim(was),
                    claim(result)
                ));
            }
            if has_another_contract {
                // Edges, vertices, parallel.
                let [was, is] = [row(&old, scalar, was), row(entrant, scalar, result)]
                    .map(|cells| cells[4..7].join(", "));
                lines.push(format!(
                    "{kernel} in {scalar}, at edges, at vertices, parallel: {was} became {is}."
                ));
            }
        }
    }
    lines.extend(
        old.iter()
            .filter(|entrant| of(&new, &entrant.kernel).is_none())
            .map(|entrant| format!("{} {} is no longer there.", entrant.kernel, entrant.version)),
    );
    let list: String = lines.iter().map(|line| format!("- {line}\n")).collect();
    Ok(format!(
        "Since {before}; what is not named has the same version, contract and claim:\n\n{list}"
    ))
}

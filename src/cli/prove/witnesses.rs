//! The stored witnesses: `corpora/proofs/witnesses.ndjson`.

use crate::arith::{Float, ScalarName};
use crate::cli::exit::Failure;
use crate::files::InputError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// The witnesses that the program was built with.
pub const KNOWN: &str = include_str!("../../../corpora/proofs/witnesses.ndjson");

/// A stored witness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredWitness {
    pub kernel: String,
    pub scalar: ScalarName,
    pub gate: String,
    /// The goal that it is a witness for: see `GOALS`.
    pub goal: String,
    /// The seventeen numbers, as bits in hexadecimal.
    pub inputs: Vec<String>,
    /// Its score in units of 2^-p. It is computed again whenever it is used.
    pub units: f64,
}

impl StoredWitness {
    /// As numbers of a scalar; none if they are not seventeen.
    pub fn numbers<F: Float>(&self) -> Option<[F; 17]> {
        let bits = |text: &String| u64::from_str_radix(text, 16).ok().map(F::from_bits);
        let numbers: Vec<F> = self.inputs.iter().map(bits).collect::<Option<_>>()?;
        numbers.try_into().ok()
    }

    /// Its place in the file.
    fn key(&self) -> [&str; 4] {
        [&self.kernel, self.scalar.name(), &self.gate, &self.goal]
    }

    /// The nearest numbers of either scalar: a place to search from.
    pub fn nearest<F: Float>(&self) -> Option<[F; 17]> {
        in_named_scalar!(self.scalar, G => {
            let numbers = self.numbers::<G>()?;
            Some(numbers.map(|x| F::from_f64(x.to_f64())))
        })
    }
}

/// The witnesses of a file's text, one a line.
pub fn read_witnesses(text: &str, path: &str) -> Result<Vec<StoredWitness>, Failure> {
    let lines = text
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(i, line)| {
            let witness: StoredWitness = serde_json::from_str(line)
                .map_err(|error| InputError::at(path, i + 1, error.to_string()))?;
            if witness.numbers::<f64>().is_none() {
                return Err(InputError::at(path, i + 1, "not seventeen numbers as bits").into());
            }
            Ok(witness)
        })
        .collect()
}

/// Puts found witnesses in the place of those of the same kernels and scalars; how many are others than before. A stored one that is
/// still a witness was found again: it was tried.
pub fn merge(stored: &mut Vec<StoredWitness>, found: Vec<StoredWitness>) -> usize {
    let run: BTreeSet<(String, ScalarName)> = found
        .iter()
        .map(|it| (it.kernel.clone(), it.scalar))
        .collect();
    let changed = found
        .iter()
        .filter(|witness| !stored.contains(witness))
        .count();
    stored.retain(|it| !run.contains(&(it.kernel.clone(), it.scalar)));
    stored.extend(found);
    stored.sort_by(|a, b| a.key().cmp(&b.key()));
    changed
}

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
    /// Its inputs as numbers of a scalar; none if they are not seventeen.
    pub fn numbers<F: Float>(&self) -> Option<[F; 17]> {
        let mut numbers = Vec::new();
        for text in &self.inputs {
            let bits = u64::from_str_radix(text, 16).ok()?;
            numbers.push(F::from_bits(bits));
        }
        numbers.try_into().ok()
    }

    /// The key by which witnesses are ordered in the file.
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
    let mut witnesses = Vec::new();
    for (i, line) in text.lines().enumerate() {
        if line.trim().is_empty() {
            continue;
        }
        let wrong = |message: String| InputError::at(path, i + 1, message);
        let witness: StoredWitness =
            serde_json::from_str(line).map_err(|error| wrong(error.to_string()))?;
        if witness.numbers::<f64>().is_none() {
            return Err(wrong("not seventeen numbers as bits".to_owned()).into());
        }
        witnesses.push(witness);
    }
    Ok(witnesses)
}

/// Puts found witnesses in the place of those of the same kernels and scalars, and returns how many were not stored before.
/// Nothing is lost: the search tried the stored ones, and found again those that still are witnesses.
pub fn merge(stored: &mut Vec<StoredWitness>, found: Vec<StoredWitness>) -> usize {
    let of = |witness: &StoredWitness| (witness.kernel.clone(), witness.scalar);
    let searched: BTreeSet<(String, ScalarName)> = found.iter().map(of).collect();
    let is_new = |witness: &&StoredWitness| !stored.contains(witness);
    let changed = found.iter().filter(is_new).count();
    stored.retain(|witness| !searched.contains(&of(witness)));
    stored.extend(found);
    stored.sort_by(|a, b| a.key().cmp(&b.key()));
    changed
}

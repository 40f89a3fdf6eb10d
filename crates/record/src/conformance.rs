//! The part of a record that says how a run compares with what was expected of it.

mod beside;
mod net;

pub use beside::*;
pub use net::NetFinding;

use crate::arith::ScalarName;
use crate::class::FindingClass;
use crate::key::Key;
use crate::kind::FindingKind;
use crate::number::{group_digits, number_of};
use crate::rate::Rate;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How a run compares with its expectations.
#[apply(part!)]
#[derive(Default)]
pub struct Conformance {
    /// The verdict of the comparison.
    pub verdict: ComparisonVerdict,
    /// How counts were compared.
    pub method: Method,
    /// True if the lock file says nothing of this run, so that families are compared and not classes.
    pub is_by_family: bool,
    /// The file of expectations; none if there is none, and nothing is expected.
    pub expectations: Option<String>,
    /// A note on what was not compared, and why.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The formulas that wrong kernels of one's own compute with another epsilon or with fused products.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub computes: Vec<ComputedFormula>,
    /// A short case of what got worse.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub short_case: Option<ShortCase>,
    /// The changes, added up.
    pub change: NetChange,
    /// Kernel rows that are set to something else than what the expectations are of.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rows: Vec<RowChange>,
    /// Proofs that `[proved]` demands and that there are none of.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unproved: Vec<Unproved>,
    /// The first answer that differed, of each kernel row whose answers differ from run to run: it is not compared.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unsteady: Vec<Deviation>,
    /// Disagreements that were not expected, or are worse than expected.
    pub unexpected: Vec<Deviation>,
    /// Expectations that no longer come true: what was wrong is less so, or gone.
    pub stale: Vec<Deviation>,
    /// Expectations that came true.
    pub known: Vec<Deviation>,
    /// Errors of right hits that are not those of the blessed run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<ErrorChange>,
    /// Classes of disagreement without an expectation that are too rare to tell from none.
    pub too_rare_to_tell: u64,
    /// Expectations of kernels, scalars or families that the plan leaves out.
    pub outside_the_plan: u64,
}

/// The verdict of a comparison.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ComparisonVerdict {
    /// All is as expected.
    #[default]
    Conforms,
    /// There are unexpected disagreements, or proofs missing.
    Disagreements,
    /// There are none, but kernels whose answers differ from run to run.
    Unsteady,
    /// There are none, but expectations that no longer come true.
    Stale,
}

/// How many classes of disagreement changed from what is expected to what a run found.
#[apply(part!)]
#[derive(Copy, Default, PartialEq, Eq)]
pub struct NetChange {
    /// Fewer cases than expected, or none.
    pub better: u64,
    /// More cases than expected.
    pub worse: u64,
    /// Cases where none is expected.
    pub new: u64,
    /// As many cases as expected, but not the same ones.
    pub other_cases: u64,
    /// Those of the worse and the new that have cases on which the kernel failed before, so that they were not judged.
    pub newly_judged: u64,
    /// As expected.
    pub unchanged: u64,
}

impl NetChange {
    /// True if something got worse.
    pub fn is_worse(&self) -> bool {
        0 < self.worse + self.new
    }
}

impl fmt::Display for NetChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let NetChange {
            better,
            worse,
            new,
            other_cases,
            newly_judged,
            unchanged,
        } = self;
        write!(
            f,
            "{better} better, {worse} worse, {new} new, {other_cases} of other cases, {unchanged} unchanged"
        )?;
        match *newly_judged {
            0 => Ok(()),
            count => write!(f, " ({count} where the kernel failed before)"),
        }
    }
}

/// How counts are compared with expectations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The cases of the plan are those of the expectations: the same must fail, by count and digest.
    #[default]
    CaseByCase,
    /// They are others: rates of samples are compared by their intervals.
    Intervals,
}

/// A class of disagreement beside what was expected of it.
#[apply(part!)]
pub struct Deviation {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// The source's name in tables.
    pub family: String,
    /// The class of the truth.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub class: FindingClass,
    /// The kind of finding.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub finding: FindingKind,
    /// The expectation, in words.
    pub expected: String,
    /// How many cases were expected; absent where a share was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected_count: Option<u64>,
    /// How often it happened.
    pub found: Rate,
    /// The line of the expectation.
    pub line: Option<usize>,
    /// The worst case, or the first.
    pub case: Option<String>,
    /// Its bit patterns in hexadecimal.
    pub bits: Option<String>,
    /// Shows it again.
    pub command: Option<String>,
    /// Why it is expected, as the expectation says.
    pub why: Option<String>,
    /// Where more is to be read.
    pub url: Option<String>,
}

impl Deviation {
    /// How many wrong answers there are more than known; all of them where no number is known.
    pub fn more_than_known(&self) -> u64 {
        let known = self.expected_count.unwrap_or_default();
        self.found.count.saturating_sub(known)
    }

    /// The key of the class that deviates.
    pub fn key(&self) -> Key {
        Key {
            kernel: self.kernel.clone(),
            set: self.set.clone(),
            scalar: self.scalar,
            family: self.family.clone(),
            class: self.class,
            finding: self.finding,
        }
    }

    /// `key: 3 of 1,000, expected none`.
    pub fn describe(&self) -> String {
        format!(
            "{}: {}, expected {}",
            self.key(),
            self.found.counts(),
            self.expected
        )
    }
}

impl Conformance {
    /// How many disagreements are known, as the expectations of this plan have them.
    pub fn expected(&self) -> u64 {
        let is_known = |found: &&Deviation| found.line.is_some();
        let deviations = self
            .unexpected
            .iter()
            .chain(&self.stale)
            .filter(is_known)
            .count();
        (self.known.len() + deviations) as u64
    }

    /// How many findings the known disagreements have together; empty where there are none.
    pub fn findings(&self) -> String {
        match self.known.iter().map(|known| known.found.count).sum() {
            0 => String::new(),
            count => format!(
                " of {} (a disagreement is a kind of wrong answer in a family and a class)",
                number_of(count, "known finding", "known findings")
            ),
        }
    }

    /// Adds demands on proofs that are not met.
    pub fn demand(&mut self, unproved: Vec<Unproved>) {
        if !unproved.is_empty() {
            self.verdict = ComparisonVerdict::Disagreements;
        }
        self.unproved = unproved;
    }

    /// Sets aside what is not compared, because answers differ from run to run.
    pub fn set_aside(&mut self, unsteady: Vec<Deviation>) {
        if !unsteady.is_empty() && self.verdict != ComparisonVerdict::Disagreements {
            self.verdict = ComparisonVerdict::Unsteady;
        }
        self.unsteady = unsteady;
    }

    /// True if something got worse: more cases are wrong, or right hits have larger errors.
    pub fn is_worse(&self) -> bool {
        self.change.is_worse() || 0 < self.worse_errors()
    }

    fn worse_errors(&self) -> usize {
        self.errors.iter().filter(|change| change.is_worse).count()
    }

    /// Adds errors of right hits that differ from those of the blessed run.
    pub fn add_errors(&mut self, errors: Vec<ErrorChange>) {
        self.errors = errors;
        if 0 < self.worse_errors() {
            self.verdict = ComparisonVerdict::Disagreements;
        } else if !self.errors.is_empty() && self.verdict == ComparisonVerdict::Conforms {
            self.verdict = ComparisonVerdict::Stale;
        }
    }

    /// One line.
    pub fn summary(&self) -> String {
        let count = |list: &[Deviation], one, many| number_of(list.len() as u64, one, many);
        let verdict = match self.verdict {
            ComparisonVerdict::Conforms => "conforms",
            ComparisonVerdict::Disagreements => "does not conform",
            ComparisonVerdict::Unsteady => "cannot be compared",
            ComparisonVerdict::Stale => "better than expected: the expectations are stale",
        };
        let NetChange {
            worse,
            new,
            other_cases,
            ..
        } = self.change;
        let how = [
            (worse, "worse"),
            (new, "new"),
            (other_cases, "of other cases"),
        ];
        let how = how.iter().filter(|(count, _)| 0 < *count);
        let how = how.map(|(count, how)| format!("{} {how}", group_digits(*count)));
        let how = match how.collect::<Vec<_>>().join(", ") {
            how if how.is_empty() => how,
            how => format!(" ({how})"),
        };
        let proofs = match self.unproved.len() {
            0 => String::new(),
            1 => "1 proof missing, ".to_owned(),
            n => format!("{n} proofs missing, "),
        };
        let errors = match self.worse_errors() {
            0 => String::new(),
            n => format!(
                "{}, ",
                number_of(n as u64, "larger error of hits", "larger errors of hits")
            ),
        };
        let unsteady = match self.unsteady.len() {
            0 => String::new(),
            n => {
                let rows = number_of(n as u64, "kernel row", "kernel rows");
                format!("answers of {rows} differ from run to run, ")
            }
        };
        format!(
            "{verdict}: {proofs}{unsteady}{errors}{}{how}, {}, {}{}",
            count(
                &self.unexpected,
                "unexpected disagreement",
                "unexpected disagreements"
            ),
            count(&self.stale, "stale expectation", "stale expectations"),
            match self.expected() {
                all if all == self.known.len() as u64 => {
                    count(&self.known, "known disagreement", "known disagreements")
                }
                all => format!(
                    "{} of {} unchanged",
                    group_digits(self.known.len() as u64),
                    number_of(all, "known disagreement", "known disagreements"),
                ),
            },
            self.findings()
        )
    }
}

//! The parts of a comparison beside the classes that deviate: settings, formulas, errors of hits, proofs and a short case.

use crate::arith::ScalarName;
use crate::class::FindingClass;
use crate::kind::FindingKind;
use crate::number::group_digits;
use std::fmt;

/// A setting of a kernel row that is not what the expectations are of.
#[apply(part!)]
#[derive(PartialEq, Eq)]
pub struct RowChange {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// `epsilon NAME`, `epsilons` if they have another name, or `contract`, its band included.
    pub what: String,
    /// As it was.
    pub before: String,
    /// As it is.
    pub now: String,
}

impl fmt::Display for RowChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RowChange {
            kernel,
            set,
            what,
            before,
            now,
        } = self;
        let is = if what == "epsilons" { "are" } else { "is" };
        let none = "nothing of it";
        let [now, before] = [
            apart(now, before, ", ", none),
            apart(before, now, ", ", none),
        ];
        write!(
            f,
            "{kernel} ({set}): its {what} {is} now {now}; blessed with {before}"
        )
    }
}

/// The parts of a list that another list does not have; other words if there is none.
pub fn apart(list: &str, other: &str, between: &str, none: &str) -> String {
    let others: Vec<&str> = other.split(between).collect();
    let parts: Vec<&str> = list
        .split(between)
        .filter(|part| !others.contains(part))
        .collect();
    let parts = parts.join(between);
    if parts.is_empty() {
        none.to_owned()
    } else {
        parts
    }
}

/// A quantile of the errors of right hits that is not the one of the blessed run.
#[apply(part!)]
pub struct ErrorChange {
    /// Which quantile of which value, of which row in which scalar.
    pub what: String,
    /// As it was.
    pub before: String,
    /// As it is.
    pub now: String,
    /// True if it is larger.
    pub is_worse: bool,
}

impl fmt::Display for ErrorChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ErrorChange {
            what, before, now, ..
        } = self;
        write!(f, "{what} {now}; blessed with {before}")
    }
}

/// A built-in formula that a kernel of one's own computes, as its answers show, but for an epsilon or for fused products.
#[apply(part!)]
pub struct ComputedFormula {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The name of the built-in kernel, in plain arithmetic.
    pub formula: String,
    /// True if its products are fused into sums.
    pub is_fused: bool,
    /// The epsilon that is another: `parallel between 9.8e-5 and 1.04e-4 in place of 1e-6`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub epsilon: Option<String>,
    /// How many hits of both have the same values, bit for bit.
    pub same: u64,
    /// All hits of both.
    pub hits: u64,
}

impl fmt::Display for ComputedFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fused = if self.is_fused {
            " with fused products"
        } else {
            ""
        };
        let epsilon = match &self.epsilon {
            Some(epsilon) => format!(" with {epsilon}"),
            None => String::new(),
        };
        let [same, hits] = [self.same, self.hits].map(group_digits);
        write!(
            f,
            "it computes {}{fused}{epsilon}: {same} of {hits} hits have its bits",
            self.formula
        )
    }
}

/// A case that shows a finding which got worse, in few digits.
#[apply(part!)]
pub struct ShortCase {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// The source of the case that was shortened.
    pub family: String,
    /// The class of the truth.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub class: FindingClass,
    /// The kind of finding.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub finding: FindingKind,
    /// The built-in formula that is right on it, if the kernel computes that one otherwise: with fused products, or with
    /// another epsilon.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub right: Option<String>,
    /// Its bit patterns in hexadecimal.
    pub bits: String,
    /// Shows it.
    pub command: String,
}

/// A demand on a proof that is not met.
#[apply(part!)]
pub struct Unproved {
    /// The kernel's name.
    pub kernel: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// The gate, or `watertight`.
    pub gate: String,
    /// The demand: a bound in units of u, or `true`.
    pub demanded: String,
    /// The reason why the demand is not met.
    pub why: String,
    /// Shows what is proved.
    pub command: String,
}

impl Unproved {
    /// In place of a row: a proof is of every epsilon.
    pub fn row(&self) -> String {
        format!("{} (any epsilon)", self.kernel)
    }

    /// In place of a family.
    pub const FAMILY: &str = "proof";
}

impl fmt::Display for Unproved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Unproved {
            kernel,
            scalar,
            gate,
            demanded,
            why,
            ..
        } = self;
        match gate.as_str() {
            WATERTIGHT => write!(f, "{kernel} {scalar} must be proved watertight: {why}"),
            _ => {
                write!(
                    f,
                    "{kernel} {scalar} {gate} must be proved to at most {demanded} u: {why}"
                )
            }
        }
    }
}

/// In place of a gate, in a demand.
pub const WATERTIGHT: &str = "watertight";

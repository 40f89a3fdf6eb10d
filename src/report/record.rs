//! The versioned record from which every format is made.
//!
//! `result` holds integers, and floats recomputed from integers: it is the same bytes whatever the
//! number of threads. `provenance` says where and how it was made and is never compared.

use super::conformance::Conformance;
use super::illustration::Illustrations;
pub use super::rate::Rate;
use super::shard::{PartialPart, ShardPart};
use crate::audit::Trials;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The schema's name and version.
pub const SCHEMA: &str = "hairline-record/1";

/// Everything that a run found.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// [`SCHEMA`].
    pub schema: String,
    /// What was found.
    pub result: ResultPart,
    /// What `merge` needs; only of a part of a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<ShardPart>,
    /// How that compares with what was expected; only of `check`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conformance: Option<Conformance>,
    /// What pictures are drawn from; only where they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub illustrations: Option<Illustrations>,
    /// Where and how it was made.
    pub provenance: Provenance,
}

/// What was found.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ResultPart {
    /// What was asked.
    pub plan: PlanPart,
    /// Which parts of it were run, if not all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub partial: Option<PartialPart>,
    /// The sources of cases, by scalar.
    pub sources: Vec<SourcePart>,
    /// One entry for each scalar, source and kernel row.
    pub results: Vec<KernelResult>,
    /// One entry for each scalar and kernel row: distributions over all sources.
    pub totals: Vec<RowTotal>,
}

impl ResultPart {
    /// The results by kernel, epsilon set, scalar and family.
    pub(crate) fn by_place(&self) -> BTreeMap<[&str; 4], &KernelResult> {
        let results = self.results.iter();
        results
            .map(|part| ([part.kernel.as_str(), &part.set, &part.scalar, &part.family], part))
            .collect()
    }
}

/// Distributions of one kernel row in one scalar, over all sources.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RowTotal {
    /// `f32` or `f64`.
    pub scalar: String,
    /// The kernel's name.
    pub kernel: String,
    /// What its epsilons are called.
    pub set: String,
    /// By `false-miss` and `false-hit`: how far from where the verdict would be right.
    pub severity: BTreeMap<String, SeverityDistribution>,
    /// Errors of right hits in ulps, of a sample of the indices: by `t`, `uv` and `point` (o + t·d).
    pub accuracy: BTreeMap<String, Distribution>,
}

/// What was asked.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlanPart {
    /// SHA-256 of the other fields' JSON, the first 16 hexadecimal digits.
    pub hash: String,
    /// Kernels with epsilons.
    pub rows: Vec<RowPart>,
    /// Sources, each by the id of its set.
    pub sources: Vec<PlannedSource>,
    /// `f32`, `f64`.
    pub scalars: Vec<String>,
}

/// A kernel with its epsilons.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RowPart {
    /// The kernel's name.
    pub kernel: String,
    /// The flag that chooses it on a command line.
    pub selector: String,
    /// What its epsilons are called.
    pub set: String,
    /// By gate; gates that take none are left out.
    pub epsilons: BTreeMap<String, String>,
    /// The contract it is judged by, as people read it.
    pub contract: String,
    /// The same as `--contract` takes it, where it is not the kernel's own.
    #[serde(default = "own", skip_serializing_if = "is_own")]
    pub contract_words: String,
}

fn own() -> String {
    "own".to_owned()
}

fn is_own(words: &String) -> bool {
    words == "own"
}

/// A source of cases as planned.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedSource {
    /// The name in tables.
    pub family: String,
    /// `family@version`, parameters and seed as in case ids.
    pub set: String,
    /// How many indices.
    pub count: u64,
}

/// What a source gave in one scalar.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SourcePart {
    /// `f32` or `f64`.
    pub scalar: String,
    /// The name in tables.
    pub family: String,
    /// Whether its rates are of a random sample.
    pub sample: bool,
    /// Whether its parameters leave its family's promise standing.
    pub promises: bool,
    /// Indices made.
    pub indices: u64,
    /// Cases in them.
    pub cases: u64,
    /// Indices that break the family's promise.
    pub promise_broken: u64,
    /// The id of the first of them.
    pub first_broken: Option<String>,
}

/// One kernel row on one source in one scalar.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct KernelResult {
    /// `f32` or `f64`.
    pub scalar: String,
    /// The kernel's name.
    pub kernel: String,
    /// What its epsilons are called.
    pub set: String,
    /// The source's name in tables.
    pub family: String,
    /// All classes together.
    pub total: Counts,
    /// Each class that occurred.
    pub classes: BTreeMap<String, Counts>,
    /// Each class of finding that occurred, with examples.
    pub findings: Vec<FindingPart>,
    /// By `false-miss` and `false-hit`: how far from where the verdict would be right.
    pub severity: BTreeMap<String, SeverityDistribution>,
    /// Errors of right hits in ulps, of a sample of the indices: by `t`, `uv` and `point` (o + t·d).
    pub accuracy: BTreeMap<String, Distribution>,
    /// Triangles of a group together.
    pub across: Option<AcrossPart>,
    /// Polygons as a whole.
    pub polygons: Option<PolygonPart>,
    /// Second hits on the triangle that a ray starts on.
    pub self_hits: Option<Rate>,
}

/// Counts and rates of findings.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Cases.
    pub cases: u64,
    /// Cases on which the contract asks nothing.
    pub free: u64,
    /// Hits that the kernel reported.
    pub hits: u64,
    /// Of the cases that must be hit, and have a verdict.
    pub false_misses: Rate,
    /// Of the cases that must be missed, and have a verdict.
    pub false_hits: Rate,
    /// Of the hits that are not false.
    pub bad_values: Rate,
    /// Cases at which the kernel panicked.
    pub panics: u64,
    /// Cases at which the kernel's process died, or wrote outside its output.
    pub crashes: u64,
    /// Cases on which the kernel's process gave no answer in time.
    pub timeouts: u64,
}

impl Counts {
    /// How often a finding of a name occurred, or could have; without an interval if it is a failure.
    pub(crate) fn rate(&self, finding: &str) -> Option<Rate> {
        let failures = |count| Some(Rate::new(Trials::independent(count, self.cases), false));
        match finding {
            "false-miss" => Some(self.false_misses.clone()),
            "false-hit" => Some(self.false_hits.clone()),
            "bad-value" => Some(self.bad_values.clone()),
            "panic" => failures(self.panics),
            "crash" => failures(self.crashes),
            "timeout" => failures(self.timeouts),
            _ => None,
        }
    }
}

/// One finding in one class.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FindingPart {
    /// `false-miss`, `false-hit`, `bad-value`, `panic`, `crash`, `timeout`.
    pub finding: String,
    /// The class of the truth.
    pub class: String,
    /// How often.
    pub rate: Rate,
    /// Why; none where nothing was attributed.
    pub causes: Option<CausesPart>,
    /// Of the set of all its cases, whatever their order.
    pub digest: String,
    /// The one with the largest severity.
    pub worst: Example,
    /// The first by index.
    pub first: Vec<Example>,
}

/// Why findings happened, of the first by index.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CausesPart {
    /// By `convention`, `epsilon`, `rounding`, `range`; with an interval if not all findings were
    /// examined.
    pub by: BTreeMap<String, Rate>,
    /// Findings examined of kernels that cannot tell.
    pub untold: u64,
}

/// How far cases with a finding are from where the verdict would be right.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SeverityDistribution {
    /// In longest edges of the triangle.
    pub edges: Distribution,
    /// In ulps of the largest coordinate.
    pub ulps: Distribution,
}

/// Counted numbers. Quantiles are rounded up by at most an eighth; an infinite one is left out.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Distribution {
    /// How many.
    pub count: u64,
    /// Half of them are at most this.
    pub median: Option<f64>,
    /// 90 % of them.
    pub percent_90: Option<f64>,
    /// 99 % of them.
    pub percent_99: Option<f64>,
    /// All of them.
    pub worst: Option<f64>,
    /// Counts by octave: `2^k` is from 2^k to 2^(k+1); `0` holds what is smaller than any normal
    /// number, `inf` the infinite.
    pub octaves: BTreeMap<String, u64>,
}

/// A case that shows a finding.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Example {
    /// The id or the name.
    pub case: String,
    /// Origin, direction, a, b, c, interval: bit patterns in hexadecimal.
    pub bits: String,
    /// Distances; of the worst only, and none of invalid input.
    pub severity: Option<SeverityPart>,
    /// Shows the case again.
    pub command: String,
}

/// How badly the verdict was wrong. Lengths are in units of the triangle's longest edge.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SeverityPart {
    /// In the plane, from where the line meets it to the triangle's boundary.
    pub in_plane: Option<f64>,
    /// In space, from the line to the boundary.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(test, schemars(with = "Option<f64>"))]
    pub in_space: f64,
    /// The longest edge in ulps of the largest coordinate: a distance times it is in ulps.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(test, schemars(with = "Option<f64>"))]
    pub edge_in_ulps: f64,
    /// |t - end|·|d| to the nearest finite end of the extent.
    pub along: Option<f64>,
}

/// A number beyond the range of an f64 is written as null, since JSON has no infinity.
fn or_infinite<'de, D: serde::Deserializer<'de>>(number: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(number)?.unwrap_or(f64::INFINITY))
}

/// What the triangles of groups did together.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct AcrossPart {
    /// What the contract promises: `nothing`, `at-least-one`, `exactly-one`.
    pub promised: String,
    /// Crossings without a hit.
    pub cracks: Rate,
    /// Crossings with two hits or more.
    pub doubles: Rate,
    /// Folds whose number of hits has the wrong parity.
    pub odd_folds: Rate,
    /// Folds without a hit where the exact line has two.
    pub missed_folds: Rate,
    /// Ids of the first cracks.
    pub first_cracks: Vec<String>,
    /// Ids of the first doubles.
    pub first_doubles: Vec<String>,
    /// Of the set of all cracks.
    pub crack_digest: String,
    /// Ids of the first folds of wrong parity.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first_odd_folds: Vec<String>,
    /// Of the set of all doubles.
    pub double_digest: String,
    /// Of the set of all folds of wrong parity.
    #[serde(default)]
    pub odd_fold_digest: String,
    /// Crossings on a mesh without a hit, which a neighbour may have: no cracks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elsewhere: Option<Rate>,
    /// The flag that names the file from which an id makes its group, as `--mesh 'model.obj'`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

/// What a kernel that takes polygons did with whole ones.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PolygonPart {
    /// Of the polygons that must be hit, and have a verdict.
    pub false_misses: Rate,
    /// Of the polygons that must be missed, and have a verdict.
    pub false_hits: Rate,
    /// Of the set of all false misses.
    pub false_miss_digest: String,
    /// Of the set of all false hits.
    pub false_hit_digest: String,
    /// Ids of the first false misses.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first_false_misses: Vec<String>,
    /// Ids of the first false hits.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first_false_hits: Vec<String>,
    /// Polygons with a bad value, and those without a verdict.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<PolygonFinding>,
}

/// A finding on whole polygons.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PolygonFinding {
    /// `bad-value`, `panic`, `crash`, `timeout`.
    pub finding: String,
    /// How often.
    pub rate: Rate,
    /// Of the set of all its polygons.
    pub digest: String,
    /// Ids of the first.
    pub first: Vec<String>,
}

/// Where and how a record was made.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
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
    pub oracle_nanoseconds: BTreeMap<String, f64>,
    /// By scalar: how often each layer of the oracle decided.
    pub oracle_layers: BTreeMap<String, BTreeMap<String, u64>>,
    /// By scalar and row label: nanoseconds a ray in the kernel.
    pub kernel_nanoseconds: BTreeMap<String, BTreeMap<String, f64>>,
    /// The flags of `hairline audit` that make the plan again, where a command line made it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan_flags: Option<PlanFlags>,
    /// Of the parts that were merged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Provenance>,
}

/// The flags that make a plan again, as a shell takes them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlanFlags {
    /// Those that choose kernels, epsilons and the contract.
    pub kernels: String,
    /// Those that choose cases.
    pub sources: String,
}

impl PlanFlags {
    /// The command that runs some kernels on the plan's cases.
    pub fn command(&self, kernels: &str) -> String {
        let words = ["hairline audit", kernels, &self.sources];
        words.into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join(" ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_infinite_severity_is_read_back() {
        let part = SeverityPart {
            in_plane: None,
            in_space: f64::INFINITY,
            edge_in_ulps: f64::INFINITY,
            along: Some(1.5),
        };
        let text = serde_json::to_string(&part).unwrap();
        let again: SeverityPart = serde_json::from_str(&text).unwrap();
        assert_eq!((again.in_space, again.edge_in_ulps), (f64::INFINITY, f64::INFINITY), "{text}");
        assert_eq!(again.along, Some(1.5));
    }
}

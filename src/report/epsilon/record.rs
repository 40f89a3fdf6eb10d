//! The versioned record of an epsilon study.

use crate::report::record::{PlannedSource, Rate};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The schema's name and version.
pub const EPSILON_SCHEMA: &str = "hairline-epsilon/1";

/// Everything that a study found.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct EpsilonRecord {
    /// [`EPSILON_SCHEMA`].
    pub schema: String,
    /// The findings: the same bytes whatever the number of threads.
    pub result: EpsilonResult,
    /// Where and how it was made.
    pub provenance: EpsilonProvenance,
}

/// The findings of a study.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct EpsilonResult {
    /// The sources of cases.
    pub sources: Vec<PlannedSource>,
    /// One entry for each kernel, scalar and gate.
    pub gates: Vec<GatePart>,
}

/// Where and how a record was made.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct EpsilonProvenance {
    /// `hairline 0.1.0`.
    pub tool: String,
    /// `x86_64-linux`.
    pub target: String,
    /// Threads used.
    pub threads: usize,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// One epsilon of one kernel in one scalar. Epsilons are shortest decimals of the scalar.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GatePart {
    /// The kernel's name.
    pub kernel: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// The gate's name.
    pub gate: String,
    /// The refusal in the source's notation, with `e` for the epsilon.
    pub refuses: String,
    /// The margin's powers of length and of |d|.
    pub dimension: [i8; 2],
    /// The epsilons of the other gates.
    pub others: BTreeMap<String, String>,
    /// The contract, in words.
    pub contract: String,
    /// True if every margin was kept, so that the points are all that ever changes.
    pub exact: bool,
    /// Epsilons with names.
    pub marks: Vec<MarkPart>,
    /// All sources together, then each.
    pub curves: Vec<CurvePart>,
    /// The false misses and the false hits between which an epsilon trades.
    pub trade: TradePart,
    /// The prices of epsilons, found by running the kernel with them.
    pub prices: Vec<PricePart>,
    /// The proof about this gate's epsilons, whatever the cases.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proved: Option<String>,
}

/// An epsilon with a name.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MarkPart {
    /// A preset's name, or the row's own.
    pub name: String,
    /// The epsilon.
    pub epsilon: String,
}

/// The response on one source.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CurvePart {
    /// The source's name in tables, or `all`.
    pub family: String,
    /// True if it is a random sample.
    pub sample: bool,
    /// How many could be wrong, by [`crate::epsilon::Question::ALL`]: false misses, false hits,
    /// cracks, doubles, self-hits, and of the false hits those that this gate is there to refuse.
    pub asked: [u64; 6],
    /// Sums over the rays of the squares of how many could be wrong on each.
    pub asked_squared: [u64; 6],
    /// How many are wrong, in order of the epsilon; constant before the first and after the last. What
    /// lies between two points lies between their counts.
    pub points: Vec<(String, [u64; 6])>,
}

/// The false misses and the false hits between which an epsilon trades.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TradePart {
    /// The lowest epsilon that the gate takes.
    pub floor: String,
    /// False misses: a lower epsilon repairs them.
    pub misses: LimitPart,
    /// False hits that this gate is there to refuse, self-hits with them for a gate on t: a higher
    /// epsilon repairs them.
    pub hits: LimitPart,
    /// The epsilons that are best for both, from and to.
    pub settled: Option<[String; 2]>,
    /// The number of cases that must be hit and that another gate refuses, whatever this epsilon.
    pub refused_by_others: BTreeMap<String, u64>,
}

/// The epsilons that are best for one count.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LimitPart {
    /// How many could be wrong.
    pub of: u64,
    /// The fewest that any epsilon reaches.
    pub unavoidable: u64,
    /// The last epsilon that reaches it, for misses; the first, for hits.
    pub limit: String,
    /// Shows the case that decides the limit; none if every epsilon reaches it.
    pub command: Option<String>,
}

/// The price of one epsilon.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PricePart {
    /// The epsilon.
    pub epsilon: String,
    /// Who uses it.
    pub names: Vec<String>,
    /// True if no other listed epsilon loses and lets through as little, and less of one.
    pub on_front: bool,
    /// Among the cases that must be hit, the share that this gate alone refuses.
    pub lost: Rate,
    /// Among the cases that this gate is there to refuse, the share that is hit.
    pub let_through: Rate,
    /// Among the cases that must be hit, the share that is missed.
    pub false_misses: Rate,
    /// Among the cases that must be missed, the share that is hit.
    pub false_hits: Rate,
    /// Groups without a hit.
    pub cracks: Rate,
    /// Groups with two hits or more.
    pub doubles: Rate,
    /// The sources on which it is wrong.
    pub families: Vec<FamilyPrice>,
    /// The false hit of this gate's kinds that is farthest outside.
    pub farthest: Option<FarthestPart>,
}

/// The price of one epsilon on one source.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FamilyPrice {
    /// The source's name in tables.
    pub family: String,
    /// Among the cases that must be hit, the share that this gate alone refuses.
    pub lost: Rate,
    /// Among the cases that this gate is there to refuse, the share that is hit.
    pub let_through: Rate,
}

/// A false hit and how far outside it is.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FarthestPart {
    /// From the line to the triangle's boundary, or along the ray from the end, in longest edges.
    pub edges: f64,
    /// The same in ulps of the largest coordinate.
    pub ulps: f64,
    /// Shows the case.
    pub command: String,
}

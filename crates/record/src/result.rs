//! The findings of an audit: counts of each kernel row on each source in each scalar.

use crate::arith::ScalarName;
use crate::audit::Trials;
use crate::class::FindingClass;
use crate::finding::{
    AcrossPart, Distribution, FindingPart, PolygonPart, RelationPart, SeverityDistribution,
};
use crate::kind::FindingKind;
use crate::mesh::MeshPart;
use crate::part::PartialPart;
use crate::plan::{PlanPart, RowPart};
use crate::rate::Rate;
use std::collections::BTreeMap;

/// The findings of a run.
#[apply(part!)]
pub struct ResultPart {
    /// The plan of the run.
    pub plan: PlanPart,
    /// Which parts of it were run, if not all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub partial: Option<PartialPart>,
    /// The sources of cases, by scalar.
    pub sources: Vec<SourcePart>,
    /// The mesh, if all cases are at its edges and vertices.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshPart>,
    /// One entry for each scalar, source and kernel row.
    pub results: Vec<KernelResult>,
    /// One entry for each scalar and kernel row: distributions over all sources.
    pub totals: Vec<RowTotal>,
}

impl ResultPart {
    /// True if triangles are put into the world by a matrix.
    pub fn is_placed(&self) -> bool {
        let mut sources = self.plan.sources.iter();
        let is_place = |word: &str| word.starts_with("instance=");
        sources.any(|source| source.set.split(['/', ',']).any(is_place))
    }

    /// The results by kernel, epsilon set, scalar and family.
    pub fn by_place(&self) -> BTreeMap<[&str; 4], &KernelResult> {
        self.results
            .iter()
            .map(|part| (part.place(), part))
            .collect()
    }
}

/// Distributions of one kernel row in one scalar, over all sources.
#[apply(part!)]
pub struct RowTotal {
    /// The scalar.
    pub scalar: ScalarName,
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// By `false-miss` and `false-hit`: how far from where the verdict would be right; by `wrong-value`: how far
    /// the point is off.
    #[cfg_attr(
        feature = "schema",
        schemars(with = "BTreeMap<String, SeverityDistribution>")
    )]
    pub severity: BTreeMap<FindingKind, SeverityDistribution>,
    /// Errors of right hits in ulps, of a sample of the indices: by `t`, `uv` and `point` (o + t·d).
    pub accuracy: BTreeMap<String, Distribution>,
    /// The relations that explain the wrong answers of a kernel of one's own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub relations: Vec<RelationPart>,
}

/// The summary of a source in one scalar.
#[apply(part!)]
pub struct SourcePart {
    /// The scalar.
    pub scalar: ScalarName,
    /// The name in tables.
    pub family: String,
    /// True if its rates are of a random sample.
    pub sample: bool,
    /// True if its parameters leave its family's promise standing.
    pub promises: bool,
    /// Indices made.
    pub indices: u64,
    /// Cases in them.
    pub cases: u64,
    /// Indices that break the family's promise.
    pub promise_broken: u64,
    /// The id of the first of them.
    pub first_broken: Option<String>,
    /// Polygons of a mesh's file that are not in the mesh, because they cross themselves or fold over.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left_out: Option<u64>,
}

/// One kernel row on one source in one scalar.
#[apply(part!)]
pub struct KernelResult {
    /// The scalar.
    pub scalar: ScalarName,
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The source's name in tables.
    pub family: String,
    /// All classes together.
    pub total: Counts,
    /// Each class that occurred.
    #[cfg_attr(feature = "schema", schemars(with = "BTreeMap<String, Counts>"))]
    pub classes: BTreeMap<FindingClass, Counts>,
    /// Each class of finding that occurred, with examples.
    pub findings: Vec<FindingPart>,
    /// By `false-miss` and `false-hit`: how far from where the verdict would be right; by `wrong-value`: how far
    /// the point is off.
    #[cfg_attr(
        feature = "schema",
        schemars(with = "BTreeMap<String, SeverityDistribution>")
    )]
    pub severity: BTreeMap<FindingKind, SeverityDistribution>,
    /// Errors of right hits in ulps, of a sample of the indices: by `t`, `uv` and `point` (o + t·d).
    pub accuracy: BTreeMap<String, Distribution>,
    /// Triangles of a group together.
    pub across: Option<AcrossPart>,
    /// Polygons as a whole.
    pub polygons: Option<PolygonPart>,
    /// Second hits on the triangle that a ray starts on.
    pub self_hits: Option<Rate>,
}

impl KernelResult {
    /// The kernel, its epsilons, the scalar and the family.
    pub fn place(&self) -> [&str; 4] {
        [&self.kernel, &self.set, self.scalar.name(), &self.family]
    }

    /// The command that shows one of its groups of triangles again by its id, on a kernel row.
    pub fn explain_group(&self, row: &RowPart, id: &str) -> String {
        let command = row.explain_command(id);
        let across = self.across.as_ref();
        match across.and_then(|across| across.file.as_deref()) {
            Some(file) => format!("{command} {file}"),
            None => command,
        }
    }
}

/// Counts and rates of findings.
#[apply(part!)]
pub struct Counts {
    /// Cases.
    pub cases: u64,
    /// Cases on which the contract asks nothing.
    pub free: u64,
    /// Hits that the kernel reported.
    pub hits: u64,
    /// Among the cases that must be hit and have a verdict, the share that is missed.
    pub false_misses: Rate,
    /// Among the cases that must be missed and have a verdict, the share that is hit.
    pub false_hits: Rate,
    /// Among the hits that are not false, the share with values that are not finite, or with a wrong facing.
    pub bad_values: Rate,
    /// Among the hits that are not false, the share with t, u or v farther from its exact value than rounding could
    /// carry it.
    pub wrong_values: Rate,
    /// Cases at which the kernel panicked.
    pub panics: u64,
    /// Cases at which the kernel's process died, or wrote outside its output.
    pub crashes: u64,
    /// Cases on which the kernel's process gave no answer in time.
    pub timeouts: u64,
}

impl Counts {
    /// How often a finding of a single triangle occurred, or could have; without an interval if it is a failure.
    pub fn rate(&self, kind: FindingKind) -> Option<Rate> {
        let failures = |count| Some(Rate::new(Trials::independent(count, self.cases), false));
        match kind {
            FindingKind::FalseMiss => Some(self.false_misses.clone()),
            FindingKind::FalseHit => Some(self.false_hits.clone()),
            FindingKind::BadValue => Some(self.bad_values.clone()),
            FindingKind::WrongValue => Some(self.wrong_values.clone()),
            FindingKind::Panic => failures(self.panics),
            FindingKind::Crash => failures(self.crashes),
            FindingKind::Timeout => failures(self.timeouts),
            _ => None,
        }
    }
}

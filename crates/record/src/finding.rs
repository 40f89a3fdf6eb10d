//! Findings: how often, why, how bad, and cases that show them.

use crate::audit::{Attribution, Octave};
use crate::class::FindingClass;
use crate::judge::Relation;
use crate::kind::{FindingKind, Promised};
use crate::rate::Rate;
use std::collections::BTreeMap;

/// One finding in one class.
#[apply(part!)]
pub struct FindingPart {
    /// `false-miss`, `false-hit`, `bad-value`, `wrong-value`, `panic`, `crash`, `timeout`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub finding: FindingKind,
    /// The class of the truth.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub class: FindingClass,
    /// How often.
    pub rate: Rate,
    /// Why; none where nothing was attributed.
    pub causes: Option<CausesPart>,
    /// The digest of the set of all its cases, whatever their order: a sum, a colon, and a sketch, which shows
    /// cases that only one of two sets has.
    pub digest: String,
    /// The one with the largest severity.
    pub worst: Example,
    /// The first by index.
    pub first: Vec<Example>,
}

/// Why findings happened, of the first by index.
#[apply(part!)]
pub struct CausesPart {
    /// By `convention`, `epsilon`, `rounding`, `range`, `transform` in instances, and `not-epsilon` of kernels that do
    /// not show their formula; with an interval if not all findings were examined.
    #[cfg_attr(feature = "schema", schemars(with = "BTreeMap<String, Rate>"))]
    pub by: BTreeMap<Attribution, Rate>,
    /// Findings examined of kernels that cannot tell.
    pub untold: u64,
    /// The cause of the worst finding, whichever the others have.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    pub worst: Option<Attribution>,
}

/// How far cases with a finding are from where the verdict would be right.
#[apply(part!)]
pub struct SeverityDistribution {
    /// In longest edges of the triangle.
    pub edges: Distribution,
    /// In ulps of the largest coordinate.
    pub ulps: Distribution,
}

/// Counted numbers. Quantiles are rounded up by at most an eighth; an infinite one is left out.
#[apply(part!)]
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
    #[cfg_attr(feature = "schema", schemars(with = "BTreeMap<String, u64>"))]
    pub octaves: BTreeMap<Octave, u64>,
}

/// A simple relation between the wrong answers of a kernel of one's own and the exact values.
#[apply(part!)]
pub struct RelationPart {
    /// `t-twice`, `u-v-exchanged`, `t-min-ignored`, ….
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub relation: Relation,
    /// The cases on which it holds.
    pub count: u64,
    /// All cases that could show it.
    pub of: u64,
}

/// A case that shows a finding.
#[apply(part!)]
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
#[apply(part!)]
pub struct SeverityPart {
    /// In the plane, from where the line meets it to the triangle's boundary.
    pub in_plane: Option<f64>,
    /// In space, from the line to the boundary.
    #[serde(deserialize_with = "crate::number::or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub in_space: f64,
    /// The longest edge in ulps of the largest coordinate: a distance times it is in ulps.
    #[serde(deserialize_with = "crate::number::or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub edge_in_ulps: f64,
    /// |t - end|·|d| to the nearest finite end of the extent.
    pub along: Option<f64>,
    /// How far the point of a hit with a wrong value is off: along the ray by t, or in the plane by u or v.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_off: Option<f64>,
    /// `before` or `beyond`, if t is not in the extent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub off_end: Option<String>,
}

/// The outcomes of groups of triangles.
#[apply(part!)]
pub struct AcrossPart {
    /// The contract's promise: `nothing`, `at-least-one`, `exactly-one`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub promised: Promised,
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
    /// The digest of all cracks.
    pub crack_digest: String,
    /// Ids of the first folds of wrong parity.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first_odd_folds: Vec<String>,
    /// The digest of all doubles.
    pub double_digest: String,
    /// The digest of all folds of wrong parity.
    pub odd_fold_digest: String,
    /// Crossings on a mesh without a hit, which a neighbour may have: no cracks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elsewhere: Option<Rate>,
    /// Ids of the first of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first_elsewhere: Vec<String>,
    /// How many edges, or vertices, of a mesh leak.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leaking: Option<LeakingPart>,
    /// At a mesh, by class of ray: `exact`, `exact-grazing`, `near`, `near-grazing`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub classes: BTreeMap<String, AcrossPart>,
    /// The flag that names the file from which an id makes its group, as `--mesh 'model.obj'`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

/// How many edges, or vertices, of a mesh some ray found a crack at.
#[apply(part!)]
pub struct LeakingPart {
    /// Those with a crack.
    pub count: u64,
    /// All that rays were aimed at.
    pub of: u64,
}

/// The results on whole polygons of a kernel that takes them.
#[apply(part!)]
pub struct PolygonPart {
    /// Among the polygons that must be hit and have a verdict, the share that is missed.
    pub false_misses: Rate,
    /// Among the polygons that must be missed and have a verdict, the share that is hit.
    pub false_hits: Rate,
    /// The digest of all false misses.
    pub false_miss_digest: String,
    /// The digest of all false hits.
    pub false_hit_digest: String,
    /// Ids of the first false misses.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first_false_misses: Vec<String>,
    /// Ids of the first false hits.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first_false_hits: Vec<String>,
    /// Polygons with a bad or wrong value, and those without a verdict.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<PolygonFinding>,
}

/// A finding on whole polygons.
#[apply(part!)]
pub struct PolygonFinding {
    /// `bad-value`, `wrong-value`, `panic`, `crash`, `timeout`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub finding: FindingKind,
    /// How often.
    pub rate: Rate,
    /// The digest of all its polygons.
    pub digest: String,
    /// Ids of the first.
    pub first: Vec<String>,
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
            value_off: None,
            off_end: None,
        };
        let text = serde_json::to_string(&part).unwrap();
        let again: SeverityPart = serde_json::from_str(&text).unwrap();
        assert_eq!(
            (again.in_space, again.edge_in_ulps),
            (f64::INFINITY, f64::INFINITY),
            "{text}"
        );
        assert_eq!(again.along, Some(1.5));
    }
}

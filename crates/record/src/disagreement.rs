//! A record's findings as one list: what expectations name and formats count by.

use crate::class::FindingClass;
use crate::family::{self, Question};
use crate::finding::Example;
use crate::judge::Finding;
use crate::key::Key;
use crate::kind::{FindingKind, Promised};
use crate::plan::RowPart;
use crate::rate::Rate;
use crate::result::{KernelResult, ResultPart};
use hairline_cases::mesh::AimedPart;
use std::collections::BTreeMap;

/// One class of disagreement that occurred.
#[derive(Clone, Debug)]
pub struct Disagreement<'a> {
    /// The class of disagreement.
    pub key: Key,
    /// How often.
    pub rate: &'a Rate,
    /// The digest of the set of its cases.
    pub digest: &'a str,
    /// The worst case, or the first where there is no worst.
    pub example: Option<Example>,
}

impl Disagreement<'_> {
    /// True if it is about single cases, not about groups or polygons.
    pub fn is_of_cases(&self) -> bool {
        self.key.class.truth().is_some()
    }
}

/// Every disagreement of a record that a contract does not allow, in the order of the record.
pub fn disagreements(result: &ResultPart) -> Vec<Disagreement<'_>> {
    let rows: BTreeMap<(&str, &str), &RowPart> = result
        .plan
        .rows
        .iter()
        .map(|row| ((row.kernel.as_str(), row.set.as_str()), row))
        .collect();
    let mut all = Vec::new();
    for part in &result.results {
        let findings = part
            .findings
            .iter()
            .filter(|found| counts_alone(part, found.finding));
        all.extend(findings.map(|finding| Disagreement {
            key: Key::of(part, finding.class, finding.finding),
            rate: &finding.rate,
            digest: &finding.digest,
            example: Some(finding.worst.clone()),
        }));
        let row = rows.get(&(part.kernel.as_str(), part.set.as_str()));
        for found in together(part) {
            let first = row.zip(found.first.first());
            all.push(Disagreement {
                key: Key::of(part, found.class, found.kind),
                rate: found.rate,
                digest: found.digest,
                example: first.map(|(row, id)| group_example(row, part, id)),
            });
        }
    }
    all.retain(|disagreement| disagreement.rate.count > 0);
    all
}

/// A finding on triangles together: on a group of them, or on a whole polygon.
#[derive(Clone, Copy)]
pub struct GroupFinding<'a> {
    /// Its subject: a group, or a polygon.
    pub class: FindingClass,
    /// The kind of finding.
    pub kind: FindingKind,
    /// How often.
    pub rate: &'a Rate,
    /// The digest of the set of its groups.
    pub digest: &'a str,
    /// The ids of the first.
    pub first: &'a [String],
}

/// True if a finding of a result counts for single triangles. At the shared edges and vertices of a scene or a
/// mesh a neighbour may take the ray: there only a ray that none of them takes is wrong.
pub fn counts_alone(part: &KernelResult, kind: FindingKind) -> bool {
    !(is_at_shared(&part.family) && kind.is_wrong_verdict())
}

/// The findings on groups and on whole polygons.
fn together(part: &KernelResult) -> impl Iterator<Item = GroupFinding<'_>> {
    across(part).into_iter().chain(polygons(part))
}

/// The counts of all that the contract rules out across triangles. Cracks of a scene and of a mesh count even where
/// nothing is promised.
pub fn across(part: &KernelResult) -> Vec<GroupFinding<'_>> {
    let (Some(across), Some(cracks)) = (&part.across, cracks(part)) else {
        return Vec::new();
    };
    if across.promised == Promised::Nothing && is_at_shared(&part.family) {
        return vec![cracks];
    }
    let doubles = GroupFinding {
        class: FindingClass::Group,
        kind: FindingKind::Double,
        rate: &across.doubles,
        digest: &across.double_digest,
        first: &across.first_doubles,
    };
    let folds = GroupFinding {
        class: FindingClass::Group,
        kind: FindingKind::OddFold,
        rate: &across.odd_folds,
        digest: &across.odd_fold_digest,
        first: &across.first_odd_folds,
    };
    let is_ruled_out = across.promised.rules_out();
    let all = [cracks, doubles, folds].into_iter().zip(is_ruled_out);
    all.filter_map(|(found, counts)| counts.then_some(found))
        .collect()
}

/// The count of cracks, whatever is promised.
pub fn cracks(part: &KernelResult) -> Option<GroupFinding<'_>> {
    let across = part.across.as_ref()?;
    Some(GroupFinding {
        class: FindingClass::Group,
        kind: FindingKind::Crack,
        rate: &across.cracks,
        digest: &across.crack_digest,
        first: &across.first_cracks,
    })
}

/// The findings on whole polygons.
pub fn polygons(part: &KernelResult) -> Vec<GroupFinding<'_>> {
    let Some(part) = &part.polygons else {
        return Vec::new();
    };
    let misses = GroupFinding {
        class: FindingClass::Polygon,
        kind: FindingKind::PolygonFalseMiss,
        rate: &part.false_misses,
        digest: &part.false_miss_digest,
        first: &part.first_false_misses,
    };
    let hits = GroupFinding {
        class: FindingClass::Polygon,
        kind: FindingKind::PolygonFalseHit,
        rate: &part.false_hits,
        digest: &part.false_hit_digest,
        first: &part.first_false_hits,
    };
    let mut all = vec![misses, hits];
    all.extend(part.others.iter().map(|found| GroupFinding {
        class: FindingClass::Polygon,
        kind: found.finding,
        rate: &found.rate,
        digest: &found.digest,
        first: &found.first,
    }));
    all
}

/// How often a finding of a class occurred in a result, or could have: nought if it did not.
pub fn rate_of(part: &KernelResult, class: FindingClass, finding: FindingKind) -> Rate {
    let of_all = class == FindingClass::Any;
    let mut rates: Vec<Rate> = together(part)
        .filter(|found| found.kind == finding && (of_all || found.class == class))
        .map(|found| found.rate.clone())
        .collect();
    let counts = if of_all {
        Some(&part.total)
    } else {
        part.classes.get(&class)
    };
    if counts_alone(part, finding) {
        rates.extend(counts.and_then(|counts| counts.rate(finding)));
    }
    if of_all {
        Rate::sum(&rates)
    } else {
        rates.into_iter().next().unwrap_or_default()
    }
}

/// The kinds of finding that a result could show.
pub fn kinds_of(part: &KernelResult) -> Vec<FindingKind> {
    let kinds = Finding::ALL.into_iter().map(FindingKind::from);
    let mut kinds: Vec<FindingKind> = kinds.filter(|kind| counts_alone(part, *kind)).collect();
    kinds.extend(together(part).map(|found| found.kind));
    kinds
}

impl RowPart {
    /// `kernel (set)`.
    pub fn label(&self) -> String {
        format!("{} ({})", self.kernel, self.set)
    }
}

/// A group by its id: its bits are those of several triangles, and are left to the command.
fn group_example(row: &RowPart, result: &KernelResult, id: &str) -> Example {
    Example {
        case: id.to_owned(),
        bits: String::new(),
        severity: None,
        command: result.explain_group(row, id),
    }
}

/// True if a source aims at the shared edges or vertices of a scene or a mesh.
pub fn is_at_shared(family: &str) -> bool {
    let part = family.split(':').next().unwrap_or_default();
    AimedPart::named(part).is_some()
        || family_of(family).is_some_and(|family| {
            family.name.starts_with("scene-")
                && matches!(family.question, Question::Edges | Question::Vertices)
        })
}

/// The family of a source by its name, in which a mesh's file may follow.
pub fn family_of(source: &str) -> Option<&'static family::Family> {
    family::find(source.split_once(':').map_or(source, |(family, _)| family))
}

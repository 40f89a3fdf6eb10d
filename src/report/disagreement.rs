//! A record's findings as one list: what expectations name and formats count by.

use super::record::*;
use crate::family::{self, Question};
use crate::judge::Finding;
use crate::mesh::AimedPart;
use std::collections::BTreeMap;

/// Names a class of disagreement of a kernel row on a family in a scalar.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// The source's name in tables.
    pub family: String,
    /// The class of the truth; `group` for triangles together, `polygon` for whole polygons.
    pub class: String,
    /// The kind of finding.
    pub finding: FindingKind,
}

/// In place of a class: all of them together.
pub const ALL_CLASSES: &str = "any class";

impl Key {
    /// The key of a finding of a result.
    pub fn of(result: &KernelResult, class: &str, finding: FindingKind) -> Key {
        Key {
            kernel: result.kernel.clone(),
            set: result.set.clone(),
            scalar: result.scalar.clone(),
            family: result.family.clone(),
            class: class.to_owned(),
            finding,
        }
    }

    /// The same finding, of all classes together.
    pub fn of_all_classes(&self) -> Key {
        Key {
            class: ALL_CLASSES.to_owned(),
            ..self.clone()
        }
    }

    /// True if it is of the same kernel row in the same scalar.
    pub fn is_of_row(&self, other: &Key) -> bool {
        self.place()[..3] == other.place()[..3]
    }

    /// The kernel, its epsilons, the scalar and the family.
    pub fn place(&self) -> [&str; 4] {
        [&self.kernel, &self.set, &self.scalar, &self.family]
    }

    /// `kernel (set)`.
    pub fn row(&self) -> String {
        format!("{} ({})", self.kernel, self.set)
    }
}

impl std::fmt::Display for Key {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Key {
            scalar,
            family,
            class,
            finding,
            ..
        } = self;
        write!(f, "{} {scalar} {family}: {finding} of {class}", self.row())
    }
}

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
        !matches!(self.key.class.as_str(), "group" | "polygon")
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
            key: Key::of(part, &finding.class, finding.finding),
            rate: &finding.rate,
            digest: &finding.digest,
            example: Some(finding.worst.clone()),
        }));
        let row = rows.get(&(part.kernel.as_str(), part.set.as_str()));
        for (class, (finding, rate, digest, first)) in together(part) {
            let example = row
                .zip(first.first())
                .map(|(row, id)| group_example(row, part, id));
            let key = Key::of(part, class, finding);
            all.push(Disagreement {
                key,
                rate,
                digest,
                example,
            });
        }
    }
    all.retain(|disagreement| disagreement.rate.count > 0);
    all
}

/// A finding on groups or polygons: its kind, how often, of the set of all, ids of the first.
pub(super) type GroupFinding<'a> = (FindingKind, &'a Rate, &'a str, &'a [String]);

/// True if a finding of a result counts for single triangles. At the shared edges and vertices of a scene or a
/// mesh a neighbour may take the ray: there only a ray that none of them takes is wrong.
pub(crate) fn counts_alone(part: &KernelResult, kind: FindingKind) -> bool {
    !(is_at_shared(&part.family) && kind.is_wrong_verdict())
}

/// The findings on groups and on whole polygons, each with its class.
fn together(part: &KernelResult) -> impl Iterator<Item = (&'static str, GroupFinding<'_>)> {
    let groups = across(part).into_iter().map(|found| ("group", found));
    groups.chain(polygons(part).into_iter().map(|found| ("polygon", found)))
}

/// The counts of all that the contract rules out across triangles. Cracks of a scene and of a mesh count even where
/// nothing is promised.
pub(super) fn across(part: &KernelResult) -> Vec<GroupFinding<'_>> {
    let (Some(across), Some(cracks)) = (&part.across, cracks(part)) else {
        return Vec::new();
    };
    let doubles: GroupFinding = (
        FindingKind::Double,
        &across.doubles,
        &across.double_digest,
        across.first_doubles.as_slice(),
    );
    let folds: GroupFinding = (
        FindingKind::OddFold,
        &across.odd_folds,
        &across.odd_fold_digest,
        &across.first_odd_folds,
    );
    match across.promised {
        Promised::Nothing if is_at_shared(&part.family) => vec![cracks],
        promised => {
            let all = promised
                .rules_out()
                .into_iter()
                .zip([cracks, doubles, folds]);
            all.filter(|(is_ruled_out, _)| *is_ruled_out)
                .map(|(_, found)| found)
                .collect()
        }
    }
}

/// The count of cracks, whatever is promised.
pub(super) fn cracks(part: &KernelResult) -> Option<GroupFinding<'_>> {
    let across = part.across.as_ref()?;
    Some((
        FindingKind::Crack,
        &across.cracks,
        &across.crack_digest,
        &across.first_cracks,
    ))
}

/// The findings on whole polygons.
pub(super) fn polygons(part: &KernelResult) -> Vec<GroupFinding<'_>> {
    let Some(part) = &part.polygons else {
        return Vec::new();
    };
    let others = part.others.iter();
    let others = others
        .map(|found| -> GroupFinding { (found.finding, &found.rate, &found.digest, &found.first) });
    let misses: GroupFinding = (
        FindingKind::PolygonFalseMiss,
        &part.false_misses,
        &part.false_miss_digest,
        &part.first_false_misses,
    );
    let hits: GroupFinding = (
        FindingKind::PolygonFalseHit,
        &part.false_hits,
        &part.false_hit_digest,
        &part.first_false_hits,
    );
    [misses, hits].into_iter().chain(others).collect()
}

/// How often a finding of a class occurred in a result, or could have: nought if it did not.
pub fn rate_of(part: &KernelResult, class: &str, finding: FindingKind) -> Rate {
    let of_all = class == ALL_CLASSES;
    let together = together(part)
        .filter(|(of, (kind, ..))| (of_all || *of == class) && *kind == finding)
        .map(|(_, (_, rate, ..))| rate.clone());
    let counts = if of_all {
        Some(&part.total)
    } else {
        part.classes.get(class)
    };
    let alone = counts
        .filter(|_| counts_alone(part, finding))
        .and_then(|it| it.rate(finding));
    let mut rates = together.chain(alone);
    match of_all {
        true => Rate::sum(&rates.collect::<Vec<_>>()),
        false => rates.next().unwrap_or_default(),
    }
}

/// The kinds of finding that a result could show.
pub(super) fn kinds_of(part: &KernelResult) -> Vec<FindingKind> {
    let kinds = Finding::ALL.into_iter().map(FindingKind::from);
    let mut kinds: Vec<FindingKind> = kinds.filter(|kind| counts_alone(part, *kind)).collect();
    kinds.extend(together(part).map(|(_, (kind, ..))| kind));
    kinds
}

impl RowPart {
    /// `kernel (set)`.
    pub(crate) fn label(&self) -> String {
        format!("{} ({})", self.kernel, self.set)
    }
}

/// A group by its id: its bits are those of several triangles, and are left to the command.
fn group_example(row: &RowPart, result: &KernelResult, id: &str) -> Example {
    Example {
        case: id.to_owned(),
        bits: String::new(),
        severity: None,
        command: row.explain_group(result, id),
    }
}

/// True if a source aims at the shared edges or vertices of a scene or a mesh.
pub(super) fn is_at_shared(family: &str) -> bool {
    let part = family.split(':').next().unwrap_or_default();
    AimedPart::named(part).is_some()
        || family_of(family).is_some_and(|family| {
            family.name.starts_with("scene-")
                && matches!(family.question, Question::Edges | Question::Vertices)
        })
}

/// The family of a source by its name, in which a mesh's file may follow.
pub(super) fn family_of(source: &str) -> Option<&'static family::Family> {
    family::find(source.split_once(':').map_or(source, |(family, _)| family))
}

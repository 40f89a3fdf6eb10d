//! The parts of a record that are distributions: causes, severities, errors of values.

use crate::arith::ScalarName;
use crate::audit::{
    Accuracy, Attribution, Audit, Causes, Histogram, Plan, Related, Relations, Severities,
};
use crate::finding::{CausesPart, Distribution, RelationPart, SeverityDistribution};
use crate::judge::Finding;
use crate::kind::FindingKind;
use crate::rate::Rate;
use crate::result::RowTotal;
use std::collections::BTreeMap;

/// The causes of the findings of one class.
pub fn causes(causes: &Causes, found: u64) -> CausesPart {
    let share = |why: Attribution| {
        let trials = causes.of(why);
        let sample = trials.of + causes.untold < found;
        (why, Rate::new(trials, sample))
    };
    // Only of kernels that do not show their formula, and of instances.
    let is_rare = |why| matches!(why, Attribution::NotEpsilon | Attribution::Transform);
    let is_told = |why: &Attribution| !is_rare(*why) || 0 < causes.of(*why).count;
    let told = Attribution::ALL.into_iter().filter(is_told);
    CausesPart {
        by: told.map(share).collect(),
        untold: causes.untold,
        worst: causes.worst,
    }
}

/// By finding.
pub fn severities(
    severities: &BTreeMap<Finding, Severities>,
) -> BTreeMap<FindingKind, SeverityDistribution> {
    let part = |severities: &Severities| SeverityDistribution {
        edges: distribution(&severities.edges),
        ulps: distribution(&severities.ulps),
    };
    severities
        .iter()
        .map(|(finding, of)| ((*finding).into(), part(of)))
        .collect()
}

/// By the value's name; those that the kernel does not give are left out.
pub fn accuracy(accuracy: &Accuracy) -> BTreeMap<String, Distribution> {
    let parts = [
        ("t", &accuracy.t),
        ("uv", &accuracy.uv),
        ("point", &accuracy.point),
    ];
    let counted = parts
        .into_iter()
        .filter(|(_, histogram)| histogram.count() > 0);
    counted
        .map(|(name, histogram)| (name.to_owned(), distribution(histogram)))
        .collect()
}

fn distribution(histogram: &Histogram) -> Distribution {
    let finite = |value: f64| value.is_finite().then_some(value);
    Distribution {
        count: histogram.count(),
        median: finite(histogram.quantile(0.5)),
        percent_90: finite(histogram.quantile(0.9)),
        percent_99: finite(histogram.quantile(0.99)),
        worst: finite(histogram.largest()),
        octaves: histogram.octaves(),
    }
}

/// The distributions of each row in each scalar, over all sources.
pub fn totals(plan: &Plan, audit: &Audit) -> Vec<RowTotal> {
    let mut totals = Vec::new();
    for scalar in ScalarName::among(plan.scalars) {
        for (number, row) in plan.rows.iter().enumerate() {
            let mut all: BTreeMap<Finding, Severities> = BTreeMap::new();
            let mut values = Accuracy::default();
            let mut related = Relations::default();
            for cell in &audit.cells {
                if (cell.scalar, cell.row) == (scalar, number) {
                    values.merge(&cell.tally.accuracy);
                    related.merge(&cell.tally.relations);
                    for (finding, more) in &cell.tally.severities {
                        all.entry(*finding).or_default().merge(more);
                    }
                }
            }
            totals.push(RowTotal {
                scalar,
                kernel: row.entry.info.name.to_owned(),
                set: row.set.clone(),
                severity: severities(&all),
                accuracy: accuracy(&values),
                relations: relations(&related),
            });
        }
    }
    totals
}

fn relations(relations: &Relations) -> Vec<RelationPart> {
    let part = |Related {
                    relation,
                    count,
                    of,
                }| RelationPart {
        relation,
        count,
        of,
    };
    relations.known().into_iter().map(part).collect()
}

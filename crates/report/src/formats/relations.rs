//! The sentences about the mistakes of a kernel that a simple relation explains.

use crate::audit::Related;
use crate::judge::{Class, Part, Relation};
use hairline_record::*;
use std::collections::BTreeMap;

/// The sentences about each row of which a relation is known, the scalars together: `mine (own): t is twice the exact t on
/// all 707,378 hits with a wrong t`.
pub(super) fn sentences(record: &Record) -> Vec<String> {
    sentences_about(record, |_, _| true)
}

/// The sentences about mistakes of which a check's unexpected findings may come. The others are known with their findings.
pub(super) fn new_sentences(record: &Record, conformance: &Conformance) -> Vec<String> {
    sentences_about(record, |row, related| is_new(conformance, row, related))
}

fn sentences_about(record: &Record, is_told: impl Fn(&RowPart, &Related) -> bool) -> Vec<String> {
    let mut sentences = Vec::new();
    for row in &record.result.plan.rows {
        let told = known(record, row).into_iter().filter(|it| is_told(row, it));
        let told: Vec<String> = told.map(|related| related.to_string()).collect();
        if !told.is_empty() {
            sentences.push(format!("{}: {}", row.label(), told.join("; ")));
        }
    }
    sentences
}

/// Each of these mistakes in few words, without counts: `mine: t is twice the exact t`.
pub(super) fn new_mistakes(record: &Record, conformance: &Conformance) -> Vec<String> {
    let mut mistakes = Vec::new();
    for row in &record.result.plan.rows {
        let known = known(record, row).into_iter();
        let new = known.filter(|related| is_new(conformance, row, related));
        mistakes.extend(new.map(|related| format!("{}: {}", row.kernel, related.relation.about())));
    }
    mistakes
}

/// True if a row's unexpected findings may come of a mistake: nothing is known, or of those that it makes there are as many more
/// than known as half of its cases.
fn is_new(conformance: &Conformance, row: &RowPart, related: &Related) -> bool {
    if conformance.expectations.is_none() {
        return true;
    }
    let of_row = |found: &&Deviation| (&found.kernel, &found.set) == (&row.kernel, &row.set);
    let unexpected = conformance.unexpected.iter().filter(of_row);
    let made = unexpected.filter(|found| makes(related.relation, found));
    let more: u64 = made.map(Deviation::more_than_known).sum();
    related.count <= 2 * more
}

/// True if a mistake makes such findings.
fn makes(relation: Relation, found: &Deviation) -> bool {
    // By families there are no classes.
    let is_of_class = |is: fn(Class) -> bool| found.class.truth().is_none_or(is);
    match (relation.part(), found.finding) {
        (
            Part::T | Part::Weights | Part::Values,
            FindingKind::WrongValue | FindingKind::BadValue,
        ) => true,
        (Part::Start | Part::End, FindingKind::FalseHit) => is_of_class(Class::is_off_the_interval),
        (Part::Start, FindingKind::FalseMiss) => true,
        (Part::Miss, FindingKind::FalseHit | FindingKind::BadValue) => true,
        _ => false,
    }
}

/// The relations of a row, its scalars together.
fn known(record: &Record, row: &RowPart) -> Vec<Related> {
    let totals = record.result.totals.iter();
    let of_row = totals.filter(|total| (&total.kernel, &total.set) == (&row.kernel, &row.set));
    let mut sums: BTreeMap<_, Related> = BTreeMap::new();
    for RelationPart {
        relation,
        count,
        of,
    } in of_row.flat_map(|total| &total.relations)
    {
        let none = Related {
            relation: *relation,
            count: 0,
            of: 0,
        };
        let sum = sums.entry(*relation).or_insert(none);
        sum.count += count;
        sum.of += of;
    }
    sums.into_values().collect()
}

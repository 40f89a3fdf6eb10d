//! The sentences about the mistakes of a kernel that a simple relation explains.

use crate::audit::Related;
use hairline_record::*;
use std::collections::BTreeMap;

/// The sentences about each row of which a relation is known, the scalars together: `mine (own): t is twice the exact t on
/// all 707,378 hits with a wrong t`.
pub(super) fn sentences(record: &Record) -> Vec<String> {
    let rows = record.result.plan.rows.iter();
    let of_row = |row: &RowPart| {
        let known: Vec<String> = known(record, row).iter().map(Related::to_string).collect();
        (!known.is_empty()).then(|| format!("{}: {}", row.label(), known.join("; ")))
    };
    rows.filter_map(of_row).collect()
}

/// Each mistake in few words, without counts: `mine: t is twice the exact t`.
pub(super) fn mistakes(record: &Record) -> Vec<String> {
    let mut mistakes = Vec::new();
    for row in &record.result.plan.rows {
        let known = known(record, row).into_iter();
        mistakes
            .extend(known.map(|related| format!("{}: {}", row.kernel, related.relation.about())));
    }
    mistakes
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

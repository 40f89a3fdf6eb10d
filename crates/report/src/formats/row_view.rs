//! A record by kernel row, as the text walks through it.

use super::pool::Pool;
use crate::arith::ScalarName;
use crate::judge::Class;
use hairline_record::counts_alone;
use hairline_record::group_digits;
use hairline_record::*;
use std::collections::HashMap;

/// Input that has no meaning.
const INVALID: FindingClass = FindingClass::Truth(Class::INVALID);

/// A rate of a result, if it has it.
type Get = fn(&KernelResult) -> Option<&Rate>;

/// Everything that is counted of a row, by its name.
pub(super) const COUNTED: [(&str, Get); 11] = [
    ("false misses", |r| {
        counts_alone(r, FindingKind::FalseMiss).then_some(&r.total.false_misses)
    }),
    ("false hits", |r| {
        counts_alone(r, FindingKind::FalseHit).then_some(&r.total.false_hits)
    }),
    ("bad values", |r| Some(&r.total.bad_values)),
    ("wrong values", |r| Some(&r.total.wrong_values)),
    ("cracks", |r| Some(&r.across.as_ref()?.cracks)),
    ("doubles", |r| Some(&r.across.as_ref()?.doubles)),
    ("wrong at folds", |r| Some(&r.across.as_ref()?.odd_folds)),
    ("missed folds", |r| Some(&r.across.as_ref()?.missed_folds)),
    ("polygon false misses", |r| {
        Some(&r.polygons.as_ref()?.false_misses)
    }),
    ("polygon false hits", |r| {
        Some(&r.polygons.as_ref()?.false_hits)
    }),
    ("self-hits", |r| r.self_hits.as_ref()),
];

/// One of the rates of a count.
pub(super) type RateOf = fn(&Counts) -> &Rate;

/// The wrong verdicts on single triangles.
pub(super) const WRONG: [(FindingKind, RateOf); 2] = [
    (FindingKind::FalseMiss, |total| &total.false_misses),
    (FindingKind::FalseHit, |total| &total.false_hits),
];

/// All families of one kernel row in one scalar.
pub(super) struct RowView<'a> {
    pub(super) part: &'a RowPart,
    pub(super) scalar: ScalarName,
    pub(super) total: Option<&'a RowTotal>,
    pub(super) results: Vec<&'a KernelResult>,
    pub(super) sources: &'a [SourcePart],
}

impl<'a> RowView<'a> {
    /// Every row of a record in a scalar.
    pub(super) fn all(record: &'a Record, scalar: ScalarName) -> Vec<RowView<'a>> {
        let ResultPart {
            plan,
            sources,
            results,
            totals,
            ..
        } = &record.result;
        let mut by_row: HashMap<[&str; 2], Vec<&KernelResult>> = HashMap::new();
        for result in results.iter().filter(|result| result.scalar == scalar) {
            by_row
                .entry([&result.kernel, &result.set])
                .or_default()
                .push(result);
        }
        let totals = totals.iter().filter(|total| total.scalar == scalar);
        let totals: HashMap<[&str; 2], &RowTotal> = totals
            .map(|total| ([&*total.kernel, &*total.set], total))
            .collect();
        // A kernel of one scalar has nothing to say in the other.
        let view = |part: &'a RowPart| {
            let key = [&*part.kernel, &*part.set];
            let (total, results) = (totals.get(&key).copied(), by_row.get(&key)?.clone());
            Some(RowView {
                part,
                scalar,
                total,
                results,
                sources,
            })
        };
        plan.rows.iter().filter_map(view).collect()
    }

    /// The sum of a rate over the sources.
    pub(super) fn total(&self, rate: impl Fn(&KernelResult) -> Option<&Rate>) -> Pool {
        Pool::of(self.results.iter().filter_map(|result| rate(result)))
    }

    /// Hits on NaN, infinities, zero directions and impossible intervals.
    pub(super) fn hits_on_invalid(&self) -> u64 {
        self.results
            .iter()
            .filter_map(|result| result.classes.get(&INVALID))
            .map(|c| c.hits)
            .sum()
    }
}

/// The remark on a scalar without a valid case.
pub(super) const ALL_INVALID: &str =
    "All are invalid: a number is infinite or NaN, or the direction is zero.";

/// True if all cases of rows are invalid.
pub(super) fn is_all_invalid(rows: &[RowView], cases: u64) -> bool {
    rows.first().is_some_and(|row| {
        let invalid = row
            .results
            .iter()
            .filter_map(|result| result.classes.get(&INVALID));
        invalid.map(|counts| counts.cases).sum::<u64>() == cases
    })
}

/// The kernels that gave no verdict on some cases, a sentence each.
pub(super) fn failures(rows: &[&RowView]) -> Vec<String> {
    let failures = |row: &&RowView| {
        let sum = |count: fn(&Counts) -> u64| -> u64 {
            row.results.iter().map(|result| count(&result.total)).sum()
        };
        let counts = [
            ("panics", sum(|counts| counts.panics)),
            ("crashes", sum(|counts| counts.crashes)),
            ("timeouts", sum(|counts| counts.timeouts)),
        ];
        let words = counts.iter().filter(|(_, count)| *count > 0);
        let words: Vec<String> = words
            .map(|(what, count)| format!("{} {what}", group_digits(*count)))
            .collect();
        let cases = group_digits(sum(|counts| counts.cases));
        (!words.is_empty()).then(|| {
            format!(
                "{}: {} in {cases} cases",
                row.part.label(),
                words.join(", ")
            )
        })
    };
    rows.iter().filter_map(failures).collect()
}

/// The rays of a record in a scalar: a case is a ray and one of its triangles.
pub(super) fn rays_in(record: &Record, scalar: ScalarName) -> u64 {
    let sources = record
        .result
        .sources
        .iter()
        .filter(|source| source.scalar == scalar);
    sources.map(|source| source.indices).sum()
}

/// The cases of a record in a scalar.
pub(super) fn cases_in(record: &Record, scalar: ScalarName) -> u64 {
    let sources = record
        .result
        .sources
        .iter()
        .filter(|source| source.scalar == scalar);
    sources.map(|source| source.cases).sum()
}

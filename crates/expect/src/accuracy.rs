//! The errors of right hits in two records: a kernel whose values get worse may be right as often as before.

use super::LockedTarget;
use super::trend::{OtherValue, Trend};
use hairline_record::{Distribution, ErrorChange, ResultPart, RowTotal};
use std::collections::BTreeMap;

/// Quantiles that differ by less than this factor are the same: they are rounded up by at most an eighth.
const SAME_CASES: f64 = 1.25;

/// The same for other cases, of which a sample differs by chance too.
const OTHER_CASES: f64 = 2.0;

/// Two samples with numbers of hits that differ by more than this share are of other cases.
const SAME_HITS: f64 = 0.1;

/// Errors of more ulps than this are told by their first digits.
const LARGE: f64 = 1000.0;

/// Errors of at most this many ulps are those of one rounding.
const ROUNDED: f64 = 0.5;

/// The values whose errors are compared, with their names.
const VALUES: [(&str, &str); 3] = [("t", "t"), ("uv", "u and v"), ("point", "o + t d")];

/// A quantile of a distribution, infinite if it has none.
type Quantile = fn(&Distribution) -> f64;

/// The quantiles that are compared, with the share of hits within them.
const QUANTILES: [(&str, Quantile); 2] = [
    ("half", |errors| errors.median.unwrap_or(f64::INFINITY)),
    ("99 %", |errors| errors.percent_99.unwrap_or(f64::INFINITY)),
];

/// The quantiles of errors that differ, of the rows that both records measured.
pub(super) fn accuracy_changes(
    old: &ResultPart,
    new: &ResultPart,
    same_cases: bool,
) -> Vec<OtherValue> {
    let mut changes = Vec::new();
    for before in &old.totals {
        let Some(now) = new.totals.iter().find(|now| is_same_row(before, now)) else {
            continue;
        };
        for (value, name) in VALUES {
            let errors = before.accuracy.get(value).zip(now.accuracy.get(value));
            let Some((old, new)) = errors else { continue };
            let is_same_sample = same_cases && are_alike(old.count, new.count);
            let factor = if is_same_sample {
                SAME_CASES
            } else {
                OTHER_CASES
            };
            for (share, quantile) in QUANTILES {
                let [old, new] = [quantile(old), quantile(new)];
                changes.extend(trend(old, new, factor).map(|trend| OtherValue {
                    what: format!(
                        "{} ({}) {}: {share} of the right hits have a {name} within",
                        before.kernel, before.set, before.scalar
                    ),
                    change: Some(trend),
                    old: ulps(old),
                    new: ulps(new),
                }));
            }
        }
    }
    changes
}

/// The errors of the hits of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitErrors {
    /// How many hits.
    pub hits: u64,
    /// Within how many ulps half and 99 % of them are.
    pub quantiles: [f64; 2],
}

/// Errors by kernel, epsilons, scalar and value.
pub(super) type LockedErrors = BTreeMap<[String; 4], HitErrors>;

/// True if samples have nearly as many hits.
fn are_alike(one: u64, other: u64) -> bool {
    one.abs_diff(other) as f64 <= SAME_HITS * one.max(other) as f64
}

/// The quantiles of a run.
pub(super) fn errors_of(result: &ResultPart) -> LockedErrors {
    let of_row = |row: &RowTotal| {
        let key = |value: &String| {
            [
                row.kernel.clone(),
                row.set.clone(),
                row.scalar.to_string(),
                value.clone(),
            ]
        };
        let errors = |errors: &Distribution| HitErrors {
            hits: errors.count,
            quantiles: QUANTILES.map(|(_, quantile)| quantile(errors)),
        };
        let all = row
            .accuracy
            .iter()
            .map(|(value, of)| (key(value), errors(of)));
        all.collect::<Vec<_>>()
    };
    result.totals.iter().flat_map(of_row).collect()
}

/// The quantiles of a run that are not those of a blessed run on the same cases.
pub(super) fn error_changes(result: &ResultPart, known: &LockedTarget) -> Vec<ErrorChange> {
    let mut changes = Vec::new();
    for (key, now) in errors_of(result) {
        let before = known
            .errors
            .get(&key)
            .filter(|it| are_alike(it.hits, now.hits));
        let Some(before) = before.map(|it| it.quantiles) else {
            continue;
        };
        let now = now.quantiles;
        let [kernel, set, scalar, value] = &key;
        let named = VALUES.iter().find(|(word, _)| word == value);
        let name = named.map_or(value.as_str(), |(_, name)| *name);
        for (i, (share, _)) in QUANTILES.iter().enumerate() {
            changes.extend(
                trend(before[i], now[i], SAME_CASES).map(|trend| ErrorChange {
                    what: format!(
                        "{kernel} ({set}) {scalar}: {share} of the right hits have a {name} within"
                    ),
                    before: ulps(before[i]),
                    now: ulps(now[i]),
                    is_worse: trend == Trend::Worse,
                }),
            );
        }
    }
    changes
}

fn is_same_row(one: &RowTotal, other: &RowTotal) -> bool {
    (&one.kernel, &one.set, one.scalar) == (&other.kernel, &other.set, other.scalar)
}

/// The trend of an error; none if it is the same.
fn trend(old: f64, new: f64, factor: f64) -> Option<Trend> {
    if old.max(new) <= ROUNDED {
        None
    } else if factor * old < new {
        Some(Trend::Worse)
    } else if factor * new < old {
        Some(Trend::Better)
    } else {
        None
    }
}

/// An error with three digits after the point, or three in all where it is large.
fn ulps(error: f64) -> String {
    if error < LARGE {
        format!("{error:.3} ulps")
    } else {
        format!("{error:.2e} ulps")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_differs_by_more_than_its_rounding_and_beyond_one_rounding() {
        for (old, new, expected) in [
            (0.5, 4.0, Some(Trend::Worse)),
            (4.0, 0.5, Some(Trend::Better)),
            (1.0, 1.2, None),
            (0.1, 0.5, None),
            (0.0, 0.51, Some(Trend::Worse)),
            (3.0, f64::INFINITY, Some(Trend::Worse)),
            (f64::INFINITY, f64::INFINITY, None),
        ] {
            assert_eq!(trend(old, new, SAME_CASES), expected, "{old} {new}");
        }
        assert_eq!(trend(1.0, 1.9, OTHER_CASES), None);
    }
}

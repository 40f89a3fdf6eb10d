//! The order in which unexpected disagreements are told: the worst first.

use super::{Amount, Entry};
use crate::report::{Deviation, Rate};
use std::cmp::Ordering;

/// How much harm a disagreement does beyond what is expected.
pub(super) struct Harm {
    /// Whether cases have no verdict at all.
    is_failure: bool,
    /// How many more cases show it than expected, of as many.
    more: f64,
}

impl Harm {
    /// Of a finding with so many cases, on the cases of the expectation or on others.
    pub fn of(finding: &str, entry: Option<&Entry>, found: &Rate, same_cases: bool) -> Harm {
        let (count, of) = (found.count as f64, found.of as f64);
        let expected = match entry.map(|entry| &entry.amount) {
            None => 0.0,
            Some(Amount::Rate(bound)) => bound * of,
            Some(Amount::Count { count, cases: Some((of_expected, _)) }) if !same_cases => {
                *count as f64 / (*of_expected).max(1) as f64 * of
            }
            Some(Amount::Count { count, .. }) => *count as f64,
        };
        let is_failure = matches!(finding, "panic" | "crash" | "timeout");
        Harm { is_failure, more: count - expected }
    }

    fn compare(&self, other: &Harm) -> Ordering {
        let by_kind = self.is_failure.cmp(&other.is_failure);
        by_kind.then(self.more.total_cmp(&other.more))
    }
}

/// The deviations alone, the worst first: cases without a verdict, then what has the most cases more than expected;
/// as many on other cases come last. Those that are alike stay in their order.
pub(super) fn worst_first(mut list: Vec<(Harm, Deviation)>) -> Vec<Deviation> {
    list.sort_by(|(a, _), (b, _)| b.compare(a));
    list.into_iter().map(|(_, deviation)| deviation).collect()
}

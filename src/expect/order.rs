//! The order in which unexpected disagreements are told: the worst first.

use super::{Amount, Entry};
use crate::report::{Deviation, FindingKind, Rate};
use std::cmp::Ordering;

/// How much harm a disagreement does beyond what is expected.
pub(super) struct Harm {
    /// True if cases have no verdict at all.
    is_failure: bool,
    /// How many more cases show it than expected, of as many.
    more: f64,
}

impl Harm {
    /// The harm of a finding with so many cases, on the cases of the expectation or on others.
    pub fn of(finding: FindingKind, entry: Option<&Entry>, found: &Rate, same_cases: bool) -> Harm {
        let (count, of) = (found.count as f64, found.of as f64);
        let expected = match entry.map(|entry| &entry.amount) {
            None => 0.0,
            Some(Amount::Rate(bound)) => bound * of,
            Some(Amount::Count { count, cases: Some((of_expected, _)) }) if !same_cases => {
                *count as f64 / (*of_expected).max(1) as f64 * of
            }
            Some(Amount::Count { count, .. }) => *count as f64,
        };
        Harm { is_failure: finding.is_failure(), more: count - expected }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Trials;

    fn harm(finding: FindingKind, amount: Option<Amount>, found: u64, same_cases: bool) -> Harm {
        let entry = amount.map(|amount| Entry { line: 1, amount, why: None, url: None });
        let found = Rate::new(Trials::independent(found, 200), true);
        Harm::of(finding, entry.as_ref(), &found, same_cases)
    }

    #[test]
    fn harm_is_what_is_found_beyond_what_is_expected_of_as_many() {
        let more = |amount, same_cases| harm(FindingKind::FalseHit, amount, 30, same_cases).more;
        let ten = |of: Option<u64>| {
            Some(Amount::Count { count: 10, cases: of.map(|of| (of, String::new())) })
        };
        assert_eq!([true, false].map(|same| more(None, same)), [30.0; 2]);
        assert_eq!(more(Some(Amount::Rate(0.125)), true), 5.0);
        // Ten of 100 are twenty of 200.
        assert_eq!([true, false].map(|same| more(ten(Some(100)), same)), [20.0, 10.0]);
        assert_eq!(more(ten(None), false), 20.0);
        assert_eq!([0, 1].map(|of| more(ten(Some(of)), false)), [-1970.0; 2]);
    }

    #[test]
    fn cases_without_a_verdict_are_worst_then_the_most() {
        let none = |finding, found| harm(finding, None, found, true);
        let order = |one: Harm, other: Harm| one.compare(&other);
        for finding in [FindingKind::Panic, FindingKind::Crash, FindingKind::Timeout] {
            assert_eq!(order(none(finding, 1), none(FindingKind::FalseHit, 99)), Ordering::Greater);
        }
        assert_eq!(
            order(none(FindingKind::FalseHit, 3), none(FindingKind::FalseMiss, 2)),
            Ordering::Greater
        );
        assert_eq!(
            order(none(FindingKind::FalseHit, 2), none(FindingKind::FalseMiss, 2)),
            Ordering::Equal
        );
    }
}

//! Two records side by side: what got better, what got worse.

use super::accuracy::accuracy_changes;
use super::changed::{CaseChange, changed_case};
use super::compare::tail;
use super::trend::{OtherValue, Trend};
use hairline_record::{
    Disagreement, KernelResult, Key, Rate, ResultPart, RowPart, disagreements, rate_of,
};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// The schema of a comparison.
pub(super) const DIFF_SCHEMA: &str = "hairline-diff/1";

/// A class of disagreement in two records.
#[derive(Clone, Debug, Serialize)]
pub struct Difference {
    /// The class of disagreement: kernel, epsilons, scalar, family, finding and class in one line.
    pub what: String,
    /// The trend of the class.
    pub change: Trend,
    /// How often it was.
    pub old: Rate,
    /// How often it is.
    pub new: Rate,
    /// Shows a case that is wrong in one of the records and not in the other, or the worst case of the record
    /// that has more of it.
    pub command: Option<String>,
    /// Says in words if that case is wrong in one of them only.
    pub shown: &'static str,
}

/// The comparison of two records: what they have in common, and where they differ.
#[derive(Clone, Debug, Serialize)]
pub struct RecordComparison {
    /// `hairline-diff/1`.
    pub schema: &'static str,
    /// True if the cases of all families compared are the same, so that any difference counts.
    pub same_cases: bool,
    /// Kernels, epsilons, scalars and families, taken together, that both records have.
    pub common: usize,
    /// How many classes of disagreement were compared.
    pub compared: usize,
    /// Those that differ, the worse first.
    pub differences: Vec<Difference>,
    /// Kernels whose contracts differ, so that the rates are of other questions.
    pub contracts: Vec<OtherValue>,
    /// Numbers that were chosen or proved, and differ.
    pub chosen: Vec<OtherValue>,
    /// Quantiles of the errors of right hits that differ.
    pub accuracy: Vec<OtherValue>,
    /// Classes of disagreement of kernels, epsilons, scalars or families that only the old record has.
    pub only_old: usize,
    /// And only the new one.
    pub only_new: usize,
}

impl RecordComparison {
    /// True if something is more frequent, or a bound or an error is higher.
    pub fn is_worse(&self) -> bool {
        let bounds = self
            .chosen
            .iter()
            .chain(&self.accuracy)
            .filter_map(|it| it.change);
        self.differences
            .iter()
            .map(|it| it.change)
            .chain(bounds)
            .any(|it| it == Trend::Worse)
    }
}

/// Compares. Where both records have the same cases of a family (the same set of the same size) any change
/// of a count or of the set of failing cases is one. Else rates differ if their Clopper-Pearson intervals, at
/// 0.05 divided by the number of comparisons, are disjoint.
pub fn difference(old: &ResultPart, new: &ResultPart) -> RecordComparison {
    let contracts = contract_changes(old, new);
    let same_parts = old.partial == new.partial;
    let is_of_same_cases = same_parts && old.plan.hash_of_cases() == new.plan.hash_of_cases();
    let accuracy = accuracy_changes(old, new, is_of_same_cases);
    let (old, new) = (Side::of(old), Side::of(new));
    let keys: BTreeSet<&Key> = old.found.keys().chain(new.found.keys()).collect();
    let (common, lone): (Vec<&Key>, Vec<&Key>) = keys
        .into_iter()
        .partition(|key| old.result(key).is_some() && new.result(key).is_some());
    let judge = DifferenceJudge {
        same_parts,
        tail: tail(common.len()),
    };
    let mut differences: Vec<Difference> = common
        .iter()
        .filter_map(|key| judge.difference(key, &old, &new))
        .collect();
    worst_first(&mut differences);
    RecordComparison {
        schema: DIFF_SCHEMA,
        same_cases: common.iter().all(|key| judge.same_cases(key, &old, &new)),
        common: old
            .results
            .keys()
            .filter(|place| new.results.contains_key(*place))
            .count(),
        compared: common.len(),
        differences,
        contracts,
        chosen: Vec::new(),
        accuracy,
        only_old: lone
            .iter()
            .filter(|key| old.found.contains_key(**key))
            .count(),
        only_new: lone
            .iter()
            .filter(|key| new.found.contains_key(**key))
            .count(),
    }
}

/// Puts the worse first, and of each trend the largest change.
pub(super) fn worst_first(differences: &mut [Difference]) {
    let size = |it: &Difference| it.old.count.abs_diff(it.new.count);
    differences.sort_by_key(|it| (it.change as u8, std::cmp::Reverse(size(it))));
}

/// The rows that both plans have, by contracts that are not the same.
fn contract_changes(old: &ResultPart, new: &ResultPart) -> Vec<OtherValue> {
    let pairs = old.plan.rows.iter().flat_map(|before| {
        let same = |after: &&RowPart| (&after.kernel, &after.set) == (&before.kernel, &before.set);
        new.plan.rows.iter().find(same).map(|after| (before, after))
    });
    let changed = pairs.filter(|(before, after)| before.contract != after.contract);
    changed
        .map(|(before, after)| OtherValue {
            what: before.label(),
            change: None,
            old: before.contract.clone(),
            new: after.contract.clone(),
        })
        .collect()
}

/// One of the records.
struct Side<'a> {
    result: &'a ResultPart,
    found: BTreeMap<Key, Disagreement<'a>>,
    results: BTreeMap<[&'a str; 4], &'a KernelResult>,
    /// By family: the id of the set, and how many indices.
    sources: BTreeMap<&'a str, (&'a str, u64)>,
}

impl<'a> Side<'a> {
    fn of(result: &'a ResultPart) -> Side<'a> {
        let sources = result.plan.sources.iter();
        Side {
            result,
            found: disagreements(result)
                .into_iter()
                .map(|found| (found.key.clone(), found))
                .collect(),
            results: result.by_place(),
            sources: sources
                .map(|s| (s.family.as_str(), (s.set.as_str(), s.count)))
                .collect(),
        }
    }

    fn result(&self, key: &Key) -> Option<&'a KernelResult> {
        self.results.get(&key.place()).copied()
    }

    fn row(&self, key: &Key) -> Option<&'a RowPart> {
        let mut rows = self.result.plan.rows.iter();
        rows.find(|row| (&row.kernel, &row.set) == (&key.kernel, &key.set))
    }

    fn rate(&self, key: &Key) -> Option<Rate> {
        self.result(key)
            .map(|part| rate_of(part, key.class, key.finding))
    }
}

/// How rates are compared.
pub(super) struct DifferenceJudge {
    /// True if both records are of the same parts of a run.
    pub same_parts: bool,
    /// The error of each interval.
    pub tail: f64,
}

impl DifferenceJudge {
    fn difference(&self, key: &Key, old: &Side, new: &Side) -> Option<Difference> {
        let (old_rate, new_rate) = (old.rate(key)?, new.rate(key)?);
        let digests = [old, new].map(|side| side.found.get(key).map(|found| found.digest));
        let same_set = digests[0] == digests[1];
        if is_as_often(&old_rate, &new_rate) && same_set {
            return None;
        }
        let same_cases = self.same_cases(key, old, new);
        let change = self.change(same_cases, &old_rate, &new_rate);
        let which = if change == Trend::Better {
            CaseChange::Right
        } else {
            CaseChange::New
        };
        let of_side =
            |side: &&Side<'_>| side.found.get(key).and_then(|found| found.example.clone());
        // What is right now is shown as the new record runs it, if it says how; on other cases the record
        // shows its own that has more.
        let is_old = change == Trend::Better && !same_cases;
        let sides = if is_old { [old, new] } else { [new, old] };
        let example = sides.iter().find_map(|side| {
            let mut example = of_side(side)?;
            // The same case may be run by the new kernel, which has other words.
            if let (true, Some(before), Some(now)) = (same_cases, old.row(key), new.row(key)) {
                example.command = example.command.replace(&before.flags(), &now.flags());
            }
            Some(example)
        });
        let changed = example.as_ref().filter(|_| same_cases);
        let changed =
            changed.and_then(|example| changed_case(new.result, key, example, which, digests));
        let shown = which.note(changed.is_some(), same_cases && example.is_some());
        // What may still be wrong shows nothing better.
        let is_unsure = same_cases && which == CaseChange::Right;
        let example = changed.or(example.filter(|_| !is_unsure));
        Some(Difference {
            what: key.to_string(),
            change,
            command: example.map(|example| example.command),
            shown,
            old: old_rate,
            new: new_rate,
        })
    }

    /// True if both records have the same cases of a family.
    fn same_cases(&self, key: &Key, old: &Side, new: &Side) -> bool {
        let family = key.family.as_str();
        self.same_parts && old.sources.get(family) == new.sources.get(family)
    }

    /// The trend of a rate.
    pub fn change(&self, same_cases: bool, old: &Rate, new: &Rate) -> Trend {
        let whole_sets = old.interval.is_none() && new.interval.is_none() && old.of == new.of;
        if same_cases || whole_sets {
            return match new.count.cmp(&old.count) {
                std::cmp::Ordering::Greater => Trend::Worse,
                std::cmp::Ordering::Less => Trend::Better,
                std::cmp::Ordering::Equal => Trend::Other,
            };
        }
        let [old, new] = [old, new].map(|rate| rate.trials().interval_at(self.tail));
        if old.high < new.low {
            Trend::Worse
        } else if new.high < old.low {
            Trend::Better
        } else {
            Trend::Insignificant
        }
    }
}

/// True if as many were found among as many.
fn is_as_often(old: &Rate, new: &Rate) -> bool {
    old.count == new.count && old.of == new.of
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Trials;

    #[test]
    fn as_many_of_more_or_fewer_is_a_difference() {
        let rate = |count, of| Rate::new(Trials::independent(count, of), true);
        for (count, of, is_same) in [(10, 90, true), (9, 90, false), (10, 89, false)] {
            assert_eq!(
                is_as_often(&rate(10, 90), &rate(count, of)),
                is_same,
                "{count} of {of}"
            );
        }
    }

    #[test]
    fn any_change_of_the_same_cases_is_one_and_rates_differ_if_their_intervals_are_disjoint() {
        use Trend::{Better, Insignificant, Other, Worse};
        let change = |same_cases: bool, rates: [(u64, u64, bool); 2]| {
            let [old, new] = rates
                .map(|(count, of, is_sample)| Rate::new(Trials::independent(count, of), is_sample));
            DifferenceJudge {
                same_parts: true,
                tail: 1e-5,
            }
            .change(same_cases, &old, &new)
        };
        // The standard deviation is 30: both intervals at 1e-5 reach about 4.3 of it.
        for (count, same, others) in [
            (700, Better, Better),
            (999, Better, Insignificant),
            (1000, Other, Insignificant),
            (1001, Worse, Insignificant),
            (1400, Worse, Worse),
        ] {
            let of = |is_sample| [(1000, 10_000, is_sample), (count, 10_000, is_sample)];
            assert_eq!(
                [change(true, of(true)), change(false, of(true))],
                [same, others]
            );
            // All cases that there are need no interval.
            assert_eq!(change(false, of(false)), same);
        }
        for (of, is_sample) in [
            (10_001, [false; 2]),
            (10_000, [true, false]),
            (10_000, [false, true]),
        ] {
            let rates = [(1000, 10_000, is_sample[0]), (1001, of, is_sample[1])];
            assert_eq!(change(false, rates), Insignificant, "{rates:?}");
        }
    }
}

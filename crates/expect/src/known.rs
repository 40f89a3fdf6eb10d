//! The expectations of a run on a target: for each class where the lock file has the cases, otherwise for all
//! classes of a family together.

use super::{Amount, Expectations, ExpectedEntry, Lock, LockedTarget};
use hairline_record::{Disagreement, Example, Key, Rate, ResultPart, disagreements, rate_of};
use std::collections::{BTreeMap, BTreeSet};

/// The expectations of a run.
pub(super) struct KnownDisagreements<'a> {
    /// By class, or of all classes together.
    pub entries: BTreeMap<Key, ExpectedEntry>,
    /// The target in the lock file.
    pub target: Option<&'a LockedTarget>,
    /// A note on the comparison for people, in one line.
    pub note: Option<String>,
}

/// A disagreement of a run, of one class or of all.
pub(super) struct FoundDisagreement<'a> {
    /// The class of disagreement.
    pub key: Key,
    /// How often.
    pub rate: Rate,
    /// The digest of the set of its cases; only for a single class.
    pub digest: Option<&'a str>,
    /// A case.
    pub example: Option<Example>,
}

impl KnownDisagreements<'_> {
    /// The expectations of a run on a target, on the cases of the expectations or on others; `file` is their name.
    pub fn of<'a>(
        expectations: &'a Expectations,
        same_plan: bool,
        target: &str,
        file: &str,
    ) -> KnownDisagreements<'a> {
        // A lock of other cases says nothing of those of the file and the run.
        let is_of_others = |lock: &&Lock| same_plan && lock.cases != expectations.cases;
        let lock = expectations
            .lock
            .as_ref()
            .filter(|lock| !is_of_others(lock));
        let known = lock.and_then(|lock| lock.targets.get(target));
        let cases = known.map(|known| &known.cases);
        let is_rate = |entry: &ExpectedEntry| matches!(entry.amount, Amount::Rate(_));
        let without_cases =
            |entry: &&ExpectedEntry| is_rate(entry) || (cases.is_none() && same_plan);
        let mut entries: BTreeMap<Key, ExpectedEntry> = expectations
            .entries
            .iter()
            .filter(|(_, entry)| without_cases(entry))
            .map(|(key, entry)| (key.clone(), entry.clone()))
            .collect();
        for (key, cases) in cases.into_iter().flatten() {
            // What people took out is not expected.
            let entry = expectations.entries.get(&key.of_all_classes());
            if let Some(entry) = entry.filter(|entry| !is_rate(entry)) {
                let of_class = Some((cases.of, cases.digest.clone()));
                let amount = Amount::Count {
                    count: cases.count,
                    cases: of_class,
                };
                entries.insert(
                    key.clone(),
                    ExpectedEntry {
                        amount,
                        ..entry.clone()
                    },
                );
            }
        }
        let lacking = match lock {
            None if expectations.lock.is_some() => format!("{file}.lock is of other cases"),
            None => format!("{file}.lock is missing (--bless writes it)"),
            Some(_) => format!("{file}.lock has no section of {target}"),
        };
        let note = match (cases, same_plan) {
            (Some(_), _) => None,
            _ if expectations.entries.values().all(is_rate) => None,
            (None, true) => Some(format!(
                "{lacking}: counts by family are compared, not cases"
            )),
            (None, false) => Some(format!(
                "{lacking}, and the counts of {file} are of other cases: they are not used"
            )),
        };
        KnownDisagreements {
            entries,
            target: known,
            note,
        }
    }

    /// The findings of a run, for each class, or for all together where the expectation is.
    pub fn found<'a>(&self, result: &'a ResultPart) -> Vec<FoundDisagreement<'a>> {
        let results = result.by_place();
        let mut together: BTreeSet<Key> = BTreeSet::new();
        let mut all: Vec<FoundDisagreement> = Vec::new();
        for Disagreement {
            key,
            rate,
            digest,
            example,
        } in disagreements(result)
        {
            let whole = key.of_all_classes();
            if !self.entries.contains_key(&whole) {
                all.push(FoundDisagreement {
                    key,
                    rate: rate.clone(),
                    digest: Some(digest),
                    example,
                });
            } else if together.insert(whole.clone()) {
                let part = results[&key.place()];
                let rate = rate_of(part, whole.class, whole.finding);
                all.push(FoundDisagreement {
                    key: whole,
                    rate,
                    digest: None,
                    example,
                });
            }
        }
        all
    }
}

//! A run beside its expectations.

use super::accuracy::error_changes;
use super::changed::{CaseChange, changed_case};
use super::known::{FoundDisagreement, KnownDisagreements};
use super::rows::changed_rows;
use super::{Amount, Expectations, ExpectedEntry};
use crate::audit::Interval;
use hairline_record::{
    ComparisonVerdict, Conformance, Deviation, Example, FindingClass, FindingKind, Key, Method,
    PlanPart, Rate, ResultPart, group_digits, rate_of,
};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// The probability that at least one of all comparisons by interval reports a difference by chance.
const ERROR: f64 = 0.05;

/// Compares a run on a target; `file` is the expectations' name.
///
/// Under the plan of the expectations everything is deterministic: counts and digests must be the
/// same. Under another, rates of random samples differ if their Clopper-Pearson intervals are
/// disjoint, at 0.05 divided by the number of comparisons. A class without an expectation then counts
/// as none of as many; but for a kernel row without any expectation, and for panics, one is too many.
pub fn compare(
    result: &ResultPart,
    target: &str,
    expectations: &Expectations,
    file: Option<&str>,
) -> Conformance {
    let same_plan = result.plan.hash_of_cases() == expectations.cases;
    let known = KnownDisagreements::of(expectations, same_plan, target, file.unwrap_or_default());
    let all = known.found(result);
    let method = if same_plan {
        Method::CaseByCase
    } else {
        Method::Intervals
    };
    let entries = &known.entries;
    let found: BTreeMap<&Key, &FoundDisagreement> =
        all.iter().map(|found| (&found.key, found)).collect();
    let keys: BTreeSet<&Key> = entries.keys().chain(found.keys().copied()).collect();
    let judge = ClassJudge {
        method,
        tail: tail(keys.len()),
    };
    let results = result.by_place();
    // Classes with as many wrong answers as known, but not on the same cases.
    let mut on_other_cases = Vec::new();
    let mut conformance = Conformance {
        method,
        is_by_family: same_plan && known.target.is_none(),
        expectations: file.map(str::to_owned),
        note: known.note.clone(),
        rows: known
            .target
            .map_or(Vec::new(), |target| changed_rows(&result.plan, target)),
        ..Conformance::default()
    };
    for key in keys {
        let (entry, found) = (entries.get(key), found.get(key).copied());
        let part = results.get(&key.place()).copied();
        let rate = part.map_or_else(Rate::default, |part| rate_of(part, key.class, key.finding));
        let mut deviation = deviation(key, entry, &rate, found);
        let outcome = match (entry, part) {
            (Some(_), None) if is_left_out(&result.plan, key) => {
                conformance.outside_the_plan += 1;
                continue;
            }
            (None, _) if !found.is_some_and(|found| judge.is_unexpected(found, entries)) => {
                conformance.too_rare_to_tell += 1;
                continue;
            }
            (Some(_), None) => ClassOutcome::Better,
            (Some(entry), Some(_)) => {
                judge.outcome(entry, &rate, found.and_then(|found| found.digest))
            }
            (None, _) => ClassOutcome::Worse,
        };
        let shown = |change| {
            let (entry, found) = entry.zip(found).filter(|_| same_plan)?;
            changed(result, entry, found, change)
        };
        let change = &mut conformance.change;
        match outcome {
            ClassOutcome::Same => {
                // What is known needs no example: with them a record would be half as large again.
                (deviation.case, deviation.bits, deviation.command) = (None, None, None);
                change.unchanged += 1;
                conformance.known.push(deviation);
            }
            ClassOutcome::Better => {
                if part.is_some() && rate.of == 0 {
                    deviation.expected +=
                        "; nothing is demanded there now: has the contract changed?";
                }
                show(&mut deviation, CaseChange::Right, shown(CaseChange::Right));
                change.better += 1;
                conformance.stale.push(deviation);
            }
            ClassOutcome::Worse => {
                let repaired = repaired(entries, &all, key).filter(|_| same_plan);
                change.newly_judged += u64::from(repaired.is_some());
                deviation.expected += &repaired.unwrap_or_default();
                if entry.is_some() {
                    show(&mut deviation, CaseChange::New, shown(CaseChange::New));
                }
                let list = match entry {
                    None => {
                        change.new += 1;
                        &mut conformance.unexpected
                    }
                    Some(entry) if same_plan && is_as_many(&entry.amount, &rate) => {
                        change.other_cases += 1;
                        &mut on_other_cases
                    }
                    Some(_) => {
                        change.worse += 1;
                        &mut conformance.unexpected
                    }
                };
                list.push(deviation);
            }
        }
    }
    for deviation in on_other_cases {
        let list = match is_improved(&conformance, &deviation.key()) {
            true => &mut conformance.stale,
            false => &mut conformance.unexpected,
        };
        list.push(deviation);
    }
    conformance
        .unexpected
        .sort_by_key(|found| Reverse(harm(found)));
    conformance.verdict = match (conformance.unexpected.len(), conformance.stale.len()) {
        (0, 0) => ComparisonVerdict::Conforms,
        (0, _) => ComparisonVerdict::Stale,
        _ => ComparisonVerdict::Disagreements,
    };
    let target = known.target.filter(|_| same_plan);
    conformance.add_errors(target.map_or(Vec::new(), |target| error_changes(result, target)));
    conformance
}

/// True if a row has fewer wrong answers than known, and more in no class: then classes with as many on other cases are part
/// of an improvement.
fn is_improved(conformance: &Conformance, key: &Key) -> bool {
    let is_of_row = |found: &&Deviation| found.key().is_of_row(key);
    let has_fewer = |found: &&Deviation| {
        let known = found.expected_count;
        known.is_some_and(|known| found.found.count < known)
    };
    let has_more = |found: &&Deviation| {
        found
            .expected_count
            .is_none_or(|known| known < found.found.count)
    };
    let is_better = conformance
        .stale
        .iter()
        .filter(is_of_row)
        .any(|found| has_fewer(&found));
    let is_worse = conformance
        .unexpected
        .iter()
        .filter(is_of_row)
        .any(|found| has_more(&found));
    is_better && !is_worse
}

/// True if a plan leaves out the kernel, the scalar or the family: then the expectation is about
/// something else. A kernel that runs with other epsilons only is another matter.
fn is_left_out(plan: &PlanPart, key: &Key) -> bool {
    let is_planned = plan.rows.iter().any(|row| row.kernel == key.kernel)
        && plan.scalars.contains(&key.scalar)
        && plan
            .sources
            .iter()
            .any(|source| source.family == key.family);
    !is_planned
}

/// How much harm a disagreement does: cases without a verdict are worst, then what has the most cases more than expected.
fn harm(found: &Deviation) -> (bool, u64) {
    (found.finding.is_failure(), found.more_than_known())
}

/// The probability at each end of each interval.
pub(super) fn tail(comparisons: usize) -> f64 {
    ERROR / comparisons.max(1) as f64 / 2.0
}

/// A case of a class that changed, if the digests tell one.
fn changed(
    result: &ResultPart,
    entry: &ExpectedEntry,
    found: &FoundDisagreement,
    change: CaseChange,
) -> Option<Example> {
    let Amount::Count {
        cases: Some((_, expected)),
        ..
    } = &entry.amount
    else {
        return None;
    };
    let digests = [Some(expected.as_str()), Some(found.digest?)];
    changed_case(result, &found.key, found.example.as_ref()?, change, digests)
}

enum ClassOutcome {
    Same,
    Worse,
    Better,
}

struct ClassJudge {
    method: Method,
    tail: f64,
}

impl ClassJudge {
    /// True if a disagreement without an expectation is one too many.
    fn is_unexpected(
        &self,
        found: &FoundDisagreement,
        entries: &BTreeMap<Key, ExpectedEntry>,
    ) -> bool {
        let trials = found.rate.trials();
        self.method == Method::CaseByCase
            || found.rate.interval.is_none()
            || found.key.finding == FindingKind::Panic
            || !entries.keys().any(|key| key.is_of_row(&found.key))
            || trials.interval_of_others(0, trials.of, self.tail).high
                < trials.interval_at(self.tail).low
    }

    fn outcome(&self, entry: &ExpectedEntry, found: &Rate, digest: Option<&str>) -> ClassOutcome {
        match &entry.amount {
            Amount::Rate(bound) => self.within(*bound, found),
            Amount::Count { count, cases } => {
                let of = cases.as_ref().map(|(of, _)| *of);
                let same_trials = of.is_none_or(|of| of == found.of);
                let exact =
                    self.method == Method::CaseByCase || (found.interval.is_none() && same_trials);
                if !exact {
                    return self.rates(*count, of.unwrap_or(found.of), found);
                }
                let same_cases = cases
                    .as_ref()
                    .is_none_or(|(_, expected)| Some(expected.as_str()) == digest);
                // The number of trials moves with other findings: a crash gives no verdict, and bad values are
                // counted among the hits.
                if found.count < *count {
                    ClassOutcome::Better
                } else if found.count == *count && same_cases {
                    ClassOutcome::Same
                } else {
                    ClassOutcome::Worse
                }
            }
        }
    }

    /// Expectations do not say which trials share a ray, so both intervals have the design effect of
    /// this run.
    fn rates(&self, count: u64, of: u64, found: &Rate) -> ClassOutcome {
        let found = found.trials();
        let expected = found.interval_of_others(count, of, self.tail);
        let found = found.interval_at(self.tail);
        if expected.high < found.low {
            ClassOutcome::Worse
        } else if found.high < expected.low {
            ClassOutcome::Better
        } else {
            ClassOutcome::Same
        }
    }

    /// At most a share: of a sample as far as its interval tells. None at all, of enough, is better.
    fn within(&self, bound: f64, found: &Rate) -> ClassOutcome {
        let share = found.rate.unwrap_or(0.0);
        let interval = match found.interval {
            Some(_) => found.trials().interval_at(self.tail),
            None => Interval {
                low: share,
                high: share,
            },
        };
        if bound < interval.low {
            ClassOutcome::Worse
        } else if found.count == 0 && interval.high < bound {
            ClassOutcome::Better
        } else {
            ClassOutcome::Same
        }
    }
}

fn deviation(
    key: &Key,
    entry: Option<&ExpectedEntry>,
    rate: &Rate,
    found: Option<&FoundDisagreement>,
) -> Deviation {
    let example = found.and_then(|found| found.example.clone());
    let bits = example.as_ref().map(|example| example.bits.clone());
    Deviation {
        kernel: key.kernel.clone(),
        set: key.set.clone(),
        scalar: key.scalar,
        family: key.family.clone(),
        class: key.class,
        finding: key.finding,
        expected: entry.map_or("none".to_owned(), |entry| {
            describe(&entry.amount, rate, found.and_then(|found| found.digest))
        }),
        expected_count: match entry.map(|entry| &entry.amount) {
            None => Some(0),
            Some(Amount::Count { count, .. }) => Some(*count),
            Some(Amount::Rate(_)) => None,
        },
        found: rate.clone(),
        line: entry.map(|entry| entry.line),
        case: example.as_ref().map(|example| example.case.clone()),
        bits: bits.filter(|bits| !bits.is_empty()),
        command: example.map(|example| example.command),
        why: entry.and_then(|entry| entry.why.clone()),
        url: entry.and_then(|entry| entry.url.clone()),
    }
}

/// Shows a case that changed. Else what got worse says that the case shown may have failed before, and what
/// got better shows none: it may still be wrong.
fn show(deviation: &mut Deviation, change: CaseChange, changed: Option<Example>) {
    deviation.expected += change.note(changed.is_some(), deviation.case.is_some());
    match changed {
        Some(Example {
            case,
            bits,
            command,
            ..
        }) => {
            (deviation.case, deviation.command) = (Some(case), Some(command));
            deviation.bits = Some(bits).filter(|bits| !bits.is_empty());
        }
        None if change == CaseChange::Right => {
            (deviation.case, deviation.bits, deviation.command) = (None, None, None);
        }
        None => {}
    }
}

/// True if the expected number of cases was found, and among as many cases as expected.
fn is_as_many(amount: &Amount, found: &Rate) -> bool {
    let Amount::Count { count, cases } = amount else {
        return false;
    };
    *count == found.count && cases.as_ref().is_none_or(|(of, _)| *of == found.of)
}

/// The expectation; where as many were found, whether they are other cases.
fn describe(amount: &Amount, found: &Rate, digest: Option<&str>) -> String {
    match amount {
        Amount::Rate(bound) => format!("a share of at most {bound}, and not none"),
        Amount::Count { count, cases: None } => group_digits(*count),
        Amount::Count {
            count,
            cases: Some((of, expected)),
        } => {
            let is_other = is_as_many(amount, found) && Some(expected.as_str()) != digest;
            let other = if is_other { " (other cases)" } else { "" };
            format!("{} of {}{other}", group_digits(*count), group_digits(*of))
        }
    }
}

/// The verb for the kernel's failure, if it gave no verdict.
fn verb(finding: FindingKind) -> Option<&'static str> {
    match finding {
        FindingKind::Crash => Some("crashed"),
        FindingKind::Panic => Some("panicked"),
        FindingKind::Timeout => Some("gave no answer"),
        _ => None,
    }
}

/// True if a failure keeps cases of a class from being judged: one on a triangle also keeps its group.
fn keeps(failure: &Key, key: &Key) -> bool {
    let is_of_class = match key.class {
        FindingClass::Group => failure.class != FindingClass::Polygon,
        class => failure.class == class,
    };
    let is_of_place = failure.is_of_row(key) && failure.family == key.family;
    failure.finding.is_failure() && is_of_class && is_of_place
}

/// A note on a class of which there is more than expected, if the kernel failed on more of its cases before.
fn repaired(
    entries: &BTreeMap<Key, ExpectedEntry>,
    all: &[FoundDisagreement],
    key: &Key,
) -> Option<String> {
    let count = |entry: &ExpectedEntry| match &entry.amount {
        Amount::Count { count, .. } => *count,
        Amount::Rate(_) => 0,
    };
    let failed: Vec<(&Key, &ExpectedEntry)> = entries
        .iter()
        .filter(|(other, _)| keeps(other, key))
        .collect();
    let failing = all.iter().filter(|other| keeps(&other.key, key));
    let before: u64 = failed.iter().map(|(_, entry)| count(entry)).sum();
    let fewer = before.checked_sub(failing.map(|other| other.rate.count).sum())?;
    let did = verb(failed.first()?.0.finding)?;
    let is_any = 0 < fewer && !key.finding.is_failure();
    is_any.then(|| format!("; before, the kernel {did} on {fewer} cases that it answers now"))
}

#[cfg(test)]
mod tests;

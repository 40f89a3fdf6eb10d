//! Cases that had no verdict, because the kernel failed on them: once it is repaired, what it does wrong there is new.

use super::known::FoundDisagreement;
use super::{Amount, ExpectedEntry};
use crate::report::{FindingKind, Key};
use std::collections::BTreeMap;

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
    let is_of_class = match key.class.as_str() {
        "group" => failure.class != "polygon",
        class => failure.class == class,
    };
    let is_of_place = failure.is_of_row(key) && failure.family == key.family;
    failure.finding.is_failure() && is_of_class && is_of_place
}

/// A note on a class of which there is more than expected, if the kernel failed on more of its cases before.
pub(super) fn repaired(
    entries: &BTreeMap<Key, ExpectedEntry>,
    all: &[FoundDisagreement],
    key: &Key,
) -> Option<String> {
    let count = |entry: &ExpectedEntry| match &entry.amount {
        Amount::Count { count, .. } => *count,
        Amount::Rate(_) => 0,
    };
    let failed: Vec<(&Key, &ExpectedEntry)> =
        entries.iter().filter(|(other, _)| keeps(other, key)).collect();
    let failing = all.iter().filter(|other| keeps(&other.key, key));
    let before: u64 = failed.iter().map(|(_, entry)| count(entry)).sum();
    let fewer = before.checked_sub(failing.map(|other| other.rate.count).sum())?;
    let did = verb(failed.first()?.0.finding)?;
    let is_any = 0 < fewer && !key.finding.is_failure();
    is_any.then(|| format!("; before, the kernel {did} on {fewer} cases that it answers now"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Rate;

    fn key(class: &str, finding: FindingKind) -> Key {
        let [kernel, set, scalar, family] = ["k", "source", "f32", "edges"].map(str::to_owned);
        Key { kernel, set, scalar, family, class: class.to_owned(), finding }
    }

    /// The note on a finding, by the failures before and now: class, finding, cases.
    fn note(
        before: &[(&str, FindingKind, u64)],
        now: &[(&str, FindingKind, u64)],
        of: (&str, FindingKind),
    ) -> Option<String> {
        let entry = |count| ExpectedEntry {
            line: 1,
            amount: Amount::Count { count, cases: None },
            why: None,
            url: None,
        };
        let entries = before.iter().map(|(class, finding, n)| (key(class, *finding), entry(*n)));
        let found = |(class, finding, count): &(&str, FindingKind, u64)| FoundDisagreement {
            key: key(class, *finding),
            rate: Rate { count: *count, of: 100, ..Rate::default() },
            digest: None,
            example: None,
        };
        let all: Vec<FoundDisagreement> = now.iter().map(found).collect();
        repaired(&entries.collect(), &all, &key(of.0, of.1))
    }

    #[test]
    fn what_was_repaired_is_said_of_the_class_and_of_its_groups() {
        use FindingKind::{Crack, Crash, FalseMiss, Panic, PolygonFalseMiss, Timeout};
        let crashed = ("edge", Crash, 4);
        let said = "; before, the kernel crashed on 4 cases that it answers now";
        assert_eq!(note(&[crashed], &[], ("edge", FalseMiss)).as_deref(), Some(said));
        assert_eq!(note(&[crashed], &[], ("group", Crack)).as_deref(), Some(said));
        let late = note(&[("edge", Timeout, 3)], &[("edge", Timeout, 1)], ("edge", FalseMiss));
        let said = "; before, the kernel gave no answer on 2 cases that it answers now";
        assert_eq!(late.as_deref(), Some(said));
        // Another class, a failure of another kind, and as many as before.
        for other in [("vertex", FalseMiss), ("polygon", PolygonFalseMiss), ("edge", Panic)] {
            assert_eq!(note(&[crashed], &[], other), None, "{other:?}");
        }
        assert_eq!(note(&[crashed], &[("edge", Panic, 4)], ("edge", FalseMiss)), None);
        assert_eq!(note(&[], &[], ("edge", FalseMiss)), None);
    }
}

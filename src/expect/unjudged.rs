//! Cases that a crash kept from being judged: what a kernel does wrong on them once it is repaired is no regression.

use super::known::Found;
use super::{Amount, Entry, Target};
use crate::audit::Digest;
use crate::report::{FindingKind, KernelResult, Key};
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
    let of_place =
        |key: &Key| (key.kernel.clone(), key.set.clone(), key.scalar.clone(), key.family.clone());
    let is_of_class = match key.class.as_str() {
        "group" => failure.class != "polygon",
        class => failure.class == class,
    };
    failure.finding.is_failure() && is_of_class && of_place(failure) == of_place(key)
}

/// How many there were, where that is known.
fn had(entries: &BTreeMap<Key, Entry>, key: &Key) -> Option<u64> {
    match entries.get(key).map(|entry| &entry.amount) {
        None => Some(0),
        Some(Amount::Count { count, .. }) => Some(*count),
        Some(Amount::Rate(_)) => None,
    }
}

/// The kind of group that a finding is on: crossings (0) or folds (1), whatever class it is counted in.
fn of_groups(finding: FindingKind) -> Option<usize> {
    match finding {
        FindingKind::Crack | FindingKind::Double => Some(0),
        FindingKind::OddFold => Some(1),
        _ => None,
    }
}

/// How many more crossings, or folds, are judged than before, where the kernel failed on some triangles then; none
/// for findings that are not on groups, and where it is not known.
pub(super) fn newly_judged_groups(
    known: Option<&Target>,
    part: &KernelResult,
    key: &Key,
) -> Option<u64> {
    let Key { kernel, set, scalar, family, .. } = key.clone();
    let kind = of_groups(key.finding)?;
    let (before, across) =
        (known?.judged.get(&[kernel, set, scalar, family])?, part.across.as_ref()?);
    Some([across.cracks.of, across.odd_folds.of][kind].saturating_sub(before[kind]))
}

/// The note on a class if all of its cases that are too many may be such that were not judged before; none
/// if some are known to be others. Both runs have the same cases.
///
/// They may be if no more of the class came in, its findings together, than failures of all kinds went. Several
/// failures in one group hid one group, so of groups it is `groups` that counts: how many more are judged. The digests
/// tell some cases of a difference: one that did not fail before is a regression, and so is a change of cases that
/// were judged.
pub(super) fn not_judged_before(
    entries: &BTreeMap<Key, Entry>,
    all: &[Found],
    (indices, groups): (u64, Option<u64>),
    found: &Found,
) -> Option<String> {
    let key = &found.key;
    if key.finding.is_failure() {
        return None;
    }
    let more = found.rate.count.checked_sub(had(entries, key)?).filter(|more| 0 < *more)?;
    let kind = of_groups(key.finding);
    let is_beside = |other: &&Found| {
        !other.key.finding.is_failure()
            && of_groups(other.key.finding) == kind
            && Key { finding: key.finding, ..other.key.clone() } == *key
    };
    let more_than =
        |other: &Found| Some(other.rate.count.saturating_sub(had(entries, &other.key)?));
    let of_class: u64 = all.iter().filter(is_beside).filter_map(more_than).sum();
    let failing: u64 =
        all.iter().filter(|other| keeps(&other.key, key)).map(|other| other.rate.count).sum();
    let failed: Vec<(&Key, &Entry)> =
        entries.iter().filter(|(other, _)| keeps(other, key)).collect();
    let failed_before: u64 = failed.iter().filter_map(|(other, _)| had(entries, other)).sum();
    let repaired = failed_before.saturating_sub(failing);
    let repaired = match kind {
        Some(_) => repaired.min(groups?),
        None => repaired,
    };
    let (first, _) = failed.first().filter(|_| of_class <= repaired)?;
    let did = verb(first.finding)?;
    let digest = |text: &str| Digest::try_from(text.to_owned()).ok();
    let of_entry = |entry: &Entry| match &entry.amount {
        Amount::Count { cases, .. } => cases.as_ref().and_then(|(_, cases)| digest(cases)),
        Amount::Rate(_) => None,
    };
    let before = match entries.get(key) {
        None => Some(Digest::default()),
        Some(entry) => of_entry(entry),
    };
    let is_of_triangles = kind.is_none() && key.class != "polygon";
    if let (true, Some(before), Some(now)) =
        (is_of_triangles, before, found.digest.and_then(digest))
    {
        let failed: Vec<Option<Digest>> = failed.iter().map(|(_, entry)| of_entry(entry)).collect();
        let is_no_failure = |place| {
            let has = |failed: &Option<Digest>| failed.as_ref().map(|f| f.may_have(place, indices));
            failed.iter().all(|failed| has(failed) == Some(false))
        };
        if now.beyond(&before, indices).any(is_no_failure)
            || before.beyond(&now, indices).next().is_some()
        {
            return None;
        }
    }
    Some(format!("; {more} more, among {repaired} not judged before: the kernel {did}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Place;
    use crate::report::Rate;

    fn key(class: &str, finding: FindingKind) -> Key {
        let [kernel, set, scalar, family] = ["k", "source", "f32", "edges"].map(str::to_owned);
        Key { kernel, set, scalar, family, class: class.to_owned(), finding }
    }

    /// The text form of a set of single triangles.
    fn written(indices: &[u64]) -> String {
        let mut digest = Digest::default();
        for &index in indices {
            let place = Place { index, triangle: 0 };
            digest.add(place, Digest::hash(place));
        }
        digest.to_string()
    }

    /// The excuse for the first of the findings of now, by those of before: class, finding, cases.
    fn excuse(
        before: &[(&str, FindingKind, &[u64])],
        now: &[(&str, FindingKind, &[u64])],
    ) -> Option<String> {
        excuse_with(None, before, now)
    }

    /// The same, where so many more groups are judged than before.
    fn excuse_with(
        groups: Option<u64>,
        before: &[(&str, FindingKind, &[u64])],
        now: &[(&str, FindingKind, &[u64])],
    ) -> Option<String> {
        let entry = |cases: &[u64]| Entry {
            line: 1,
            amount: Amount::Count { count: cases.len() as u64, cases: Some((100, written(cases))) },
            why: None,
            url: None,
        };
        let entries =
            before.iter().map(|(class, finding, cases)| (key(class, *finding), entry(cases)));
        let texts: Vec<String> = now.iter().map(|(.., cases)| written(cases)).collect();
        let rate = |count| Rate { count, of: 100, rate: None, interval: None, rays: None };
        let all: Vec<Found> = now
            .iter()
            .zip(&texts)
            .map(|((class, finding, cases), text)| Found {
                key: key(class, *finding),
                rate: rate(cases.len() as u64),
                digest: Some(text),
                example: None,
            })
            .collect();
        not_judged_before(&entries.collect(), &all, (1000, groups), &all[0])
    }

    fn is_excused(
        before: &[(&str, FindingKind, &[u64])],
        now: &[(&str, FindingKind, &[u64])],
    ) -> bool {
        excuse(before, now).is_some()
    }

    fn with_groups(
        groups: Option<u64>,
        before: &[(&str, FindingKind, &[u64])],
        now: &[(&str, FindingKind, &[u64])],
    ) -> bool {
        excuse_with(groups, before, now).is_some()
    }

    #[test]
    fn what_came_from_repaired_failures_alone_is_excused() {
        let crashed: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Crash, &[10, 20, 30, 40]);
        assert!(is_excused(&[crashed], &[("edge", FindingKind::FalseMiss, &[10, 30])]));
        assert!(
            !is_excused(&[], &[("edge", FindingKind::FalseMiss, &[10, 30])]),
            "nothing crashed"
        );
        assert!(
            !is_excused(&[crashed], &[("vertex", FindingKind::FalseMiss, &[10])]),
            "another class"
        );
        let five: &[u64] = &[10, 20, 30, 40, 50];
        assert!(
            !is_excused(&[crashed], &[("edge", FindingKind::FalseMiss, five)]),
            "more than crashed"
        );
        // One of them is shown to be another case, though not the first.
        assert!(!is_excused(&[crashed], &[("edge", FindingKind::FalseMiss, &[10, 500, 600])]));
        // The findings of a class together are no more than what crashed.
        let beside: (&str, FindingKind, &[u64]) = ("edge", FindingKind::FalseHit, &[20, 40]);
        assert!(is_excused(&[crashed], &[("edge", FindingKind::FalseMiss, &[10, 30]), beside]));
        assert!(!is_excused(
            &[crashed],
            &[("edge", FindingKind::FalseMiss, &[10, 20, 30]), beside]
        ));
    }

    #[test]
    fn a_failure_of_another_kind_is_no_repair() {
        let crashed: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Crash, &[10, 20, 30]);
        assert!(!is_excused(&[crashed], &[("edge", FindingKind::Panic, &[10, 20, 30])]));
        let panics: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Panic, &[10, 20]);
        assert!(is_excused(&[crashed], &[("edge", FindingKind::FalseMiss, &[30]), panics]));
        assert!(!is_excused(&[crashed], &[("edge", FindingKind::FalseMiss, &[10, 30]), panics]));
    }

    #[test]
    fn groups_wait_for_their_triangles_and_polygons_for_themselves() {
        let crashed: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Crash, &[10]);
        assert!(with_groups(Some(1), &[crashed], &[("group", FindingKind::Crack, &[10])]));
        assert!(!is_excused(&[crashed], &[("polygon", FindingKind::PolygonFalseMiss, &[10])]));
        let polygon: (&str, FindingKind, &[u64]) = ("polygon", FindingKind::Crash, &[10]);
        assert!(is_excused(&[polygon], &[("polygon", FindingKind::PolygonFalseMiss, &[10])]));
        assert!(!with_groups(Some(1), &[polygon], &[("group", FindingKind::Crack, &[10])]));
    }

    #[test]
    fn several_failures_in_one_group_hid_one_group() {
        let crashed: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Crash, &[10, 11, 12, 13]);
        fn of_groups(finding: FindingKind, cases: &[u64]) -> (&str, FindingKind, &[u64]) {
            ("group", finding, cases)
        }
        let two = of_groups(FindingKind::Crack, &[10, 20]);
        assert!(with_groups(Some(2), &[crashed], &[two]));
        assert!(!with_groups(Some(2), &[crashed], &[of_groups(FindingKind::Crack, &[10, 20, 30])]));
        // A fold is another kind of group; a crossing is cracked or doubled.
        assert!(!with_groups(Some(2), &[crashed], &[two, of_groups(FindingKind::Double, &[30])]));
        assert!(with_groups(Some(2), &[crashed], &[two, of_groups(FindingKind::OddFold, &[40])]));
        // Nobody knows how many were judged before.
        assert!(!with_groups(None, &[crashed], &[of_groups(FindingKind::Crack, &[10])]));
    }

    #[test]
    fn what_is_said_has_the_count_and_the_failure() {
        let crashed: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Crash, &[10, 20, 30]);
        let text = excuse(&[crashed], &[("edge", FindingKind::FalseMiss, &[10, 30])]);
        let said = "; 2 more, among 3 not judged before: the kernel crashed";
        assert_eq!(text.as_deref(), Some(said));
        // One of three still fails.
        let late: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Timeout, &[10, 20, 30]);
        let still: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Timeout, &[20]);
        let text = excuse(&[late], &[("edge", FindingKind::FalseMiss, &[10]), still]);
        let said = "; 1 more, among 2 not judged before: the kernel gave no answer";
        assert_eq!(text.as_deref(), Some(said));
    }

    #[test]
    fn cases_that_were_judged_are_no_excuse() {
        let crashed: (&str, FindingKind, &[u64]) = ("edge", FindingKind::Crash, &[10, 20, 30]);
        let one: (&str, FindingKind, &[u64]) = ("edge", FindingKind::FalseMiss, &[70]);
        assert!(is_excused(&[crashed, one], &[("edge", FindingKind::FalseMiss, &[10, 70])]));
        assert!(!is_excused(&[crashed, one], &[one]), "none more");
        assert!(
            !is_excused(&[crashed, one], &[("edge", FindingKind::FalseMiss, &[10, 20])]),
            "70 went"
        );
        // The places of groups and polygons are not those of triangles.
        assert!(with_groups(Some(1), &[crashed], &[("group", FindingKind::Crack, &[500])]));
    }

    #[test]
    fn failures_elsewhere_and_shares_are_no_excuse() {
        let (found, failure) =
            (key("edge", FindingKind::FalseMiss), key("edge", FindingKind::Crash));
        assert!(keeps(&failure, &found));
        let others = [
            Key { kernel: "other".to_owned(), ..failure.clone() },
            Key { set: "other".to_owned(), ..failure.clone() },
            Key { scalar: "f64".to_owned(), ..failure.clone() },
            Key { family: "other".to_owned(), ..failure.clone() },
            Key { finding: FindingKind::FalseHit, ..failure.clone() },
        ];
        assert!(others.iter().all(|other| !keeps(other, &found)));
        let share = Entry { line: 1, amount: Amount::Rate(0.5), why: None, url: None };
        assert_eq!(had(&[(found.clone(), share)].into(), &found), None);
    }
}

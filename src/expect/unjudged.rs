//! Cases that a crash kept from being judged: what a kernel does wrong on them once it is repaired is no regression.

use super::known::Found;
use super::{Amount, Entry};
use crate::audit::Digest;
use crate::report::{KernelResult, Key, rate_of};
use std::collections::BTreeMap;

/// Findings by which a case gets no verdict, and what the kernel did.
const FAILURES: [(&str, &str); 3] =
    [("crash", "crashed"), ("panic", "panicked"), ("timeout", "gave no answer")];

/// What is said of a class if all of its cases that are too many may be such that were not judged before; none
/// if some are known to be others. Of the same cases only.
///
/// They may be if no more of them came in than failures went. The digests tell some cases of a difference: one
/// that did not fail before is a regression, and so is a change of cases that were judged.
pub(super) fn not_judged_before(
    entries: &BTreeMap<Key, Entry>,
    part: &KernelResult,
    indices: u64,
    found: &Found,
) -> Option<String> {
    let (key, entry) = (&found.key, entries.get(&found.key));
    let digest = |text: &str| Digest::try_from(text.to_owned()).ok();
    let (had, before) = match entry.map(|entry| &entry.amount) {
        None => (0, Some(Digest::default())),
        Some(Amount::Count { count, cases }) => {
            (*count, cases.as_ref().and_then(|(_, before)| digest(before)))
        }
        Some(Amount::Rate(_)) => return None,
    };
    let more = found.rate.count.checked_sub(had).filter(|more| 0 < *more)?;
    let is_together = matches!(key.class.as_str(), "group" | "polygon");
    let of_place = |other: &Key| {
        let is_of_class = is_together || other.class == key.class;
        Key { finding: other.finding.clone(), class: other.class.clone(), ..key.clone() } == *other
            && is_of_class
    };
    let (mut repaired, mut did, mut failed) = (0, None, Vec::new());
    for (failure, entry) in entries.iter().filter(|(other, _)| of_place(other)) {
        let Some((_, verb)) = FAILURES.iter().find(|(name, _)| *name == failure.finding) else {
            continue;
        };
        let Amount::Count { count, cases } = &entry.amount else { continue };
        let now = rate_of(part, &failure.class, &failure.finding).count;
        repaired += count.saturating_sub(now);
        did = did.or(Some(verb));
        failed.push(cases.as_ref().and_then(|(_, cases)| digest(cases)));
    }
    let did = did.filter(|_| more <= repaired)?;
    if let (false, Some(before), Some(now)) = (is_together, before, found.digest.and_then(digest)) {
        let is_no_failure = |place| {
            let has = |failed: &Option<Digest>| failed.as_ref().map(|f| f.may_have(place, indices));
            failed.iter().all(|failed| has(failed) == Some(false))
        };
        let is_other = now.beyond(&before, indices).is_some_and(is_no_failure);
        if is_other || before.beyond(&now, indices).is_some() {
            return None;
        }
    }
    Some(format!("; {more} more, among {repaired} not judged before: the kernel {did}"))
}

//! Writing what a run found as what is expected from now on.

use super::scene::scene_of;
use super::{Amount, Expectations, Lock, LockedTarget, SCHEMA};
use hairline_files::InputError;
use hairline_record::{Conformance, Key, Record};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Why a record is not blessed.
#[derive(Debug)]
pub enum BlessError {
    /// The file also has so many entries for kernels, scalars or families that the plan leaves out, and they would be lost.
    Outside(u64),
    /// The written files cannot be read.
    Unread(InputError),
}

/// The file for people, and that of the cases beside it.
pub type Texts = [String; 2];

/// The expectations that a run on a target meets. Reasons and links of the old ones are kept, and so are bounds
/// by rate that hold, and the cases of other targets; nothing that the plan leaves out is dropped silently. The
/// targets whose counts are of other cases are left out, and named.
pub fn bless(
    record: &Record,
    old: &Expectations,
    compared: &Conformance,
) -> Result<(Texts, Vec<String>), BlessError> {
    let (result, target) = (&record.result, &record.provenance.target);
    if compared.outside_the_plan > 0 {
        return Err(BlessError::Outside(compared.outside_the_plan));
    }
    let cases_of_plan = result.plan.hash_of_cases();
    let (mut kept, dropped) = match old.lock.clone() {
        Some(lock) if lock.cases == cases_of_plan => (lock.targets, BTreeMap::new()),
        Some(lock) => (BTreeMap::new(), lock.targets),
        None => Default::default(),
    };
    let now = LockedTarget::of(result);
    // What people took out is expected nowhere.
    for target in kept.values_mut() {
        let is_planned =
            |kernel: &String, set: &String| now.rows.contains_key(&[kernel.clone(), set.clone()]);
        target
            .rows
            .retain(|[kernel, set], _| is_planned(kernel, set));
        target
            .errors
            .retain(|[kernel, set, ..], _| is_planned(kernel, set));
        target
            .cases
            .retain(|key, _| old.entries.contains_key(&key.of_all_classes()));
    }
    let mut lock = Lock {
        cases: cases_of_plan,
        targets: kept,
    };
    lock.targets.insert(target.clone(), now);
    let dropped = dropped.into_keys().filter(|name| name != target).collect();
    Ok((
        [reviewed(&lock, record, old, compared), lock.to_string()],
        dropped,
    ))
}

/// Families, each with its amount, the larger count first.
type Amounts<'a> = BTreeMap<(Reverse<u64>, &'a str), String>;

/// The file for people: a line for each finding of a kernel row in a scalar, and for each reason.
fn reviewed(lock: &Lock, record: &Record, old: &Expectations, compared: &Conformance) -> String {
    let mut text = format!(
        "# Known disagreements: what `hairline check` expects beside the default, which is none. The cases are\n\
         # in the .lock file beside this one. `hairline check --bless`, or HAIRLINE_BLESS=1 in a test, writes both,\n\
         # and keeps `why` and `url`.\n\
         # A line may be split by families, each part with its reason. A family in `rates = {{ NAME = 0.02 }}`\n\
         # instead of `counts` has an upper bound.\n\
         schema = \"{SCHEMA}\"\ncases = \"{}\"\n",
        lock.cases
    );
    let flags = record.provenance.plan_flags.as_ref();
    if let Some(sources) = flags
        .map(|flags| &flags.sources)
        .filter(|flags| !flags.is_empty())
    {
        let _ = writeln!(text, "sources = {}", quoted(sources));
    }
    if let Some(scene) = scene_of(&record.result.plan) {
        let _ = writeln!(text, "scene = {}", quoted(&scene));
    }
    let exceeded: BTreeSet<Key> = compared
        .unexpected
        .iter()
        .map(|found| found.key())
        .collect();
    let mut most = lock.most();
    let stale: BTreeSet<Key> = compared.stale.iter().map(|found| found.key()).collect();
    // A bound of what did not occur holds, too.
    let is_bound = |entry: &super::ExpectedEntry| matches!(entry.amount, Amount::Rate(_));
    let bounds = old
        .entries
        .iter()
        .filter(|(key, entry)| is_bound(entry) && !stale.contains(key));
    bounds.for_each(|(key, _)| {
        most.entry(key.clone()).or_insert(0);
    });
    let rows: BTreeSet<(&str, &str)> = most
        .keys()
        .map(|key| (key.kernel.as_str(), key.set.as_str()))
        .collect();
    for row in rows {
        let (kernel, set) = (quoted(row.0), quoted(row.1));
        let _ = write!(
            text,
            "\n[[known]]\nkernel = {kernel}\nset = {set}\nfindings = [\n"
        );
        let mut lines: BTreeMap<[Option<&str>; 4], [Amounts; 2]> = BTreeMap::new();
        for (key, count) in most
            .iter()
            .filter(|(key, _)| (&*key.kernel, &*key.set) == row)
        {
            let old = old.entries.get(key);
            let why = old.and_then(|old| old.why.as_deref());
            let url = old.and_then(|old| old.url.as_deref());
            let line = [Some(key.scalar.name()), Some(key.finding.name()), why, url];
            let (kind, amount) = match old.map(|old| &old.amount) {
                Some(Amount::Rate(rate)) if !exceeded.contains(key) => (1, format!("{rate:?}")),
                _ => (0, count.to_string()),
            };
            let place = (Reverse(*count), key.family.as_str());
            lines.entry(line).or_default()[kind].insert(place, amount);
        }
        for (words, amounts) in lines {
            let [scalar, finding, why, url] = words.map(|words| words.map(quoted));
            let [counts, rates] = amounts.map(|amounts| {
                let each = amounts.iter();
                let each =
                    each.map(|((_, family), amount)| format!("{} = {amount}", named(family)));
                let each: Vec<String> = each.collect();
                (!each.is_empty()).then(|| format!("{{ {} }}", each.join(", ")))
            });
            let names = ["scalar", "finding", "counts", "rates", "why", "url"];
            let parts = names
                .into_iter()
                .zip([scalar, finding, counts, rates, why, url]);
            let parts = parts.filter_map(|(name, value)| Some(format!("{name} = {}", value?)));
            let _ = writeln!(text, "  {{ {} }},", parts.collect::<Vec<_>>().join(", "));
        }
        text.push_str("]\n");
    }
    text
}

/// A TOML key.
fn named(key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    if !key.is_empty() && key.chars().all(is_bare) {
        key.to_owned()
    } else {
        quoted(key)
    }
}

/// A TOML string.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => _ = write!(quoted, "\\u{:04X}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_what_toml_reads() {
        for text in [
            "plain",
            "",
            "a-b_c",
            "two words",
            "\"",
            "\\",
            "a\tb\n\u{1}\u{7f}",
            "ä:€",
        ] {
            let line = format!("{} = {}", named(text), quoted(text));
            let table: toml::Table = line.parse().unwrap();
            assert_eq!(
                table.into_iter().collect::<Vec<_>>(),
                [(text.to_owned(), text.into())]
            );
        }
    }
}

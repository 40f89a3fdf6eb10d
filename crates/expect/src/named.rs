//! Two records of one study that is no audit, side by side: its rates and its values by their names.

use super::compare::tail;
use super::difference::{DIFF_SCHEMA, Difference, DifferenceJudge, RecordComparison, worst_first};
use super::trend::{OtherValue, Trend};
use hairline_record::{Comparable, NamedValue};
use std::collections::BTreeMap;

/// Compares what two studies of one kind counted, chose and proved, name by name. Rates differ as those of audits do.
pub fn difference_of<R: Comparable>(old: &R, new: &R) -> RecordComparison {
    let counted = Common::of(old.counted(), new.counted(), |rate| &rate.what);
    let chosen = Common::of(old.chosen(), new.chosen(), |value| &value.what);
    let same_cases = old.cases() == new.cases();
    let compared = counted.both.len();
    let judge = DifferenceJudge {
        same_parts: true,
        tail: tail(compared),
    };
    let mut differences = Vec::new();
    for (old, new) in &counted.both {
        if (old.rate.count, old.rate.of) == (new.rate.count, new.rate.of) {
            continue;
        }
        let change = judge.change(same_cases, &old.rate, &new.rate);
        // What is still wrong shows nothing better.
        let is_better = same_cases && change == Trend::Better;
        let command = new.command.clone().or(old.command.clone());
        differences.push(Difference {
            what: old.what.clone(),
            change,
            old: old.rate.clone(),
            new: new.rate.clone(),
            command: command.filter(|_| !is_better),
            shown: "",
        });
    }
    worst_first(&mut differences);
    RecordComparison {
        schema: DIFF_SCHEMA,
        same_cases,
        common: compared + chosen.both.len(),
        compared,
        differences,
        contracts: Vec::new(),
        chosen: chosen.both.iter().filter_map(other_value).collect(),
        accuracy: Vec::new(),
        only_old: counted.only_old + chosen.only_old,
        only_new: counted.only_new + chosen.only_new,
    }
}

/// The things that two records name alike, in the order of their names, and how many names only one of them has.
struct Common<T> {
    both: Vec<(T, T)>,
    only_old: usize,
    only_new: usize,
}

impl<T> Common<T> {
    fn of(old: Vec<T>, new: Vec<T>, name: fn(&T) -> &String) -> Common<T> {
        let by_name = |all: Vec<T>| -> BTreeMap<String, T> {
            all.into_iter().map(|it| (name(&it).clone(), it)).collect()
        };
        let mut new = by_name(new);
        let mut both = Vec::new();
        let mut only_old = 0;
        for (what, old) in by_name(old) {
            match new.remove(&what) {
                Some(new) => both.push((old, new)),
                None => only_old += 1,
            }
        }
        Common {
            both,
            only_old,
            only_new: new.len(),
        }
    }
}

/// A value that is another now. Only of a bound it is known which way is worse: up.
fn other_value((old, new): &(NamedValue, NamedValue)) -> Option<OtherValue> {
    if old.value == new.value {
        return None;
    }
    let [before, now] = [old, new].map(|it| it.value.parse::<f64>().ok());
    let trend = if before < now {
        Trend::Worse
    } else {
        Trend::Better
    };
    Some(OtherValue {
        what: old.what.clone(),
        change: new.is_bound.then_some(trend),
        old: old.value.clone(),
        new: new.value.clone(),
    })
}

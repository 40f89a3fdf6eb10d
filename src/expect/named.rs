//! Two records of one study that is no audit, side by side: its rates and its values by their names.

use super::compare::tail;
use super::difference::{DIFF_SCHEMA, Difference, DifferenceJudge, RecordComparison, worst_first};
use super::trend::{OtherValue, Trend};
use crate::report::{Comparable, NamedRate, NamedValue};
use std::collections::BTreeMap;

/// Compares what two studies of one kind counted, chose and proved, name by name. Rates differ as those of audits do.
pub fn difference_of<R: Comparable>(old: &R, new: &R) -> RecordComparison {
    /// How many names only the first has.
    fn lone<T>(of: &BTreeMap<String, T>, other: &BTreeMap<String, T>) -> usize {
        of.keys().filter(|what| !other.contains_key(*what)).count()
    }
    fn by_name<T>(all: Vec<T>, name: impl Fn(&T) -> String) -> BTreeMap<String, T> {
        all.into_iter().map(|it| (name(&it), it)).collect()
    }
    let [counted, counted_new] = [old, new].map(|it| by_name(it.counted(), |it| it.what.clone()));
    let [chosen, chosen_new] = [old, new].map(|it| by_name(it.chosen(), |it| it.what.clone()));
    let same_cases = old.cases() == new.cases();
    let common = || {
        counted
            .iter()
            .filter_map(|(what, old)| Some((what, old, counted_new.get(what)?)))
    };
    let compared = common().count();
    let judge = DifferenceJudge {
        same_parts: true,
        tail: tail(compared),
    };
    let differs = common()
        .filter(|(_, old, new)| (old.rate.count, old.rate.of) != (new.rate.count, new.rate.of));
    let difference = |(what, old, new): (&String, &NamedRate, &NamedRate)| Difference {
        what: what.clone(),
        change: judge.change(same_cases, &old.rate, &new.rate),
        old: old.rate.clone(),
        new: new.rate.clone(),
        command: new.command.clone().or(old.command.clone()),
        shown: "",
    };
    let mut differences: Vec<Difference> = differs.map(difference).collect();
    worst_first(&mut differences);
    let other = |(what, old): (&String, &NamedValue)| {
        let new = chosen_new.get(what).filter(|new| new.value != old.value)?;
        let [before, now] = [old, new].map(|it| it.value.parse::<f64>().ok());
        let trend = if before < now {
            Trend::Worse
        } else {
            Trend::Better
        };
        Some(OtherValue {
            what: what.clone(),
            change: new.is_bound.then_some(trend),
            old: old.value.clone(),
            new: new.value.clone(),
        })
    };
    RecordComparison {
        schema: DIFF_SCHEMA,
        same_cases,
        common: compared
            + chosen
                .keys()
                .filter(|what| chosen_new.contains_key(*what))
                .count(),
        compared,
        differences,
        contracts: Vec::new(),
        chosen: chosen.iter().filter_map(other).collect(),
        accuracy: Vec::new(),
        only_old: lone(&counted, &counted_new) + lone(&chosen, &chosen_new),
        only_new: lone(&counted_new, &counted) + lone(&chosen_new, &chosen),
    }
}

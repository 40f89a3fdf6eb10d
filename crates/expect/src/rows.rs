//! Rows that are set to something else than what was blessed: an epsilon, the contract or its band.

use super::{Expectations, LockedTarget, RowSettings};
use hairline_record::{Key, PlanPart, RowChange, RowPart};
use std::collections::{BTreeMap, BTreeSet};

impl Expectations {
    /// The same about the rows of a plan: where a kernel has one row in both, and only the name of its epsilons differs
    /// (`parallel=1e-6` became `parallel=1e-9`), they are about the new name, so that changes are counted and not
    /// totals.
    pub(super) fn following(mut self, plan: &PlanPart) -> Expectations {
        let mut known: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for Key { kernel, set, .. } in self.entries.keys() {
            known.entry(kernel.clone()).or_default().insert(set.clone());
        }
        for (kernel, sets) in known {
            let now: Vec<&RowPart> = plan
                .rows
                .iter()
                .filter(|row| row.kernel == kernel)
                .collect();
            if let (Some(was), [row]) = (sets.first().filter(|_| sets.len() == 1), &now[..])
                && *was != row.set
            {
                self.rename(&kernel, was, &row.set);
            }
        }
        self
    }

    fn rename(&mut self, kernel: &str, was: &str, now: &str) {
        let name = |of: &str, set: &mut String| {
            if of == kernel && set == was {
                now.clone_into(set);
            }
        };
        let key = |mut key: Key| {
            name(&key.kernel, &mut key.set);
            key
        };
        let entries = std::mem::take(&mut self.entries).into_iter();
        self.entries = entries.map(|(place, entry)| (key(place), entry)).collect();
        for target in self
            .lock
            .iter_mut()
            .flat_map(|lock| lock.targets.values_mut())
        {
            let LockedTarget {
                rows,
                cases,
                errors,
            } = std::mem::take(target);
            *target = LockedTarget {
                rows: rows
                    .into_iter()
                    .map(|([kernel, mut set], settings)| {
                        name(&kernel, &mut set);
                        ([kernel, set], settings)
                    })
                    .collect(),
                cases: cases
                    .into_iter()
                    .map(|(place, cases)| (key(place), cases))
                    .collect(),
                errors: errors
                    .into_iter()
                    .map(|([kernel, mut set, scalar, value], errors)| {
                        name(&kernel, &mut set);
                        ([kernel, set, scalar, value], errors)
                    })
                    .collect(),
            };
        }
    }
}

/// Where the rows of a plan differ from those of the expectations, in the order of the plan.
pub(super) fn changed_rows(plan: &PlanPart, known: &LockedTarget) -> Vec<RowChange> {
    plan.rows
        .iter()
        .flat_map(|row| changes(row, plan, known))
        .collect()
}

fn changes(row: &RowPart, plan: &PlanPart, known: &LockedTarget) -> Vec<RowChange> {
    let now = RowSettings::of(row);
    let change = |what: &str, before: &str, now: &str| RowChange {
        kernel: row.kernel.clone(),
        set: row.set.clone(),
        what: what.to_owned(),
        before: before.to_owned(),
        now: now.to_owned(),
    };
    let Some(before) = known.rows.get(&[row.kernel.clone(), row.set.clone()]) else {
        // The kernel ran with other epsilons, which have another name, and no longer does.
        let is_planned =
            |kernel: &str, set: &str| plan.rows.iter().any(|r| r.kernel == kernel && r.set == set);
        let gone = known
            .rows
            .iter()
            .filter(|([kernel, set], _)| *kernel == row.kernel && !is_planned(kernel, set));
        let gone = gone.map(|(_, before)| change("epsilons", &before.epsilons, &now.epsilons));
        return gone.collect();
    };
    let [old, new] = [before, &now].map(|settings| -> BTreeMap<&str, &str> {
        settings
            .epsilons
            .split(',')
            .filter_map(|word| word.split_once('='))
            .collect()
    });
    let names: BTreeSet<&&str> = old.keys().chain(new.keys()).collect();
    let epsilons = names.into_iter().filter_map(|name| {
        let [before, now] = [&old, &new].map(|all| all.get(name).copied().unwrap_or("none"));
        (before != now).then(|| change(&format!("epsilon {name}"), before, now))
    });
    let contract = (before.contract != now.contract)
        .then(|| change("contract", &before.contract, &now.contract));
    epsilons.chain(contract).collect()
}

//! Rows that are set to something else than what was blessed: an epsilon, the contract or its band.

use super::{Settings, Target};
use crate::report::{PlanPart, RowChange, RowPart};

/// Where the rows of a plan differ from those of the expectations, in the order of the plan.
pub(super) fn changed_rows(plan: &PlanPart, known: &Target) -> Vec<RowChange> {
    plan.rows.iter().flat_map(|row| changes(row, plan, known)).collect()
}

fn changes(row: &RowPart, plan: &PlanPart, known: &Target) -> Vec<RowChange> {
    let now = Settings::of(row);
    let change = |what: &str, before: &str, now: &str| RowChange {
        row: format!("{} ({})", row.kernel, row.set),
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
    let value = |settings: &Settings, name: &str| {
        let mut words = settings.epsilons.split(',').filter_map(|word| word.split_once('='));
        words.find(|(word, _)| *word == name).map_or("none", |(_, value)| value).to_owned()
    };
    let words = before.epsilons.split(',').chain(now.epsilons.split(','));
    let mut names: Vec<&str> = words.filter_map(|word| Some(word.split_once('=')?.0)).collect();
    names.sort_unstable();
    names.dedup();
    let epsilons = names.into_iter().filter_map(|name| {
        let [before, now] = [before, &now].map(|settings| value(settings, name));
        (before != now).then(|| change(&format!("epsilon {name}"), &before, &now))
    });
    let contract = (before.contract != now.contract)
        .then(|| change("contract", &before.contract, &now.contract));
    epsilons.chain(contract).collect()
}

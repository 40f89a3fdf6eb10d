//! The questions that `check` asks a kernel again before it calls a finding a change: answers that differ from run to run are neither
//! worse nor better.

use super::plugins;
use crate::arith::ScalarName;
use crate::audit::{self, CasePlace, Digest, Plan, Shard, Stock};
use crate::case::CaseId;
use crate::engine::Unobserved;
use crate::expect::{self, Expectations};
use crate::record::{
    Conformance, Context, Deviation, FindingClass, FindingKind, Key, ResultPart, build,
    disagreements,
};
use std::collections::BTreeMap;

/// How often a case is asked again.
const TIMES: usize = 4;

/// The findings of a class: digests by key.
type FindingDigests = BTreeMap<Key, String>;

/// Compares a run with its expectations, without the kernel rows of the plan whose answers differ from run to run.
pub fn compare(
    plan: Option<&Plan>,
    result: &ResultPart,
    target: &str,
    expected: &Expectations,
    file: Option<&str>,
) -> Conformance {
    let mut conformance = expect::compare(result, target, expected, file);
    let unsteady = plan.map_or(Vec::new(), |plan| unsteady(plan, result, &mut conformance));
    if unsteady.is_empty() {
        return conformance;
    }
    let is_unsteady = |key: &Key| unsteady.iter().any(|found| found.key().is_of_row(key));
    let mut steady = result.clone();
    steady
        .results
        .retain(|part| !is_unsteady(&Key::of(part, FindingClass::Any, FindingKind::Crash)));
    steady.totals.retain(|row| {
        let place = (&row.kernel, &row.set, row.scalar);
        unsteady
            .iter()
            .all(|found| (&found.kernel, &found.set, found.scalar) != place)
    });
    let expected = expected.clone().without(is_unsteady);
    let mut conformance = expect::compare(&steady, target, &expected, file);
    conformance.set_aside(unsteady);
    conformance
}

/// Asks the kernels of one's own again for what deviates. The first deviation of each row, in a scalar, whose answers differ
/// from run to run; what depends on the cases asked together says so in the comparison.
fn unsteady(plan: &Plan, result: &ResultPart, conformance: &mut Conformance) -> Vec<Deviation> {
    let mut unsteady: Vec<Deviation> = Vec::new();
    let mut whole = BTreeMap::new();
    let Conformance {
        unexpected, stale, ..
    } = conformance;
    let unexpected = unexpected.iter_mut().map(|found| (found, true));
    // A case of a stale entry is right now.
    let stale = stale.iter_mut().map(|found| (found, false));
    for (found, shows_it) in unexpected.chain(stale) {
        let key = found.key();
        if unsteady.iter().any(|other| other.key().is_of_row(&key)) {
            continue;
        }
        let Some((plan, place, count)) = part(plan, found) else {
            continue;
        };
        let is_other = || {
            let again = run(&plan, Shard::of_index(place.index, count));
            let again = findings(&again, &key);
            let is_other = if shows_it {
                again.is_empty()
            } else {
                // Another triangle of the group may have the finding still.
                has(&again, place)
            };
            // What a kernel says that was given up is nothing.
            is_other && plugins::check().is_ok()
        };
        let times = if key.finding.is_failure() { 1 } else { TIMES };
        if !(0..times).any(|_| is_other()) {
            continue;
        }
        let place = key.place().map(str::to_owned);
        let again = whole
            .entry(place)
            .or_insert_with(|| run(&plan, Shard::WHOLE));
        if plugins::check().is_err() {
            break;
        }
        let is = if shows_it { "is none" } else { "is one" };
        if findings(again, &key) == findings(result, &key) {
            found.expected += &format!(
                "; asked alone, the case shown {is}: the answer depends on the cases asked before it"
            );
        } else {
            let expected = format!(
                "the same answer each time, but answers differ from run to run: asked again, the case shown {is}"
            );
            unsteady.push(Deviation {
                expected,
                ..found.clone()
            });
        }
    }
    unsteady
}

/// True if one of the findings at the index of a place, which was asked about alone, is at its triangle.
fn has(found: &FindingDigests, place: CasePlace) -> bool {
    found.values().any(|digest| {
        let (none, digest) = (Digest::default(), Digest::try_from(digest.clone()));
        let digest = digest.unwrap_or_default();
        digest.beyond(&none, u64::MAX).any(|other| other == place)
    })
}

/// The part of a plan in which a deviation is, the place of the case shown, and how many indices there are; none of built-in
/// kernels, and where no case is shown.
fn part(plan: &Plan, found: &Deviation) -> Option<(Plan, CasePlace, u64)> {
    let is_row = |name: &str, set: &str| (name, set) == (&found.kernel, &found.set);
    let row = plan
        .rows
        .iter()
        .find(|row| is_row(row.entry.info.name, &row.set))?;
    let source = plan
        .sources
        .iter()
        .find(|source| source.name() == found.family)?;
    let case = found.case.as_ref().filter(|_| !row.entry.is_built_in())?;
    let (count, place) = in_named_scalar!(found.scalar, F => {
        let count = source.count::<F>();
        // The name of a stored case does not tell its place, even if it is the id of another source.
        let place = match source.stock {
            Stock::Corpus(_) => {
                let index = (0..count).find(|index| source.id::<F>(*index, None) == *case);
                index.map(|index| CasePlace { index, triangle: 0 })
            }
            _ => case.parse().ok().map(|id: CaseId| CasePlace {
                index: id.index,
                triangle: id.triangle.unwrap_or(0) as u32,
            }),
        };
        (count, place.filter(|place| place.index < count)?)
    });
    let scalars = [
        found.scalar == ScalarName::F32,
        found.scalar == ScalarName::F64,
    ];
    let (rows, sources) = (vec![row.clone()], vec![source.clone()]);
    Some((Plan::new(rows, sources, scalars, 1), place, count))
}

/// The findings of a part of a plan.
fn run(plan: &Plan, shard: Shard) -> ResultPart {
    let sums = audit::sum(plan, shard, &Unobserved);
    build(
        plan,
        &sums,
        &Context {
            seconds: 0.0,
            threads: 1,
        },
    )
    .result
}

/// Those of a class, or of all classes together.
fn findings(result: &ResultPart, key: &Key) -> FindingDigests {
    let found = disagreements(result).into_iter();
    let of_key = found.filter(|found| found.key == *key || found.key.of_all_classes() == *key);
    of_key
        .map(|found| (found.key, found.digest.to_owned()))
        .collect()
}

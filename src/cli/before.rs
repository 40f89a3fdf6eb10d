//! The decisions and notes before a run starts: its scalars, the number of its indices, its threads, and strange
//! stored rays.

use super::exit::{Failure, Status};
use super::flags::chosen_scalars;
use crate::arith::{Float, ScalarName};
use crate::audit::{self, CorpusSet, Plan, Row, Source, Stock};
use crate::case::{Parameters, Scene};
use crate::contract::Direction;
use crate::engine::Unobserved;
use crate::family::{self, TRIES, missed_sine};
use crate::judge::Finding;
use crate::mesh::SceneMesh;
use crate::record::number_of;
use std::collections::BTreeSet;

/// Why nothing runs: the scalars that the rows have.
fn no_scalar(rows: &[Row]) -> String {
    let other = rows
        .iter()
        .find_map(|row| ScalarName::among(row.entry.scalars()).next());
    let Some(scalar) = other else {
        return "no selected kernel runs in any scalar".to_owned();
    };
    let names: BTreeSet<&str> = rows.iter().map(|row| row.entry.info.name).collect();
    let who = match names.first() {
        Some(name) if names.len() == 1 => format!("{name} runs"),
        _ => "the selected kernels run".to_owned(),
    };
    format!("{who} in {scalar} alone: write --scalar {scalar}, or leave --scalar out")
}

/// The chosen scalars that a kernel runs in; an error if there are none, or if an epsilon is not representable in
/// one of them.
pub fn scalars_in_use(rows: &[Row], chosen: [bool; 2]) -> Result<[bool; 2], Failure> {
    let used = [0, 1].map(|i| chosen[i] && rows.iter().any(|row| row.entry.scalars()[i]));
    if used == [false; 2] {
        return Err(Failure::nothing(no_scalar(rows)));
    }
    rows.iter().try_for_each(|row| row.check_in(chosen))?;
    Ok(used)
}

/// The same where one scalar is run unless both are named: `f32`, or `f64` if no kernel runs in `f32`.
pub fn one_scalar(rows: &[Row], names: &[String]) -> Result<[bool; 2], Failure> {
    let is_in_f32 = rows.iter().any(|row| row.entry.scalars()[0]);
    let chosen = if names.is_empty() {
        [is_in_f32, !is_in_f32]
    } else {
        chosen_scalars(names)?
    };
    scalars_in_use(rows, chosen)
}

/// Refuses kernels whose t, u or v is wrong on plain hits: no epsilon and no offset can be right for them. They are run on
/// the control family, at the insides of well-shaped triangles; one hit in a hundred may be off there.
pub fn refuse_wrong_values(rows: &[Row], scalars: [bool; 2]) -> Result<(), Failure> {
    let unit_direction = rows
        .iter()
        .any(|row| row.contract.direction != Direction::Any);
    let parameters = Parameters {
        unit_direction,
        ..Parameters::default()
    };
    let family = family::find("interior").expect("the control family");
    let source = Source::of(family, parameters, 1, 1024);
    let plan = Plan::new(rows.to_vec(), vec![source], scalars, 1);
    for cell in audit::run(&plan, &Unobserved).cells {
        let total = cell.tally.total();
        let of = total.trials(Finding::WrongValue);
        let wrong = total.of(Finding::WrongValue) + total.of(Finding::BadValue);
        if of < wrong.saturating_mul(100) {
            let name = rows[cell.row].entry.info.name;
            let message = format!(
                "{name}: {wrong} of {of} plain hits in {} come with a wrong t, u, v or side, so no epsilon and no offset \
                 can be advised; `hairline audit {} --family interior` shows them",
                cell.scalar,
                rows[cell.row].entry.selector(),
            );
            return Err(Failure::Message(Status::Disagreements, message));
        }
    }
    Ok(())
}

/// Notes what is strange about the stored rays that start on their triangle, or should: that there are none though
/// the run asks about self-hits, and those that start far from it.
pub fn note_secondary_rays(rows: &[Row], sources: &[Source]) {
    let sets = sources.iter().filter_map(|source| match &source.stock {
        Stock::Corpus(set) => Some(set),
        _ => None,
    });
    let (marked, plain): (Vec<_>, Vec<_>) = sets.partition(|set| set.is_secondary);
    if rows.iter().any(|row| row.contract.no_self_hit) {
        let has_none = |set: &&&CorpusSet| !marked.iter().any(|other| other.file == set.file);
        for set in plain.iter().filter(has_none) {
            eprintln!(
                "note: no case of {} says \"starts\":\"on-triangle\", so no-self-hit demands nothing more of them",
                set.file
            );
        }
    }
    let asks_nothing = |row: &&Row| !row.contract.no_self_hit;
    if let (Some(set), Some(row)) = (marked.first(), rows.iter().find(asks_nothing)) {
        eprintln!(
            "note: rays of {} start on their triangle; {} is judged by the exact answer for the rounded start, unless \
             --contract own,no-self-hit makes every hit there wrong",
            set.file, row.entry.info.name
        );
    }
    for set in marked {
        let far = set.far_starts();
        if let Some(first) = far.first() {
            eprintln!(
                "warning: {} of {}: \"starts\":\"on-triangle\", but the ray starts farther from its triangle than \
                 that is large: {first} first. Is it a first ray?",
                number_of(far.len() as u64, "case", "cases"),
                set.file
            );
        }
    }
}

/// How many almost parallel rays are looked at before a run.
const LOOKED_AT: u64 = 1_000;

/// Notes how many almost parallel rays of a scene do not have the angle that was drawn for them, and which they have.
pub fn note_missed_angles(scene: &Scene, mesh: Option<&SceneMesh>, scalars: [bool; 2], seed: u64) {
    fn note<F: Float>(scene: &Scene, mesh: Option<&SceneMesh>, seed: u64) {
        let missed = (0..LOOKED_AT).filter_map(|index| match mesh {
            Some(mesh) => missed_sine(&mesh.triangles::<F>(scene), scene, seed, index),
            None => missed_sine::<F>(scene, scene, seed, index),
        });
        let missed: Vec<f64> = missed.collect();
        let ends = missed.iter().fold([1.0, 0.0], |[low, high], sine| {
            [sine.min(low), sine.max(high)]
        });
        if !missed.is_empty() {
            eprintln!(
                "note: the angle that was drawn is missed by {} of the first {LOOKED_AT} almost parallel rays in {}: none of \
                 {TRIES} tries has it in rounded numbers; these rays have sines from {:.1e} to {:.1e}",
                missed.len(),
                F::NAME,
                ends[0],
                ends[1],
            );
        }
    }
    for name in ScalarName::among(scalars) {
        in_named_scalar!(name, F => note::<F>(scene, mesh, seed));
    }
}

/// The indices of a run; an error if there are none.
pub fn total_indices(sources: &[Source], scalars: [bool; 2]) -> Result<u64, Failure> {
    match count_indices(sources, scalars) {
        0 => Err(Failure::nothing(
            "nothing to run: the sources have no case in the chosen scalars",
        )),
        total => Ok(total),
    }
}

/// How many indices the sources have in some scalars.
pub fn count_indices(sources: &[Source], scalars: [bool; 2]) -> u64 {
    let count =
        |name| -> u64 { in_named_scalar!(name, F => sources.iter().map(Source::count::<F>).sum()) };
    ScalarName::among(scalars).map(count).sum()
}

/// The scalars in which the sources have a case.
pub fn scalars_with_cases(sources: &[Source], scalars: [bool; 2]) -> [bool; 2] {
    let has = |count: fn(&Source) -> u64| sources.iter().any(|source| 0 < count(source));
    [
        scalars[0] && has(Source::count::<f32>),
        scalars[1] && has(Source::count::<f64>),
    ]
}

/// Sets the number of threads, all cores if none is given; returns how many there are.
pub fn set_threads(threads: Option<usize>) -> Result<usize, Failure> {
    if let Some(threads) = threads {
        if threads == 0 || threads > 4096 {
            return Err(Failure::usage(format!(
                "--threads: {threads} is not from 1 to 4096"
            )));
        }
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|error| Failure::Message(Status::InputOutput, error.to_string()))?;
    }
    Ok(rayon::current_num_threads())
}

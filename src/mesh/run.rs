//! The run: each ray once to the oracle and once to each kernel, with the triangles around its target.

use super::neighbours::may_be_elsewhere;
use super::rays::{Aim, Part, Targets};
use super::tally::{Offence, Outcome, Tally};
use super::topology::Topology;
use crate::audit::{Observer, Row, verdicts_of};
use crate::case::Case;
use crate::contract::{Across, Contract};
use crate::corpus::mesh::Mesh;
use crate::corpus::winds_once;
use crate::judge::{GroupTruth, group_truth, promises_direction};
use crate::kernel::{Scalar, Subject, Verdict};
use crate::oracle::{self, Layers};
use crate::truth::{Facing, Truth};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

/// What to run on a mesh.
pub struct Plan {
    /// The kernels with their epsilons and contracts.
    pub rows: Vec<Row>,
    /// Rays at each edge and vertex.
    pub directions: u64,
    /// Which random rays.
    pub seed: u64,
    /// Whether directions are replaced by their rounded unit vectors.
    pub unit_direction: bool,
    /// How many examples of each class and kind to keep, by index.
    pub examples: usize,
}

/// What a run in one scalar found.
pub struct Found {
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// The mesh in this scalar.
    pub topology: Topology,
    /// The rows whose kernels run in this scalar.
    pub rows: Vec<RowFound>,
    /// What some row did wrong, by part and target.
    pub offences: Vec<Offence>,
    /// Cases that went through the oracle: a ray and a triangle each.
    pub cases: u64,
    /// Which layer of the oracle decided.
    pub layers: Layers,
}

/// What one row did.
pub struct RowFound {
    /// The row's place in the plan.
    pub row: usize,
    /// By [`Part::ALL`].
    pub tallies: [Tally; 2],
    /// How many edges, and how many vertices, have a crack.
    pub cracked: [u64; 2],
    /// Time spent in the kernel, over all threads.
    pub nanoseconds: u64,
}

/// Indices that go through together; of vertices a quarter, which have more triangles.
const CHUNK: u64 = 1024;

/// Neighbours of crossings without a hit that go through together, about.
const NEIGHBOURS: usize = 4096;

/// Runs a plan on a mesh in one scalar. The sums do not depend on the number of threads.
pub fn run<F: Scalar>(
    mesh: &Mesh,
    topology: Topology,
    plan: &Plan,
    observer: &dyn Observer,
) -> Found {
    let targets = Targets::new::<F>(mesh, &topology, plan.seed, plan.unit_direction);
    let runner = Runner::<F>::new(&targets, plan, observer);
    let mut sums = Sums::new(&runner);
    let mut parts = Vec::new();
    for part in Part::ALL {
        let marks = Marks::new(targets.count(part), runner.rows.len());
        let (cut, indices) = match part {
            Part::Edges => (CHUNK, targets.count(part) * plan.directions),
            Part::Vertices => (CHUNK / 4, targets.count(part) * plan.directions),
        };
        let more = (0..indices.div_ceil(cut))
            .into_par_iter()
            .fold(
                || Sums::new(&runner),
                |mut sums, chunk| {
                    let end = indices.min((chunk + 1) * cut);
                    runner.add_chunk(part, chunk * cut..end, &marks, &mut sums);
                    sums
                },
            )
            .reduce(|| Sums::new(&runner), Sums::merged);
        sums = sums.merged(more);
        parts.push((part, marks));
    }
    let cracked = |row: usize| [&parts[0].1, &parts[1].1].map(|marks| marks.cracked(row));
    let rows = runner.rows.iter().zip(sums.rows).enumerate().map(|(i, (row, sums))| {
        let (tallies, nanoseconds) = sums;
        RowFound { row: row.number, tallies, cracked: cracked(i), nanoseconds }
    });
    let rows = rows.collect();
    let offences = parts.iter().flat_map(|(part, marks)| marks.offences(*part)).collect();
    let (cases, layers) = (sums.cases, sums.layers);
    drop(runner);
    Found { scalar: F::NAME, rows, offences, cases, layers, topology }
}

/// Which targets have what: shared by all threads. Additions and unions commute.
struct Marks {
    targets: Vec<[AtomicU32; 3]>,
    /// For each row a bit a target: whether it has a crack.
    cracked: Vec<Vec<AtomicU64>>,
}

impl Marks {
    fn new(targets: u64, rows: usize) -> Marks {
        let words = || (0..targets.div_ceil(64)).map(|_| AtomicU64::new(0)).collect();
        Marks {
            targets: (0..targets).map(|_| Default::default()).collect(),
            cracked: (0..rows).map(|_| words()).collect(),
        }
    }

    fn note(&self, row: usize, target: usize, outcome: Outcome, across: Across) {
        let kind = match outcome {
            Outcome::Right | Outcome::Elsewhere => return,
            Outcome::Crack => {
                self.cracked[row][target / 64].fetch_or(1 << (target % 64), Ordering::Relaxed);
                0
            }
            // Who does not promise it is not blamed for it.
            _ if across != Across::ExactlyOne => return,
            Outcome::Double => 1,
            Outcome::OddFold => 2,
        };
        self.targets[target][kind].fetch_add(1, Ordering::Relaxed);
    }

    fn cracked(&self, row: usize) -> u64 {
        let ones = |word: &AtomicU64| u64::from(word.load(Ordering::Relaxed).count_ones());
        self.cracked[row].iter().map(ones).sum()
    }

    fn offences(&self, part: Part) -> impl Iterator<Item = Offence> + '_ {
        let counts = |marks: &[AtomicU32; 3]| marks.each_ref().map(|n| n.load(Ordering::Relaxed));
        (0..).zip(&self.targets).filter_map(move |(target, marks)| {
            let [cracks, doubles, odd_folds] = counts(marks);
            (cracks + doubles + odd_folds > 0).then_some(Offence {
                part,
                target,
                cracks,
                doubles,
                odd_folds,
            })
        })
    }
}

/// What chunks add up to.
struct Sums {
    rows: Vec<([Tally; 2], u64)>,
    cases: u64,
    layers: Layers,
}

impl Sums {
    fn new<F: Scalar>(runner: &Runner<F>) -> Sums {
        let tallies = || std::array::from_fn(|_| Tally::new(runner.examples));
        let rows = runner.rows.iter().map(|_| (tallies(), 0)).collect();
        Sums { rows, cases: 0, layers: Layers::default() }
    }

    fn merged(mut self, other: Sums) -> Sums {
        self.cases += other.cases;
        self.layers.merge(&other.layers);
        for ((tallies, time), (more, more_time)) in self.rows.iter_mut().zip(other.rows) {
            tallies.iter_mut().zip(more).for_each(|(tally, more)| tally.merge(more));
            *time += more_time;
        }
        self
    }
}

/// A plan in one scalar, its kernels and epsilons resolved.
struct Runner<'a, F: Scalar> {
    targets: &'a Targets<'a>,
    rows: Vec<RunnerRow<F>>,
    /// The distinct contracts of the rows.
    contracts: Vec<Contract>,
    examples: usize,
    observer: &'a dyn Observer,
}

struct RunnerRow<F: 'static> {
    number: usize,
    subject: &'static dyn Subject<F>,
    epsilons: Vec<F>,
    contract: usize,
}

impl<'a, F: Scalar> Runner<'a, F> {
    fn new(targets: &'a Targets<'a>, plan: &Plan, observer: &'a dyn Observer) -> Self {
        let mut contracts: Vec<Contract> = Vec::new();
        let resolve = |(number, row): (usize, &Row)| {
            let subject = F::subject(row.entry)?;
            let known = contracts.iter().position(|contract| *contract == row.contract);
            let contract = known.unwrap_or_else(|| {
                contracts.push(row.contract);
                contracts.len() - 1
            });
            Some(RunnerRow { number, subject, epsilons: row.epsilons(), contract })
        };
        let rows = plan.rows.iter().enumerate().filter_map(resolve).collect();
        Runner { targets, rows, contracts, examples: plan.examples, observer }
    }

    fn add_chunk(&self, part: Part, indices: std::ops::Range<u64>, marks: &Marks, sums: &mut Sums) {
        let (mut cases, mut ends) = (Vec::new(), Vec::new());
        for index in indices.clone() {
            self.targets.make::<F>(part, index, &mut cases);
            ends.push(cases.len());
        }
        let mut truths = Vec::with_capacity(cases.len());
        oracle::truths(&cases, &mut truths, &mut sums.layers);
        sums.cases += cases.len() as u64;
        let groups = || {
            let starts = std::iter::once(0).chain(ends.iter().copied());
            indices.clone().zip(starts.zip(&ends).map(|(start, end)| start..*end))
        };
        let on_target: Vec<bool> =
            groups().map(|(_, group)| is_on_target(part, &truths[group])).collect();
        let ask = |contract: &Contract| -> Vec<GroupTruth> {
            let groups = groups().zip(&on_target);
            groups
                .map(|((index, group), on_target)| {
                    let around = (&cases[group.clone()], &truths[group]);
                    self.asked(part, index, around, contract, *on_target)
                })
                .collect()
        };
        let asked: Vec<Vec<GroupTruth>> = self.contracts.iter().map(ask).collect();
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        for (number, (row, (tallies, time))) in self.rows.iter().zip(&mut sums.rows).enumerate() {
            let start = self.observer.now();
            verdicts_of(row.subject, &cases, &row.epsilons, &mut verdicts);
            *time += self.observer.now() - start;
            let tally = &mut tallies[part as usize];
            let across = self.contracts[row.contract].across;
            let without = groups().zip(&asked[row.contract]).filter(|((_, group), truth)| {
                let mut verdicts = verdicts[group.clone()].iter();
                **truth == GroupTruth::Crossing
                    && verdicts.all(|verdict| !verdict.hit && verdict.failure.is_none())
            });
            let rays = without.filter_map(|((index, group), _)| {
                let facing = truths[group.start].crossing()?.facing;
                Some((index, &cases[group.start], facing))
            });
            let elsewhere = self.elsewhere(part, row, rays);
            let judged = groups().zip(&asked[row.contract]).zip(&on_target);
            for (((index, group), truth), on_target) in judged {
                let verdicts = &verdicts[group];
                if verdicts.iter().any(|verdict| verdict.failure.is_some()) {
                    tally.fail(index);
                    continue;
                }
                let hits = verdicts.iter().filter(|verdict| verdict.hit).count();
                let (target, ray) = self.targets.place(part, index);
                let mut outcome = Outcome::of(*truth, hits);
                if outcome == Outcome::Crack && elsewhere.binary_search(&index).is_ok() {
                    outcome = Outcome::Elsewhere;
                }
                tally.add(index, (Aim::of(ray), *on_target), (*truth, hits), outcome);
                marks.note(number, target, outcome, across);
            }
        }
        self.observer.advance(ends.len() as u64);
    }

    /// Of crossings without a hit, by index, those whose hit may be among the neighbours.
    fn elsewhere<'c>(
        &self,
        part: Part,
        row: &RunnerRow<F>,
        rays: impl Iterator<Item = (u64, &'c Case<F>, Facing)>,
    ) -> Vec<u64> {
        let (mut elsewhere, mut cases, mut waiting) = (Vec::new(), Vec::new(), Vec::new());
        let ask = |cases: &mut Vec<Case<F>>, waiting: &mut Vec<(u64, Facing, usize)>| {
            let mut truths = Vec::with_capacity(cases.len());
            oracle::truths(cases, &mut truths, &mut Layers::default());
            let mut verdicts = vec![Verdict::miss(None); cases.len()];
            if !cases.is_empty() {
                verdicts_of(row.subject, cases, &row.epsilons, &mut verdicts);
            }
            let mut start = 0;
            let found = waiting.drain(..).filter_map(|(index, facing, end)| {
                let around = std::mem::replace(&mut start, end)..end;
                let contract = &self.contracts[row.contract];
                let (truths, verdicts) = (&truths[around.clone()], &verdicts[around.clone()]);
                may_be_elsewhere(facing, &cases[around], truths, verdicts, contract)
                    .then_some(index)
            });
            let found: Vec<u64> = found.collect();
            cases.clear();
            found
        };
        for (index, case, facing) in rays {
            let (target, _) = self.targets.place(part, index);
            // Who could not be asked is not accused.
            let Some(more) = self.targets.neighbours(part, target, case) else {
                elsewhere.push(index);
                continue;
            };
            cases.extend(more);
            waiting.push((index, facing, cases.len()));
            if cases.len() >= NEIGHBOURS {
                elsewhere.extend(ask(&mut cases, &mut waiting));
            }
        }
        elsewhere.extend(ask(&mut cases, &mut waiting));
        elsewhere.sort_unstable();
        elsewhere
    }

    /// What a contract asks of the triangles around a target together.
    fn asked(
        &self,
        part: Part,
        index: u64,
        (cases, truths): (&[Case<F>], &[Truth]),
        contract: &Contract,
        on_target: bool,
    ) -> GroupTruth {
        let direction: [F; 3] = cases[0].ray.direction.into();
        if !promises_direction(contract.direction, direction) {
            return GroupTruth::Free;
        }
        let asked = group_truth(truths, contract, part.grouping());
        // A fan that goes around its centre twice has two triangles on each side of it.
        if asked == GroupTruth::Crossing && part == Part::Vertices && on_target {
            let (target, _) = self.targets.place(part, index);
            let ring: Vec<[f64; 3]> = self.targets.ring::<F>(target);
            let centre = self.targets.points(part, target)[0];
            if !winds_once(direction.map(F::to_f64), self.targets.position::<F>(centre), &ring) {
                return GroupTruth::Free;
            }
        }
        asked
    }
}

/// Whether the exact line meets the edge that the triangles share, or the centre of the fan.
fn is_on_target(part: Part, truths: &[Truth]) -> bool {
    truths.iter().all(|truth| {
        truth.crossing().is_some_and(|crossing| match part {
            Part::Edges => crossing.feature.is_edge(),
            Part::Vertices => crossing.feature.is_vertex(),
        })
    })
}

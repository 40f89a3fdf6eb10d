//! Judges the verdicts of one row on a chunk.

use super::accuracy::Errors;
use super::chunk::Chunk;
use super::digest::Digest;
use super::neighbours::KnownNeighbours;
use super::rows::RowIn;
use super::source::Source;
use super::tally::{ClassCount, Tally};
use super::trials::RayProducts;
use crate::case::Case;
use crate::contract::Contract;
use crate::family::Grouping;
use crate::judge::{
    self, Class, Demands, Distances, Finding, GroupTruth, Obligation, RelatedValues, ValueErrors,
    polygon_obligation, polygon_truth,
};
use crate::kernel::{Failure, KernelIn, Scalar, Verdict};
use crate::truth::Feature;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// A contract's demands on a chunk.
pub(super) struct ChunkDemands {
    pub expectations: Demands,
    /// The demands, counted by class.
    pub classes: Vec<ClassCount>,
    pub groups: Arc<[GroupTruth]>,
}

/// Answers that rows need of a chunk where they are wrong: whoever asks first has them computed, for all.
pub(super) struct KnownOfChunk<F: Scalar> {
    cases: Vec<Option<LazyCase>>,
    neighbours: KnownNeighbours<F>,
}

impl<F: Scalar> KnownOfChunk<F> {
    /// Nothing yet of so many cases.
    pub fn new(cases: usize) -> KnownOfChunk<F> {
        KnownOfChunk {
            cases: vec![None; cases],
            neighbours: KnownNeighbours::default(),
        }
    }
}

/// Data of a case on which some row is wrong.
#[derive(Clone, Copy)]
struct LazyCase {
    /// None of invalid input.
    distances: Option<Distances>,
    /// The hash of the case's place.
    hash: u128,
}

impl LazyCase {
    fn of<F: Scalar>(chunk: &Chunk<F>, case: usize) -> LazyCase {
        let valid = !chunk.class(case).is_invalid();
        LazyCase {
            distances: valid.then(|| chunk.distances(case)),
            hash: Digest::hash(chunk.places[case]),
        }
    }
}

impl<F: Scalar> RowIn<F> {
    /// Judges the verdicts; only `suspects` can show a finding ([`judge::suspects`]).
    pub fn judge(
        &self,
        (source, chunk): (&Source, &Chunk<F>),
        (contract, asked): (&Contract, &ChunkDemands),
        (verdicts, suspects): (&[Verdict<F>], &[usize]),
        known: &mut KnownOfChunk<F>,
        tally: &mut Tally,
    ) {
        tally.ask(&asked.classes);
        let gives = chunk.judged(self.info.gives);
        let class = |i: usize| chunk.class(i);
        // Who is no suspect hit where a hit was asked, and missed where a miss was.
        let mut hits: [u64; Class::COUNT] = std::array::from_fn(|i| asked.classes[i].must_hit);
        for &i in &asked.expectations.free {
            hits[class(i).number()] += u64::from(verdicts[i].hit);
        }
        let shares_a_ray = chunk.grouping.shares_a_ray();
        let mut found = Vec::new();
        for &i in suspects {
            let (case, truth) = (&chunk.cases[i], &chunk.truths[i]);
            let (verdict, obligation) = (&verdicts[i], asked.expectations.of[i].obligation());
            let number = class(i).number();
            match obligation {
                Obligation::MustHit => hits[number] -= u64::from(!verdict.hit),
                Obligation::MustMiss => hits[number] += u64::from(verdict.hit),
                Obligation::Free => {}
            }
            let asked = (contract, obligation);
            if let Some(finding) = judge::judge(asked, (case, truth), gives, verdict) {
                // Kernels tend to be wrong on the same cases.
                let LazyCase { distances, hash } =
                    known.cases[i].get_or_insert_with(|| LazyCase::of(chunk, i));
                let severity = distances.as_ref().map(|distances| {
                    let edges = match finding {
                        Finding::WrongValue => ValueErrors::of(case, truth, gives, verdict).edges,
                        _ => distances.nearest_change(truth, contract),
                    };
                    (edges, distances.edge_in_ulps)
                });
                if self.is_own && finding == Finding::WrongValue {
                    let tolerance = contract.value_tolerance;
                    let values = RelatedValues::of(case, gives, verdict, tolerance);
                    let before = i.checked_sub(1).map(|place| &verdicts[place]);
                    tally.relations.add_values(&values, verdict, before);
                }
                tally.find(class(i), finding, (chunk.places[i], *hash), severity);
                if finding.is_failure() {
                    tally.classes[number].fail(obligation);
                }
                if shares_a_ray {
                    found.push((i, finding));
                }
            }
        }
        if shares_a_ray {
            add_rays(chunk, asked, verdicts, &found, tally);
        }
        tally.hits(&hits);
        if self.is_own {
            self.relate_answers(chunk, contract, asked, verdicts, &mut tally.relations);
        }
        if chunk.grouping == Grouping::SecondaryRay {
            tally.self_hits.rays += verdicts.len() as u64;
            tally.self_hits.hits += verdicts.iter().filter(|verdict| verdict.hit).count() as u64;
        }
        let groups = (contract, &asked.groups[..]);
        let around = &mut known.neighbours;
        let judged = self.judge_groups(source, chunk, groups, verdicts, around);
        for group in judged.flatten() {
            tally.group(&group, chunk.aimed(group.index), contract.across);
        }
    }

    /// Measures the values of right hits on a sample.
    pub fn measure(
        &self,
        chunk: &Chunk<F>,
        sample: &[usize],
        asked: &ChunkDemands,
        verdicts: &[Verdict<F>],
        tally: &mut Tally,
    ) {
        let gives = chunk.judged(self.info.gives);
        for &i in sample {
            let (truth, verdict) = (&chunk.truths[i], &verdicts[i]);
            let Some(crossing) = truth.crossing() else {
                continue;
            };
            let may_hit = asked.expectations.of[i].obligation() != Obligation::MustMiss;
            let is_right = verdict.hit && may_hit;
            if is_right && crossing.feature != Feature::Outside {
                tally
                    .accuracy
                    .add(&Errors::of(&chunk.cases[i], crossing, gives, verdict));
            }
        }
    }

    /// Judges each polygon as a whole; its truth is that of the union of its fan.
    pub fn judge_polygons(&self, chunk: &Chunk<F>, contract: &Contract, tally: &mut Tally) {
        let gives = chunk.judged(self.info.gives);
        for (index, range) in chunk.groups() {
            let (cases, truths) = (&chunk.cases[range.clone()], &chunk.truths[range]);
            let owed = polygon_obligation(cases, truths, contract);
            let verdict = polygon_verdict(self.subject, cases, &self.epsilons);
            let union = (&cases[0], &polygon_truth(truths));
            let finding = judge::judge((contract, owed), union, gives, &verdict);
            tally.polygon(index, (owed, verdict.hit, finding));
        }
    }
}

/// Adds up, ray by ray, what was found on the triangles of each.
fn add_rays<F: Scalar>(
    chunk: &Chunk<F>,
    asked: &ChunkDemands,
    verdicts: &[Verdict<F>],
    found: &[(usize, Finding)],
    tally: &mut Tally,
) {
    const FINDINGS: usize = Finding::ALL.len();
    // The last is of all classes together.
    let mut sums = [[RayProducts::default(); FINDINGS]; Class::COUNT + 1];
    let mut found = found.iter().peekable();
    let mut counts: Vec<(usize, ClassCount)> = Vec::new();
    for (_, range) in chunk.groups() {
        counts.clear();
        counts.push((Class::COUNT, ClassCount::default()));
        for i in range {
            let class = chunk.class(i);
            let mut count = ClassCount::default();
            let obligation = asked.expectations.of[i].obligation();
            count.ask(obligation, 1);
            count.hits = u64::from(verdicts[i].hit);
            count.valued_hits = if class.is_invalid() { 0 } else { count.hits };
            while let Some((_, finding)) = found.next_if(|(at, _)| *at == i) {
                count.find(*finding, !class.is_invalid());
                if finding.is_failure() {
                    count.fail(obligation);
                }
            }
            counts[0].1.merge(&count);
            match counts
                .iter_mut()
                .find(|(number, _)| *number == class.number())
            {
                Some((_, sum)) => sum.merge(&count),
                None => counts.push((class.number(), count)),
            }
        }
        for (number, count) in &counts {
            for finding in Finding::ALL {
                let sum = &mut sums[*number][finding as usize];
                sum.add_ray(count.of(finding), count.trials(finding));
            }
        }
    }
    let keys = Class::all().map(Some).chain([None]);
    for (class, sums) in keys.zip(sums) {
        for (finding, sum) in Finding::ALL.into_iter().zip(sums) {
            if sum.of_squared > 0 {
                tally
                    .products
                    .entry((class, finding))
                    .or_default()
                    .merge(&sum);
            }
        }
    }
}

/// A kernel's verdict on a polygon, given as its fan.
pub fn polygon_verdict<F: Scalar>(
    subject: &dyn KernelIn<F>,
    cases: &[Case<F>],
    epsilons: &[F],
) -> Verdict<F> {
    let Case { ray, triangle } = &cases[0];
    let mut vertices = vec![triangle.a, triangle.b];
    vertices.extend(cases.iter().map(|case| case.triangle.c));
    let run = || subject.run_polygon(&vertices, ray, epsilons);
    catch_unwind(AssertUnwindSafe(run)).unwrap_or(Verdict::failed(Failure::Panic))
}

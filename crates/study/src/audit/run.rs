//! The run: each case once to the oracle and once to each kernel.

use super::causes::{self, Causes};
use super::chunk::{Chunk, SourceSummary};
use super::judging::{ChunkDemands, KnownOfChunk};
use super::plan::Plan;
use super::rows::Rows;
use super::shard::Shard;
use super::source::Source;
use super::tally::{ClassCount, Tally};
use crate::arith::ScalarName;
use crate::engine::{self, Merge, Observer};
use crate::family::Grouping;
use crate::judge::{self, Class, Finding};
use crate::kernel::{Scalar, Verdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;

/// One kernel row on one source in one scalar.
#[derive(Clone, Serialize, Deserialize)]
pub struct SourceCell {
    /// The row's place in the plan.
    pub row: usize,
    /// The source's place in the plan.
    pub source: usize,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// The counts and findings.
    pub tally: Tally,
    /// Why, by class and finding; once finished.
    #[serde(skip)]
    pub causes: BTreeMap<(Class, Finding), Causes>,
    /// Time spent in the kernel, over all threads.
    pub nanoseconds: u64,
}

impl SourceCell {
    /// A cell with a tally; its causes are not looked for yet.
    fn new(
        row: usize,
        source: usize,
        scalar: ScalarName,
        tally: Tally,
        nanoseconds: u64,
    ) -> SourceCell {
        SourceCell {
            row,
            source,
            scalar,
            tally,
            causes: BTreeMap::new(),
            nanoseconds,
        }
    }
}

/// All sums of a run.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Audit {
    /// By scalar, source and row, in the order of the plan.
    pub cells: Vec<SourceCell>,
    /// By scalar and source, in the order of the plan.
    pub sources: Vec<SourceSummary>,
}

/// Runs a plan.
pub fn run(plan: &Plan, observer: &dyn Observer) -> Audit {
    let mut audit = sum(plan, Shard::WHOLE, observer);
    finish(plan, observer, &mut audit);
    audit
}

/// The sums of a part of a plan. Those of all parts can be merged, and are then to be finished.
pub fn sum(plan: &Plan, shard: Shard, observer: &dyn Observer) -> Audit {
    let mut audit = Audit::default();
    if plan.scalars[0] {
        sum_scalar::<f32>(plan, shard, observer, &mut audit);
    }
    if plan.scalars[1] {
        sum_scalar::<f64>(plan, shard, observer, &mut audit);
    }
    audit
}

/// Finds the causes of the findings, of the first by index, and keeps as many examples as the plan asks.
pub fn finish(plan: &Plan, observer: &dyn Observer, audit: &mut Audit) {
    finish_scalar::<f32>(plan, observer, audit);
    finish_scalar::<f64>(plan, observer, audit);
}

/// Runs a plan in one scalar.
pub fn run_scalar<F: Scalar>(plan: &Plan, observer: &dyn Observer, audit: &mut Audit) {
    sum_scalar::<F>(plan, Shard::WHOLE, observer, audit);
    finish_scalar::<F>(plan, observer, audit);
}

fn sum_scalar<F: Scalar>(plan: &Plan, shard: Shard, observer: &dyn Observer, audit: &mut Audit) {
    let runner = Runner::<F>::new(plan, observer);
    for (number, source) in plan.sources.iter().enumerate() {
        let empty = || runner.no_sums(number);
        let add = |sums: &mut SourceSums, indices| runner.add_chunk(source, indices, sums);
        let indices = shard.range(source.count::<F>());
        runner.add_to(
            engine::sum(indices, source.chunk(), observer, empty, add),
            audit,
        );
    }
}

fn finish_scalar<F: Scalar>(plan: &Plan, observer: &dyn Observer, audit: &mut Audit) {
    let runner = Runner::<F>::new(plan, observer);
    let cells: Vec<&mut SourceCell> = audit
        .cells
        .iter_mut()
        .filter(|cell| cell.scalar == F::NAME)
        .collect();
    let causes = engine::map(&cells, |cell| {
        runner.causes(&plan.sources[cell.source], cell)
    });
    for (cell, causes) in cells.into_iter().zip(causes) {
        cell.causes = causes;
        cell.tally.keep_examples(plan.examples);
    }
}

impl Audit {
    /// The sums of no case.
    pub fn of_nothing(plan: &Plan) -> Audit {
        let mut audit = Audit::default();
        if plan.scalars[0] {
            audit.add_nothing::<f32>(plan);
        }
        if plan.scalars[1] {
            audit.add_nothing::<f64>(plan);
        }
        audit
    }

    fn add_nothing<F: Scalar>(&mut self, plan: &Plan) {
        for source in 0..plan.sources.len() {
            self.sources.push(SourceSummary::new(source, F::NAME));
            let rows = plan.rows.iter().enumerate();
            let running = rows.filter(|(_, row)| F::subject(row.entry).is_some());
            self.cells.extend(running.map(|(row, _)| {
                SourceCell::new(row, source, F::NAME, Tally::new(plan.limits()), 0)
            }));
        }
    }
}

/// The sums over a source.
struct SourceSums {
    summary: SourceSummary,
    rows: Vec<(Tally, u64)>,
}

impl Merge for SourceSums {
    fn merge(&mut self, other: SourceSums) {
        self.summary.merge(&other.summary);
        for ((tally, time), (more, more_time)) in self.rows.iter_mut().zip(other.rows) {
            tally.merge(more);
            *time += more_time;
        }
    }
}

/// A plan in one scalar, its kernels and epsilons resolved.
struct Runner<'a, F: Scalar> {
    rows: Rows<F>,
    plan: &'a Plan,
    observer: &'a dyn Observer,
}

impl<'a, F: Scalar> Runner<'a, F> {
    fn new(plan: &'a Plan, observer: &'a dyn Observer) -> Self {
        Runner {
            rows: Rows::new(&plan.rows),
            plan,
            observer,
        }
    }

    fn no_sums(&self, source: usize) -> SourceSums {
        let tally = || Tally::new(self.plan.limits());
        SourceSums {
            summary: SourceSummary::new(source, F::NAME),
            rows: self.rows.each.iter().map(|_| (tally(), 0)).collect(),
        }
    }

    /// Puts what a source added up to at the end of the sums.
    fn add_to(&self, sums: SourceSums, audit: &mut Audit) {
        let source = sums.summary.source;
        audit.sources.push(sums.summary);
        let rows = self.rows.each.iter().zip(sums.rows);
        audit.cells.extend(rows.map(|(row, (tally, nanoseconds))| {
            SourceCell::new(row.number, source, F::NAME, tally, nanoseconds)
        }));
    }

    fn causes(&self, source: &Source, cell: &SourceCell) -> BTreeMap<(Class, Finding), Causes> {
        let row = self.rows.each.iter().find(|row| row.number == cell.row);
        row.map_or_else(BTreeMap::new, |row| {
            let contract = &self.rows.contracts[row.contract];
            causes::causes(source, row, contract, &cell.tally, self.plan.attribute)
        })
    }

    /// The demands of each contract on a chunk.
    fn ask(&self, chunk: &Chunk<F>) -> Vec<ChunkDemands> {
        let ask = |(contract, groups)| {
            let expectations = chunk.expectations(contract);
            let mut classes = vec![ClassCount::default(); Class::COUNT];
            for (class, obligation, cases) in &expectations.counts {
                classes[class.number()].ask(*obligation, *cases);
            }
            ChunkDemands {
                expectations,
                classes,
                groups,
            }
        };
        let contracts = &self.rows.contracts;
        contracts
            .iter()
            .zip(chunk.group_truths_of_all(contracts))
            .map(ask)
            .collect()
    }

    /// The cases of a chunk on which the values of hits are measured.
    fn sample(&self, source: &Source, chunk: &Chunk<F>) -> Vec<usize> {
        let measured = self.plan.measured.max(self.plan.attribute);
        if measured == 0 {
            return Vec::new();
        }
        let every = source.count::<F>().div_ceil(measured as u64).max(1);
        let sampled = chunk
            .groups()
            .filter(|(index, _)| index.is_multiple_of(every));
        sampled.flat_map(|(_, cases)| cases).collect()
    }

    fn add_chunk(&self, source: &Source, indices: Range<u64>, sums: &mut SourceSums) {
        let chunk = Chunk::make(source, indices, self.observer, &mut sums.summary);
        let sample = self.sample(source, &chunk);
        let asked = self.ask(&chunk);
        let mut verdicts = vec![Verdict::miss(None); chunk.cases.len()];
        let mut known = KnownOfChunk::new(chunk.cases.len());
        let limits = chunk.limits();
        let mut suspects = Vec::new();
        for (row, (tally, time)) in self.rows.each.iter().zip(&mut sums.rows) {
            *time += row.run(&chunk.cases, &mut verdicts, self.observer);
            let contract = &self.rows.contracts[row.contract];
            let asked = &asked[row.contract];
            let of = (&asked.expectations.of[..], &limits[..]);
            judge::suspects(of, chunk.judged(row.info.gives), &verdicts, &mut suspects);
            let found = (&verdicts[..], &suspects[..]);
            row.judge(
                (source, &chunk),
                (contract, asked),
                found,
                &mut known,
                tally,
            );
            row.measure(&chunk, &sample, asked, &verdicts, tally);
            // Rounded polygons are not planar, and have no truth as a whole.
            if chunk.grouping == Grouping::Polygon && row.info.polygons && source.keeps_truth() {
                row.judge_polygons(&chunk, contract, tally);
            }
        }
    }
}

//! The audit: each configuration once to the exact determinant and once to each predicate.

use super::predicate::{Row, Scalar};
use super::{Answer, Dimension, FAMILIES, Finding, Points, ScaledPoints, judge};
use crate::engine::{self, Merge, Observer};
use std::cmp::Ordering;
use std::ops::Range;

/// The plan of a run: every family of each dimension, in each scalar.
pub struct Plan {
    /// The predicates with their epsilons.
    pub rows: Vec<Row>,
    /// The dimensions.
    pub dimensions: Vec<Dimension>,
    /// True for each scalar that runs: `f32`, `f64`.
    pub scalars: [bool; 2],
    /// Cases of each family.
    pub count: u64,
    /// Which random cases.
    pub seed: u64,
}

impl Plan {
    /// All cases of a run.
    pub fn cases(&self) -> u64 {
        let scalars = self.scalars.iter().filter(|&&chosen| chosen).count();
        (self.dimensions.len() * scalars * FAMILIES.len()) as u64 * self.count
    }
}

/// The findings of one row on one set: sums, and the first index of each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// By [`Finding::ALL`].
    pub findings: [u64; Finding::ALL.len()],
    /// The lowest index of each finding.
    pub first: [Option<u64>; Finding::ALL.len()],
}

impl Counts {
    fn add(&mut self, finding: Finding, index: u64) {
        self.findings[finding as usize] += 1;
        self.merge_first(finding as usize, Some(index));
    }

    fn merge_first(&mut self, finding: usize, index: Option<u64>) {
        let first = &mut self.first[finding];
        *first = first.iter().copied().chain(index).min();
    }

    fn merge(&mut self, other: &Counts) {
        for k in 0..Finding::ALL.len() {
            self.findings[k] += other.findings[k];
            self.merge_first(k, other.first[k]);
        }
    }
}

/// A set of points: a family of a dimension in a scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SetSummary {
    /// The dimension.
    pub dimension: Dimension,
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// The family's place in [`FAMILIES`].
    pub family: usize,
    /// Cases made.
    pub cases: u64,
    /// Cases whose determinant is exactly 0.
    pub zeros: u64,
    /// Cases that do not keep the family's promise.
    pub promise_broken: u64,
    /// The first of them.
    pub first_broken: Option<u64>,
}

impl SetSummary {
    /// How many cases could have shown a finding: a wrong sign any, since a NaN is one whatever the
    /// truth.
    pub fn trials(&self, finding: Finding) -> u64 {
        match finding {
            Finding::WrongSign => self.cases,
            Finding::FalseZero => self.cases - self.zeros,
            Finding::MissedZero => self.zeros,
        }
    }
}

/// One row on one set.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// The row's place in the plan.
    pub row: usize,
    /// The set's place in [`Sums::sets`].
    pub set: usize,
    /// The counts of answers.
    pub counts: Counts,
    /// Time spent in the predicate, over all threads.
    pub nanoseconds: u64,
}

/// All sums of a run.
#[derive(Default)]
pub struct Sums {
    /// By dimension, scalar and family.
    pub sets: Vec<SetSummary>,
    /// By set and row.
    pub cells: Vec<Cell>,
}

/// Indices that go through a run together.
const CHUNK: u64 = 1024;

/// Runs a plan. All but the times is the same whatever the number of threads.
pub fn run(plan: &Plan, observer: &dyn Observer) -> Sums {
    let mut sums = Sums::default();
    for &dimension in &plan.dimensions {
        if plan.scalars[0] {
            run_scalar::<f32>(plan, dimension, observer, &mut sums);
        }
        if plan.scalars[1] {
            run_scalar::<f64>(plan, dimension, observer, &mut sums);
        }
    }
    sums
}

fn run_scalar<F: Scalar>(
    plan: &Plan,
    dimension: Dimension,
    observer: &dyn Observer,
    sums: &mut Sums,
) {
    let rows: Vec<(usize, &Row)> =
        plan.rows.iter().enumerate().filter(|(_, row)| row.runs::<F>(dimension)).collect();
    for family in 0..FAMILIES.len() {
        let empty = || Part {
            set: SetSummary {
                dimension,
                scalar: F::NAME,
                family,
                cases: 0,
                zeros: 0,
                promise_broken: 0,
                first_broken: None,
            },
            rows: vec![(Counts::default(), 0); rows.len()],
        };
        let add = |part: &mut Part, indices| part.add_chunk::<F>(plan, &rows, indices, observer);
        let part = engine::sum(0..plan.count, CHUNK, observer, empty, add);
        let set = sums.sets.len();
        sums.sets.push(part.set);
        let cells = rows.iter().zip(part.rows);
        sums.cells.extend(cells.map(|(&(row, _), (counts, nanoseconds))| Cell {
            row,
            set,
            counts,
            nanoseconds,
        }));
    }
}

/// The sums over some chunks of a set.
struct Part {
    set: SetSummary,
    rows: Vec<(Counts, u64)>,
}

impl Part {
    fn add_chunk<F: Scalar>(
        &mut self,
        plan: &Plan,
        rows: &[(usize, &Row)],
        indices: Range<u64>,
        observer: &dyn Observer,
    ) {
        let Range { start, end } = indices;
        let family = &FAMILIES[self.set.family];
        let dimension = self.set.dimension;
        let cases: Vec<Points<F>> =
            (start..end).map(|index| family.make(dimension, plan.seed, index)).collect();
        let signs: Vec<Option<Ordering>> = cases
            .iter()
            .zip(start..)
            .map(|(points, index)| {
                let exact = ScaledPoints::new(points).map(|scaled| {
                    let determinant = scaled.determinant();
                    (family.keeps::<F>(dimension, &scaled, &determinant), determinant.sign())
                });
                self.ask(index, exact);
                exact.map(|(_, sign)| sign)
            })
            .collect();
        let mut determinants: Vec<F> = Vec::with_capacity(cases.len());
        for (&(_, row), (counts, nanoseconds)) in rows.iter().zip(&mut self.rows) {
            let Some(batch) = F::batch(row.predicate) else { continue };
            let epsilon = row.epsilon();
            let before = observer.now();
            batch(&cases, &mut determinants);
            *nanoseconds += observer.now() - before;
            for ((&determinant, sign), index) in determinants.iter().zip(&signs).zip(start..) {
                let answer = Answer::of(determinant, epsilon);
                if let Some(finding) = sign.and_then(|sign| judge(answer, sign)) {
                    counts.add(finding, index);
                }
            }
        }
    }

    /// Counts a case: whether it keeps the promise, and its sign; a case without a sign does not keep it.
    fn ask(&mut self, index: u64, exact: Option<(bool, Ordering)>) {
        let set = &mut self.set;
        set.cases += 1;
        set.zeros += u64::from(exact.is_some_and(|(_, sign)| sign == Ordering::Equal));
        if !exact.is_some_and(|(keeps, _)| keeps) {
            set.promise_broken += 1;
            set.first_broken = set.first_broken.into_iter().chain([index]).min();
        }
    }
}

impl Merge for Part {
    fn merge(&mut self, other: Part) {
        self.set.cases += other.set.cases;
        self.set.zeros += other.set.zeros;
        self.set.promise_broken += other.set.promise_broken;
        let first = self.set.first_broken.into_iter().chain(other.set.first_broken).min();
        self.set.first_broken = first;
        for ((counts, nanoseconds), (more, more_nanoseconds)) in
            self.rows.iter_mut().zip(&other.rows)
        {
            counts.merge(more);
            *nanoseconds += more_nanoseconds;
        }
    }
}

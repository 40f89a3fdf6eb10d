//! An audit: slab tests against families, in counts that add up in any order.

use crate::case::{BoxCase, Boxes};
use crate::family::Made;
use crate::judge::{Finding, Obligation, severity};
use crate::oracle::truth;
use crate::setup::Setup;
use crate::source::Source;
use hairline_core::engine::{Merge, Observer, sum};
use hairline_core::kernel::{Scalar, Subject, verdicts_of};
use hairline_core::{Extent, ScalarName, Verdict};
use std::cell::OnceCell;
use std::ops::Range;

/// How many cases go through at once.
const CHUNK: u64 = 1024;

/// The counts of one slab test on one source of cases. Sums come out the same however they are split.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// All cases.
    pub cases: u64,
    /// The cases that it hit.
    pub hits: u64,
    /// The cases that it had to hit.
    pub must_hit: u64,
    /// The cases that it had to miss.
    pub must_miss: u64,
    /// Hits of what must be missed.
    pub false_hits: Wrong,
    /// Misses of what must be hit.
    pub false_misses: Wrong,
    /// Cases without a verdict.
    pub failed: Wrong,
    /// Pairs of neighbours of which one must be hit at least.
    pub owed_pairs: u64,
    /// Those of them that it lost in both.
    pub lost_pairs: u64,
}

/// Wrong verdicts of one kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wrong {
    /// How many.
    pub count: u64,
    /// The least index of such a case.
    pub first: Option<u64>,
    /// The most severe of them, and its index.
    pub worst: Option<Worst>,
}

/// The most severe wrong verdict.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// How far off, as a share of the largest coordinate.
    pub severity: f64,
    /// The case.
    pub index: u64,
}

impl Worst {
    /// The more severe of two; of equals that of the lower index.
    fn of(self, other: Worst) -> Worst {
        let order = self.severity.total_cmp(&other.severity);
        let of_equals = other.index.cmp(&self.index);
        if order.then(of_equals).is_lt() {
            other
        } else {
            self
        }
    }
}

impl Wrong {
    fn add(&mut self, index: u64, severity: Option<f64>) {
        self.merge(Wrong {
            count: 1,
            first: Some(index),
            worst: severity.map(|severity| Worst { severity, index }),
        });
    }
}

impl Merge for Wrong {
    fn merge(&mut self, other: Wrong) {
        self.count += other.count;
        let both = self.first.into_iter().chain(other.first);
        self.first = both.min();
        let both = self.worst.into_iter().chain(other.worst);
        self.worst = both.reduce(Worst::of);
    }
}

impl Merge for Tally {
    fn merge(&mut self, other: Tally) {
        self.cases += other.cases;
        self.hits += other.hits;
        self.must_hit += other.must_hit;
        self.must_miss += other.must_miss;
        self.false_hits.merge(other.false_hits);
        self.false_misses.merge(other.false_misses);
        self.failed.merge(other.failed);
        self.owed_pairs += other.owed_pairs;
        self.lost_pairs += other.lost_pairs;
    }
}

impl Tally {
    /// The share of the cases with an obligation on which it was wrong; none if there are no such cases.
    pub fn rate(&self) -> Option<f64> {
        let owed = self.must_hit + self.must_miss;
        let false_verdicts = self.false_hits.count + self.false_misses.count;
        let wrong = false_verdicts + self.failed.count;
        (owed > 0).then(|| wrong as f64 / owed as f64)
    }

    fn add<F: Made>(&mut self, judged: &Judged<F>, verdict: &Verdict<F>, extent: Extent) {
        let Judged {
            index, obligation, ..
        } = *judged;
        self.cases += 1;
        self.hits += u64::from(verdict.hit);
        self.must_hit += u64::from(obligation == Obligation::Hit);
        self.must_miss += u64::from(obligation == Obligation::Miss);
        let severity = || judged.severity(extent);
        match obligation.judge(verdict) {
            Finding::Right => {}
            Finding::FalseHit => self.false_hits.add(index, severity()),
            Finding::FalseMiss => self.false_misses.add(index, severity()),
            Finding::Failed => self.failed.add(index, None),
        }
    }
}

/// A case with what a setup owes on it.
struct Judged<'a, F: Made> {
    case: &'a BoxCase<F>,
    index: u64,
    obligation: Obligation,
    severities: &'a Severities,
}

/// The severity of a wrong verdict on a case, by extent. It is rational, and most slab tests are wrong on the same cases.
type Severities = [OnceCell<Option<f64>>; 3];

impl<F: Made> Judged<'_, F> {
    fn severity(&self, extent: Extent) -> Option<f64> {
        let known = &self.severities[extent as usize];
        *known.get_or_init(|| severity(self.case, extent))
    }
}

/// A line of an audit.
#[derive(Clone, Debug)]
pub struct Row {
    /// The slab test, with its epsilons.
    pub setup: Setup,
    /// The source of its cases, as it prints itself.
    pub source: String,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// The counts.
    pub tally: Tally,
}

/// The tallies of all setups on one source.
struct Tallies(Vec<Tally>);

impl Merge for Tallies {
    fn merge(&mut self, other: Tallies) {
        for (tally, more) in self.0.iter_mut().zip(other.0) {
            tally.merge(more);
        }
    }
}

/// Every setup on the first cases of every source, in a scalar. A setup that does not run in it has no row.
pub fn audit<F: Made + Scalar>(
    setups: &[Setup],
    sources: &[Source],
    count: u64,
    seed: u64,
    observer: &dyn Observer,
) -> Vec<Row> {
    let running: Vec<Running<F>> = setups.iter().filter_map(Running::new).collect();
    let mut rows = Vec::new();
    for source in sources {
        let empty = || Tallies(vec![Tally::default(); running.len()]);
        let add =
            |tallies: &mut Tallies, indices| add_chunk(tallies, &running, source, seed, indices);
        let tallies = sum(0..count, CHUNK, observer, empty, add);
        for (running, tally) in running.iter().zip(tallies.0) {
            rows.push(Row {
                setup: running.setup.clone(),
                source: source.to_string(),
                scalar: F::NAME,
                tally,
            });
        }
    }
    rows
}

/// A setup in one scalar.
struct Running<'a, F: Made> {
    setup: &'a Setup,
    subject: &'static dyn Subject<F, Boxes>,
    epsilons: Vec<F>,
}

impl<'a, F: Made + Scalar> Running<'a, F> {
    fn new(setup: &'a Setup) -> Option<Running<'a, F>> {
        Some(Running {
            setup,
            subject: F::subject(setup.entry)?,
            epsilons: setup.epsilons::<F>()?,
        })
    }
}

fn add_chunk<F: Made + Scalar>(
    tallies: &mut Tallies,
    running: &[Running<F>],
    source: &Source,
    seed: u64,
    indices: Range<u64>,
) {
    let first = indices.start;
    let cases = source.cases::<F>(seed, indices);
    let truths: Vec<_> = cases.iter().map(truth).collect();
    let severities = vec![Severities::default(); cases.len()];
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    for (running, tally) in running.iter().zip(&mut tallies.0) {
        let contract = &running.setup.contract;
        let owed = |truth| Obligation::new(truth, contract) == Obligation::Hit;
        verdicts_of(running.subject, &cases, &running.epsilons, &mut verdicts);
        for (index, case) in cases.iter().enumerate() {
            let judged = Judged {
                case,
                index: first + index as u64,
                obligation: Obligation::new(&truths[index], contract),
                severities: &severities[index],
            };
            tally.add(&judged, &verdicts[index], contract.extent);
        }
        if source.is_of_pairs() {
            for (truths, verdicts) in truths.chunks(2).zip(verdicts.chunks(2)) {
                let is_owed = truths.iter().any(owed);
                let is_lost = verdicts.iter().all(|verdict| !verdict.hit);
                tally.owed_pairs += u64::from(is_owed);
                tally.lost_pairs += u64::from(is_owed && is_lost);
            }
        }
    }
}

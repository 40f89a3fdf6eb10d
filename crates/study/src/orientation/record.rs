//! The record of a run, versioned: `result` is the same bytes whatever the number of threads.

use super::predicate::{Row, Scalar};
use super::{Answer, Dimension, FAMILIES, Finding, Plan, Points, ScaledPoints, Sums, judge};
use crate::arith::Float;
use crate::audit::Trials;
use serde::Serialize;

/// The schema's name and version.
pub const SCHEMA: &str = "hairline-orientation/1";

/// Everything that a run found.
#[derive(Clone, Debug, Serialize)]
pub struct Record {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// The findings.
    pub result: ResultPart,
    /// How it was made.
    pub provenance: Provenance,
}

/// The findings of a run.
#[derive(Clone, Debug, Serialize)]
pub struct ResultPart {
    /// Which random cases.
    pub seed: u64,
    /// Cases of each family.
    pub count: u64,
    /// The sets of points, by dimension, scalar and family.
    pub sets: Vec<SetPart>,
    /// One entry for each set and predicate row.
    pub results: Vec<RowResult>,
    /// The first example of each row, scalar and finding.
    pub examples: Vec<ExamplePart>,
}

/// A set of points.
#[derive(Clone, Debug, Serialize)]
pub struct SetPart {
    /// 2 or 3.
    pub dimension: usize,
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// The family's name.
    pub family: &'static str,
    /// Its version.
    pub version: u32,
    /// Cases made.
    pub cases: u64,
    /// Cases whose determinant is exactly 0.
    pub zeros: u64,
    /// Cases that do not keep the family's promise.
    pub promise_broken: u64,
    /// The id of the first of them.
    pub first_broken: Option<String>,
}

/// A predicate row on a set.
#[derive(Clone, Debug, Serialize)]
pub struct RowResult {
    /// 2 or 3.
    pub dimension: usize,
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// The predicate's name.
    pub predicate: &'static str,
    /// Its epsilon.
    pub epsilon: Option<String>,
    /// The family's name.
    pub family: &'static str,
    /// Opposite signs and NaN, of all cases.
    pub wrong_sign: Rate,
    /// The false zeros among the cases whose determinant is not 0.
    pub false_zero: Rate,
    /// The missed zeros among the cases whose determinant is 0.
    pub missed_zero: Rate,
}

/// A count of those that could have shown it, with its 95 % interval (Clopper-Pearson).
#[derive(Clone, Debug, Serialize)]
pub struct Rate {
    /// How many.
    pub count: u64,
    /// The number of trials.
    pub of: u64,
    /// Their quotient; none without a trial.
    pub rate: Option<f64>,
    /// Low and high; none without a trial.
    pub interval: Option<[f64; 2]>,
    /// The id of the first.
    pub first: Option<String>,
}

/// An example of a finding.
#[derive(Clone, Debug, Serialize)]
pub struct ExamplePart {
    /// The predicate's name.
    pub predicate: &'static str,
    /// Its epsilon.
    pub epsilon: Option<String>,
    /// Which finding.
    pub finding: &'static str,
    /// The case.
    pub case: CasePart,
}

/// One case: its points, the truth, and what predicates say.
#[derive(Clone, Debug, Serialize)]
pub struct CasePart {
    /// Its id, or the name of a curated one.
    pub id: String,
    /// 2 or 3.
    pub dimension: usize,
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// The points, each number exactly.
    pub points: Vec<Vec<f64>>,
    /// Their bit patterns in hexadecimal.
    pub bits: Vec<Vec<String>>,
    /// `-`, `0` or `+`.
    pub sign: &'static str,
    /// The determinant as a fraction in lowest terms, its power of two unexpanded.
    pub determinant: String,
    /// The answer of each predicate.
    pub answers: Vec<AnswerPart>,
}

/// A predicate's answer.
#[derive(Clone, Debug, Serialize)]
pub struct AnswerPart {
    /// The predicate's name.
    pub predicate: &'static str,
    /// Its epsilon.
    pub epsilon: Option<String>,
    /// `-`, `0`, `+` or `NaN`.
    pub answer: &'static str,
    /// The determinant that it computed, as text: it need not be finite.
    pub determinant: String,
    /// The kind of wrong answer, if it is wrong.
    pub finding: Option<&'static str>,
}

/// How a run was made: never compared.
#[derive(Clone, Debug, Serialize)]
pub struct Provenance {
    /// `hairline` and its version.
    pub tool: String,
    /// Wall-clock time.
    pub seconds: f64,
    /// Threads that worked.
    pub threads: usize,
    /// One entry for each of `results`, in the same order.
    pub timings: Vec<TimingPart>,
}

/// The time of a row on a set.
#[derive(Clone, Debug, Serialize)]
pub struct TimingPart {
    /// Nanoseconds a call.
    pub nanoseconds_per_call: f64,
}

/// Makes the record of a run.
pub fn build(plan: &Plan, sums: &Sums, seconds: f64, threads: usize) -> Record {
    let sets = sums.sets.iter().map(|set| {
        let family = &FAMILIES[set.family];
        SetPart {
            dimension: set.dimension.number(),
            scalar: set.scalar,
            family: family.name,
            version: family.version,
            cases: set.cases,
            zeros: set.zeros,
            promise_broken: set.promise_broken,
            first_broken: set.first_broken.map(|index| id(plan, sums, set_place(sums, set), index)),
        }
    });
    let results = sums.cells.iter().map(|cell| {
        let set = &sums.sets[cell.set];
        let row = &plan.rows[cell.row];
        let rate = |finding: Finding| {
            let (count, of) = (cell.counts.findings[finding as usize], set.trials(finding));
            let first = cell.counts.first[finding as usize];
            let interval = (of > 0).then(|| Trials::independent(count, of).interval());
            Rate {
                count,
                of,
                rate: (of > 0).then(|| count as f64 / of as f64),
                interval: interval.map(|interval| [interval.low, interval.high]),
                first: first.map(|index| id(plan, sums, cell.set, index)),
            }
        };
        RowResult {
            dimension: set.dimension.number(),
            scalar: set.scalar,
            predicate: row.predicate.name,
            epsilon: row.epsilon.clone(),
            family: FAMILIES[set.family].name,
            wrong_sign: rate(Finding::WrongSign),
            false_zero: rate(Finding::FalseZero),
            missed_zero: rate(Finding::MissedZero),
        }
    });
    let timings = sums.cells.iter().map(|cell| TimingPart {
        nanoseconds_per_call: cell.nanoseconds as f64 / sums.sets[cell.set].cases.max(1) as f64,
    });
    Record {
        schema: SCHEMA,
        result: ResultPart {
            seed: plan.seed,
            count: plan.count,
            sets: sets.collect(),
            results: results.collect(),
            examples: examples(plan, sums),
        },
        provenance: Provenance {
            tool: concat!("hairline ", env!("CARGO_PKG_VERSION")).to_owned(),
            seconds,
            threads,
            timings: timings.collect(),
        },
    }
}

fn set_place(sums: &Sums, set: &super::SetSummary) -> usize {
    sums.sets.iter().position(|other| other == set).unwrap_or(0)
}

fn id(plan: &Plan, sums: &Sums, set: usize, index: u64) -> String {
    let set = &sums.sets[set];
    let family = &FAMILIES[set.family];
    in_named_scalar!(set.scalar, F => family.id::<F>(set.dimension, plan.seed, index)).to_string()
}

/// By dimension, scalar, row and finding: the first family that shows it, at its lowest index.
fn examples(plan: &Plan, sums: &Sums) -> Vec<ExamplePart> {
    let mut examples = Vec::new();
    let mut groups: Vec<(Dimension, &'static str)> =
        sums.sets.iter().map(|set| (set.dimension, set.scalar)).collect();
    groups.dedup();
    for group in groups {
        for (number, row) in plan.rows.iter().enumerate() {
            for finding in Finding::ALL {
                let mut cells = sums.cells.iter().filter(|cell| {
                    let set = &sums.sets[cell.set];
                    cell.row == number && (set.dimension, set.scalar) == group
                });
                let found = cells.find_map(|cell| {
                    let index = cell.counts.first[finding as usize]?;
                    let case = made(plan, sums, cell.set, index, row)?;
                    Some(ExamplePart {
                        predicate: row.predicate.name,
                        epsilon: row.epsilon.clone(),
                        finding: finding.name(),
                        case,
                    })
                });
                examples.extend(found);
            }
        }
    }
    examples
}

/// A case of a run again, with one row's answer.
fn made(plan: &Plan, sums: &Sums, set: usize, index: u64, row: &Row) -> Option<CasePart> {
    let id = id(plan, sums, set, index);
    let set = &sums.sets[set];
    let family = &FAMILIES[set.family];
    let rows = std::slice::from_ref(row);
    in_named_scalar!(set.scalar, F => {
        show::<F>(id, &family.make(set.dimension, plan.seed, index), rows)
    })
}

/// One case with the answers of those rows that run on it; none if its points are not finite.
pub fn show<F: Scalar>(id: String, points: &Points<F>, rows: &[Row]) -> Option<CasePart> {
    let determinant = ScaledPoints::new(points)?.determinant();
    let sign = determinant.sign();
    let answers = rows.iter().filter_map(|row| {
        let (computed, answer) = row.answer(points)?;
        Some(AnswerPart {
            predicate: row.predicate.name,
            epsilon: row.epsilon.clone(),
            answer: answer.symbol(),
            determinant: format!("{computed:?}"),
            finding: judge(answer, sign).map(Finding::name),
        })
    });
    Some(CasePart {
        id,
        dimension: points.dimension().number(),
        scalar: F::NAME,
        points: points.widen().iter().map(<[f64]>::to_vec).collect(),
        bits: points.iter().map(|p| p.iter().copied().map(Float::hex).collect()).collect(),
        sign: Answer::from(sign).symbol(),
        determinant: determinant.to_string(),
        answers: answers.collect(),
    })
}

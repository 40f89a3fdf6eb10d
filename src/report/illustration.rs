//! What a report's pictures are drawn from: computed beside a run, on few cases, and no part of its
//! result.

use super::epsilon::shortest;
use crate::arith::Float;
use crate::audit::{Observer, Plan, Row, Source, clopper_pearson};
use crate::kernel::Scalar;
use crate::response::{Axis, Curve, Question, Sketch, few, sketch};
use serde::{Deserialize, Serialize};

/// Indices of each source that the responses are counted on.
const FEW: u64 = 400;
/// Points of a response's curve that are kept.
const POINTS: usize = 96;

/// What pictures are drawn from; only where they were asked for.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Illustrations {
    /// Indices of each source that the responses are counted on, at most.
    pub indices: u64,
    /// The names of those sources.
    pub families: Vec<String>,
    /// One for each row, scalar and gate that takes an epsilon.
    pub responses: Vec<ResponsePart>,
}

/// How wrong a kernel row is as one of its epsilons varies and the others stay.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ResponsePart {
    /// The kernel's name.
    pub kernel: String,
    /// What its epsilons are called.
    pub set: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// The gate's name.
    pub gate: String,
    /// The row's own epsilon, the shortest decimal of the scalar; `own` has its counts.
    pub epsilon: String,
    /// What is wrong at the row's own epsilon.
    pub own: [u64; 3],
    /// How many could be wrong: false misses, false hits that this gate is there to refuse, cracks.
    pub asked: [u64; 3],
    /// Whether they are a random sample.
    pub sample: bool,
    /// Epsilons in order, each with how many are wrong; constant before the first and after the last.
    /// What lies between two points lies between their counts.
    pub points: Vec<(String, [u64; 3])>,
    /// The fewest false misses, and the last epsilon with so few.
    pub misses: (u64, String),
    /// The fewest false hits that this gate is there to refuse, and the first epsilon with so few.
    pub hits: (u64, String),
}

/// The questions of a response's counts.
const QUESTIONS: [Question; 3] = [Question::FalseMiss, Question::OwnFalseHit, Question::Crack];

/// Computes what the pictures of a plan's report are drawn from: the same whatever the number of threads.
pub fn illustrations(plan: &Plan, observer: &dyn Observer) -> Illustrations {
    let sources = few(&plan.sources, FEW);
    let mut responses = Vec::new();
    if plan.scalars[0] {
        add_responses::<f32>(plan, &sources, observer, &mut responses);
    }
    if plan.scalars[1] {
        add_responses::<f64>(plan, &sources, observer, &mut responses);
    }
    let families = sources.iter().map(Source::name).collect();
    Illustrations { indices: FEW, families, responses }
}

/// The responses of the rows that show their gates.
fn add_responses<F: Scalar>(
    plan: &Plan,
    sources: &[Source],
    observer: &dyn Observer,
    all: &mut Vec<ResponsePart>,
) {
    let axis = Axis::new(&[]);
    let sample = sources.iter().any(Source::is_sample);
    for row in &plan.rows {
        let gated = F::subject(row.entry).and_then(|subject| subject.gated());
        let sketches =
            gated.map(|gated| sketch::<F>(row, gated, sources, &axis, observer)).unwrap_or_default();
        all.extend(sketches.iter().map(|sketch| response(row, sketch, sample)));
    }
}

fn response<F: Scalar>(row: &Row, sketch: &Sketch<F>, sample: bool) -> ResponsePart {
    let curves = QUESTIONS.map(|question| sketch.total.curve(question));
    // Every margin was kept, so that nothing is bracketed.
    let wrong = |epsilon: F| curves.map(|curve| curve.wrong(epsilon).low);
    let own: F = row.epsilons()[sketch.gate];
    let trade = &sketch.trade;
    let points = thinned(curves, &wrong);
    ResponsePart {
        kernel: row.entry.info.name.to_owned(),
        set: row.set.clone(),
        scalar: F::NAME.to_owned(),
        gate: row.entry.info.gates[sketch.gate].name.to_owned(),
        epsilon: shortest(own),
        own: wrong(own),
        asked: curves.map(|curve| curve.total),
        sample,
        points: points.into_iter().map(|(e, counts)| (shortest(e), counts)).collect(),
        misses: (trade.misses.unavoidable, shortest(trade.misses.limit)),
        hits: (trade.hits.unavoidable, shortest(trade.hits.limit)),
    }
}

/// The epsilons at which something changes visibly, with the counts there.
fn thinned<F: Float>(
    curves: [&Curve<F>; 3],
    wrong: &impl Fn(F) -> [u64; 3],
) -> Vec<(F, [u64; 3])> {
    let mut epsilons: Vec<F> = curves.iter().flat_map(|curve| curve.steps()).collect();
    epsilons.retain(|epsilon| epsilon.is_finite() && curves[0].floor <= *epsilon);
    epsilons.sort_by_key(|epsilon| epsilon.place());
    epsilons.dedup_by(|a, b| a == b);
    let all: Vec<(F, [u64; 3])> = epsilons.into_iter().map(|e| (e, wrong(e))).collect();
    // Coarser and coarser, until few are left.
    let mut step = 0.04;
    loop {
        let mut kept: Vec<(F, [u64; 3])> = Vec::new();
        for (i, (epsilon, counts)) in all.iter().enumerate() {
            let seen = kept.last().is_none_or(|(_, last)| differ(last, counts, step));
            if seen || i + 1 == all.len() {
                kept.push((*epsilon, *counts));
            }
        }
        if kept.len() <= POINTS {
            return kept;
        }
        step *= 1.5;
    }
}

/// Whether one of the counts has changed by a share of itself.
fn differ(a: &[u64; 3], b: &[u64; 3], step: f64) -> bool {
    a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) as f64 > step * *a.max(b) as f64)
}

impl ResponsePart {
    /// The share of a question that is wrong, with its 95 % interval if it is of a sample; none of
    /// nothing.
    pub fn share(&self, question: usize, counts: [u64; 3]) -> Option<(f64, Option<[f64; 2]>)> {
        let (count, of) = (counts[question], self.asked[question]);
        let interval = || {
            let interval = clopper_pearson(count, of);
            [interval.low, interval.high]
        };
        (0 < of).then(|| (count as f64 / of as f64, self.sample.then(interval)))
    }
}

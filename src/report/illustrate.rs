//! Computes what a report's pictures are drawn from.

use super::epsilon::shortest;
use super::illustration::{Illustrations, MapPart, ResponsePart};
use crate::arith::Float;
use crate::audit::{Observer, Plan, Row, Source};
use crate::epsilon::{Axis, Curve, Question, Sketch, few, sketch};
use crate::kernel::Scalar;
use crate::map::{self, Ink, Map, Spot};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Indices of each source that the responses are counted on.
const FEW: u64 = 400;
/// Points of a response's curve that are kept.
const POINTS: usize = 96;
/// Pixels of a map's panel on a side.
const PIXELS: usize = 64;

/// The questions of a response's counts.
const QUESTIONS: [Question; 3] = [Question::FalseMiss, Question::OwnFalseHit, Question::Crack];

/// Computes what the pictures of a plan's report are drawn from, without proofs: the same whatever the number of
/// threads.
pub fn illustrations(plan: &Plan, observer: &dyn Observer) -> Illustrations {
    let sources = few(&plan.sources, FEW);
    let families = sources.iter().map(Source::name).collect();
    let mut all = Illustrations {
        indices: FEW,
        families,
        responses: Vec::new(),
        maps: Vec::new(),
        proofs: Vec::new(),
    };
    if plan.scalars[0] {
        add::<f32>(plan, &sources, observer, &mut all);
    }
    if plan.scalars[1] {
        add::<f64>(plan, &sources, observer, &mut all);
    }
    all
}

/// All of one scalar. A kernel that panics on the way has no pictures: the run counts its panics.
fn add<F: Scalar>(
    plan: &Plan,
    sources: &[Source],
    observer: &dyn Observer,
    all: &mut Illustrations,
) {
    let axis = Axis::new(&[]);
    for row in plan.rows.iter().filter(|row| F::subject(row.entry).is_some()) {
        let responses = || responses::<F>(row, sources, &axis, observer);
        let responses = catch_unwind(AssertUnwindSafe(responses));
        all.responses.extend(responses.unwrap_or_default());
        for spot in Spot::ALL {
            let map =
                catch_unwind(AssertUnwindSafe(|| map::standard::<F>(row, spot, [PIXELS; 2]).ok()));
            let map = map.ok().flatten();
            all.maps.extend(map.and_then(|map| map_part(row, spot, &map)));
        }
    }
}

fn map_part(row: &Row, spot: Spot, map: &Map) -> Option<MapPart> {
    let counts = |legend: Vec<(Ink, &'static str, usize)>| -> Vec<(String, u64)> {
        legend.into_iter().map(|(_, words, n)| (words.to_owned(), n as u64)).collect()
    };
    Some(MapPart {
        kernel: row.entry.info.name.to_owned(),
        set: row.set.clone(),
        scalar: map.scalar.to_owned(),
        spot: spot.name().to_owned(),
        size: map.size().map(|side| side as u64),
        axes: map.axes.each_ref().map(|axis| {
            format!("{} in steps of {} about {}", axis.name, axis.step.describe(), axis.centre)
        }),
        wrong: map.wrong() as u64,
        computed: counts(map.computed_legend()),
        exact: counts(map.exact_legend()),
        png: BASE64_STANDARD.encode(map::png(map, 1).ok()?),
    })
}

/// The responses of a row, if it tells its margins.
fn responses<F: Scalar>(
    row: &Row,
    sources: &[Source],
    axis: &Axis<F>,
    observer: &dyn Observer,
) -> Vec<ResponsePart> {
    let subject = F::subject(row.entry).filter(|subject| subject.tells_margins());
    let Some(subject) = subject else { return Vec::new() };
    let sample = sources.iter().any(Source::is_sample);
    let sketches = sketch::<F>(row, subject, sources, axis, observer);
    if subject.margins_gave_up().is_some() {
        return Vec::new();
    }
    sketches.iter().map(|sketch| response(row, sketch, sample)).collect()
}

fn response<F: Scalar>(row: &Row, sketch: &Sketch<F>, sample: bool) -> ResponsePart {
    let curves = QUESTIONS.map(|question| sketch.total.curve(question));
    // Every margin was kept, so that nothing is bracketed.
    let wrong = |epsilon: F| curves.map(|curve| curve.wrong(epsilon).low);
    let own: F = row.epsilons()[sketch.gate];
    let trade = &sketch.trade;
    let points = thinned(curves, &wrong);
    let asked = curves.map(|curve| curve.total);
    let squared = curves.map(|curve| curve.squared);
    ResponsePart {
        kernel: row.entry.info.name.to_owned(),
        set: row.set.clone(),
        scalar: F::NAME.to_owned(),
        gate: row.entry.info.gates[sketch.gate].name.to_owned(),
        epsilon: shortest(own),
        own: wrong(own),
        asked,
        asked_squared: (squared != asked).then_some(squared),
        sample,
        points: points.into_iter().map(|(e, counts)| (shortest(e), counts)).collect(),
        misses: (trade.misses.unavoidable, shortest(trade.misses.limit)),
        hits: (trade.hits.unavoidable, shortest(trade.hits.limit)),
    }
}

/// The epsilons at which something changes visibly, with the counts there.
fn thinned<F: Float>(curves: [&Curve<F>; 3], wrong: &impl Fn(F) -> [u64; 3]) -> Vec<(F, [u64; 3])> {
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

/// True if one of the counts has changed by a share of itself.
fn differ(a: &[u64; 3], b: &[u64; 3], step: f64) -> bool {
    a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) as f64 > step * *a.max(b) as f64)
}

//! The values that are weighed for each knob: round numbers over the range in which they matter.

use super::errors::MaxError;
use super::joint::KnobGrid;
use super::knob::{Knob, MOST_KNOBS};
use super::rays::{Rays, WrongKind};
use super::trials::{Pass, Setting, Trial};
use crate::arith::{Float, smallest_normal};
use crate::case::{DirectionLength, Scene};
use crate::engine::Merge;
use crate::kernel::{Dimension, Gate, Role, Scalar};
use std::ops::RangeInclusive;

/// The first indices of a set show the range.
const PILOT: u64 = 2048;

/// The decades of the numbers that are weighed.
const DECADES: RangeInclusive<i32> = -330..=310;

/// How far the range reaches beyond what the pilot shows at an edge, of self-hits, and of hits that are too far off.
const BEYOND: f64 = 100.0;

/// The ends of a range of sizes.
type Ends = [f64; 2];

/// The range without what is smaller than its largest value by the scalar's precision, three times over, since products
/// of lengths are compared. That does no more than the least float, at which a strict comparison accepts already.
fn that_matters<F: Float>([low, high]: Ends) -> Ends {
    let negligible = F::EPSILON.to_f64().powi(3);
    [low.max(high * negligible), high]
}

/// The most values of a knob on each side of zero.
const MOST_VALUES: usize = 60;

/// The most points of the grid of a study.
pub const MOST_POINTS: usize = 300_000;

/// The largest size of a knob that means anything: a tolerance as large as the largest triangle, or the
/// longest way; without a scene any number.
fn cap(knob: Knob, gates: &[Gate], scene: Option<&Scene>) -> f64 {
    let Some(scene) = scene else { return f64::MAX };
    let gate = knob.gate(gates);
    let [shortest_edge, longest_edge] = scene.edge;
    let farthest = scene.distance[1].max(longest_edge);
    let size = if gate.role == Role::T {
        farthest
    } else {
        longest_edge
    };
    let [slowest, fastest] = match scene.direction {
        DirectionLength::Unit => [1.0, 1.0],
        DirectionLength::Target => [shortest_edge, farthest],
        DirectionLength::Mixed => [shortest_edge.min(1.0 / 64.0), farthest.max(64.0)],
    };
    let Dimension { length, direction } = gate.dimension;
    let speed = if direction < 0 { slowest } else { fastest };
    size.powi(length.into()) * speed.powi(direction.into())
}

/// By knob: the smallest and the largest margin above zero, and of those below zero their sizes.
#[derive(Default)]
struct Ranges {
    above: [Option<Ends>; MOST_KNOBS],
    below: [Option<Ends>; MOST_KNOBS],
}

fn widen(range: &mut Option<Ends>, size: f64) {
    let [low, high] = range.unwrap_or([size, size]);
    *range = Some([low.min(size), high.max(size)]);
}

fn join(range: &mut Option<Ends>, other: Option<Ends>) {
    for end in other.into_iter().flatten() {
        widen(range, end);
    }
}

impl Merge for Ranges {
    fn merge(&mut self, other: Ranges) {
        for knob in 0..MOST_KNOBS {
            join(&mut self.above[knob], other.above[knob]);
            join(&mut self.below[knob], other.below[knob]);
        }
    }
}

impl Ranges {
    fn add<F: Scalar>(
        &mut self,
        setting: &Setting<'_, F>,
        max_error: Option<&MaxError>,
        trial: &Trial<'_, F>,
    ) {
        let gates = setting.row.entry.info.gates;
        let count = &setting.counts[trial.count];
        let kind = count.kind;
        let is_of_scene = matches!(count.rays, Rays::Stratum(_));
        let is_refused = is_to_be_refused(kind, max_error, trial);
        for (k, knob) in setting.knobs.iter().enumerate() {
            let margin = largest_margin(trial, k);
            if margin.is_zero() && is_refused && trial.guards[k] && !is_of_scene {
                // Any number above zero refuses it; a scene's own almost parallel rays show such numbers.
                widen(&mut self.above[k], smallest_normal::<F>());
            }
            if !margin.is_finite() || margin.is_zero() {
                continue;
            }
            let cap = cap(*knob, gates, setting.scene);
            let size = margin.to_f64().abs().min(cap);
            // Of a larger sample some are worse than those of the pilot.
            let beyond = (BEYOND * size).min(cap);
            if margin < F::zero() {
                if kind.is_wrong_if_refused() {
                    widen(&mut self.below[k], size);
                    widen(&mut self.below[k], beyond);
                }
                continue;
            }
            let is_of_t = knob.gate(gates).role == Role::T;
            // No ray of a scene hits nearer than its least distance, so every other false hit nearer than that
            // would speak for a least t as large: for a property of these rays, and not of the kernel.
            let is_in_reach = if is_of_scene {
                !is_of_t || kind == WrongKind::SelfHit
            } else {
                trial.guards[k]
            };
            let is_too_far_off = kind == WrongKind::Miss;
            if is_refused && (is_in_reach || is_too_far_off) {
                widen(&mut self.above[k], size);
                if is_of_t || is_too_far_off {
                    widen(&mut self.above[k], beyond);
                }
            }
        }
    }
}

/// True if it is right to refuse the hits of a trial.
fn is_to_be_refused<F: Scalar>(
    kind: WrongKind,
    max_error: Option<&MaxError>,
    trial: &Trial<'_, F>,
) -> bool {
    if kind != WrongKind::Miss {
        return !kind.is_wrong_if_refused();
    }
    // A hit that is too far off is to be refused too.
    max_error.is_some_and(|max| max.is_exceeded(&trial.errors()))
}

/// The largest margin of a knob among the triangles of a trial: an epsilon above it refuses all of them.
fn largest_margin<F: Scalar>(trial: &Trial<'_, F>, knob: usize) -> F {
    let mut most = -F::infinity();
    for margins in trial.margins {
        if most < margins[knob] {
            most = margins[knob];
        }
    }
    most
}

/// The grid of a setting: for each knob zero, and round numbers over the margins of what is to be refused and of
/// what is lost. Also how coarse it is (`rounds`), to keep it within so many points.
pub fn grid<F: Scalar>(
    setting: &Setting<'_, F>,
    most_points: usize,
    max_error: Option<&MaxError>,
    pass: Pass<'_>,
) -> (KnobGrid<F>, usize) {
    let gates = setting.row.entry.info.gates;
    let pilot = Pass {
        count: pass.count.min(PILOT),
        ..pass
    };
    let add = |ranges: &mut Ranges, trial: Trial<'_, F>| ranges.add(setting, max_error, &trial);
    let ranges = setting.sum(pilot, Ranges::default, add);
    let mut step = 0;
    loop {
        let mut points: usize = 1;
        let mut coarsest = step;
        let mut axes = Vec::with_capacity(setting.knobs.len());
        for (k, knob) in setting.knobs.iter().enumerate() {
            let below = ranges.below[k].filter(|_| knob.takes_negative(gates));
            let (values, coarseness) = values_over::<F>(ranges.above[k], below, step);
            points *= values.len() + 1;
            coarsest = coarsest.max(coarseness);
            axes.push(values);
        }
        if points <= most_points || step == 8 {
            return (KnobGrid::new(axes), coarsest);
        }
        step += 1;
    }
}

/// Zero and round numbers over a range on each side of it, from a step on, and the step of the coarser side.
fn values_over<F: Float>(above: Option<Ends>, below: Option<Ends>, step: usize) -> (Vec<F>, usize) {
    let mut values = vec![F::zero()];
    let mut coarsest = step;
    if let Some(range) = above {
        let (sizes, coarseness) = few_rounds::<F>(that_matters::<F>(range), step);
        values.extend(sizes);
        coarsest = coarseness;
    }
    if let Some(range) = below {
        let (sizes, coarseness) = few_rounds::<F>(that_matters::<F>(range), step);
        values.extend(sizes.into_iter().map(|size| -size));
        coarsest = coarsest.max(coarseness);
    }
    (in_order(values), coarsest)
}

/// Some values, zero, and round numbers on each side of zero where there are values, from a thousandth of
/// the smallest to a thousand times the largest: 1, 2, 5, and (fine) every number of two digits.
pub fn round_values<F: Float>(special: &[F], is_fine: bool) -> Vec<F> {
    let mut values = vec![F::zero()];
    values.extend(special);
    for sign in [F::one(), -F::one()] {
        let mut range = None;
        for x in special {
            let size = (*x * sign).to_f64();
            if 0.0 < size {
                widen(&mut range, size);
            }
        }
        let Some([low, high]) = range else { continue };
        let around = [low / 1e3, high * 1e3];
        let (mut sizes, _) = few_rounds::<F>(around, 0);
        if is_fine {
            sizes.extend(two_digits::<F>(around));
        }
        values.extend(sizes.into_iter().map(|x| x * sign));
    }
    in_order(values)
}

/// Every number of two digits in a range that no machine flushes to zero.
fn two_digits<F: Float>([low, high]: Ends) -> Vec<F> {
    let least = low.max(smallest_normal::<F>());
    let mut found = Vec::new();
    for k in DECADES {
        for digits in 10..100 {
            let Some((wide, value)) = parsed::<F>(&format!("{digits}e{}", k - 1)) else {
                continue;
            };
            if least <= wide && wide <= high {
                found.push(value);
            }
        }
    }
    found
}

/// The number of a text in `f64` and in the scalar, if that holds it.
fn parsed<F: Float>(text: &str) -> Option<(f64, F)> {
    let wide = text.parse().ok()?;
    let value = F::parse(text)?;
    value.is_finite().then_some((wide, value))
}

/// The different values, in order.
fn in_order<F: Float>(mut values: Vec<F>) -> Vec<F> {
    values.sort_by_key(|value| value.place());
    values.dedup_by(|a, b| a == b);
    values
}

/// At most [`MOST_VALUES`] round numbers over a range, and the first step from the given one on that has so few.
fn few_rounds<F: Float>(range: Ends, first_step: usize) -> (Vec<F>, usize) {
    let mut step = first_step;
    loop {
        // In the end one is left.
        let values = rounds::<F>(range, step);
        if values.len() <= MOST_VALUES {
            return (values, step);
        }
        step += 1;
    }
}

/// Round numbers from one at or below a range to one at or above it: 1, 2 and 5 of each decade; in step 1 the powers of
/// ten, then every second power, every fourth, and so on.
fn rounds<F: Float>([low, high]: Ends, step: usize) -> Vec<F> {
    // Below the normal numbers a machine may flush to zero.
    let normal = smallest_normal::<F>();
    let digits: &[u32] = if step == 0 { &[1, 2, 5] } else { &[1] };
    let every = 1 << step.saturating_sub(1);
    let mut wides = Vec::new();
    let mut values = Vec::new();
    for k in DECADES.filter(|k| k % every == 0) {
        for digit in digits {
            let Some((wide, value)) = parsed::<F>(&format!("{digit}e{k}")) else {
                continue;
            };
            if normal <= wide {
                wides.push(wide);
                values.push(value);
            }
        }
    }
    let above_low = wides.partition_point(|wide| *wide <= low);
    let from_high = wides.partition_point(|wide| *wide < high);
    let first = above_low.saturating_sub(1);
    let end = (from_high + 1).min(values.len());
    values[first..end].to_vec()
}

/// The round number in the middle between two of one sign, or the first of them.
pub fn middle<F: Float>(low: F, high: F) -> F {
    let ends = [low.to_f64(), high.to_f64()];
    let far_from_middle = |x: &F| unevenness(x.to_f64(), ends);
    rounds::<F>(ends, 0)
        .into_iter()
        .filter(|x| low <= *x && *x <= high)
        .min_by(|a, b| far_from_middle(a).total_cmp(&far_from_middle(b)))
        .unwrap_or(low)
}

/// How much farther a number is from one end of a range than from the other, as factors are far.
fn unevenness(x: f64, [low, high]: Ends) -> f64 {
    let from_low = libm::log(x / low);
    let from_high = libm::log(high / x);
    (from_low - from_high).abs()
}

/// The grid of some values of each knob.
pub fn of_values<F: Float>(values: impl Iterator<Item = Vec<F>>) -> KnobGrid<F> {
    KnobGrid::new(values.map(in_order).collect())
}

/// The grid of a point, zero, and the round numbers of a step on the point's side of zero, as far on each side as the
/// neighbours of the next coarser grid.
pub fn around<F: Float>(point: &[F], step: usize) -> KnobGrid<F> {
    let factor = 10f64.powi(1 << step);
    let mut axes = Vec::with_capacity(point.len());
    for x in point {
        let size = x.to_f64().abs();
        let sign = if *x < F::zero() { -F::one() } else { F::one() };
        let mut values = vec![F::zero(), *x];
        if 0.0 < size {
            let sizes = rounds::<F>([size / factor, size * factor], step);
            values.extend(sizes.into_iter().map(|y| y * sign));
        }
        axes.push(in_order(values));
    }
    KnobGrid::new(axes)
}

#[cfg(test)]
mod tests;

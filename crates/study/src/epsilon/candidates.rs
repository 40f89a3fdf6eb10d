//! The values that are weighed for each knob: round numbers over the range in which they matter.

use super::errors::{MaxError, errors_of};
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

/// The range without what is smaller than its largest value by the scalar's precision, three times over, since products
/// of lengths are compared. That does no more than the least float, at which a strict comparison accepts already.
fn that_matters<F: Float>([low, high]: [f64; 2]) -> [f64; 2] {
    [low.max(high * F::EPSILON.to_f64().powi(3)), high]
}

/// The most values of a knob on each side of zero.
const MOST_VALUES: usize = 60;

/// The most points of the grid of a study.
pub const MOST_POINTS: usize = 300_000;

/// The largest size of a knob that means anything: a tolerance as large as the largest triangle, or the
/// longest way; without a scene any number.
fn cap(knob: Knob, gates: &[Gate], scene: Option<&Scene>) -> f64 {
    let Some(scene) = scene else { return f64::MAX };
    let Dimension { length, direction } = knob.gate(gates).dimension;
    let farthest = scene.distance[1].max(scene.edge[1]);
    let size = if knob.gate(gates).role == Role::T {
        farthest
    } else {
        scene.edge[1]
    };
    let [shortest, longest] = match scene.direction {
        DirectionLength::Unit => [1.0, 1.0],
        DirectionLength::Target => [scene.edge[0], farthest],
        DirectionLength::Mixed => [scene.edge[0].min(1.0 / 64.0), farthest.max(64.0)],
    };
    let speed = if direction < 0 { shortest } else { longest };
    size.powi(length.into()) * speed.powi(direction.into())
}

/// By knob: the smallest and the largest margin above zero, and of those below zero their sizes.
struct Ranges {
    above: [Option<[f64; 2]>; MOST_KNOBS],
    below: [Option<[f64; 2]>; MOST_KNOBS],
}

fn widen(range: &mut Option<[f64; 2]>, size: f64) {
    let [low, high] = range.unwrap_or([size, size]);
    *range = Some([low.min(size), high.max(size)]);
}

impl Merge for Ranges {
    fn merge(&mut self, other: Ranges) {
        let pairs = self.above.iter_mut().zip(other.above);
        for (range, more) in pairs.chain(self.below.iter_mut().zip(other.below)) {
            more.into_iter()
                .flatten()
                .for_each(|size| widen(range, size));
        }
    }
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
    let empty = || Ranges {
        above: [None; MOST_KNOBS],
        below: [None; MOST_KNOBS],
    };
    let add = |ranges: &mut Ranges, trial: Trial<'_, F>| {
        let kind = setting.counts[trial.count].kind;
        let is_exceeded = |max: &MaxError| max.is_exceeded(&errors_of(&trial));
        let is_refused = match kind {
            // A hit that is too far off is to be refused too.
            WrongKind::Miss => max_error.is_some_and(is_exceeded),
            kind => !kind.is_wrong_if_refused(),
        };
        let is_self_hit = kind == WrongKind::SelfHit;
        for (k, knob) in setting.knobs.iter().enumerate() {
            let margins = trial.margins.iter().map(|margins| margins[k]);
            let margin = margins.fold(-F::infinity(), |most, m| if most < m { m } else { most });
            let is_of_scene = matches!(setting.counts[trial.count].rays, Rays::Stratum(_));
            if margin.is_zero() && is_refused && trial.guards[k] && !is_of_scene {
                // Any number above zero refuses it; a scene's own almost parallel rays show such numbers.
                widen(&mut ranges.above[k], smallest_normal::<F>());
            }
            if !margin.is_finite() || margin.is_zero() {
                continue;
            }
            let cap = cap(*knob, gates, setting.scene);
            let size = margin.to_f64().abs().min(cap);
            // Of a larger sample some are worse than those of the pilot.
            let beyond = (BEYOND * size).min(cap);
            if margin < F::zero() && kind.is_wrong_if_refused() {
                widen(&mut ranges.below[k], size);
                widen(&mut ranges.below[k], beyond);
            }
            // No ray of a scene hits nearer than its least distance, so every other false hit nearer than that
            // would speak for a least t as large: for a property of these rays, and not of the kernel.
            let is_of_t = knob.gate(gates).role == Role::T;
            let is_in_reach = match is_of_scene {
                true => !is_of_t || is_self_hit || kind == WrongKind::Miss,
                false => trial.guards[k] || kind == WrongKind::Miss,
            };
            if F::zero() < margin && is_refused && is_in_reach {
                widen(&mut ranges.above[k], size);
                if is_of_t || kind == WrongKind::Miss {
                    widen(&mut ranges.above[k], beyond);
                }
            }
        }
    };
    let pilot = Pass {
        count: pass.count.min(PILOT),
        ..pass
    };
    let ranges = setting.sum(pilot, empty, add);
    let mut step = 0;
    loop {
        let of_knob = |(k, knob): (usize, &Knob)| {
            let mut values = vec![F::zero()];
            let below = ranges.below[k].filter(|_| knob.takes_negative(gates));
            let few = |range| few_rounds::<F>(that_matters::<F>(range), step);
            let [above, below] =
                [ranges.above[k], below].map(|range| range.map_or((Vec::new(), step), few));
            values.extend(above.0);
            values.extend(below.0.into_iter().map(|x| -x));
            (in_order(values), above.1.max(below.1))
        };
        let (values, steps): (Vec<Vec<F>>, Vec<usize>) =
            setting.knobs.iter().enumerate().map(of_knob).unzip();
        let points: usize = values.iter().map(|values| values.len() + 1).product();
        if points <= most_points || step == 8 {
            return (
                KnobGrid::new(values),
                steps.into_iter().fold(step, usize::max),
            );
        }
        step += 1;
    }
}

/// Some values, zero, and round numbers on each side of zero where there are values, from a thousandth of
/// the smallest to a thousand times the largest: 1, 2, 5, and (fine) every number of two digits.
pub fn round_values<F: Float>(special: &[F], is_fine: bool) -> Vec<F> {
    let mut values = vec![F::zero()];
    values.extend(special);
    for sign in [F::one(), -F::one()] {
        let sizes = special
            .iter()
            .map(|x| (*x * sign).to_f64())
            .filter(|size| 0.0 < *size);
        let ends = sizes.fold(None, |ends: Option<[f64; 2]>, size| {
            let [low, high] = ends.unwrap_or([size; 2]);
            Some([low.min(size), high.max(size)])
        });
        let around = ends.map(|[low, high]| {
            let ends = [low / 1e3, high * 1e3];
            let more = if is_fine {
                two_digits::<F>(ends)
            } else {
                Vec::new()
            };
            [few_rounds::<F>(ends, 0).0, more].concat()
        });
        values.extend(around.into_iter().flatten().map(|x| x * sign));
    }
    in_order(values)
}

/// Every number of two digits in a range that no machine flushes to zero.
fn two_digits<F: Float>([low, high]: [f64; 2]) -> Vec<F> {
    let least = low.max(smallest_normal::<F>());
    let all = DECADES.flat_map(|k| (10..100).map(move |d| format!("{d}e{}", k - 1)));
    let is_in = |text: &String| text.parse().is_ok_and(|x: f64| least <= x && x <= high);
    let found = all.filter(is_in).filter_map(|text| F::parse(&text));
    found.filter(|value| value.is_finite()).collect()
}

/// The different values, in order.
fn in_order<F: Float>(mut values: Vec<F>) -> Vec<F> {
    values.sort_by_key(|value| value.place());
    values.dedup_by(|a, b| a == b);
    values
}

/// At most [`MOST_VALUES`] round numbers over a range, and the first step from the given one on that has so few.
fn few_rounds<F: Float>(range: [f64; 2], step: usize) -> (Vec<F>, usize) {
    let all = (step..).map(|step| (rounds::<F>(range, step), step));
    all.into_iter()
        .find(|(values, _)| values.len() <= MOST_VALUES)
        .expect("in the end one is left")
}

/// Round numbers from one at or below a range to one at or above it: 1, 2 and 5 of each decade; in step 1 the powers of
/// ten, then every second power, every fourth, and so on.
fn rounds<F: Float>([low, high]: [f64; 2], step: usize) -> Vec<F> {
    // Below the normal numbers a machine may flush to zero.
    let normal = smallest_normal::<F>();
    let digits: &[u32] = if step == 0 { &[1, 2, 5] } else { &[1] };
    let every = 1 << step.saturating_sub(1);
    let decades = DECADES.filter(|k| k % every == 0);
    let all = decades.flat_map(|k| digits.iter().map(move |d| format!("{d}e{k}")));
    let all = all.filter_map(|text| Some((text.parse::<f64>().ok()?, F::parse(&text)?)));
    let all: Vec<(f64, F)> = all
        .filter(|(wide, value)| normal <= *wide && value.is_finite())
        .collect();
    let first = all
        .partition_point(|(wide, _)| *wide <= low)
        .saturating_sub(1);
    let last = (all.partition_point(|(wide, _)| *wide < high) + 1).min(all.len());
    all[first..last].iter().map(|(_, value)| *value).collect()
}

/// The round number in the middle between two of one sign, or the first of them.
pub fn middle<F: Float>(low: F, high: F) -> F {
    let ends = [low.to_f64(), high.to_f64()];
    let far_from_middle =
        |x: &F| (libm::log(x.to_f64() / ends[0]) - libm::log(ends[1] / x.to_f64())).abs();
    let within = rounds::<F>(ends, 0)
        .into_iter()
        .filter(|x| low <= *x && *x <= high);
    within
        .min_by(|a, b| far_from_middle(a).total_cmp(&far_from_middle(b)))
        .unwrap_or(low)
}

/// The grid of some values of each knob.
pub fn of_values<F: Float>(values: impl Iterator<Item = Vec<F>>) -> KnobGrid<F> {
    KnobGrid::new(values.map(in_order).collect())
}

/// The grid of a point, zero, and the round numbers of a step on the point's side of zero, as far on each side as the
/// neighbours of the next coarser grid.
pub fn around<F: Float>(point: &[F], step: usize) -> KnobGrid<F> {
    let factor = 10f64.powi(1 << step);
    let near = |x: &F| {
        let size = x.to_f64().abs();
        let sign = if *x < F::zero() { -F::one() } else { F::one() };
        let mut values = vec![F::zero(), *x];
        if 0.0 < size {
            values.extend(
                rounds::<F>([size / factor, size * factor], step)
                    .into_iter()
                    .map(|y| y * sign),
            );
        }
        in_order(values)
    };
    KnobGrid::new(point.iter().map(near).collect())
}

#[cfg(test)]
mod tests;

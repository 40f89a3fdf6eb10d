//! The search for witnesses.

use super::depth::Judge;
use super::measures::Sample;
use super::starts::{make_parallel, power_of_half};
use super::witness::{Goal, Inputs, Search, Searched};
use crate::arith::recorded::{Operation, Place};
use crate::case::Draw;
use glam::DVec3;

/// After so many evaluations without anything better a climb starts elsewhere.
const STALE: u64 = 20_000;
/// The same for verdicts.
const SHORT: u64 = 6_000;
/// In a scene, where inputs differ by much: a climb begins at the worst of so many.
const STARTS: u64 = 1_000;
/// Steps to where the errors could be large.
const ASCENT: u64 = 3_000;

impl<F: Searched> Search<'_, F> {
    /// Climbs for so many evaluations; the best inputs and their exact score.
    ///
    /// An error is a sum of roundings, each with a weight. A change of many digits changes all of the roundings, and so
    /// hides what it does to the weights. So a climb goes first to where the errors could be large, and then through
    /// the last digits there.
    pub fn climb(
        &mut self,
        goal: Goal,
        evaluations: u64,
        draw: &mut Draw,
        known: &[Inputs<F>],
    ) -> Option<(Inputs<F>, f64)> {
        let mut near = Vec::new();
        let mut best: Option<(Inputs<F>, f64)> = None;
        let mut current: Option<(Inputs<F>, f64)> = None;
        let mut stale = 0;
        let mut left = evaluations;
        let mut highest = f64::INFINITY;
        let patience = if self.judge.is_some() { SHORT } else { STALE };
        while 0 < left {
            left -= 1;
            // Starts again where nothing better came for long; sometimes from a known case.
            if current.is_none() || stale > patience {
                let starts = if self.domain.measures.is_some() {
                    left.min(STARTS)
                } else {
                    0
                };
                left -= starts;
                let started = (0..=starts).filter_map(|_| {
                    let is_known = !known.is_empty() && draw.below(4) == 0;
                    let mut inputs = if is_known {
                        draw.pick(known)
                    } else {
                        self.start(goal, draw)
                    };
                    // A known one of this scalar is where it should be; one of the other scalar is not.
                    if let Some(judge) = self.judge
                        && !(is_known && draw.coin())
                    {
                        judge.move_to_boundary(&mut inputs, draw);
                        inputs[15..].copy_from_slice(&self.domain.interval());
                    }
                    self.score(&inputs, goal, &mut near)
                        .map(|score| (inputs, score))
                });
                current = started.max_by(|(_, a), (_, b)| a.total_cmp(b));
                if let Some((inputs, score)) = &mut current
                    && goal != Goal::Zero
                    && draw.coin()
                {
                    let steps = ASCENT.min(left / 4);
                    left -= steps;
                    *inputs = self.ascend(*inputs, goal, steps, draw);
                    *score = self.score(inputs, goal, &mut near).unwrap_or(*score);
                }
                let started = current.filter(|_| self.judge.is_none());
                let all = best.into_iter().chain(started);
                best = all.max_by(|(_, a), (_, b)| a.total_cmp(b));
                stale = 0;
                highest = current.map_or(f64::INFINITY, |(_, score)| score);
                continue;
            }
            let Some((inputs, score)) = current else {
                continue;
            };
            let mut tried = inputs;
            for _ in 0..1 + draw.below(3) {
                self.change(&mut tried, draw);
            }
            self.settle(&mut tried);
            if goal == Goal::Zero {
                make_parallel(&mut tried, draw);
            }
            if let Some(judge) = self.judge
                && draw.below(8) == 0
            {
                judge.move_to_boundary(&mut tried, draw);
            }
            stale += 1;
            let Some(found) = self.score(&tried, goal, &mut near) else {
                continue;
            };
            // A little worse is allowed now and then.
            let slack = if draw.below(64) == 0 {
                0.02 * score.abs()
            } else {
                0.0
            };
            if found >= score - slack {
                if found > score && self.judge.is_none() {
                    stale = stale.min(STALE / 2);
                }
                if found > highest + 0.01 * highest.abs() {
                    (highest, stale) = (found, 0);
                }
                current = Some((tried, found));
            }
            if self.counts && best.is_none_or(|(_, best)| found > best) {
                best = Some((tried, found));
                stale = if self.judge.is_none() { 0 } else { stale };
            }
        }
        let (inputs, _) = best?;
        self.exact(&inputs, goal).map(|score| (inputs, score))
    }

    /// Moves inputs inside the domain to where the roundings could add up to much.
    fn ascend(
        &mut self,
        mut inputs: Inputs<F>,
        goal: Goal,
        steps: u64,
        draw: &mut Draw,
    ) -> Inputs<F> {
        let mut near = Vec::new();
        let mut highest = 0.0;
        for _ in 0..steps {
            let mut tried = inputs;
            for _ in 0..1 + draw.below(4) {
                let i = self.any_input(draw);
                let by = draw.symmetric::<f64>() * power_of_half(12, draw);
                let scale = self.scale();
                tried[i] = match draw.below(6) {
                    0 => -tried[i],
                    _ => tried[i] + F::from_f64(by * scale),
                };
            }
            self.settle(&mut tried);
            if let Some(judge) = self.judge {
                judge.move_to_boundary(&mut tried, draw);
            }
            if self.score(&tried, goal, &mut near).is_some() {
                let value = self.computed[self.place as usize].to_f64();
                let weight =
                    |judge: &Judge<F>| judge.weight(value, &Sample::of(&tried.map(F::to_f64)));
                let found = self.amplitude() * self.judge.map_or(1.0, weight);
                if found >= highest {
                    (inputs, highest) = (tried, found);
                }
            }
        }
        inputs
    }

    /// Makes the direction of a scene's ray as long as it should be, where it is not.
    fn settle(&self, inputs: &mut Inputs<F>) {
        if self.domain.measures.is_none() {
            return;
        }
        let direction = DVec3::from([3, 4, 5].map(|i| inputs[i].to_f64()));
        if (direction.length() - 1.0).abs() < 2.0 * F::EPSILON.to_f64() {
            return;
        }
        let unit = direction.normalize_or_zero().to_array();
        inputs[3..6].copy_from_slice(&unit.map(F::from_f64));
    }

    /// The most that half an ulp of every rounded number of the last run could add up to, in units of its unit
    /// roundoff.
    fn amplitude(&self) -> f64 {
        let values: Vec<f64> = self.computed.iter().map(|x| x.to_f64()).collect();
        let mut slopes = vec![0.0; values.len()];
        slopes[self.place as usize] = 1.0;
        let mut sum = 0.0;
        for (place, operation) in self.operations.iter().enumerate().rev() {
            let slope = slopes[place];
            let result = values[place];
            let of = |place: Place| values[place as usize];
            let mut add = |place: Place, x: f64| slopes[place as usize] += x;
            match *operation {
                Operation::Abs(a) => add(a, slope * of(a).signum()),
                Operation::Sqrt(a) => add(a, slope / (2.0 * result)),
                Operation::Div(a, b) => {
                    add(a, slope / of(b));
                    add(b, -slope * result / of(b));
                }
                _ => {
                    for (is_minus, a, b) in operation.terms() {
                        let slope = if is_minus { -slope } else { slope };
                        add(a, b.map_or(slope, |b| slope * of(b)));
                        b.into_iter().for_each(|b| add(b, slope * of(a)));
                    }
                }
            }
            use Operation::{Abs, Input, Neg, Number};
            let is_exact = matches!(operation, Input(_) | Number(_) | Neg(_) | Abs(_));
            if !is_exact && result != 0.0 {
                sum += slope.abs() * result.abs().log2().floor().exp2();
            }
        }
        sum
    }

    fn any_input(&self, draw: &mut Draw) -> usize {
        let has_ends = self.quantity.uses().extent;
        draw.below(if has_ends { 17 } else { 15 })
    }

    /// The largest difference of coordinates.
    fn scale(&self) -> f64 {
        self.domain.reach.max(self.domain.edge).to_f64()
    }

    fn change(&self, inputs: &mut Inputs<F>, draw: &mut Draw) {
        let i = self.any_input(draw);
        let x = inputs[i];
        inputs[i] = match draw.below(8) {
            0..3 => x.offset_ulps(draw.integer(-3, 3)),
            3 => x.offset_ulps(draw.integer(-300, 300)),
            4 => {
                let exponent = -draw.integer(0, i64::from(F::DIGITS) + 6);
                let share = draw.symmetric::<f64>() * 2f64.powi(exponent as i32);
                x + F::from_f64(self.scale() * share)
            }
            5 => -x,
            6 => {
                // Fewer digits.
                let keep = 1 + draw.below(F::DIGITS as usize) as u32;
                let drop = F::DIGITS - keep.min(F::DIGITS);
                F::from_bits(x.to_bits() >> drop << drop)
            }
            _ => {
                // The other points along the same axis move along.
                let by = F::from_f64(draw.symmetric::<f64>() * power_of_half(40, draw));
                if !(3..6).contains(&i) && i < 15 {
                    for j in [0, 6, 9, 12].map(|j| j + i % 3) {
                        if j != i {
                            inputs[j] = inputs[j] + by;
                        }
                    }
                }
                x + by
            }
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel;
    use crate::{Domain, Proof, format_of, paths_of, run};

    /// Each rounded number is moved by a hair, and the program run again from there.
    #[test]
    fn an_amplitude_is_the_sum_of_what_each_half_ulp_does() {
        for name in [
            "moller-trumbore",
            "plane-unit-normal",
            "woop-watertight",
            "cramer+fma",
        ] {
            let entry = kernel::find(name).unwrap();
            let paths = paths_of::<f64>(entry).unwrap();
            let proof = Proof::new(paths, None, Domain::UNIT, format_of::<f64>());
            let quantities = proof.quantities.iter().filter(|q| !q.uses().extent);
            for quantity in quantities.take(4) {
                let mut search = Search::<f64>::new(&proof, quantity, None);
                let mut draw = Draw::new("amplitude", 1, 0);
                for _ in 0..5 {
                    let inputs = search.start(Goal::Error, &mut draw);
                    run(&search.operations, &inputs, &mut search.computed);
                    let expected = by_differences(&search, &inputs);
                    let found = search.amplitude();
                    let apart = (found - expected).abs();
                    assert!(apart <= 1e-4 * expected, "{name}: {found} {expected}");
                }
            }
        }
    }

    fn by_differences(search: &Search<'_, f64>, inputs: &Inputs<f64>) -> f64 {
        let effect = |(place, operation): (usize, &Operation)| {
            use Operation::{Abs, Input, Neg, Number};
            let value = search.computed[place];
            if matches!(operation, Input(_) | Number(_) | Neg(_) | Abs(_)) || value == 0.0 {
                return 0.0;
            }
            // No quantity here uses the last input.
            let mut operations = search.operations.clone();
            operations[place] = Input(16);
            let result = |by: f64| {
                let (mut inputs, mut values) = (*inputs, Vec::new());
                inputs[16] = value * (1.0 + by);
                run(&operations, &inputs, &mut values);
                values[search.place as usize]
            };
            let slope = (result(1e-6) - result(-1e-6)) / (2e-6 * value);
            slope.abs() * value.abs().log2().floor().exp2()
        };
        search.operations.iter().enumerate().map(effect).sum()
    }
}

//! Advice from a response: which epsilons are right, and what the others cost.

use super::axis::largest;
use super::curve::{Bracket, Curve, Question};
use super::duty::Duty;
use super::run::{Response, SourceResponse, floor};
use crate::arith::Float;
use crate::audit::{Place, Source};
use crate::family::Grouping;
use crate::kernel::{Gate, Scalar};
use std::ops::RangeInclusive;

/// The two counts that an epsilon trades against each other, over all sources: hits lost, and false
/// hits of the kinds that the gate is there to refuse.
///
/// For a gate on t a second hit on the triangle from which a ray starts (family `secondary-ray`) counts as a hit
/// to reject: by exact truth alone an epsilon there could only lose hits.
#[derive(Clone, Debug)]
pub struct Trade<F> {
    /// The lowest epsilon that the gate takes.
    pub floor: F,
    /// The false misses, which a lower epsilon repairs.
    pub misses: Side<F>,
    /// The false hits, which a higher epsilon repairs.
    pub hits: Side<F>,
}

/// One of the counts.
#[derive(Clone, Debug)]
pub struct Side<F> {
    /// The counts at every epsilon.
    pub curve: Curve<F>,
    /// The fewest that any epsilon reaches.
    pub unavoidable: u64,
    /// The last epsilon that reaches it, for misses; the first, for hits.
    pub limit: F,
    /// The case that decides the limit: its source and its place there; none if every epsilon
    /// reaches it.
    pub decided_by: Option<(usize, Place)>,
}

impl<F: Scalar> Trade<F> {
    /// The trade of one gate (the n-th of the request), over the sources of a run.
    pub fn new(
        gate: &Gate,
        duty: &Duty,
        n: usize,
        sources: &[Source],
        run: &[SourceResponse<F>],
    ) -> Trade<F> {
        let (largest, floor) = (largest(), floor(gate));
        let secondary =
            |source: &Source| duty.guards_start() && source.grouping() == Grouping::SecondaryRay;
        let side = |question: Question, counts: &dyn Fn(&Source) -> bool| {
            let counted = |(i, source): (usize, &Source)| counts(source).then_some(i);
            let counted = sources.iter().enumerate().filter_map(counted);
            let curves = counted.map(|i| (i, run[i].gates[n].curve(question)));
            Side::new(question, floor, largest, curves)
        };
        let misses = side(Question::FalseMiss, &|source| !secondary(source));
        let hits = side(Question::OwnFalseHit, &|_| true);
        Trade { floor, misses, hits }
    }

    /// The epsilons that are best for both counts, if there are any.
    pub fn settled(&self) -> Option<(F, F)> {
        (self.hits.limit <= self.misses.limit).then_some((self.hits.limit, self.misses.limit))
    }

    /// The epsilon among some with the smallest sum of the two shares.
    pub fn knee(&self, among: &[F]) -> Option<F> {
        let cost = |e: &F| self.misses.share(*e) + self.hits.share(*e);
        among.iter().copied().min_by(|a, b| cost(a).total_cmp(&cost(b)))
    }
}

impl<F: Float> Side<F> {
    /// The share of wrong answers at an epsilon; the middle of its bracket.
    fn share(&self, epsilon: F) -> f64 {
        let Bracket { low, high } = self.curve.wrong(epsilon);
        (low + high) as f64 / (2 * self.curve.total.max(1)) as f64
    }

    fn new<'a>(
        question: Question,
        floor: F,
        largest: F,
        curves: impl Iterator<Item = (usize, &'a Curve<F>)>,
    ) -> Side<F> {
        let refused = question.is_wrong_if_refused();
        let mut sum = Curve::new(question, floor);
        let mut decided: Option<(F, usize, Place)> = None;
        for (source, curve) in curves {
            sum.merge(curve);
            if let Some((margin, place)) = curve.decisive {
                let beyond = |kept: F| if refused { margin < kept } else { kept < margin };
                if decided.is_none_or(|(kept, ..)| beyond(kept)) {
                    decided = Some((margin, source, place));
                }
            }
        }
        let by = decided.map(|(_, source, place)| (source, place));
        let (limit, decided_by) = match decided {
            Some((margin, ..)) if refused => (margin, by),
            Some((margin, ..)) => (margin.offset_ulps(1), by),
            _ => (if refused { largest } else { floor }, None),
        };
        // Hits that are refused only above the largest number are not avoidable.
        let limit = if limit.is_finite() { limit } else { largest };
        let unavoidable = sum.wrong(limit).high;
        Side { curve: sum, unavoidable, limit, decided_by }
    }
}

/// The sum of a gate's responses over sources.
pub fn total<F: Scalar>(n: usize, run: &[SourceResponse<F>]) -> Option<Response<F>> {
    let (first, others) = run.split_first()?;
    let mut sum = first.gates[n].clone();
    others.iter().for_each(|source| sum.merge(&source.gates[n]));
    Some(sum)
}

/// Epsilons to weigh: zero, the limits of the trade and, where the limits do not meet, some `most`
/// powers of ten between them: those across which the counts change.
pub fn candidates<F: Scalar>(trade: &Trade<F>, most: usize) -> Vec<F> {
    let (low, high) = (trade.misses.limit, trade.hits.limit);
    let shares = |e: F| [trade.misses.share(e), trade.hits.share(e)];
    let change = |from: F, to: F| {
        let ([a, b], [c, d]) = (shares(from), shares(to));
        (c - a).abs() + (d - b).abs()
    };
    let enough = change(low, high) / most as f64;
    let mut chosen = vec![low, high, F::zero()];
    let mut last = low;
    for decade in decades::<F>().filter(|e| low < *e && *e < high) {
        if change(last, decade) >= enough {
            chosen.push(decade);
            last = decade;
        }
    }
    let largest = largest();
    chosen.retain(|e| trade.floor <= *e && e.abs() < largest);
    chosen
}

/// The exponents of the powers of ten that any scalar has, and some more.
pub(super) const DECADES: RangeInclusive<i32> = -330..=310;

/// The powers of ten of a scalar, negative ones first, in order.
pub fn decades<F: Float>() -> impl Iterator<Item = F> {
    let text = move |sign: &str, k: i32| F::parse(&format!("{sign}1e{k}"));
    let negative = DECADES.rev().filter_map(move |k| text("-", k));
    let positive = DECADES.filter_map(move |k| text("", k));
    negative.chain(positive).filter(|e| e.is_finite() && !e.is_zero())
}

#[cfg(test)]
mod tests {
    use super::super::axis::Axis;
    use super::super::curve::Lane;
    use super::*;
    use crate::case::Draw;

    const LARGEST: f32 = f32::MAX;

    /// Margins of two sources, mostly of few values.
    fn margins(draw: &mut Draw) -> [Vec<f32>; 2] {
        let size = draw.integer(-20, 3) as i32;
        let margin = |draw: &mut Draw| match draw.below(12) {
            0 => f32::INFINITY,
            1 => -f32::INFINITY,
            2 => draw.pick(&[0.0, LARGEST, -LARGEST]),
            _ => (draw.integer(-6, 6) as f32 + 0.3) * 2f32.powi(size),
        };
        [(); 2].map(|()| (0..draw.below(7)).map(|_| margin(draw)).collect())
    }

    fn side(
        axis: &Axis<f32>,
        question: Question,
        floor: f32,
        sources: &[Vec<f32>; 2],
    ) -> Side<f32> {
        let curve = |(source, margins): (usize, &Vec<f32>)| {
            let mut lane = Lane::new(question, floor, true);
            for (i, margin) in margins.iter().enumerate() {
                lane.add(axis, *margin, Place { index: i as u64, triangle: 0 });
            }
            (source, lane.curve(axis))
        };
        let curves: Vec<_> = sources.iter().enumerate().map(curve).collect();
        let curves = curves.iter().map(|(source, curve)| (*source, curve));
        Side::new(question, floor, LARGEST, curves)
    }

    /// The wrong answers by their definition.
    fn wrong(question: Question, sources: &[Vec<f32>; 2], epsilon: f32) -> usize {
        let is_wrong = |m: &&f32| (**m < epsilon) == question.is_wrong_if_refused();
        sources.iter().flatten().filter(is_wrong).count()
    }

    #[test]
    fn limits_are_the_last_epsilon_without_a_further_miss_and_the_first_without_a_further_hit() {
        let (mut draw, axis) = (Draw::new("limits", 1, 0), Axis::new(&[]));
        for _ in 0..3000 {
            let (sources, floor) = (margins(&mut draw), draw.pick(&[0.0, -LARGEST]));
            for question in [Question::FalseMiss, Question::OwnFalseHit] {
                let side = side(&axis, question, floor, &sources);
                if question == Question::OwnFalseHit && sources.concat().contains(&LARGEST) {
                    // No epsilon refuses it.
                    assert_eq!(
                        (side.limit, side.unavoidable),
                        (LARGEST, {
                            sources.iter().flatten().filter(|m| LARGEST <= **m).count() as u64
                        })
                    );
                    continue;
                }
                let count = |e: f32| wrong(question, &sources, e);
                let misses = question.is_wrong_if_refused();
                let (best, beyond) = match misses {
                    true => (floor, side.limit.next_up()),
                    false => (LARGEST, side.limit.next_down()),
                };
                assert_eq!(count(side.limit), count(best), "{question:?} {sources:?}");
                assert_eq!(side.unavoidable, count(best) as u64, "{question:?} {sources:?}");
                let is_last = side.limit == if misses { LARGEST } else { floor };
                assert!(is_last || count(best) < count(beyond), "{question:?} {sources:?}");
                let margin =
                    |(source, place): (usize, Place)| sources[source][place.index as usize];
                if let Some((source, _)) = side.decided_by {
                    let m = margin(side.decided_by.unwrap());
                    assert_eq!(sources.iter().position(|of| of.contains(&m)), Some(source));
                }
                match side.decided_by.map(margin) {
                    Some(m) if misses => assert_eq!(m, side.limit),
                    Some(m) => assert_eq!(m.next_up().min(LARGEST), side.limit),
                    None => assert!(is_last),
                }
            }
        }
    }

    fn trade(draw: &mut Draw, axis: &Axis<f32>, floor: f32) -> (Trade<f32>, [[Vec<f32>; 2]; 2]) {
        let sources = [margins(draw), margins(draw)];
        let misses = side(axis, Question::FalseMiss, floor, &sources[0]);
        let hits = side(axis, Question::OwnFalseHit, floor, &sources[1]);
        (Trade { floor, misses, hits }, sources)
    }

    /// The two shares of wrong answers by their definition.
    fn shares(sources: &[[Vec<f32>; 2]; 2], epsilon: f32) -> [f64; 2] {
        let share = |question, of: &[Vec<f32>; 2]| {
            let all = of.iter().flatten().count().max(1);
            wrong(question, of, epsilon) as f64 / all as f64
        };
        [share(Question::FalseMiss, &sources[0]), share(Question::OwnFalseHit, &sources[1])]
    }

    #[test]
    fn the_knee_has_the_least_sum_of_both_shares() {
        let (mut draw, axis) = (Draw::new("knee", 1, 0), Axis::new(&[]));
        for _ in 0..500 {
            let (trade, sources) = trade(&mut draw, &axis, -LARGEST);
            let (low, high) = (trade.hits.limit, trade.misses.limit);
            assert_eq!(trade.settled(), (low <= high).then_some((low, high)));
            let among: Vec<f32> = (0..30).map(|_| draw.symmetric::<f32>() * 8.0).collect();
            let sum = |e: f32| shares(&sources, e).iter().sum::<f64>();
            let least = among.iter().map(|e| sum(*e)).fold(f64::INFINITY, f64::min);
            assert!(sum(trade.knee(&among).unwrap()) <= least + 1e-12);
            assert_eq!(trade.knee(&[]), None);
        }
    }

    #[test]
    fn a_gate_is_settled_where_the_limits_meet() {
        let axis = Axis::new(&[]);
        for (below, is_settled) in [(2, true), (1, true), (0, false)] {
            let hits = [vec![1f32.offset_ulps(-below)], vec![]];
            let misses = side(&axis, Question::FalseMiss, 0.0, &[vec![1.0], vec![]]);
            let hits = side(&axis, Question::OwnFalseHit, 0.0, &hits);
            let limit = hits.limit;
            let settled = Trade { floor: 0.0, misses, hits }.settled();
            assert_eq!(settled, is_settled.then_some((limit, 1.0)));
        }
    }

    #[test]
    fn a_gate_on_t_is_not_blamed_for_misses_of_rays_that_start_on_their_triangle() {
        use crate::audit::{EpsilonChoice, Unobserved};
        let entry = crate::kernel::find("plane-unit-normal").unwrap();
        let row = &EpsilonChoice::Source.rows(&[entry], None).unwrap()[0];
        let source = |name| Source::Family {
            family: crate::family::find(name).unwrap(),
            parameters: crate::case::Parameters::default(),
            seed: 1,
            count: 60,
            exhaustive: false,
        };
        let sources = ["secondary-ray", "edge-exact", "behind"].map(source);
        let (axis, gates) = (Axis::new(&[]), [0, 1, 2]);
        let subject = f32::subject(entry).unwrap();
        let request =
            super::super::run::Request { row, subject, gates: &gates, axis: &axis, exact: true };
        let run = super::super::run::run(&request, &sources, &Unobserved);
        for n in gates {
            let gate = &entry.info.gates[n];
            let duty = Duty::of(entry.info.gates, n, &row.contract);
            let trade = Trade::new(gate, &duty, n, &sources, &run);
            let is_t = gate.role == crate::kernel::Role::T;
            let total = |i: usize, question| run[i].gates[n].curve(question).total;
            let misses = [0, 1, 2].map(|i| total(i, Question::FalseMiss));
            assert!(misses[0] > 0 && misses[1] > 0, "{misses:?}");
            let counted = if is_t { &misses[1..] } else { &misses };
            assert_eq!(trade.misses.curve.total, counted.iter().sum::<u64>(), "{}", gate.name);
            let hits = (0..3).map(|i| total(i, Question::OwnFalseHit)).sum::<u64>();
            assert_eq!((trade.hits.curve.total, trade.floor), (hits, floor(gate)));
            let all = super::total(n, &run).unwrap();
            for question in Question::ALL {
                let sum = (0..3).map(|i| total(i, question)).sum::<u64>();
                assert_eq!(all.curve(question).total, sum, "{question:?}");
            }
            for other in gates {
                let refused = (0..3).map(|i| run[i].gates[n].refused_by_others[other]);
                assert_eq!(all.refused_by_others[other], refused.sum::<u64>(), "{other}");
            }
        }
    }

    #[test]
    fn candidates_are_zero_the_limits_and_decades_between_which_the_counts_change() {
        let (mut draw, axis) = (Draw::new("candidates", 1, 0), Axis::new(&[]));
        let mut found = 0;
        for _ in 0..150 {
            let floor = draw.pick(&[0.0, -LARGEST]);
            let (trade, sources) = trade(&mut draw, &axis, floor);
            let (low, high) = (trade.misses.limit, trade.hits.limit);
            let change = |from: f32, to: f32| {
                let (from, to) = (shares(&sources, from), shares(&sources, to));
                (0..2).map(|i| (from[i] - to[i]).abs()).sum::<f64>()
            };
            for most in [3, 12] {
                let chosen = candidates(&trade, most);
                for special in [low, high, 0.0] {
                    let is_usable = floor <= special && special.abs() < LARGEST;
                    assert_eq!(chosen.contains(&special), is_usable, "{special:e} {chosen:?}");
                }
                // From one to the next the counts change enough, and before that they do not.
                let enough = change(low, high) / most as f64;
                let mut last = low;
                for decade in decades::<f32>().filter(|e| low < *e && *e < high) {
                    let is_enough = enough <= change(last, decade);
                    if is_enough {
                        last = decade;
                        found += 1;
                    }
                    let is_wanted = is_enough && floor <= decade;
                    assert_eq!(chosen.contains(&decade), is_wanted, "{decade:e} {chosen:?}");
                }
                let others = chosen.iter().filter(|e| ![low, high, 0.0].contains(e));
                let mut between = others.filter(|e| **e <= low || high <= **e);
                assert_eq!(between.next(), None, "{chosen:?}");
            }
        }
        assert!(50 < found, "{found}");
    }

    #[test]
    fn decades_cover_the_scalar_in_order() {
        let all: Vec<f32> = decades().collect();
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(all.contains(&1e-45) && all.contains(&1e38) && all.contains(&-1e-6));
        assert!(decades::<f64>().any(|e| e == 1e308) && decades::<f64>().any(|e| e == 1e-323));
    }
}

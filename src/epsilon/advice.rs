//! What follows from a response: which epsilons are right, and what the others cost.

use super::curve::{Bracket, Curve, Question};
use super::duty::Duty;
use super::run::{Response, SourceResponse, floor};
use crate::arith::Float;
use crate::audit::{Place, Source};
use crate::family::Grouping;
use crate::kernel::{Gate, Scalar};

/// The two counts that an epsilon trades against each other, over all sources: hits lost, and false
/// hits of the kinds that the gate is there to refuse.
///
/// For a gate on t a second hit on the triangle from which a ray starts (family `secondary-ray`) counts as a hit
/// to reject: by exact truth alone an epsilon there could only lose hits.
#[derive(Clone, Debug)]
pub struct Trade<F> {
    /// The lowest epsilon that the gate takes.
    pub floor: F,
    /// What a lower epsilon repairs.
    pub misses: Side<F>,
    /// What a higher epsilon repairs.
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
    /// Of one gate (the n-th of the request), over the sources of a run.
    pub fn new(
        gate: &Gate,
        duty: &Duty,
        n: usize,
        sources: &[Source],
        run: &[SourceResponse<F>],
    ) -> Trade<F> {
        let largest = F::infinity().offset_ulps(-1);
        let floor = floor(gate);
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
    let largest = F::infinity().offset_ulps(-1);
    chosen.retain(|e| trade.floor <= *e && e.abs() < largest);
    chosen
}

/// The powers of ten of a scalar, negative ones first, in order.
pub fn decades<F: Float>() -> impl Iterator<Item = F> {
    let digits = F::MAX_EXPONENT * 3 / 10 + 20;
    let text = move |sign: &str, k: i32| F::parse(&format!("{sign}1e{k}"));
    let negative = (-digits..=digits).rev().filter_map(move |k| text("-", k));
    let positive = (-digits..=digits).filter_map(move |k| text("", k));
    negative.chain(positive).filter(|e| e.is_finite() && !e.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_cover_the_scalar_in_order() {
        let all: Vec<f32> = decades().collect();
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(all.contains(&1e-45) && all.contains(&1e38) && all.contains(&-1e-6));
        assert!(decades::<f64>().any(|e| e == 1e308) && decades::<f64>().any(|e| e == 1e-323));
    }
}

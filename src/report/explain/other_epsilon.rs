//! The epsilon with which a built-in formula answers as a kernel does that does not show its own.

use super::near::Nearby;
use crate::arith::Float;
use crate::audit::Row;
use crate::case::Case;
use crate::kernel::{Scalar, Tunable, Verdict};
use crate::report::epsilon::shortest;

/// The range of an epsilon: the kernel refuses at a margin of `low` and accepts at one of `high`.
#[derive(Clone, Copy)]
struct EpsilonRange<F> {
    low: F,
    high: F,
}

/// The gate of a formula with another epsilon at which it explains every answer of a kernel nearby: `parallel = 1e-4 in place
/// of 1e-6`; none if its own epsilons do, or if one other epsilon does not. Where the kernel, in its row, names an epsilon as the
/// formula does, its value counts.
pub(super) fn other_epsilon<F: Scalar>(
    row: &Row,
    formula: &Row,
    nearby: &Nearby<F>,
) -> Option<String> {
    let gated = F::subject(formula.entry)?.gated()?;
    let mut epsilons: Vec<F> = formula.epsilons();
    let declared = row.entry.info.gates.iter().zip(row.epsilons::<F>());
    for (own, value) in declared.filter(|(own, _)| own.epsilon != Tunable::Fixed) {
        let place = formula.entry.info.gates.iter().position(|gate| gate.name == own.name);
        if let Some(place) = place {
            epsilons[place] = value;
        }
    }
    let drawn = nearby.drawn.iter().zip(&nearby.answers);
    let scaled = nearby.scaled.iter().map(|(case, answer)| (case, answer));
    let measured =
        |(case, answer): (&Case<F>, &Verdict<F>)| (gated.measure(case).margins, answer.hit);
    let answers: Vec<(Vec<F>, bool)> = drawn.chain(scaled).map(measured).collect();
    let gates = formula.entry.info.gates.iter().enumerate();
    let tuned = gates.filter(|(_, gate)| gate.epsilon != Tunable::Fixed);
    let of_gate = tuned.filter_map(|(place, gate)| {
        let range = range(&answers, &epsilons, place)?;
        let old = epsilons[place];
        let is_old = range.low < old && old <= range.high;
        (!is_old)
            .then(|| format!("{} {} in place of {}", gate.name, range.in_words(), shortest(old)))
    });
    let found: Vec<String> = of_gate.collect();
    match &found[..] {
        [one] => Some(one.clone()),
        _ => None,
    }
}

/// The range of one gate's epsilon that explains all answers; none if no epsilon does, or if it has no end.
fn range<F: Float>(
    answers: &[(Vec<F>, bool)],
    epsilons: &[F],
    place: usize,
) -> Option<EpsilonRange<F>> {
    let mut range = EpsilonRange { low: -F::infinity(), high: F::infinity() };
    for (margins, hit) in answers {
        let mut others = (0..margins.len()).filter(|other| *other != place);
        let others_pass = others.all(|other| epsilons[other] <= margins[other]);
        let margin = margins[place];
        match (hit, others_pass) {
            (true, false) => return None,
            (true, true) if margin < range.high => range.high = margin,
            (false, true) if range.low < margin => range.low = margin,
            _ => {}
        }
    }
    let is_bounded = range.low.is_finite() && range.high.is_finite();
    (is_bounded && range.low < range.high).then_some(range)
}

impl<F: Float> EpsilonRange<F> {
    /// The number of fewest digits in the range, or its ends.
    fn in_words(self) -> String {
        let ends = [self.low, self.high].map(F::to_f64);
        let rounded = |digits: usize| ends.map(|end| format!("{end:.digits$e}"));
        let is_inside = |text: &String| {
            let number = text.parse().map_or(self.low, F::from_f64);
            self.low < number && number <= self.high
        };
        match (0..3).flat_map(rounded).find(is_inside) {
            Some(text) => format!("= {text}"),
            None => format!("between {:.1e} and {:.1e}", ends[0], ends[1]),
        }
    }
}

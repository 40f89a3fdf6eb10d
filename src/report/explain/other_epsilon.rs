//! The epsilon with which a built-in formula answers as a kernel does that does not show its own.

use super::near::Nearby;
use crate::arith::Float;
use crate::audit::Row;
use crate::case::Case;
use crate::kernel::{KERNELS, Role, Scalar, Tunable, Verdict};
use crate::report::epsilon::shortest;

/// The range of an epsilon: the kernel refuses at a margin of `low` and accepts at one of `high`.
#[derive(Clone, Copy)]
struct EpsilonRange<F> {
    low: F,
    high: F,
}

/// The gate of a formula with another epsilon at which it explains every answer of a kernel nearby: `parallel between 9.8e-5 and
/// 1.04e-4 in place of 1e-6`; none if its own epsilons do, if one other epsilon does not, or if the epsilon is one that the
/// kernel declares or that another formula publishes for that gate. Where the kernel, in its row, names an epsilon as the
/// formula does, its value counts.
pub(super) fn other_epsilon<F: Scalar>(
    row: &Row,
    formula: &Row,
    nearby: &Nearby<F>,
) -> Option<String> {
    let gated = F::subject(formula.entry)?.gated()?;
    let mut epsilons: Vec<F> = formula.epsilons();
    let declared: Vec<(&str, F)> = tunable(row);
    for &(name, value) in &declared {
        let place = formula
            .entry
            .info
            .gates
            .iter()
            .position(|gate| gate.name == name);
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
    // Cases have intervals: a kernel's t_min and a gate on t cannot be told apart.
    let tuned = gates.filter(|(_, gate)| gate.epsilon != Tunable::Fixed && gate.role != Role::T);
    let of_gate = tuned.filter_map(|(place, gate)| {
        let range = range(&answers, &epsilons, place)?;
        let old = epsilons[place];
        // A kernel may call its epsilon as it likes.
        let is_declared = declared.iter().any(|(_, value)| range.holds(*value));
        if range.holds(old) || is_declared || published(gate.name).any(|it| range.holds(it)) {
            return None;
        }
        Some(format!(
            "{} {} in place of {}",
            gate.name,
            range.in_words(),
            shortest(old)
        ))
    });
    let found: Vec<String> = of_gate.collect();
    match &found[..] {
        [one] => Some(one.clone()),
        _ => None,
    }
}

/// The epsilons of a row that can be chosen, with the names of their gates.
fn tunable<F: Scalar>(row: &Row) -> Vec<(&'static str, F)> {
    let gates = row.entry.info.gates.iter().zip(row.epsilons::<F>());
    let chosen = gates.filter(|(gate, _)| gate.epsilon != Tunable::Fixed);
    chosen.map(|(gate, value)| (gate.name, value)).collect()
}

/// The epsilons that built-in formulas publish for a gate of this name.
fn published<F: Scalar>(name: &str) -> impl Iterator<Item = F> {
    let rows = KERNELS
        .iter()
        .filter_map(|entry| Row::named(entry.info.name, None, "own").ok());
    let all = rows.flat_map(|row| tunable::<F>(&row));
    all.filter(move |(gate, _)| *gate == name)
        .map(|(_, value)| value)
}

/// The range of one gate's epsilon that explains all answers; none if no epsilon does, or if it has no end.
fn range<F: Float>(
    answers: &[(Vec<F>, bool)],
    epsilons: &[F],
    place: usize,
) -> Option<EpsilonRange<F>> {
    let mut range = EpsilonRange {
        low: -F::infinity(),
        high: F::infinity(),
    };
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
    fn holds(self, epsilon: F) -> bool {
        self.low < epsilon && epsilon <= self.high
    }

    /// Its ends, rounded outwards to three digits: which number between them the kernel has, its answers do not tell.
    fn in_words(self) -> String {
        // Three digits are off by half a percent at most.
        const ROUNDING: f64 = 0.005;
        let [low, high] = [self.low, self.high].map(F::to_f64);
        let [low, high] = [low - ROUNDING * low.abs(), high + ROUNDING * high.abs()];
        format!("between {low:.2e} and {high:.2e}")
    }
}

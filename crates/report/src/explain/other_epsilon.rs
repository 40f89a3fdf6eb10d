//! The epsilon with which a built-in formula answers as a kernel does that does not show its own.

use super::near::Nearby;
use crate::arith::Float;
use crate::audit::Row;
use crate::epsilon::shortest;
use crate::kernel::{KERNELS, Role, Scalar, Tunable};

/// The range of an epsilon: the kernel refuses at a margin of `low` and accepts at one of `high`.
#[derive(Clone, Copy)]
struct EpsilonRange<F> {
    low: F,
    high: F,
}

/// A kernel's answer to a case, beside the margins that the formula's gates have there.
struct Answer<F> {
    margins: Vec<F>,
    hit: bool,
}

/// The gate of a formula with another epsilon at which it explains every answer of a kernel nearby: `parallel between 9.8e-5 and
/// 1.04e-4 in place of 1e-6`; none if its own epsilons do, if one other epsilon does not, or if the epsilon is one that the
/// kernel declares or that another formula publishes for that gate; nor where the kernel has a gate for t and the formula has
/// none. Where the kernel, in its row, names an epsilon as the formula does, its value counts.
pub(super) fn other_epsilon<F: Scalar>(
    row: &Row,
    formula: &Row,
    nearby: &Nearby<F>,
) -> Option<String> {
    let gated = F::subject(formula.entry)?.gated()?;
    let gates = formula.entry.info.gates;
    let declared: Vec<Named<F>> = tunable(row);
    // What the kernel's own gate of t refuses, another gate of the formula would seem to.
    let is_lacking =
        |named: &Named<F>| is_of_t(named.gate) && gates.iter().all(|gate| gate.name != named.gate);
    if declared.iter().any(is_lacking) {
        return None;
    }
    let mut epsilons: Vec<F> = formula.epsilons();
    for (gate, epsilon) in gates.iter().zip(&mut epsilons) {
        if let Some(named) = declared.iter().find(|named| named.gate == gate.name) {
            *epsilon = named.epsilon;
        }
    }
    let answers: Vec<Answer<F>> = nearby
        .all()
        .map(|(case, verdict)| Answer {
            margins: gated.measure(case).margins,
            hit: verdict.hit,
        })
        .collect();
    let mut found = Vec::new();
    for (place, gate) in gates.iter().enumerate() {
        // Cases have intervals: a kernel's t_min and a gate on t cannot be told apart.
        if gate.epsilon == Tunable::Fixed || gate.role == Role::T {
            continue;
        }
        let Some(range) = range(&answers, &epsilons, place) else {
            continue;
        };
        let own = epsilons[place];
        // A kernel may call its epsilon as it likes.
        let is_declared = declared.iter().any(|named| range.holds(named.epsilon));
        let is_published = published(gate.name).any(|epsilon| range.holds(epsilon));
        if range.holds(own) || is_declared || is_published {
            continue;
        }
        let (name, own) = (gate.name, shortest(own));
        found.push(format!("{name} {} in place of {own}", range.in_words()));
    }
    match &found[..] {
        [one] => Some(one.clone()),
        _ => None,
    }
}

/// An epsilon, with the name of its gate.
struct Named<F> {
    gate: &'static str,
    epsilon: F,
}

/// True if a built-in formula has a gate of this name for t.
fn is_of_t(gate: &str) -> bool {
    let mut gates = KERNELS.iter().flat_map(|entry| entry.info.gates);
    gates.any(|it| it.name == gate && it.role == Role::T)
}

/// The epsilons of a row that can be chosen.
fn tunable<F: Scalar>(row: &Row) -> Vec<Named<F>> {
    let mut all = Vec::new();
    for (gate, epsilon) in row.entry.info.gates.iter().zip(row.epsilons::<F>()) {
        if gate.epsilon != Tunable::Fixed {
            all.push(Named {
                gate: gate.name,
                epsilon,
            });
        }
    }
    all
}

/// The epsilons that built-in formulas publish for a gate of this name.
fn published<F: Scalar>(gate: &str) -> impl Iterator<Item = F> {
    KERNELS
        .iter()
        .filter_map(|entry| Row::named(entry.info.name, None, "own").ok())
        .flat_map(|row| tunable::<F>(&row))
        .filter(move |named| named.gate == gate)
        .map(|named| named.epsilon)
}

/// The range of one gate's epsilon that explains all answers; none if no epsilon does, or if it has no end.
fn range<F: Float>(answers: &[Answer<F>], epsilons: &[F], place: usize) -> Option<EpsilonRange<F>> {
    let mut range = EpsilonRange {
        low: -F::infinity(),
        high: F::infinity(),
    };
    for Answer { margins, hit } in answers {
        let mut others = (0..margins.len()).filter(|other| *other != place);
        if !others.all(|other| epsilons[other] <= margins[other]) {
            // Another gate refuses: a hit contradicts the formula, and a miss says nothing of this one.
            if *hit {
                return None;
            }
            continue;
        }
        let margin = margins[place];
        if *hit && margin < range.high {
            range.high = margin;
        }
        if !*hit && range.low < margin {
            range.low = margin;
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

//! Requests to a process for margins, and the consequences if it fails.

#![forbid(unsafe_code)]

use super::asked::Asked;
use super::running::Lost;
use crate::arith::Float;
use crate::kernel::{Failure, KernelInfo, Verdict};

/// Cases on which processes failed while they were asked for margins.
#[derive(Default)]
pub(super) struct MarginFailures {
    count: u64,
    /// The first of them.
    first: Option<String>,
    /// Why no more margins are asked for.
    pub gave_up: Option<String>,
}

impl MarginFailures {
    /// Adds one.
    pub fn add(&mut self, failure: Failure, case: &str) {
        self.count += 1;
        let first = self
            .first
            .get_or_insert_with(|| format!("{failure} on {case}"));
        if MOST_MARGIN_FAILURES < self.count {
            self.gave_up = Some(format!(
                "it fails at some epsilons, from the smallest to the largest number, on more than \
                 {MOST_MARGIN_FAILURES} cases; first: it {first}"
            ));
        }
    }

    /// A note on these cases, in one line; none if there are none.
    pub fn note(&self) -> Option<String> {
        let (count, first) = (self.count, self.first.as_ref()?);
        Some(format!(
            "on {count} cases it fails at some epsilon, and they are left out; first: it {first}"
        ))
    }
}

/// The margins of some cases, with their verdicts at the epsilons that let the most through, as `ask` gets them.
/// NaN where a process fails, which `failed` is told: no finding, because nobody asked for these epsilons. An
/// error says what answer was none.
pub(super) fn find<F: Float, T: Asked>(
    (info, open): (&KernelInfo, &[F]),
    cases: &[T::Case<F>],
    verdicts: &mut [Verdict<F>],
    margins: &mut [F],
    ask: &impl Fn(&[T::Case<F>], &mut [Verdict<F>], &mut [F]) -> Result<(), Lost>,
    failed: &impl Fn(Failure, &T::Case<F>),
) -> Result<(), String> {
    match ask(cases, verdicts, margins) {
        Ok(()) => check(info, open, verdicts, margins),
        Err(Lost::Garbled(message)) => Err(message),
        Err(Lost::Failed(failure)) if cases.len() == 1 => {
            margins.fill(F::from_f64(f64::NAN));
            verdicts[0] = Verdict::miss(None);
            failed(failure, &cases[0]);
            Ok(())
        }
        Err(Lost::Failed(_)) => {
            let one_by_one = cases.chunks(1).zip(verdicts.chunks_mut(1));
            let mut one_by_one = one_by_one.zip(margins.chunks_mut(open.len()));
            one_by_one.try_for_each(|((case, verdict), margins)| {
                find::<F, T>((info, open), case, verdict, margins, ask, failed)
            })
        }
    }
}

/// So many cases are asked for margins at a time, because each is up to 65 runs a gate.
pub(super) const MARGINS_AT_ONCE: usize = 64;

/// On how many cases a process may fail while it is asked for margins.
const MOST_MARGIN_FAILURES: u64 = 100;

/// An error if margins contradict the verdicts at the epsilons that let the most through.
fn check<F: Float>(
    info: &KernelInfo,
    open: &[F],
    verdicts: &[Verdict<F>],
    margins: &[F],
) -> Result<(), String> {
    let rows = margins.chunks(open.len()).zip(verdicts).enumerate();
    for (case, (margins, verdict)) in rows {
        let pairs = margins.iter().zip(open).zip(info.gates);
        for ((margin, open), gate) in pairs {
            let expected = match verdict.hit {
                true if open <= margin => continue,
                true => "at least the epsilon of the batch, for its verdict is a hit",
                false if margin.to_f64().is_infinite() => continue,
                false => "infinity or -infinity, for its verdict is a miss",
            };
            let name = gate.name;
            return Err(format!(
                "the margin {name} of case {case} is {margin:e}, expected {expected}"
            ));
        }
    }
    Ok(())
}

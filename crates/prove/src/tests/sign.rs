//! The properties that the last rounding cannot change: signs, and how large a number can be that is exactly zero.

use crate::arith::recorded::{Operation, Place};
use crate::dyadic::round_up;
use crate::formula::DIGITS;
use crate::{Dyadic, Prover, Rule};

impl Prover<'_> {
    /// The bound of the difference of a number's exact value and what its last operation rounds.
    ///
    /// Rounding is monotone. So where the exact number is larger in size than this bound, the computed
    /// one has its sign, or is zero; and where the exact number is zero, the computed one is at most this
    /// bound, rounded to the format.
    pub fn bound_before_last(&mut self, place: Place) -> Result<Dyadic, String> {
        if let Operation::Neg(inner) | Operation::Abs(inner) = self.operation(place) {
            return self.bound_before_last(inner);
        }
        let bound = self.bound(place)?;
        let lemma = self
            .lemmas
            .iter()
            .find(|lemma| lemma.place == place)
            .expect("a lemma of a bound");
        let mut formula = lemma.formula.clone();
        let rounds = formula.rounds.last().is_some_and(|rounds| *rounds);
        if lemma.rule != Rule::Sum || !rounds {
            return Ok(bound.error);
        }
        let last = formula.steps.len() - 1;
        formula.rounds[last] = false;
        formula.relative.fill(false);
        let maximum = formula.maximum(self.format)?;
        Ok(round_up(&maximum.error(), DIGITS))
    }
}

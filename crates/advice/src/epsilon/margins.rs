//! The margins of cases by knob, as they are and as multiples of each case's own size.

use super::knob::{Knob, KnobMargins, MOST_KNOBS};
use super::prepared::Prepared;
use super::relative::{CaseSizes, relative};
use super::trials::Setting;
use crate::arith::Float;
use crate::case::Case;
use crate::kernel::{Hit, Scalar};

/// So many cases' margins are asked for together.
const BLOCK: usize = 1024;

impl<F: Scalar> Setting<'_, F> {
    /// Each case's margins of the knobs, -inf where another gate refuses, NaN where they are unknown; and what a
    /// hit would report.
    pub(super) fn margins(&self, cases: &[Case<F>]) -> (Vec<KnobMargins<F>>, Vec<Option<Hit<F>>>) {
        let mut margins = Vec::with_capacity(cases.len());
        let mut values = vec![None; cases.len()];
        // Around fans there are many cases, whose margins of all gates need not be in memory at once.
        for (cases, values) in cases.chunks(BLOCK).zip(values.chunks_mut(BLOCK)) {
            self.add_margins(cases, values, &mut margins);
        }
        (margins, values)
    }

    fn add_margins(
        &self,
        cases: &[Case<F>],
        values: &mut [Option<Hit<F>>],
        margins: &mut Vec<KnobMargins<F>>,
    ) {
        let info = self.row.entry.info;
        let gates = info.gates;
        let epsilons = self.row.epsilons::<F>();
        let mut all = vec![F::zero(); cases.len() * gates.len()];
        self.subject.margins(info, cases, &mut all, values);
        let is_fixed = |gate: &usize| !self.knobs.contains(&Knob::Gate(*gate));
        let fixed: Vec<usize> = (0..gates.len()).filter(is_fixed).collect();
        let of_case = |i: usize| {
            let row = &all[i * gates.len()..(i + 1) * gates.len()];
            if row.iter().any(|margin| margin.is_nan()) {
                return [F::from_f64(f64::NAN); MOST_KNOBS];
            }
            if fixed.iter().any(|gate| row[*gate] < epsilons[*gate]) {
                return [-F::infinity(); MOST_KNOBS];
            }
            let mut margins = [F::infinity(); MOST_KNOBS];
            for (margin, knob) in margins.iter_mut().zip(self.knobs) {
                *margin = match knob {
                    Knob::Gate(gate) => row[*gate],
                    Knob::LeastT => t_of(values[i].as_ref()),
                };
            }
            margins
        };
        margins.extend((0..cases.len()).map(of_case));
    }

    /// Margins as multiples of each case's own size.
    pub(super) fn relative_margins(
        &self,
        cases: &[Case<F>],
        margins: &[KnobMargins<F>],
    ) -> Vec<KnobMargins<F>> {
        let mut all = Vec::with_capacity(margins.len());
        for (case, margins) in cases.iter().zip(margins) {
            all.push(self.relative_to(CaseSizes::of(case), margins));
        }
        all
    }

    /// The margins of one case as multiples of its own sizes.
    pub(super) fn relative_to(&self, sizes: CaseSizes, margins: &KnobMargins<F>) -> KnobMargins<F> {
        let mut own = *margins;
        for (margin, knob) in own.iter_mut().zip(self.knobs) {
            let dimension = knob.gate(self.row.entry.info.gates).dimension;
            if dimension.has_unit() && margin.is_finite() {
                *margin = relative(*margin, sizes.unit(dimension));
            }
        }
        own
    }

    /// All margins of a part as multiples of each case's own size.
    pub(super) fn all_relative(&self, part: &Prepared<F>) -> Vec<KnobMargins<F>> {
        let sizes = part.made.sizes();
        let own = 0..part.made.chunk.cases.len();
        let mut all = Vec::with_capacity(part.margins.len());
        for (place, margins) in own.chain(part.others.iter().copied()).zip(&part.margins) {
            all.push(self.relative_to(sizes[place], margins));
        }
        all
    }
}

/// The t that a hit would report; -inf if it is no number, for no comparison accepts that.
fn t_of<F: Float>(values: Option<&Hit<F>>) -> F {
    let t = values.and_then(|hit| hit.t);
    t.filter(|t| !t.is_nan()).unwrap_or(-F::infinity())
}

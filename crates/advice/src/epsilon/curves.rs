//! The wrong answers at every value of one knob while the others stay.

use super::candidates::round_values;
use super::limits::{KnobLimit, alone};
use super::proved::ProvedValue;
use super::trials::{Pass, Setting, Trial};
use crate::arith::Float;
use crate::engine::Merge;
use crate::kernel::Scalar;

/// The wrong answers at some values of a knob.
pub struct Curve<F> {
    /// In order.
    pub values: Vec<F>,
    /// By count, by value: how many trials are hits.
    pub hits: Vec<Vec<u64>>,
    /// By count: how many of all trials the other knobs leave to this one.
    pub left: Vec<u64>,
    /// By count: how many trials.
    pub of: Vec<u64>,
}

/// By knob, by count: how many trials are hits at so many of the values.
struct Accepted(Vec<Vec<Vec<u64>>>);

impl Merge for Accepted {
    fn merge(&mut self, other: Accepted) {
        let cells = self.0.iter_mut().flatten().flatten();
        cells
            .zip(other.0.into_iter().flatten().flatten())
            .for_each(|(sum, more)| *sum += more);
    }
}

/// The curve of each knob around given epsilons.
pub fn curves<F: Scalar>(
    setting: &Setting<'_, F>,
    epsilons: &[F],
    axes: &[Vec<F>],
    pass: Pass<'_>,
) -> Vec<Curve<F>> {
    // Beside those that are hits at some values: one more cell for those that no value accepts, and the last
    // for those that the other knobs refuse.
    let empty = || {
        let of_knob = |values: &Vec<F>| vec![vec![0; values.len() + 2]; setting.counts.len()];
        Accepted(axes.iter().map(of_knob).collect())
    };
    let add = |sums: &mut Accepted, trial: Trial<'_, F>| {
        for (k, values) in axes.iter().enumerate() {
            let margin = alone(&trial, k, epsilons);
            let accepted = match -F::infinity() < margin {
                true => values.partition_point(|value| *value <= margin),
                false => values.len() + 1,
            };
            sums.0[k][trial.count][accepted] += 1;
        }
    };
    let Accepted(cells) = setting.sum(pass, empty, add);
    let curve = |(values, cells): (&Vec<F>, Vec<Vec<u64>>)| {
        let at = |cells: &Vec<u64>| {
            (0..values.len())
                .map(|i| cells[i + 1..=values.len()].iter().sum())
                .collect()
        };
        Curve {
            values: values.clone(),
            hits: cells.iter().map(at).collect(),
            left: cells
                .iter()
                .map(|cells| cells[..=values.len()].iter().sum())
                .collect(),
            of: cells.iter().map(|cells| cells.iter().sum()).collect(),
        }
    };
    axes.iter().zip(cells).map(curve).collect()
}

/// For each knob the values at which its curve is drawn: those that are tried, its limits, those that are
/// proved, zero, and round numbers from far below to far above them, many if fine.
pub fn axes<F: Float>(
    tried: &[(String, Vec<F>)],
    limits: &[KnobLimit<F>],
    proofs: &[ProvedValue<F>],
    is_fine: bool,
) -> Vec<Vec<F>> {
    let of_knob = |knob: usize| {
        let own = tried.iter().map(|(_, epsilons)| epsilons[knob]);
        let limits = limits.iter().filter(|limit| limit.knob == knob);
        let proofs = proofs.iter().filter(|proved| proved.knob == knob);
        let limits = limits.filter_map(|limit| limit.value);
        let special: Vec<F> = own
            .chain(limits)
            .chain(proofs.map(|proved| proved.value))
            .collect();
        round_values(&special, is_fine)
    };
    let knobs = tried.first().map_or(0, |(_, epsilons)| epsilons.len());
    (0..knobs).map(of_knob).collect()
}

//! The margins of a kernel that does not show its gates: by running it at many epsilons.

use super::{Hit, KernelInfo, Tunable, Verdict};
use crate::arith::Float;

/// By gate, the epsilon that lets the most through: 0 where smaller ones mean the same, otherwise the
/// smallest number.
pub fn open_epsilons<F: Float>(info: &KernelInfo) -> Vec<F> {
    let smallest = -F::infinity().offset_ulps(-1);
    let open = |tunable| {
        if tunable == Tunable::Signed {
            smallest
        } else {
            F::zero()
        }
    };
    info.gates.iter().map(|gate| open(gate.epsilon)).collect()
}

/// Each gate's margin on a case that the kernel hits at the epsilons that let the most through: the largest
/// epsilon at which it still hits while the other gates stay open; +inf if it hits at the largest number.
///
/// So raising an epsilon must only refuse more, and gates must not look at each other's epsilons.
///
/// On a case that it misses there no epsilon is accepted, unless it hits at a larger one, which no margin can say. Then
/// every one is, and a run at any epsilons shows the contradiction.
pub fn by_running<F: Float>(
    open: &[F],
    hits_open: bool,
    is_hit: impl Fn(&[F]) -> bool,
    margins: &mut [F],
) {
    let mut epsilons = open.to_vec();
    if !hits_open {
        let largest = F::infinity().offset_ulps(-1);
        let is_hit_above = (0..open.len()).any(|gate| {
            epsilons.copy_from_slice(open);
            epsilons[gate] = largest;
            is_hit(&epsilons)
        });
        margins.fill(if is_hit_above {
            F::infinity()
        } else {
            -F::infinity()
        });
        return;
    }
    for (gate, margin) in margins.iter_mut().enumerate() {
        let mut hits_at = |place| {
            epsilons[gate] = F::from_place(place);
            is_hit(&epsilons)
        };
        let (mut accepted, mut refused) = (open[gate].place(), F::infinity().place() - 1);
        *margin = if hits_at(refused) {
            F::infinity()
        } else {
            while accepted + 1 < refused {
                let middle = accepted.midpoint(refused);
                if hits_at(middle) {
                    accepted = middle
                } else {
                    refused = middle
                }
            }
            F::from_place(accepted)
        };
        epsilons[gate] = open[gate];
    }
}

/// Measures case by case: margins into one entry a gate for each case in turn, and what a hit would report into
/// `values`, unless that is empty.
pub fn each_case<F: Float, C>(
    info: &KernelInfo,
    cases: &[C],
    margins: &mut [F],
    values: &mut [Option<Hit<F>>],
    mut measure: impl FnMut(&C, &mut [F]) -> Option<Hit<F>>,
) {
    let width = info.gates.len();
    for (i, case) in cases.iter().enumerate() {
        let hit = measure(case, &mut margins[i * width..(i + 1) * width]);
        if let Some(place) = values.get_mut(i) {
            *place = hit;
        }
    }
}

/// The values that a kernel would report of a hit.
pub fn values_of<F: Float>(info: &KernelInfo, verdict: &Verdict<F>) -> Option<Hit<F>> {
    let &Verdict {
        hit,
        facing,
        t,
        u,
        v,
        ..
    } = verdict;
    let (t, uv) = (info.gives.t.then_some(t), info.gives.uv.then_some((u, v)));
    hit.then_some(Hit { t, uv, facing })
}

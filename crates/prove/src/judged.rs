//! A kernel's verdicts at some epsilons: how wrong they can be, and the worst that is known.

use super::depth::Judge;
use super::gates::{Proof, Quantity, Uses};
use super::summary::{Effort, Summary, Witness, paths_of, worst};
use super::verdict::{Verdicts, supposes_weights, verdicts};
use super::witness::{Goal, Inputs, Searched};
use super::{Domain, Dyadic};
use crate::kernel::{Entry, Role, Scalar};

const ABOVE_ONE: Dyadic = Dyadic::ABOVE_ONE;

/// The verdicts of a kernel.
#[derive(Clone, Debug)]
pub struct Judged<F> {
    /// The bounds.
    pub verdicts: Verdicts,
    /// The deepest false miss and the farthest false hit that are known.
    pub known: [Option<Witness<F>>; 2],
    /// The known verdict that is farther off than its bound, if there is one: then the proof is wrong, or the search.
    pub contradiction: Option<String>,
}

/// The goals of the search, in the order of [`Judged::known`].
pub const VERDICTS: [Goal; 2] = [Goal::Missed, Goal::Hit];

impl<F: Searched + Scalar> Judged<F> {
    /// The verdicts of a kernel that is proved, in the domain or its parts.
    pub fn new(
        entry: &Entry,
        summary: &Summary<F>,
        epsilons: &[F],
        parts: &[Domain],
        (known, effort): (&[Inputs<F>], Effort),
    ) -> Option<Judged<F>> {
        let proof = &summary.proof;
        let Summary { domain, format, .. } = *summary;
        let is_wide = domain.measures.is_none() && supposes_weights(entry, proof);
        // Near the triangle, and anywhere.
        let wide = is_wide.then(|| {
            [ABOVE_ONE - Dyadic::ONE, ABOVE_ONE].map(|below| {
                let domain = Domain { quotient: ABOVE_ONE, below, ..domain };
                paths_of::<F>(entry).map(|paths| Proof::new(paths, None, domain, format)).ok()
            })
        });
        let [near, far] = wide.unwrap_or_default();
        let proofs = [proof, near.as_ref().unwrap_or(proof), far.as_ref().unwrap_or(proof)];
        let floats: Vec<f64> = epsilons.iter().map(|x| x.to_f64()).collect();
        let verdicts = verdicts(entry, proofs, &floats, parts);
        let is_edge = |quantity: &&Quantity| entry.info.gates[quantity.gate].role == Role::Edge;
        let of_edges = || proof.quantities.iter().filter(is_edge);
        let judge = Judge {
            gated: F::subject(entry)?.gated()?,
            epsilons,
            uses: of_edges().map(Quantity::uses).fold(Uses::default(), Uses::or),
            scales: verdicts.scales.iter().map(|(scale, _)| *scale).collect(),
        };
        let known = VERDICTS.map(|goal| {
            let bound = if goal == Goal::Missed { &verdicts.misses } else { &verdicts.hits };
            let found = of_edges().filter(|_| bound.is_ok()).filter_map(|quantity| {
                let effort = effort.shared(proof, quantity);
                worst::<F>((proof, quantity), goal, Some(&judge), known, effort)
            });
            found.filter(|found| 0.0 < found.score).max_by(|a, b| a.score.total_cmp(&b.score))
        });
        let bounds = [("false miss", &verdicts.misses), ("false hit", &verdicts.hits)];
        let contradiction = bounds.into_iter().zip(&known).find_map(|((what, bound), known)| {
            let (share, score) = (bound.as_ref().ok()?.share, known.as_ref()?.score);
            let message = || {
                format!("a {what} is known {score:e} of an edge away, and {share:e} is its bound")
            };
            (share * (1.0 + 1e-12) < score).then(message)
        });
        Some(Judged { verdicts, known, contradiction })
    }
}

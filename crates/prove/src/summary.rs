//! Everything that is proved of a kernel, and the worst that is known, gate by gate.

use super::bound::Proven;
use super::depth::Judge;
use super::gates::{Assumption, Proof, Quantity, Uses};
use super::permanent::{Relative, relative};
use super::watertight::{Symmetry, symmetry};
use super::witness::{Goal, Inputs, Search, Searched};
use super::{Domain, Dyadic, Format};
use crate::arith::Float;
use crate::case::Draw;
use crate::kernel::{Entry, Gate, Path, Role, Scalar};
use std::collections::HashSet;

/// A kernel in one scalar and one domain.
#[derive(Debug)]
pub struct Summary<F> {
    /// The domain.
    pub domain: Domain,
    /// The format of the scalar.
    pub format: Format,
    /// Everything that was proved.
    pub proof: Proof,
    /// Its gates that compare numbers, in the order of the kernel.
    pub gates: Vec<GateSummary<F>>,
    /// The symmetry of its edge values.
    pub symmetry: Symmetry,
    /// A witness above the bound of its quantity, if there is one: then the proof is wrong, or the search.
    pub contradiction: Option<String>,
}

/// One gate.
#[derive(Clone, Debug)]
pub struct GateSummary<F> {
    /// Which gate.
    pub index: usize,
    /// The gate itself.
    pub gate: Gate,
    /// The bound of the error of what it compares, or why there is none.
    pub bound: Proven<Dyadic>,
    /// The error relative to the permanent of what it compares, if it has one: the largest of its quantities.
    pub relative: Option<Relative>,
    /// The suppositions of the bound.
    pub uses: Uses,
    /// In a scene, the limits of divisors and of quotients that it supposes.
    pub limits: Vec<Assumption>,
    /// True if what it compares is compared with the epsilon itself; false if with zero, at an epsilon of 0.
    pub is_margin: bool,
    /// The worst inputs known for each goal, in the order of [`GOALS`].
    pub witnesses: [Option<Witness<F>>; 2],
}

/// Inputs, and how bad they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness<F> {
    /// The seventeen numbers.
    pub inputs: Inputs<F>,
    /// The score of the goal, from exact arithmetic.
    pub score: f64,
}

/// The goals of the search, in the order of [`GateSummary::witnesses`].
pub const GOALS: [Goal; 2] = [Goal::Error, Goal::Zero];

impl<F> GateSummary<F> {
    /// The bound over the witness.
    pub fn factor(&self) -> Option<f64> {
        let witness = self.witnesses[0].as_ref()?;
        let bound = self.bound.as_ref().ok()?;
        (witness.score > 0.0).then(|| bound.to_f64() / witness.score)
    }
}

/// The format of a scalar.
pub fn format_of<F: Float>() -> Format {
    if F::DIGITS == 24 {
        Format::F32
    } else {
        Format::F64
    }
}

/// The recorded paths of a kernel; an error in one sentence if it has no program.
pub fn paths_of<F: Scalar>(entry: &Entry) -> Proven<Vec<Path>> {
    let subject = F::subject(entry).ok_or("it does not run in this scalar")?;
    subject
        .gated()
        .ok_or("it is not written for every arithmetic")?
        .paths()
}

impl Proof {
    /// The proof of a kernel, of all gates or of one; an error in one sentence if it has no program.
    pub fn of<F: Scalar>(entry: &Entry, gate: Option<usize>, domain: Domain) -> Proven<Proof> {
        Ok(Proof::new(
            paths_of::<F>(entry)?,
            gate,
            domain,
            format_of::<F>(),
        ))
    }
}

/// How wrong what a gate compares with its epsilon can be in a domain; none if that has no bound, or other numbers are
/// compared.
pub fn bound_of_gate<F: Scalar>(entry: &Entry, gate: usize, domain: Domain) -> Option<Dyadic> {
    let proof = Proof::of::<F>(entry, Some(gate), domain).ok()?;
    let is_margin = proof.quantities.iter().all(|quantity| quantity.is_margin);
    let worst = proof.gate(gate).filter(|_| is_margin)?.ok()?;
    worst.error()
}

/// How hard to search, and from where.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Evaluations for each quantity and goal; the parts of a domain share them by their bounds.
    pub evaluations: u64,
    /// The seed of the random moves.
    pub seed: u64,
}

impl Effort {
    /// No search.
    pub const NONE: Effort = Effort {
        evaluations: 0,
        seed: 1,
    };

    /// The parts of a domain share the evaluations: most of them where most may be wrong.
    pub(super) fn shared(self, proof: &Proof, quantity: &Quantity) -> Effort {
        let quantities = proof.quantities.iter();
        let parts = quantities.filter(|it| it.program == quantity.program);
        let bound = error(quantity);
        let share = bound / parts.map(error).sum::<f64>().max(bound);
        Effort {
            evaluations: (self.evaluations as f64 * share) as u64,
            ..self
        }
    }
}

/// The bound of a quantity's error, or 0.
fn error(quantity: &Quantity) -> f64 {
    quantity.error().map_or(0.0, Dyadic::to_f64)
}

impl<F: Searched + Scalar> Summary<F> {
    /// Proves and searches, in a domain and where things are divided in each of its parts, if it has some; an error
    /// in one sentence if the kernel has no program.
    pub fn new(
        entry: &Entry,
        domain: Domain,
        parts: &[Domain],
        known: &[Inputs<F>],
        effort: Effort,
    ) -> Proven<Summary<F>> {
        let format = format_of::<F>();
        let proof = Proof::of::<F>(entry, None, domain)?.split(parts, format);
        let mut contradiction = None;
        let of_kernel = entry.info.gates.iter().enumerate();
        let gates = of_kernel.filter_map(|(index, gate)| {
            let bound = proof.gate(index)?;
            let of_gate = || proof.of_gate(index);
            let uses = Uses::of(of_gate().flat_map(|quantity| &quantity.lemmas));
            let mut limits: Vec<Assumption> = of_gate().flat_map(Quantity::limits).collect();
            // The weakest of each.
            limits.sort_unstable();
            limits.dedup_by(|later, kept| {
                let is_same = (kept.is_most, kept.name) == (later.is_most, later.name);
                if is_same && kept.is_most {
                    kept.limit = later.limit;
                }
                is_same
            });
            let mut seen = HashSet::new();
            let once = of_gate().filter(|quantity| seen.insert((quantity.path, quantity.place)));
            let forms = once.map(|quantity| {
                let path = &proof.paths[quantity.path];
                relative(path, quantity.place, domain, format).ok()
            });
            let forms: Option<Vec<Relative>> = forms.collect();
            let relative = forms.unwrap_or_default().into_iter();
            let relative = relative.max_by_key(|form| form.factor);
            let is_margin = of_gate().all(|quantity| quantity.is_margin);
            let witnesses = GOALS.map(|goal| {
                let wanted = goal == Goal::Error || gate.role == Role::Parallel;
                let quantities = of_gate().filter(|q| wanted && q.bound.is_ok());
                let found = quantities.filter_map(|quantity| {
                    let effort = effort.shared(&proof, quantity);
                    let found = worst::<F>((&proof, quantity), goal, None, known, effort)?;
                    let bound = error(quantity);
                    // Both are rounded to floats.
                    if goal == Goal::Error && found.score > bound * (1.0 + 1e-12) {
                        let Witness { score, .. } = found;
                        contradiction = Some(format!(
                            "gate '{}': an error of {score:e} is known, and {bound:e} is its bound",
                            gate.name
                        ));
                    }
                    Some(found)
                });
                found.max_by(|a, b| a.score.total_cmp(&b.score))
            });
            let bound = bound.map(|quantity| quantity.error().expect("it has one"));
            Some(GateSummary {
                index,
                gate: *gate,
                bound,
                relative,
                uses,
                limits,
                is_margin,
                witnesses,
            })
        });
        let gates: Vec<GateSummary<F>> = gates.collect();
        let is_edge = |gate: usize| entry.info.gates[gate].role == Role::Edge;
        let symmetry = symmetry(&proof.paths, is_edge);
        Ok(Summary {
            domain,
            format,
            gates,
            symmetry,
            contradiction,
            proof,
        })
    }
}

/// The worst inputs for a number of a proof that are known, or that a search finds.
pub fn worst<F: Searched>(
    (proof, quantity): (&Proof, &Quantity),
    goal: Goal,
    judge: Option<&Judge<F>>,
    known: &[Inputs<F>],
    effort: Effort,
) -> Option<Witness<F>> {
    let mut search = Search::<F>::new(proof, quantity, judge);
    let known = scaled(known, &quantity.domain, judge.is_some());
    let witness = |(inputs, score)| Witness { inputs, score };
    let exact = |inputs| Some(witness((inputs, search.exact(&inputs, goal)?)));
    let mut known: Vec<Witness<F>> = known.into_iter().filter_map(exact).collect();
    known.sort_by(|a, b| b.score.total_cmp(&a.score));
    let best = known.first().copied();
    if effort.evaluations == 0 {
        return best;
    }
    let mut draw = Draw::new("prove", effort.seed, quantity.place.into());
    let known: Vec<Inputs<F>> = known.iter().map(|witness| witness.inputs).collect();
    let found = search.climb(goal, effort.evaluations, &mut draw, &known);
    let all = best.into_iter().chain(found.map(witness));
    all.max_by(|a, b| a.score.total_cmp(&b.score))
}

/// Known inputs of the unit domain, moved into another one by a power of two, which changes no rounding. Rays whose verdicts
/// are looked at begin at 0, and end where the domain does.
fn scaled<F: Float>(known: &[Inputs<F>], domain: &Domain, are_verdicts: bool) -> Vec<Inputs<F>> {
    let least = domain.edge.min(domain.reach).min(domain.world).to_f64();
    let exponent = (least / Domain::UNIT.edge.to_f64()).log2().floor();
    let factor = F::from_f64(2f64.powf(exponent));
    let scale = |inputs: &Inputs<F>| {
        let mut inputs = *inputs;
        for i in (0..3).chain(6..15) {
            inputs[i] = inputs[i] * factor;
        }
        if are_verdicts {
            inputs[15..].copy_from_slice(&domain.interval());
        }
        inputs
    };
    known.iter().map(scale).collect()
}

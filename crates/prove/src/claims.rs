//! Which sentences are true of a gate: they follow from what its numbers mean, not from its role alone.

use super::depth::case_of;
use super::facts::{Fact, Form, Reader, wanted_sides};
use super::meaning::{Meanings, What};
use super::summary::{GateSummary, Summary, Witness};
use super::watertight::signed;
use super::witness::Searched;
use crate::arith::recorded::{Comparison, Operation};
use crate::kernel::{Acceptance, Entry, Scalar};

/// True if a gate compares numbers with 0 alone, wherever it does.
pub fn compares_with_zero<F>(summary: &Summary<F>, gate: usize) -> bool {
    let proof = &summary.proof;
    proof.paths.iter().all(|path| {
        let is_zero =
            |place| path.operations[signed(path, place).place as usize] == Operation::Number(0);
        let is_with_zero = |comparison: &Comparison| match *comparison {
            Comparison::Less(a, b) | Comparison::AtMost(a, b) => is_zero(a) || is_zero(b),
            Comparison::Zero(_) | Comparison::Negative(_) => true,
        };
        let mut compared = path.compared.iter().filter(|it| it.gate == gate);
        compared.all(|compared| match &compared.accepts {
            Acceptance::Clauses(..) => true,
            Acceptance::Fixed(asked, _) => asked.iter().all(is_with_zero),
            Acceptance::Rounded(outcomes) => {
                let mut answers = outcomes.iter().flat_map(|outcome| &outcome.answers);
                answers.all(|(comparison, _)| is_with_zero(comparison))
            }
        })
    })
}

/// The decisions of a gate, wherever it is asked; none if something of them is not read.
fn forms_of<F>(summary: &Summary<F>, gate: usize) -> Option<Vec<Form>> {
    let proof = &summary.proof;
    let mut meanings = Meanings::new(proof);
    let mut forms = Vec::new();
    for (index, path) in proof.paths.iter().enumerate() {
        for compared in path.compared.iter().filter(|it| it.gate == gate) {
            let mut reader = Reader {
                proof,
                index,
                path,
                meanings: &mut meanings,
            };
            forms.push(reader.form(compared)?);
        }
    }
    Some(forms)
}

/// True if a gate compares weights alone, and some epsilon is low enough that it refuses no hit on the sides that are owed.
pub fn loses_no_hit<F>(entry: &Entry, summary: &Summary<F>, gate: usize) -> bool {
    let sides = entry.info.contract.sides;
    forms_of(summary, gate).is_some_and(|forms| {
        forms.iter().all(|form| {
            let mut wanted = wanted_sides(form.facts().copied(), sides);
            form.is_of_weights() && wanted.all(|side| form.refuses[side].is_some())
        })
    })
}

/// True if every hit has to pass the gate, and each way to pass it wants a number that is 0 for every ray that is exactly parallel.
pub fn is_zero_of_parallel_rays<F>(summary: &Summary<F>, gate: usize) -> bool {
    let is_zero =
        |fact: &Fact| matches!(fact.what, What::One | What::Size) && fact.scale.has_sign();
    let mut hits = summary.proof.paths.iter().filter(|path| path.hits);
    let is_asked = hits.all(|path| path.compared.iter().any(|it| it.gate == gate));
    let forms = forms_of(summary, gate).filter(|_| is_asked);
    forms.is_some_and(|forms| {
        let mut ways = forms.iter().flat_map(|form| &form.ways);
        ways.all(|way| way.iter().any(is_zero))
    })
}

/// True if the known parallel ray, or the one in the opposite direction, passes a gate at an epsilon, its lengths times a power of
/// two. The number of one of them may be positive and that of the other negative.
pub fn passes_scaled<F: Searched + Scalar>(
    entry: &Entry,
    gate: &GateSummary<F>,
    exponent: i32,
    epsilon: f64,
) -> bool {
    let gated = F::subject(entry).and_then(|subject| subject.gated());
    let (Some(Witness { inputs, .. }), Some(gated)) = (gate.witnesses[1], gated) else {
        return false;
    };
    let factor = 2f64.powi(exponent);
    let mut scaled = inputs;
    for i in (0..3).chain(6..15) {
        scaled[i] = F::from_f64(inputs[i].to_f64() * factor);
        if scaled[i].to_f64() / factor != inputs[i].to_f64() {
            return false;
        }
    }
    [F::one(), -F::one()].into_iter().any(|side| {
        let mut turned = scaled;
        for x in &mut turned[3..6] {
            *x = side * *x;
        }
        let margin = gated.measure(&case_of(&turned)).margins[gate.index];
        F::from_f64(epsilon) <= margin
    })
}

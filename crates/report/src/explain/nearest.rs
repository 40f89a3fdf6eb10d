//! The built-in formula that answers as a kernel does whose own is not shown: what the formula does on a case is a likely cause
//! of the kernel's mistake there.

use super::near::{Nearby, run};
use super::other_epsilon::other_epsilon;
use super::verdict::verdict_of;
use crate::arith::Float;
use crate::audit::{Row, attribute};
use crate::case::Case;
use crate::judge::asked;
use crate::kernel::{KERNELS, Scalar, Verdict};
use crate::oracle;
use hairline_record::{ComputedFormula, group_digits};

/// The ending of a name that says that products are fused into sums.
const FUSED: &str = "+fma";

/// The fewest hits of both by which a formula is known.
const FEWEST_HITS: usize = 50;
/// The least share of them with the same values.
const LEAST_SAME: f64 = 0.9;
/// So many cases are compared before a formula is looked at again: most differ in so many values that the rest cannot make
/// up for it.
const BATCH: usize = 100;

/// The answers of a formula beside a kernel's.
struct FormulaBeside {
    row: Row,
    /// Hits of both.
    hits: usize,
    /// Those with the same values, bit for bit.
    same: usize,
    /// The same verdicts.
    agreed: usize,
}

impl FormulaBeside {
    /// The answers of a formula to the cases nearby; none if it does not run in this scalar, or is not one to know the kernel by.
    fn named<F: Scalar>(name: &str, kernel: &Row, nearby: &Nearby<F>) -> Option<FormulaBeside> {
        let row = Row::named(name, None, &kernel.contract.words(None)).ok()?;
        let subject = F::subject(row.entry)?;
        let gives_uv = row.entry.info.gives.uv && kernel.entry.info.gives.uv;
        let hits_of_kernel = nearby.answers.iter().filter(|it| it.hit).count();
        let mut beside = FormulaBeside {
            row,
            hits: 0,
            same: 0,
            agreed: 0,
        };
        let batches = nearby.drawn.chunks(BATCH);
        for (cases, of_kernel) in batches.zip(nearby.answers.chunks(BATCH)) {
            let answers = run(subject, cases, &beside.row);
            for (one, other) in of_kernel.iter().zip(&answers) {
                beside.add(one, other, gives_uv);
            }
            let most_same = hits_of_kernel - (beside.hits - beside.same);
            if (most_same as f64) < LEAST_SAME * hits_of_kernel as f64 {
                return None;
            }
        }
        beside.is_known().then_some(beside)
    }

    /// Counts the answers of both to a case.
    fn add<F: Float>(&mut self, one: &Verdict<F>, other: &Verdict<F>, gives_uv: bool) {
        if one.hit == other.hit {
            self.agreed += 1;
        }
        if one.hit && other.hit {
            self.hits += 1;
            if has_same_values(one, other, gives_uv) {
                self.same += 1;
            }
        }
    }

    /// True if the hits are enough to know the kernel by.
    fn is_known(&self) -> bool {
        FEWEST_HITS <= self.hits && LEAST_SAME * self.hits as f64 <= self.same as f64
    }
}

/// True if two hits have the same t, and the same u and v where both give them, bit for bit.
fn has_same_values<F: Float>(one: &Verdict<F>, other: &Verdict<F>, gives_uv: bool) -> bool {
    let is_same = |x: F, y: F| x.to_bits() == y.to_bits();
    let has_same_uv = || is_same(one.u, other.u) && is_same(one.v, other.v);
    is_same(one.t, other.t) && (!gives_uv || has_same_uv())
}

/// A note on the built-in formula that is nearest to a wrong kernel, and on what it does on the case; none if none is near.
pub(super) fn nearest<F: Scalar>(
    case: &Case<F>,
    is_secondary: bool,
    row: &Row,
    verdict: &Verdict<F>,
    nearby: &Nearby<F>,
) -> Option<String> {
    let formula = nearest_formula(row, nearby)?;
    let FormulaBeside {
        hits, same, agreed, ..
    } = formula;
    let agreed = group_digits(agreed as u64);
    let drawn = group_digits(nearby.drawn.len() as u64);
    let name = in_words(formula.row.entry.info.name);
    let other = match other_epsilon(row, &formula.row, nearby) {
        Some(other) => format!("; it would on all with {other}"),
        None => String::new(),
    };
    let answer = answer_here(case, is_secondary, &formula.row, verdict)?;
    Some(format!(
        "compared, not proved: on {agreed} of {drawn} cases like this one it answers as {name} does, and on {same} of {hits} \
         hits of both with the same bits{other}; {answer}"
    ))
}

/// The built-in formula that a wrong kernel computes with another epsilon or with fused products, as its answers to cases like
/// a given one show; none where neither is seen.
pub fn misused_formula<F: Scalar>(case: &Case<F>, row: &Row) -> Option<ComputedFormula> {
    let nearby = Nearby::of(case, row)?;
    let formula = nearest_formula(row, &nearby)?;
    let epsilon = other_epsilon(row, &formula.row, &nearby);
    let name = formula.row.entry.info.name;
    let plain = name.strip_suffix(FUSED);
    if epsilon.is_none() && plain.is_none() {
        return None;
    }
    Some(ComputedFormula {
        kernel: row.entry.info.name.to_owned(),
        set: row.set.clone(),
        formula: plain.unwrap_or(name).to_owned(),
        is_fused: plain.is_some(),
        epsilon,
        same: formula.same as u64,
        hits: formula.hits as u64,
    })
}

/// The formula with the most hits of the same values, among those that a kernel can be known by: its own, or the same with fused
/// products.
fn nearest_formula<F: Scalar>(row: &Row, nearby: &Nearby<F>) -> Option<FormulaBeside> {
    if !row.entry.info.gives.t {
        return None;
    }
    let mut all = Vec::new();
    // Of equals `max_by_key` takes the last: one without fused products, and the first of the table.
    for ending in [FUSED, ""] {
        for entry in KERNELS.iter().rev() {
            let name = format!("{}{ending}", entry.info.name);
            all.extend(FormulaBeside::named(&name, row, nearby));
        }
    }
    all.into_iter().max_by_key(|it| (it.same, it.agreed))
}

/// The name of a formula: `moller-trumbore with fused products`.
fn in_words(name: &str) -> String {
    match name.strip_suffix(FUSED) {
        Some(name) => format!("{name} with fused products"),
        None => name.to_owned(),
    }
}

/// The answer of a formula to the case, beside the kernel's verdict.
fn answer_here<F: Scalar>(
    case: &Case<F>,
    is_secondary: bool,
    row: &Row,
    verdict: &Verdict<F>,
) -> Option<String> {
    let subject = F::subject(row.entry)?;
    let epsilons: Vec<F> = row.epsilons();
    let answer = verdict_of(subject, case, &epsilons);
    let does = match answer.refused_by {
        None => "hits".to_owned(),
        Some(i) => {
            let gate = row.entry.info.gates[usize::from(i)];
            format!("refuses by its gate {} ({})", gate.name, gate.refuses)
        }
    };
    if answer.hit != verdict.hit {
        return Some(format!(
            "here they part: that formula {does}, so something else decides"
        ));
    }
    let truth = oracle::truth(case);
    let owed = asked(case, &truth, &row.contract, is_secondary);
    let cause = attribute(subject, case, &epsilons, &truth, (&row.contract, owed));
    let cause = cause.map_or(String::new(), |cause| format!(": {}", cause.describe()));
    Some(format!("here that formula {does} too{cause}"))
}

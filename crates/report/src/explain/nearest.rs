//! The built-in formula that answers as a kernel does which does not show its own: what it does on the case is a likely cause.

use super::near::{Nearby, run};
use super::other_epsilon::other_epsilon;
use super::verdict::verdict_of;
use crate::arith::Float;
use crate::audit::{Row, attribute};
use crate::case::Case;
use crate::judge::asked;
use crate::kernel::{KERNELS, Scalar, Verdict};
use crate::oracle;
use hairline_record::group_digits;

/// The ending of a name that says that products are fused into sums.
const FUSED: &str = "+fma";

/// The fewest hits of both by which a formula is known, and the share of them with the same values.
const FEWEST_HITS: usize = 50;
const SAME: f64 = 0.9;

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

/// A note on the built-in formula that is nearest to a wrong kernel, and on what it does on the case; none if none is near.
pub(super) fn nearest<F: Scalar>(
    case: &Case<F>,
    is_secondary: bool,
    row: &Row,
    verdict: &Verdict<F>,
    nearby: &Nearby<F>,
) -> Option<String> {
    let nearest = nearest_formula(row, nearby)?;
    let FormulaBeside {
        hits, same, agreed, ..
    } = nearest;
    let text = format!(
        "{} of {} cases like this one it answers as {} does, and on {same} of {hits} hits of both with the same bits",
        group_digits(agreed as u64),
        group_digits(nearby.drawn.len() as u64),
        in_words(nearest.row.entry.info.name),
    );
    let other = other_epsilon(row, &nearest.row, nearby);
    let other = other.map_or(String::new(), |words| {
        format!("; it would on all with {words}")
    });
    let here = here(case, is_secondary, &nearest.row, verdict)?;
    Some(format!("compared, not proved: on {text}{other}; {here}"))
}

/// The built-in formula that a wrong kernel computes with another epsilon or with fused products, as its answers to cases like
/// a given one show: `moller-trumbore with parallel between 9.8e-5 and 1.04e-4 in place of 1e-6`; none where neither is seen.
pub fn misused_formula<F: Scalar>(case: &Case<F>, row: &Row) -> Option<String> {
    let nearby = Nearby::of(case, row)?;
    let formula = nearest_formula(row, &nearby)?;
    let name = formula.row.entry.info.name;
    let other = other_epsilon(row, &formula.row, &nearby);
    if other.is_none() && !name.ends_with(FUSED) {
        return None;
    }
    let how = other.map_or(String::new(), |other| format!(" with {other}"));
    let (same, hits) = (
        group_digits(formula.same as u64),
        group_digits(formula.hits as u64),
    );
    Some(format!(
        "it computes {}{how}: {same} of {hits} hits have its bits",
        in_words(name)
    ))
}

/// The formula with the most hits of the same values, if they are enough to know it by: a kernel's own, or the same with fused
/// products.
fn nearest_formula<F: Scalar>(row: &Row, nearby: &Nearby<F>) -> Option<FormulaBeside> {
    if !row.entry.info.gives.t {
        return None;
    }
    let contract = row.contract.words(None);
    let names = KERNELS.iter().rev().map(|entry| entry.info.name);
    let fused = names.clone().map(|name| format!("{name}{FUSED}"));
    // Of equals the last is taken: one without fused products, and the first of the table.
    let beside = fused.chain(names.map(str::to_owned)).filter_map(|name| {
        let other = Row::named(&name, None, &contract).ok()?;
        let others = run(F::subject(other.entry)?, &nearby.drawn, &other);
        let gives_uv = other.entry.info.gives.uv && row.entry.info.gives.uv;
        let pairs = || nearby.answers.iter().zip(&others);
        let both = || pairs().filter(|(one, other)| one.hit && other.hit);
        let is_same = |(one, other): &(&Verdict<F>, &Verdict<F>)| {
            let values = |it: &Verdict<F>| {
                if gives_uv {
                    [it.t, it.u, it.v]
                } else {
                    [it.t; 3]
                }
            };
            values(one).map(Float::to_bits) == values(other).map(Float::to_bits)
        };
        Some(FormulaBeside {
            row: other,
            hits: both().count(),
            same: both().filter(is_same).count(),
            agreed: pairs().filter(|(one, other)| one.hit == other.hit).count(),
        })
    });
    let most = beside.max_by_key(|it| (it.same, it.agreed));
    most.filter(|it| FEWEST_HITS <= it.hits && SAME * it.hits as f64 <= it.same as f64)
}

/// The name of a formula: `moller-trumbore with fused products`.
fn in_words(name: &str) -> String {
    match name.strip_suffix(FUSED) {
        Some(name) => format!("{name} with fused products"),
        None => name.to_owned(),
    }
}

/// The answer of a formula on the case.
fn here<F: Scalar>(
    case: &Case<F>,
    is_secondary: bool,
    row: &Row,
    verdict: &Verdict<F>,
) -> Option<String> {
    let (subject, epsilons) = (F::subject(row.entry)?, row.epsilons::<F>());
    let answer = verdict_of(subject, case, &epsilons);
    let gate = answer
        .refused_by
        .map(|i| row.entry.info.gates[usize::from(i)]);
    let does = match gate {
        None => "hits".to_owned(),
        Some(gate) => format!("refuses by its gate {} ({})", gate.name, gate.refuses),
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

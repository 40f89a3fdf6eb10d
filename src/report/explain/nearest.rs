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
use crate::report::group_digits;

/// The ending of a name that says that products are fused into sums.
const FUSED: &str = "+fma";

/// The fewest hits of both by which a formula is known, and the share of them with the same values.
const FEWEST_HITS: usize = 20;
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
    let FormulaBeside { hits, same, agreed, .. } = nearest;
    if hits < FEWEST_HITS || (same as f64) < SAME * hits as f64 {
        return None;
    }
    let text = format!(
        "{} of {} cases like this one it answers as {} does, and on {same} of {hits} hits of both with the same bits",
        group_digits(agreed as u64),
        group_digits(nearby.drawn.len() as u64),
        in_words(nearest.row.entry.info.name),
    );
    let other = other_epsilon(&nearest.row, nearby);
    let other = other.map_or(String::new(), |words| format!("; it would on all with {words}"));
    let here = here(case, is_secondary, &nearest.row, verdict)?;
    Some(format!("compared, not proved: on {text}{other}; {here}"))
}

/// The formula with the most hits of the same values: a kernel's own, or the same with fused products.
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
            let values = |it: &Verdict<F>| if gives_uv { [it.t, it.u, it.v] } else { [it.t; 3] };
            values(one).map(Float::to_bits) == values(other).map(Float::to_bits)
        };
        Some(FormulaBeside {
            row: other,
            hits: both().count(),
            same: both().filter(is_same).count(),
            agreed: pairs().filter(|(one, other)| one.hit == other.hit).count(),
        })
    });
    beside.max_by_key(|it| (it.same, it.agreed))
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
    let gate = answer.refused_by.map(|i| row.entry.info.gates[usize::from(i)]);
    let does = match gate {
        None => "hits".to_owned(),
        Some(gate) => {
            let compares = gate.refuses.split(" (printed").next().unwrap_or_default();
            format!("refuses by its gate {} ({compares})", gate.name)
        }
    };
    if answer.hit != verdict.hit {
        return Some(format!("here they part: that formula {does}, so something else decides"));
    }
    let truth = oracle::truth(case);
    let owed = asked(case, &truth, &row.contract, is_secondary);
    let cause = attribute(subject, case, &epsilons, &truth, (&row.contract, owed));
    let cause = cause.map_or(String::new(), |cause| format!(": {}", cause.describe()));
    Some(format!("here that formula {does} too{cause}"))
}

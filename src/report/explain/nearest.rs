//! The built-in formula that answers as a kernel does which does not show its own: what it does on the case is a likely cause.

use super::verdict::verdict_of;
use crate::arith::Float;
use crate::audit::{Row, attribute};
use crate::case::{Case, Draw};
use crate::judge::asked;
use crate::kernel::{KERNELS, Scalar, Subject, Verdict};
use crate::oracle;
use crate::report::group_digits;

/// How many cases are tried.
const CASES: usize = 1_000;

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
) -> Option<String> {
    let subject = F::subject(row.entry)?;
    if !row.entry.info.gives.t || subject.talks() {
        return None;
    }
    let mut draw = Draw::new("nearest", 1, 0);
    let cases: Vec<Case<F>> =
        (0..CASES).map(|i| near(case, [i % 2 == 1, i % 4 < 2], &mut draw)).collect();
    let run = |subject: &dyn Subject<F>, epsilons: &[F]| {
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        subject.run(&cases, epsilons, &mut verdicts);
        verdicts
    };
    let answers = run(subject, &row.epsilons::<F>());
    let contract = row.contract.words(None);
    let beside = KERNELS.iter().rev().filter_map(|entry| {
        let other = Row::named(entry.info.name, None, &contract).ok()?;
        let others = run(F::subject(entry)?, &other.epsilons::<F>());
        let gives_uv = entry.info.gives.uv && row.entry.info.gives.uv;
        let both = || answers.iter().zip(&others).filter(|(one, other)| one.hit && other.hit);
        let is_same = |(one, other): &(&Verdict<F>, &Verdict<F>)| {
            let values = |it: &Verdict<F>| if gives_uv { [it.t, it.u, it.v] } else { [it.t; 3] };
            values(one).map(Float::to_bits) == values(other).map(Float::to_bits)
        };
        Some(FormulaBeside {
            row: other,
            hits: both().count(),
            same: both().filter(is_same).count(),
            agreed: answers.iter().zip(&others).filter(|(one, other)| one.hit == other.hit).count(),
        })
    });
    let nearest = beside.max_by_key(|it| (it.same, it.agreed))?;
    let FormulaBeside { hits, same, agreed, .. } = nearest;
    if hits < FEWEST_HITS || (same as f64) < SAME * hits as f64 {
        return None;
    }
    let info = nearest.row.entry.info;
    let text = format!(
        "{} of {} cases like this one it answers as {} does, and on {same} of {hits} hits of both with the same bits",
        group_digits(agreed as u64),
        group_digits(CASES as u64),
        info.name
    );
    let here = here(case, is_secondary, &nearest.row, verdict)?;
    Some(format!("compared, not proved: on {text}; {here}"))
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

/// The case with every number moved by the same part of its triangle, or of the direction: from one unit in the last place to
/// all of it. In ordinary sizes if asked, because what an epsilon refuses in small triangles is a hit there; and from the other side.
fn near<F: Float>(case: &Case<F>, [ordinary, turned]: [bool; 2], draw: &mut Draw) -> Case<F> {
    let [o, d, a, b, c] = case.vectors();
    let [b, c] = if turned { [c, b] } else { [b, c] };
    let largest =
        |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, |m: f64, x| m.max(x.abs()));
    let sides = [b, c].map(|vertex| [0, 1, 2].map(|i| (vertex[i] - a[i]).to_f64()));
    let size = largest(&mut sides.into_iter().flatten());
    let length = largest(&mut d.into_iter().map(F::to_f64));
    // Powers of two change no rounding.
    let power = |size: f64| match ordinary && size.is_normal() {
        true => 2f64.powi(-size.log2().floor() as i32),
        false => 1.0,
    };
    let (of_size, of_length) = (power(size), power(length));
    let part = 2f64.powi(-(draw.below(F::DIGITS as usize) as i32));
    let mut moved = |vector: [F; 3], size: f64, power: f64| {
        vector.map(|x| {
            let by = draw.symmetric::<F>().to_f64() * size * part;
            F::from_f64((x.to_f64() + by) * power)
        })
    };
    let [o, a, b, c] = [o, a, b, c].map(|point| moved(point, size, of_size));
    let ends = [case.ray.t_min, case.ray.t_max];
    let [t_min, t_max] = ends.map(|t| F::from_f64(t.to_f64() * of_size / of_length));
    Case::new(o, moved(d, length, of_length), [a, b, c]).on(t_min, t_max)
}

//! Ways to make a wrong verdict right: other epsilons, a comparison of t, more precision, another kernel. Each is tried on the
//! case before it is said.

use super::verdict::{Together, group_verdict, number, verdict_of};
use crate::arith::{Float, smallest_normal};
use crate::audit::{Attribution, Row};
use crate::case::Case;
use crate::contract::{Extent, Sides};
use crate::epsilon::shortest;
use crate::judge::{Finding, asked, judge};
use crate::kernel::{self, Entry, KernelIn, Role, Scalar, Tunable, Verdict};
use crate::lists::listed;
use crate::oracle;
use crate::truth::{Facing, Truth};
use std::slice;

/// So many other kernels are named.
const MOST_NAMES: usize = 3;

/// The changes that make a row right on a case.
pub(super) fn advice<F: Scalar>(
    case: &Case<F>,
    is_secondary: bool,
    row: &Row,
    (finding, cause): (Finding, Option<Attribution>),
    verdict: &Verdict<F>,
) -> Vec<String> {
    let mut all = Vec::new();
    if cause == Some(Attribution::Convention) && is_off_the_ray(case, row, verdict) {
        let end = if verdict.t < case.ray.t_min {
            "t >= t_min"
        } else {
            "t <= t_max"
        };
        all.push(format!("counting a hit only if {end}: it has no gate on t"));
    } else if cause == Some(Attribution::Convention) {
        let promised = row.entry.info.contract;
        let is_back = oracle::truth(case).crossing().map(|it| it.facing) == Some(Facing::Back);
        if finding == Finding::FalseHit {
            all.extend(other_epsilons(case, is_secondary, row, (finding, cause)));
        }
        if promised.sides == Sides::Front && is_back && finding == Finding::FalseMiss {
            all.push(
                "a kernel of both sides: it counts front faces only, as it promises".to_owned(),
            );
        }
    } else {
        all.extend(other_epsilons(case, is_secondary, row, (finding, cause)));
    }
    if F::NAME == f32::NAME && row.entry.scalars()[1] {
        let wide = case.widen();
        let epsilons: Vec<f64> = row.epsilons();
        if is_right(&wide, is_secondary, row, f64::subject(row.entry), &epsilons) {
            all.push("in f64".to_owned());
        }
    }
    let is_right_of = |other: &Row| {
        is_right(
            case,
            is_secondary,
            other,
            F::subject(other.entry),
            &other.epsilons::<F>(),
        )
    };
    all.extend(others(row, is_right_of).map(|names| format!("other kernels: {names}")));
    all
}

/// The built-in kernels that are right on a group.
pub(super) fn group_advice<F: Scalar>(group: Together<F>, row: &Row) -> String {
    let is_right_of = |other: &Row| {
        let subject = F::subject(other.entry);
        subject.is_some_and(|it| matches!(group_verdict(group, other, it), Ok((_, _, false))))
    };
    others(row, is_right_of).unwrap_or_default()
}

/// The names of the built-in kernels that are right by the contract of a row, with their authors' epsilons.
fn others(row: &Row, is_right: impl Fn(&Row) -> bool) -> Option<String> {
    let contract = row.contract.words(None);
    let other = |entry: &&Entry| {
        let name = entry.info.name;
        let other = Row::named(name, None, &contract)
            .ok()
            .filter(|_| name != row.entry.info.name);
        other.is_some_and(|other| is_right(&other))
    };
    let names: Vec<&str> = kernel::KERNELS
        .iter()
        .filter(other)
        .map(|entry| entry.info.name)
        .collect();
    (!names.is_empty()).then(|| listed(&names, MOST_NAMES))
}

/// True if the kernel, run with these epsilons, does as a row's contract asks.
fn is_right<F: Scalar>(
    case: &Case<F>,
    is_secondary: bool,
    row: &Row,
    subject: Option<&dyn KernelIn<F>>,
    epsilons: &[F],
) -> bool {
    let Some(subject) = subject else { return false };
    let truth = oracle::truth(case);
    let owed = asked(case, &truth, &row.contract, is_secondary);
    let verdict = verdict_of(subject, case, epsilons);
    judge(
        (&row.contract, owed),
        (case, &truth),
        row.entry.info.gives,
        &verdict,
    )
    .is_none()
}

/// True of a hit whose t, as computed, is not on the ray, by a kernel that never looks.
fn is_off_the_ray<F: Scalar>(case: &Case<F>, row: &Row, verdict: &Verdict<F>) -> bool {
    let info = row.entry.info;
    let looks = info.gates.iter().any(|gate| gate.role == Role::T);
    verdict.hit && info.gives.t && !looks && is_off(case, verdict)
}

fn is_off<F: Scalar>(case: &Case<F>, verdict: &Verdict<F>) -> bool {
    verdict.t < case.ray.t_min || case.ray.t_max < verdict.t
}

/// A note on a hit that a kernel of lines reports off the ray.
pub(super) fn of_line<F: Scalar>(
    case: &Case<F>,
    row: &Row,
    verdict: &Verdict<F>,
) -> Option<String> {
    let is_of_lines = row.contract.extent == Extent::Line;
    let is_off = verdict.hit && row.entry.info.gives.t && is_off(case, verdict);
    (is_of_lines && is_off).then(|| {
        format!(
            "t = {} is not on the ray: this kernel answers for the whole line, and its caller must compare t",
            number(verdict.t)
        )
    })
}

/// A note on what lets a hit on invalid input pass: the contract, and comparisons that are false of a NaN.
pub(super) fn of_invalid<F: Scalar>(
    truth: &Truth,
    subject: &dyn KernelIn<F>,
    verdict: &Verdict<F>,
) -> Option<String> {
    if *truth != Truth::Invalid || !verdict.hit {
        return None;
    }
    let passes = match subject.gated() {
        Some(_) => {
            "each of its gates refuses only where a comparison is true, and one with NaN is false"
        }
        None => {
            "a comparison that refuses lets NaN pass, as `if (u < 0) return false` does; `if (!(u >= 0)) return false` does not"
        }
    };
    Some(format!(
        "a hit on invalid input: {passes}; a contract with invalid=miss calls that a false hit"
    ))
}

/// The epsilons nearest to a row's with which it is right.
fn other_epsilons<F: Scalar>(
    case: &Case<F>,
    is_secondary: bool,
    row: &Row,
    (finding, cause): (Finding, Option<Attribution>),
) -> Option<String> {
    let subject = F::subject(row.entry)?;
    let info = row.entry.info;
    let old: Vec<F> = row.epsilons();
    let mut margins = vec![F::from_f64(f64::NAN); info.gates.len()];
    let exact = match subject.gated() {
        Some(gated) => {
            margins.clone_from(&gated.measure(case).margins);
            Some(gated.measure_exact(case).margins)
        }
        None if subject.tells_margins() => {
            subject.margins(info, slice::from_ref(case), &mut margins, &mut []);
            None
        }
        None => return None,
    };
    // Those that refuse a hit, or those that should have refused one; of a formula that should not have hit, any.
    let is_to_blame = |i: usize| match finding {
        Finding::FalseMiss => margins[i] < old[i],
        Finding::FalseHit if cause == Some(Attribution::Convention) => true,
        Finding::FalseHit => exact
            .as_ref()
            .is_some_and(|exact| exact[i].approximate() < old[i].to_f64()),
        _ => false,
    };
    let tuned: Vec<usize> = (0..info.gates.len())
        .filter(|i| info.gates[*i].epsilon != Tunable::Fixed && margins[*i].to_f64().is_finite())
        .filter(|i| is_to_blame(*i))
        .collect();
    let is_lower = finding == Finding::FalseMiss;
    let with = |gates: &[usize], value: &dyn Fn(F) -> F| {
        let mut new = old.clone();
        gates.iter().for_each(|i| new[*i] = value(margins[*i]));
        let fits = |i: &usize| info.gates[*i].epsilon == Tunable::Signed || F::zero() <= new[*i];
        let is_right = !gates.is_empty()
            && gates.iter().all(fits)
            && is_right(case, is_secondary, row, Some(subject), &new);
        is_right.then_some(new)
    };
    let nearest = |gates: &[usize]| {
        let rounded = with(gates, &|margin| in_two_digits(margin, is_lower));
        rounded.or_else(|| {
            with(gates, &|margin| {
                if is_lower {
                    margin
                } else {
                    margin.offset_ulps(1)
                }
            })
        })
    };
    // All that refuse must let it pass, and one of those that should refuse it is enough: the smallest.
    let size = |new: &Vec<F>, i: usize| new[i].to_f64().abs();
    let (gates, new) = match is_lower {
        true => (tuned.clone(), nearest(&tuned)?),
        false => {
            let each = tuned.iter().filter_map(|i| Some((*i, nearest(&[*i])?)));
            let least = each.min_by(|(i, a), (k, b)| size(a, *i).total_cmp(&size(b, *k)))?;
            (vec![least.0], least.1)
        }
    };
    // Nobody would set such a number.
    let is_tiny = |i: &usize| !new[*i].is_zero() && size(&new, *i) < smallest_normal::<F>();
    if gates.iter().any(is_tiny) {
        return None;
    }
    let words = gates.iter().map(|i| {
        let (name, old, new) = (info.gates[*i].name, shortest(old[*i]), shortest(new[*i]));
        format!("{name} = {new} in place of {old}")
    });
    let words = words.collect::<Vec<_>>().join(" and ");
    Some(format!("{words} (`hairline epsilon` weighs all cases)"))
}

/// The nearest number of two digits that is not above, or not below.
fn in_two_digits<F: Float>(x: F, down: bool) -> F {
    let rounded = |x: f64| format!("{x:.1e}").parse::<f64>().unwrap_or(x);
    let x = x.to_f64();
    let is_beyond = |y: f64| if down { x < y } else { y <= x };
    let step = 0.06 * x.abs() * if down { -1.0 } else { 1.0 };
    let first = rounded(x);
    F::from_f64(if is_beyond(first) {
        rounded(x + step)
    } else {
        first
    })
}

//! Floor 3: the only place that compares a verdict with a truth under a contract.

#![forbid(unsafe_code)]

mod change;
mod class;
mod distance;
mod elsewhere;
mod expected;
mod group;
mod limits;
mod relation;
#[cfg(test)]
mod tests;
mod values;

pub use change::exact_to_change;
pub use class::{Class, TruthKind};
pub use distance::{Distances, Squares, nearest_on_segment, square, ulp_of_points};
pub use elsewhere::{is_moved, may_be_elsewhere};
pub use expected::{Demands, Kinds, ask_all, suspects};
pub use group::{
    GroupTruth, group_obligation, group_truth, owes_groups_alike, polygon_obligation, polygon_truth,
};
pub use limits::ValueLimits;
pub use relation::{
    MISSES, Part, RelatedValues, Relation, answers_as, is_hit_far_beside, is_plain, other_demands,
    stands_for_miss,
};
pub use values::{ALLOWANCE, ValueErrors, exact_times, exact_values_are_near, rounds_to_infinity};

use crate::arith::{Exact, Float, Real, Triple};
use crate::case::Case;
use crate::contract::{Boundary, Contract, Demand, Direction, Extent, Sides};
use crate::kernel::{Failure, Gives, Verdict};
use crate::truth::{Contact, ContactKind, Crossing, Facing, Feature, Place, Truth};
use std::cmp::Ordering;

/// A contract's demand on a kernel for a case; the more it permits to miss, the greater.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Obligation {
    /// A hit.
    MustHit,
    /// Nothing.
    Free,
    /// A miss.
    MustMiss,
}

named! {
    pub names
    /// A disagreement.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Finding {
        /// It must hit, and missed.
        FalseMiss = "false-miss",
        /// It must miss, and hit.
        FalseHit = "false-hit",
        /// A hit that is not false, with a value that is not finite or with a wrong facing.
        BadValue = "bad-value",
        /// A hit that is not false, whose t, u or v is farther from its exact value than rounding could carry it
        /// ([`ALLOWANCE`]).
        WrongValue = "wrong-value",
        /// The kernel panicked.
        Panic = "panic",
        /// The kernel's process died, or it wrote outside its output.
        Crash = "crash",
        /// The kernel's process gave no answer in time.
        Timeout = "timeout",
    }
}

impl Finding {
    /// True if the kernel gave no verdict at all.
    pub fn is_failure(self) -> bool {
        matches!(self, Finding::Panic | Finding::Crash | Finding::Timeout)
    }
}

/// The contract's demand for this truth. `secondary` says that the ray starts at a kernel's own
/// rounded hit point on the triangle, as a secondary ray does.
pub fn obligation(truth: &Truth, contract: &Contract, secondary: bool) -> Obligation {
    if contract.no_self_hit && secondary && *truth != Truth::Invalid {
        return Obligation::MustMiss;
    }
    let extent = contract.extent;
    match truth {
        Truth::Invalid => demanded(contract.invalid, false),
        Truth::Parallel => Obligation::MustMiss,
        Truth::Coplanar(contact) => demanded(contract.coplanar, touches(contact, extent)),
        Truth::Degenerate(contact) => demanded(contract.degenerate, touches(contact, extent)),
        Truth::Transversal(crossing) => crossing_obligation(crossing, contract),
    }
}

/// The contract's demand on a case: nothing if it promises nothing for the direction, nothing within its band, and no
/// hit below its least determinant.
pub fn asked<F: Float>(
    case: &Case<F>,
    truth: &Truth,
    contract: &Contract,
    secondary: bool,
) -> Obligation {
    if !promises_direction::<F>(contract.direction, case.ray.direction.into()) {
        return Obligation::Free;
    }
    let asked = obligation(truth, contract, secondary);
    if asked == Obligation::Free || *truth == Truth::Invalid {
        return asked;
    }
    let within = |band| change::is_within(band, case, truth, contract);
    let is_small = asked == Obligation::MustHit && change::has_small_determinant(case, contract);
    if is_small || contract.band.is_some_and(within) {
        Obligation::Free
    } else {
        asked
    }
}

fn demanded(demand: Demand, contact: bool) -> Obligation {
    match (demand, contact) {
        (Demand::Free, _) => Obligation::Free,
        (Demand::Hit, true) => Obligation::MustHit,
        (Demand::Hit, false) | (Demand::Miss, _) => Obligation::MustMiss,
    }
}

fn touches(contact: &Contact, extent: Extent) -> bool {
    match extent {
        Extent::Line => contact.meets_line,
        Extent::Ray => contact.meets_ray,
        Extent::Interval => contact.kind != ContactKind::None,
    }
}

fn crossing_obligation(crossing: &Crossing, contract: &Contract) -> Obligation {
    let culled = contract.sides == Sides::Front && crossing.facing == Facing::Back;
    if culled || !is_in_extent(crossing, contract.extent) {
        return Obligation::MustMiss;
    }
    let across = match crossing.feature {
        Feature::Outside => return Obligation::MustMiss,
        Feature::Interior => Obligation::MustHit,
        _ => at_rim(contract.boundary),
    };
    let along = match is_at_end(crossing, contract.extent) {
        true => at_rim(contract.ends),
        false => Obligation::MustHit,
    };
    // Each of the two may forbid the hit, or leave it free.
    across.max(along)
}

/// The demand on a boundary.
fn at_rim(boundary: Boundary) -> Obligation {
    match boundary {
        Boundary::Closed => Obligation::MustHit,
        Boundary::Open => Obligation::MustMiss,
        Boundary::Free => Obligation::Free,
    }
}

/// True if a crossing lies exactly on an end of the part of the line that counts.
fn is_at_end(crossing: &Crossing, extent: Extent) -> bool {
    match extent {
        Extent::Line => false,
        Extent::Ray => crossing.t_sign == Ordering::Equal,
        Extent::Interval => matches!(crossing.place, Place::AtMin | Place::AtMax),
    }
}

/// True if a crossing lies on the part of the line that counts.
pub fn is_in_extent(crossing: &Crossing, extent: Extent) -> bool {
    match extent {
        Extent::Line => true,
        Extent::Ray => crossing.t_sign != Ordering::Less,
        Extent::Interval => !matches!(crossing.place, Place::Before | Place::Beyond),
    }
}

/// True if the contract promises anything for a direction.
pub fn promises_direction<F: Float>(direction: Direction, d: [F; 3]) -> bool {
    let Direction::Unit { ulps } = direction else {
        return true;
    };
    if !d.iter().all(F::is_finite) {
        return false;
    }
    let length_squared = square(&Triple::from(d.map(|x| Exact::from_f64(x.to_f64()))));
    let tolerance = f64::from(ulps) * F::EPSILON.to_f64();
    let exact_square = |x: Exact| x.clone() * x;
    // No length is below 0.
    let low = exact_square((Exact::one() - Exact::from_f64(tolerance)).larger(Exact::zero()));
    let high = exact_square(Exact::one() + Exact::from_f64(tolerance));
    low.is_at_most(&length_squared) && length_squared.is_at_most(&high)
}

/// As much of a run in any arithmetic as is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// Hit or miss.
    pub hit: bool,
    /// True if every value that the kernel gives is finite.
    pub finite: bool,
    /// True if every value is near its exact one, where it has one ([`ALLOWANCE`]), or as near as the contract tolerates.
    pub near: bool,
    /// The side hit.
    pub facing: Option<Facing>,
}

impl Answer {
    /// The answer in a verdict on a case.
    pub fn of<F: Float>(
        contract: &Contract,
        (case, truth): (&Case<F>, &Truth),
        gives: Gives,
        verdict: &Verdict<F>,
    ) -> Answer {
        let is_number = |t: F| t.is_finite() || values::rounds_to_infinity(case, truth, t);
        let finite = (!gives.t || is_number(verdict.t))
            && (!gives.uv || (verdict.u.is_finite() && verdict.v.is_finite()));
        let compares = verdict.hit && finite && values::has_values(truth);
        let near = !compares || values::are_near(case, gives, verdict, contract.value_tolerance);
        Answer {
            hit: verdict.hit,
            finite,
            near,
            facing: verdict.facing,
        }
    }
}

/// Compares a verdict on a case with what a contract demands there. Values of hits on invalid input are not judged, and
/// of hits along a direction for which the contract promises nothing only whether they are finite, and the facing.
#[inline]
pub fn judge<F: Float>(
    (contract, obligation): (&Contract, Obligation),
    (case, truth): (&Case<F>, &Truth),
    gives: Gives,
    verdict: &Verdict<F>,
) -> Option<Finding> {
    if let Some(failure) = verdict.failure {
        return Some(failed(failure));
    }
    match (obligation, verdict.hit) {
        // No values are compared.
        (Obligation::MustHit, false) => return Some(Finding::FalseMiss),
        (Obligation::MustMiss, true) => return Some(Finding::FalseHit),
        (_, false) => return None,
        _ => {}
    }
    let answer = Answer::of(contract, (case, truth), gives, verdict);
    judge_answer(obligation, truth, gives, answer).filter(|finding| {
        let direction = || case.ray.direction.into();
        *finding != Finding::WrongValue || promises_direction::<F>(contract.direction, direction())
    })
}

/// Compares an answer with the obligation.
#[inline]
pub fn judge_answer(
    obligation: Obligation,
    truth: &Truth,
    gives: Gives,
    answer: Answer,
) -> Option<Finding> {
    match (obligation, answer.hit) {
        (Obligation::MustHit, false) => Some(Finding::FalseMiss),
        (Obligation::MustMiss, true) => Some(Finding::FalseHit),
        (_, true) if *truth == Truth::Invalid => None,
        (_, true) if has_bad_value(truth, gives, answer) => Some(Finding::BadValue),
        (_, true) if !answer.near => Some(Finding::WrongValue),
        _ => None,
    }
}

fn failed(failure: Failure) -> Finding {
    match failure {
        Failure::Panic => Finding::Panic,
        Failure::Timeout => Finding::Timeout,
        Failure::Signal(_) | Failure::Exit(_) | Failure::Overrun | Failure::Exception => {
            Finding::Crash
        }
    }
}

fn has_bad_value(truth: &Truth, gives: Gives, answer: Answer) -> bool {
    let wrong_facing = gives.facing
        && truth
            .crossing()
            .is_some_and(|crossing| answer.facing != Some(crossing.facing));
    !answer.finite || wrong_facing
}

//! A t that a kernel's own callers take for a miss, and that hairline, which asks for hit or miss, takes for a hit.

use super::{Relation, is_plain};
use crate::arith::Float;
use crate::case::Case;
use crate::kernel::{Gives, Verdict};
use crate::truth::{Feature, Truth};

/// The relations about it.
pub const MISSES: [Relation; 4] = [
    Relation::MinusOneForMiss,
    Relation::NanForMiss,
    Relation::InfiniteForMiss,
    Relation::HugeForMiss,
];

/// A t from which on no scene of these cases has one.
const HUGE: f64 = 1e30;

/// True if a hit is reported on a line that passes far beside the triangle, with a t that may stand for a miss.
pub fn is_hit_far_beside<F: Float>(
    case: &Case<F>,
    truth: &Truth,
    gives: Gives,
    verdict: &Verdict<F>,
) -> bool {
    let is_beside = || {
        let crossing = truth.crossing();
        crossing.is_some_and(|it| it.feature == Feature::Outside)
    };
    verdict.hit && gives.t && is_beside() && is_plain(case)
}

/// The relation that a reported t shows; none if it is a t like others.
pub fn stands_for_miss<F: Float>(verdict: &Verdict<F>) -> Option<Relation> {
    let t = verdict.t.to_f64();
    if t == -1.0 {
        Some(Relation::MinusOneForMiss)
    } else if t.is_nan() {
        Some(Relation::NanForMiss)
    } else if t.is_infinite() {
        Some(Relation::InfiniteForMiss)
    } else if HUGE <= t.abs() {
        Some(Relation::HugeForMiss)
    } else {
        None
    }
}

//! The first scheme of a list that never fails, found with no more new rays than that takes.
//!
//! A scheme that failed once is out, whatever it does on other rays. So no chance enters: the answer is the one that all
//! schemes on all rays would give, while most of those that fail are gone after a few rays.

use super::run::{OffsetPlan, run_on};
use super::scheme::Scheme;
use crate::engine::Observer;
use crate::kernel::Scalar;
use std::ops::Range;

/// The first rays of each plan, which all schemes leave.
const FIRST_ROUND: u64 = 4096;

/// The first of some schemes that fails on no ray of some plans; the last one if all fail, and none of none. A scheme
/// that nothing comes after needs no ray.
pub fn first_without_failure<F: Scalar>(
    plans: &[OffsetPlan<'_>],
    schemes: &[Scheme],
    observer: &dyn Observer,
) -> Option<Scheme> {
    let (last, before) = schemes.split_last()?;
    let mut standing = before.to_vec();
    for plan in plans {
        let first_rays = 0..plan.count.min(FIRST_ROUND);
        standing = without_failures::<F>(plan, standing, first_rays, observer);
    }
    for scheme in standing {
        let mut one = vec![scheme];
        for plan in plans {
            let other_rays = FIRST_ROUND.min(plan.count)..plan.count;
            one = without_failures::<F>(plan, one, other_rays, observer);
        }
        if let Some(scheme) = one.pop() {
            return Some(scheme);
        }
    }
    Some(last.clone())
}

/// The schemes that fail on none of some first rays of a plan.
fn without_failures<F: Scalar>(
    plan: &OffsetPlan<'_>,
    schemes: Vec<Scheme>,
    indices: Range<u64>,
    observer: &dyn Observer,
) -> Vec<Scheme> {
    if schemes.is_empty() || indices.is_empty() {
        return schemes;
    }
    let counted = OffsetPlan {
        schemes: &schemes,
        with_least: false,
        with_heights: false,
        ..*plan
    };
    let sums = run_on::<F>(&counted, indices, observer);
    let mut standing = Vec::new();
    for (scheme, of_scheme) in schemes.iter().zip(&sums.schemes) {
        if of_scheme.failed == 0 {
            standing.push(scheme.clone());
        }
    }
    standing
}

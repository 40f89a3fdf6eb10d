//! The simplest case that still shows something: greedy descent to a local minimum.

use super::decimal::Decimal;
use super::objective::Scorer;
use super::signature::Signature;
use super::simplify::{Simplification, Size};
use crate::arith::{Exact, Float};
use crate::audit::Row;
use crate::case::Case;
use crate::kernel::Scalar;

/// The share of its score that a simpler witness of a search keeps.
pub const KEPT_SHARE: f64 = 0.9;

/// The result of a descent.
#[derive(Clone, Copy, Debug)]
pub struct Shrunk<F: Float> {
    /// The simplest case found: no single [`Simplification`] leads to a simpler one that is kept.
    pub case: Case<F>,
    /// Steps taken.
    pub steps: usize,
    /// Cases that were tried.
    pub tried: usize,
}

/// Walks from a case to simpler ones while `keeps` holds, until no single [`Simplification`] leads to
/// a simpler case that `keeps` accepts. The result is a local minimum: there may be simpler cases two
/// steps away. Shrinking it again changes nothing.
///
/// ```
/// use hairline_core::{Case, truth};
/// use hairline_explore::shrink;
///
/// let triangle = [[0.1, 0.2, 0.3], [4.7, 0.1, 0.4], [0.3, 5.9, 0.2]];
/// let case = Case::<f64>::new([1.1, 1.3, 7.0], [0.01, 0.02, -0.9], triangle);
/// let hit = truth(&case);
/// let simple = shrink(&case, |case| truth(case) == hit).case;
/// let coordinates = simple.vectors();
/// assert!(coordinates.iter().flatten().all(|x| x.fract() == 0.0 && x.abs() <= 3.0));
/// ```
pub fn shrink<F: Float>(case: &Case<F>, keeps: impl Fn(&Case<F>) -> bool) -> Shrunk<F> {
    shrink_within(case, usize::MAX, keeps)
}

/// The same, but what was found when so many cases were tried.
pub fn shrink_within<F: Float>(
    case: &Case<F>,
    most: usize,
    keeps: impl Fn(&Case<F>) -> bool,
) -> Shrunk<F> {
    let steps = Simplification::all();
    let (mut shrunk, mut size) = (
        Shrunk {
            case: *case,
            steps: 0,
            tried: 0,
        },
        Size::of(case),
    );
    // A place in the list of steps, and how many in a row led nowhere.
    let (mut next, mut idle) = (0, 0);
    while idle < steps.len() && shrunk.tried < most {
        let candidate = steps[next].apply(&shrunk.case);
        let simpler = Size::below(&candidate, &size);
        shrunk.tried += usize::from(simpler.is_some());
        if let Some(simpler) = simpler.filter(|_| keeps(&candidate)) {
            (shrunk.case, size) = (candidate, simpler);
            shrunk.steps += 1;
            idle = 0;
        } else {
            next = (next + 1) % steps.len();
            idle += 1;
        }
    }
    shrunk
}

/// The simplest case with the same signature; none if the row shows no finding on the case.
pub fn shrink_finding<F: Scalar>(row: &Row, case: &Case<F>) -> Option<(Signature, Shrunk<F>)> {
    let signature = Signature::of(row, case)?;
    let shrunk = shrink(case, |case| signature.is_shown(row, case));
    Some((signature, shrunk))
}

/// A simpler case whose score is at least [`KEPT_SHARE`] of this one's; none if nothing simpler is.
///
/// The descent scores as the search does, in `f64` for `f32`; what it finds is confirmed exactly.
pub fn shrink_scored<F: Scalar>(scorer: &Scorer<'_, F>, case: &Case<F>) -> Option<Shrunk<F>> {
    let score = scorer.quick(case);
    let least_exact = scorer.exact(case)? * Exact::from_f64(KEPT_SHARE);
    let least = Decimal::of(&least_exact)?;
    let keeps_exactly = |case: &Case<F>| {
        scorer
            .exact(case)
            .is_some_and(|score| Decimal::of(&score).is_some_and(|s| least <= s))
    };
    let shrunk = if score < f64::MAX {
        shrink(case, |case| KEPT_SHARE * score <= scorer.quick(case))
    } else {
        shrink(case, keeps_exactly)
    };
    Some(shrunk).filter(|shrunk| keeps_exactly(&shrunk.case))
}

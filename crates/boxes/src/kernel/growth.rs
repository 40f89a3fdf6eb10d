//! The last comparison of a slab test, near against far, with the growth of the far end as its epsilon.
//!
//! Rounding can put the far end before the near one where the exact box is met. Ize's remedy is to multiply the far end by
//! a number slightly above 1. Here that number is `1 - e`: an epsilon of 0 is the plain test, and a negative one lets
//! more through. So the margin of this gate says which growth a case needs. A far end below 0 is left as it is, so that
//! growth never moves it inwards; no ray with `t_min >= 0` meets a box there.
//!
//! How much is enough, barring overflow and underflow? With u half an ulp of 1 and n roundings in each t, the computed near
//! end is at most (1+u)^n times the exact one and the far end at least (1-u)^n times it. Times 1 + 2nu the far end is at
//! least the near one times about 1 - 2n²u², and rounds to no less, since the near end is a float. So
//! 2 units in the last place of 1 are enough for (b-o)/d, and 3 for (b-o)·inv. For fma(b, inv, -o·inv) no number is
//! enough: the error of o·inv counts, however small t is beside it.

use super::numbers::Slab;
use super::*;

/// The place of the gate among those of every kernel here.
pub const GROWTH: usize = 0;

/// `near <= far`.
pub const AT_MOST: Gate =
    Gate::signed(Role::Edge, "!(near <= far * (1 - e))", 0, 0).named("growth");
/// `near > far` refuses.
pub const NOT_ABOVE: Gate = Gate::signed(Role::Edge, "near > far * (1 - e)", 0, 0).named("growth");
/// `near < far`.
pub const BELOW: Gate = Gate::signed(Role::Edge, "!(near < far * (1 - e))", 0, 0).named("growth");

/// How a source compares the near end with the far one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// `near <= far`: a NaN is a miss.
    AtMost,
    /// A miss if `near > far`: a NaN goes through.
    NotAbove,
    /// `near < far`: a NaN is a miss, and so is a box that is met in one point.
    Below,
}

impl Comparison {
    #[inline(always)]
    pub fn holds<R: Real>(self, near: &R, far: &R) -> bool {
        match self {
            Comparison::AtMost => near.is_at_most(far),
            Comparison::NotAbove => !far.is_less(near),
            Comparison::Below => near.is_less(far),
        }
    }

    /// The largest epsilon, or the least above them, at which it holds without rounding.
    pub fn threshold<R: Real>(self, near: &R, far: &R) -> R {
        if near.is_nan() || far.is_nan() {
            return everything(self == Comparison::NotAbove);
        }
        if !R::zero().is_less(far) {
            return everything(self.holds(near, far));
        }
        let share = near.clone() / far;
        // Infinity by infinity: equal for every growth.
        if share.is_nan() {
            R::one()
        } else {
            R::one() - share
        }
    }
}

/// The threshold of a test that no epsilon changes.
pub fn everything<R: Real>(accepts: bool) -> R {
    if accepts {
        R::infinity()
    } else {
        -R::infinity()
    }
}

/// The far end after its growth.
#[inline(always)]
pub fn grown<R: Real>(far: &R, epsilon: &R) -> R {
    if far.is_less(&R::zero()) {
        return far.clone();
    }
    far.clone() * &(R::one() - epsilon)
}

impl<R: Real> Slab<R> {
    /// The hit of what a ray and a box have in common, if near and far are in order.
    #[inline(always)]
    pub fn hit<S: Sink<R>>(self, sink: &mut S, comparison: Comparison) -> Option<Hit<R>> {
        compare(sink, comparison, &self.near, &self.far)?;
        Some(Hit::at(self.near))
    }
}

/// The gate on a near and a far end.
#[inline(always)]
pub fn compare<R: Real, S: Sink<R>>(
    sink: &mut S,
    comparison: Comparison,
    near: &R,
    far: &R,
) -> Option<()> {
    sink.rounded(
        GROWTH,
        |epsilon| comparison.holds(near, &grown(far, epsilon)),
        || comparison.threshold(near, far),
    )
}

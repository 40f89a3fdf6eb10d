//! `mixed-scale`, `range-ends`, `invalid`: exponents of all sizes, the ends of the range, and input that
//! is not a finite ray and triangle.

use super::boundary::toward;
use super::control::{aimed, interior_weights};
use super::integer::shuffle;
use super::{Kept, Made, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::Truth;

pub(super) struct MixedScale;
pub(super) struct RangeEnds;
pub(super) struct Invalid;

/// A finite case of coordinates that a closure draws.
fn drawn<F: Float>(draw: &mut Draw, mut coordinate: impl FnMut(&mut Draw) -> F) -> Made<F> {
    let mut vector = |draw: &mut Draw| -> [F; 3] { std::array::from_fn(|_| coordinate(draw)) };
    let [origin, a, b, c] = std::array::from_fn(|_| vector(draw));
    // At a vertex, at the middle of two, or anywhere.
    let [p, q, _] = shuffle(draw, [a, b, c]);
    let half = F::from_f64(0.5);
    let direction = match draw.below(3) {
        0 => toward(origin, p),
        1 => std::array::from_fn(|i| (p[i] * half + q[i] * half) - origin[i]),
        _ => vector(draw),
    };
    let usable = direction.iter().all(|x| x.is_finite()) && direction.iter().any(|x| !x.is_zero());
    let direction = if usable { direction } else { [F::one(); 3] };
    Made::One(Case::new(origin, direction, [a, b, c]))
}

impl Recipe for MixedScale {
    const NAME: &'static str = "mixed-scale";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "finite, each exponent drawn independently in -30..30";
    const KEEPS: Kept = Kept::Truths(|truth| *truth != Truth::Invalid);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        drawn(draw, |draw| {
            let exponent = draw.integer(-30, 30) as i32;
            draw.with_exponent(exponent)
        })
    }
}

impl Recipe for RangeEnds {
    const NAME: &'static str = "range-ends";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "finite, subnormals and values near the largest float";
    const KEEPS: Kept = Kept::Truths(|truth| *truth != Truth::Invalid);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let (lowest, highest) = (F::MIN_EXPONENT, F::MAX_EXPONENT);
        let digits = F::DIGITS as i32;
        let (low, high) = draw.pick(&[
            (lowest, lowest + digits),
            (lowest, lowest + 2 * digits),
            (highest - 2, highest),
            (highest - digits, highest),
            (lowest, highest),
        ]);
        drawn(draw, |draw| {
            if draw.below(8) == 0 {
                return F::zero();
            }
            let exponent = draw.integer(i64::from(low), i64::from(high)) as i32;
            let x = draw.with_exponent::<F>(exponent);
            if x.is_finite() { x } else { F::one() }
        })
    }
}

impl Recipe for Invalid {
    const NAME: &'static str = "invalid";
    const HAS_OWN_INTERVAL: bool = true;
    const PROMISE: &'static str = "a NaN, an infinity, a zero direction or an impossible interval";
    const KEEPS: Kept = Kept::Truths(|truth| *truth == Truth::Invalid);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let case = aimed::<F>(draw, &mut interior_weights);
        let [nan, infinity] = [F::from_f64(f64::NAN), F::infinity()];
        match draw.below(8) {
            0 => return Made::One(case.on(F::one(), F::zero())),
            1 => return Made::One(case.on(draw.pick(&[nan, F::zero()]), nan)),
            2 => {
                let [origin, _, a, b, c] = case.vectors();
                return Made::One(Case::new(origin, [F::zero(); 3], [a, b, c]));
            }
            3 => return Made::One(Case::new([nan; 3], [nan; 3], [[nan; 3]; 3])),
            _ => {}
        }
        let mut vectors = case.vectors();
        let poison = draw.pick(&[nan, infinity, -infinity]);
        for _ in 0..draw.integer(1, 3) {
            vectors[draw.below(5)][draw.below(3)] = poison;
        }
        let [origin, direction, a, b, c] = vectors;
        Made::One(Case::new(origin, direction, [a, b, c]))
    }
}

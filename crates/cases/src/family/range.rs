//! `mixed-scale`, `range-ends`, `invalid`: exponents of all sizes, the ends of the range, and input that
//! is not a finite ray and triangle.

use super::boundary::{middle, toward};
use super::control::{aimed, interior_weights};
use super::integer::shuffle;
use super::{CaseGroup, Promise, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::Truth;

pub(super) struct MixedScale;
pub(super) struct RangeEnds;
pub(super) struct Invalid;

/// The coordinates of a family: of drawn exponents, and finite.
struct Coordinates {
    least_exponent: i64,
    most_exponent: i64,
    /// One in eight is zero.
    has_zeros: bool,
}

impl Coordinates {
    fn draw<F: Float>(&self, draw: &mut Draw) -> F {
        if self.has_zeros && draw.below(8) == 0 {
            return F::zero();
        }
        let exponent = draw.integer(self.least_exponent, self.most_exponent);
        let x = draw.with_exponent::<F>(exponent as i32);
        if x.is_finite() { x } else { F::one() }
    }

    fn vector<F: Float>(&self, draw: &mut Draw) -> [F; 3] {
        [self.draw(draw), self.draw(draw), self.draw(draw)]
    }

    fn made<F: Float>(&self, draw: &mut Draw) -> CaseGroup<F> {
        let origin = self.vector(draw);
        let corners = [(); 3].map(|()| self.vector(draw));
        let [p, q, _] = shuffle(draw, corners);
        // Towards a vertex, towards the middle of two, or anywhere.
        let direction = match draw.below(3) {
            0 => toward(origin, p),
            1 => toward(origin, middle(p, q)),
            _ => self.vector(draw),
        };
        if is_usable(direction) {
            CaseGroup::One(Case::new(origin, direction, corners))
        } else {
            CaseGroup::One(Case::new(origin, [F::one(); 3], corners))
        }
    }
}

fn is_valid(truth: &Truth) -> bool {
    *truth != Truth::Invalid
}

/// True if a ray may have a direction: it is finite and not zero.
fn is_usable<F: Float>(direction: [F; 3]) -> bool {
    let is_finite = direction.iter().all(|x| x.is_finite());
    let is_zero = direction.iter().all(F::is_zero);
    is_finite && !is_zero
}

impl Recipe for MixedScale {
    const NAME: &'static str = "mixed-scale";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "finite, each exponent drawn independently in -30..30";
    const KEEPS: Promise = Promise::Truths(is_valid);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let coordinates = Coordinates {
            least_exponent: -30,
            most_exponent: 30,
            has_zeros: false,
        };
        coordinates.made(draw)
    }
}

impl Recipe for RangeEnds {
    const NAME: &'static str = "range-ends";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "finite, subnormals and values near the largest float";
    const KEEPS: Promise = Promise::Truths(is_valid);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let lowest = i64::from(F::MIN_EXPONENT);
        let highest = i64::from(F::MAX_EXPONENT);
        let digits = i64::from(F::DIGITS);
        let (least_exponent, most_exponent) = draw.pick(&[
            (lowest, lowest + digits),
            (lowest, lowest + 2 * digits),
            (highest - 2, highest),
            (highest - digits, highest),
            (lowest, highest),
        ]);
        let coordinates = Coordinates {
            least_exponent,
            most_exponent,
            has_zeros: true,
        };
        coordinates.made(draw)
    }
}

impl Recipe for Invalid {
    const NAME: &'static str = "invalid";
    const HAS_OWN_INTERVAL: bool = true;
    const PROMISE: &'static str = "a NaN, an infinity, a zero direction or an impossible interval";
    const KEEPS: Promise = Promise::Truths(|truth| *truth == Truth::Invalid);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let case = aimed::<F>(draw, interior_weights);
        let nan = F::from_f64(f64::NAN);
        let kind = draw.below(8);
        CaseGroup::One(match kind {
            0 => case.on(F::one(), F::zero()),
            1 => case.on(draw.pick(&[nan, F::zero()]), nan),
            2 => without_direction(&case),
            3 => Case::new([nan; 3], [nan; 3], [[nan; 3]; 3]),
            _ => poisoned(draw, &case),
        })
    }
}

fn without_direction<F: Float>(case: &Case<F>) -> Case<F> {
    let [origin, _, a, b, c] = case.vectors();
    Case::new(origin, [F::zero(); 3], [a, b, c])
}

/// A case of which one to three coordinates are a NaN or an infinity.
fn poisoned<F: Float>(draw: &mut Draw, case: &Case<F>) -> Case<F> {
    let nan = F::from_f64(f64::NAN);
    let infinity = F::infinity();
    let poison = draw.pick(&[nan, infinity, -infinity]);
    let mut vectors = case.vectors();
    for _ in 0..draw.integer(1, 3) {
        let vector = draw.below(5);
        let axis = draw.below(3);
        vectors[vector][axis] = poison;
    }
    let [origin, direction, a, b, c] = vectors;
    Case::new(origin, direction, [a, b, c])
}

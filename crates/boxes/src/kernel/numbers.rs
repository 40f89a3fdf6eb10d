//! The minima and maxima of sources, which differ in what a NaN does; and one axis of a ray, in three formulas.

use hairline_core::Ray;
use hairline_core::arith::{Real, Vector};

/// `a < b ? a : b`, as SSE's `minps`: the second if either is NaN.
#[inline(always)]
pub(super) fn minps<R: Real>(a: R, b: R) -> R {
    if a.is_less(&b) { a } else { b }
}

/// `a > b ? a : b`, as SSE's `maxps`: the second if either is NaN.
#[inline(always)]
pub(super) fn maxps<R: Real>(a: R, b: R) -> R {
    if b.is_less(&a) { a } else { b }
}

/// `fmin` of C: the other one if one is NaN.
#[inline(always)]
pub(super) fn fmin<R: Real>(a: R, b: R) -> R {
    if a.is_nan() { b } else { a.smaller(b) }
}

/// `fmax` of C: the other one if one is NaN.
#[inline(always)]
pub(super) fn fmax<R: Real>(a: R, b: R) -> R {
    if a.is_nan() { b } else { a.larger(b) }
}

/// How a source finds the t of a plane that is perpendicular to an axis.
pub(super) trait Formula: Sync + 'static {
    /// The two numbers of a ray's axis that it computes with.
    fn prepare<R: Real>(origin: R, direction: R) -> Axis<R>;
    /// The t at which the ray meets the plane.
    fn t<R: Real>(axis: &Axis<R>, plane: R) -> R;
}

/// One axis of a ray.
pub(super) struct Axis<R> {
    /// The origin, or the origin times the reciprocal of the direction.
    pub origin: R,
    /// The direction, or its reciprocal; both have the same sign, that of a zero included.
    pub direction: R,
}

/// `(b - o) / d`.
pub(super) struct Divided;

/// `(b - o) * (1 / d)`.
pub(super) struct Multiplied;

/// `fma(b, 1 / d, -(o * (1 / d)))`.
pub(super) struct Fused;

impl Formula for Divided {
    #[inline(always)]
    fn prepare<R: Real>(origin: R, direction: R) -> Axis<R> {
        Axis { origin, direction }
    }

    #[inline(always)]
    fn t<R: Real>(axis: &Axis<R>, plane: R) -> R {
        (plane - &axis.origin) / &axis.direction
    }
}

impl Formula for Multiplied {
    #[inline(always)]
    fn prepare<R: Real>(origin: R, direction: R) -> Axis<R> {
        let direction = R::one() / direction;
        Axis { origin, direction }
    }

    #[inline(always)]
    fn t<R: Real>(axis: &Axis<R>, plane: R) -> R {
        (plane - &axis.origin) * &axis.direction
    }
}

impl Formula for Fused {
    #[inline(always)]
    fn prepare<R: Real>(origin: R, direction: R) -> Axis<R> {
        let direction = R::one() / direction;
        let origin = origin * &direction;
        Axis { origin, direction }
    }

    #[inline(always)]
    fn t<R: Real>(axis: &Axis<R>, plane: R) -> R {
        R::fused(&plane, &axis.direction, &-axis.origin.clone())
    }
}

/// One axis of a ray, by its number.
#[inline(always)]
pub(super) fn axis<A: Formula, V: Vector>(ray: &Ray<V>, i: usize) -> Axis<V::Real> {
    A::prepare(ray.origin.at(i), ray.direction.at(i))
}

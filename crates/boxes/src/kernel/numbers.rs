//! The minima and maxima of sources, which differ in what a NaN does; one axis of a ray, in three formulas; and the t of
//! a slab's planes.

use super::*;

/// A minimum or a maximum.
pub type Choice<R> = fn(R, R) -> R;

/// `a < b ? a : b`, as SSE's `minps`: the second if either is NaN.
#[inline(always)]
pub fn minps<R: Real>(a: R, b: R) -> R {
    if a.is_less(&b) { a } else { b }
}

/// `a > b ? a : b`, as SSE's `maxps`: the second if either is NaN.
#[inline(always)]
pub fn maxps<R: Real>(a: R, b: R) -> R {
    if b.is_less(&a) { a } else { b }
}

/// `fmin` of C: the other one if one is NaN.
#[inline(always)]
pub fn fmin<R: Real>(a: R, b: R) -> R {
    if a.is_nan() { b } else { a.smaller(b) }
}

/// `fmax` of C: the other one if one is NaN.
#[inline(always)]
pub fn fmax<R: Real>(a: R, b: R) -> R {
    if a.is_nan() { b } else { a.larger(b) }
}

/// One axis of a ray.
pub struct Axis<R> {
    /// The origin, or the origin times the reciprocal of the direction.
    pub origin: R,
    /// The direction, or its reciprocal; both have the same sign, that of a zero included.
    pub direction: R,
}

/// How a source finds the t of a plane that is perpendicular to an axis.
pub trait Formula: Sync + 'static {
    /// The two numbers of a ray's axis that it computes with.
    fn prepare<R: Real>(origin: R, direction: R) -> Axis<R>;
    /// The t at which the ray meets the plane.
    fn t<R: Real>(axis: &Axis<R>, plane: R) -> R;
}

/// `(b - o) / d`.
pub struct Divided;

/// `(b - o) * (1 / d)`.
pub struct Multiplied;

/// `fma(b, 1 / d, -(o * (1 / d)))`.
pub struct Fused;

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
        // The product is rounded before it is subtracted, also where a machine could fuse it.
        let product = axis.origin.clone();
        R::fused(&plane, &axis.direction, &-product)
    }
}

/// One axis of a ray, by its number.
#[inline(always)]
pub fn axis<A: Formula, V: Vector>(ray: &Ray<V>, i: usize) -> Axis<V::Real> {
    let origin = ray.origin.at(i);
    A::prepare(origin, ray.direction.at(i))
}

/// The t of the two planes of a slab.
#[derive(Clone)]
pub struct Slab<R> {
    pub near: R,
    pub far: R,
}

impl<R: Real> Slab<R> {
    /// The t that a minimum and a maximum choose from the two.
    #[inline(always)]
    pub fn sorted(self, min: Choice<R>, max: Choice<R>) -> Slab<R> {
        let Slab { near, far } = self;
        Slab {
            near: min(near.clone(), far.clone()),
            far: max(near, far),
        }
    }

    /// The part that it has in common with another.
    #[inline(always)]
    pub fn and(self, other: Slab<R>, max: Choice<R>, min: Choice<R>) -> Slab<R> {
        Slab {
            near: max(self.near, other.near),
            far: min(self.far, other.far),
        }
    }
}

/// The slab of an axis, near and far by the sign that a source looks at.
#[inline(always)]
pub fn turned<A: Formula, V: Vector>(
    bounds: &Bounds<V>,
    axis: &Axis<V::Real>,
    i: usize,
    is_backward: bool,
) -> Slab<V::Real> {
    let min = A::t(axis, bounds.min.at(i));
    let max = A::t(axis, bounds.max.at(i));
    if is_backward {
        return Slab {
            near: max,
            far: min,
        };
    }
    Slab {
        near: min,
        far: max,
    }
}

/// The slab of an axis with the plane at min as the near one.
#[inline(always)]
pub fn unsorted<A: Formula, V: Vector>(
    bounds: &Bounds<V>,
    ray: &Ray<V>,
    i: usize,
) -> Slab<V::Real> {
    let axis = axis::<A, V>(ray, i);
    turned::<A, V>(bounds, &axis, i, false)
}

/// The slab of an axis, near and far by the sign bit of the direction.
#[inline(always)]
pub fn crossed<A: Formula, V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>, i: usize) -> Slab<V::Real> {
    let axis = axis::<A, V>(ray, i);
    let is_backward = axis.direction.is_sign_negative();
    turned::<A, V>(bounds, &axis, i, is_backward)
}

/// The interval of a ray.
#[inline(always)]
pub fn interval<V: Vector>(ray: &Ray<V>) -> Slab<V::Real> {
    Slab {
        near: ray.t_min.clone(),
        far: ray.t_max.clone(),
    }
}

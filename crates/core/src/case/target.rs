//! The shapes that rays are tested against: triangles here, others in crates above.

use super::{Case, Ray, Triangle, lifted};
use crate::arith::{Float, Real, Triple, Vector};
use std::fmt::Debug;

/// A kind of shape, with its cases. A kernel is written for one target; whatever runs, measures or
/// registers kernels works for all targets.
pub trait Target: Copy + Debug + Send + Sync + 'static {
    /// The shape in some arithmetic.
    type Shape<V: Vector>;
    /// A ray and a shape in a scalar.
    type Case<F: Float>: Copy + Debug + Send + Sync;

    /// The ray of a case.
    fn ray<F: Float>(case: &Self::Case<F>) -> &Ray<F::Vector>;

    /// The shape of a case.
    fn shape<F: Float>(case: &Self::Case<F>) -> &Self::Shape<F::Vector>;

    /// The ray and the shape of a case in another arithmetic, number by number.
    fn lift<F: Float, R: Real>(
        case: &Self::Case<F>,
        number: impl Fn(F) -> R,
    ) -> (Ray<Triple<R>>, Self::Shape<Triple<R>>);

    /// A ray and a shape whose numbers are made from their places among those of a case.
    fn placed<R: Real>(number: impl Fn(usize) -> R) -> (Ray<Triple<R>>, Self::Shape<Triple<R>>);
}

/// Rays against triangles.
#[derive(Clone, Copy, Debug)]
pub struct Triangles;

impl Target for Triangles {
    type Shape<V: Vector> = Triangle<V>;
    type Case<F: Float> = Case<F>;

    #[inline(always)]
    fn ray<F: Float>(case: &Case<F>) -> &Ray<F::Vector> {
        &case.ray
    }

    #[inline(always)]
    fn shape<F: Float>(case: &Case<F>) -> &Triangle<F::Vector> {
        &case.triangle
    }

    fn lift<F: Float, R: Real>(
        case: &Case<F>,
        number: impl Fn(F) -> R,
    ) -> (Ray<Triple<R>>, Triangle<Triple<R>>) {
        case.lift(number)
    }

    fn placed<R: Real>(number: impl Fn(usize) -> R) -> (Ray<Triple<R>>, Triangle<Triple<R>>) {
        lifted(number)
    }
}

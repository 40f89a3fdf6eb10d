//! Floor 1: the ray, the triangle, the case, its id, and the counter-based random numbers.

#![forbid(unsafe_code)]

mod draw;
mod forms;
#[cfg(test)]
mod hard;
mod id;
mod instance;
mod scene;
mod target;

pub use draw::{Draw, mix};
pub use forms::{AnyCase, AnyScalar, rust_case, rust_list};
#[cfg(test)]
pub use hard::hard_cases;
pub use id::{CaseId, Parameters, parse_offset, parse_power_of_two};
pub use instance::{Instance, Matrix};
pub use scene::ShortNumber;
pub use scene::{
    DirectionLength, PlaneKind, RayKind, SCENES, Scene, SceneInterval, SceneKind, ScenePreset,
    Toward,
};
pub use target::{Target, Triangles};

use crate::arith::{Exact, ExactVector, Float, Real, Triple, Vector};

/// A ray `origin + t * direction`, with the interval `[t_min, t_max]` of t in which hits count. The
/// direction is a free vector of any length, used exactly as given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<V: Vector> {
    /// Where t = 0. Unit: length.
    pub origin: V,
    /// Any length but zero.
    pub direction: V,
    /// The start of the interval, in units of the direction.
    pub t_min: V::Real,
    /// The end of the interval.
    pub t_max: V::Real,
}

/// A triangle; seen from its front, a, b, c run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle<V> {
    /// First vertex.
    pub a: V,
    /// Second vertex.
    pub b: V,
    /// Third vertex.
    pub c: V,
}

impl<V> Triangle<V> {
    /// From its vertices.
    pub fn new(a: V, b: V, c: V) -> Self {
        Triangle { a, b, c }
    }

    /// The vertices, in order.
    pub fn vertices(self) -> [V; 3] {
        [self.a, self.b, self.c]
    }

    /// The edges ab, bc, ca.
    pub fn edges(&self) -> [(&V, &V); 3] {
        [(&self.a, &self.b), (&self.b, &self.c), (&self.c, &self.a)]
    }
}

/// One question to a kernel: does this ray meet this triangle?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case<F: Float> {
    /// The ray and its interval.
    pub ray: Ray<F::Vector>,
    /// The triangle.
    pub triangle: Triangle<F::Vector>,
}

impl<F: Float> Case<F> {
    /// From arrays, with the default interval `[0, +inf]`.
    pub fn new(origin: [F; 3], direction: [F; 3], [a, b, c]: [[F; 3]; 3]) -> Self {
        let ray = Ray {
            origin: origin.into(),
            direction: direction.into(),
            t_min: F::zero(),
            t_max: F::infinity(),
        };
        Case {
            ray,
            triangle: Triangle::new(a.into(), b.into(), c.into()),
        }
    }

    /// The same case on another interval.
    pub fn on(mut self, t_min: F, t_max: F) -> Self {
        (self.ray.t_min, self.ray.t_max) = (t_min, t_max);
        self
    }

    /// Origin, direction, a, b, c.
    #[inline(always)]
    pub fn vectors(&self) -> [[F; 3]; 5] {
        let Triangle { a, b, c } = self.triangle;
        [
            self.ray.origin.into(),
            self.ray.direction.into(),
            a.into(),
            b.into(),
            c.into(),
        ]
    }

    /// The case in `f64`, which holds every `f32` exactly.
    #[inline]
    pub fn widen(&self) -> Case<f64> {
        // A plain loop: arrays of arrays do not go through `map` without calls.
        let mut wide = [[0.0; 3]; 5];
        for (wide, narrow) in wide
            .as_flattened_mut()
            .iter_mut()
            .zip(self.vectors().as_flattened())
        {
            *wide = narrow.to_f64();
        }
        let [origin, direction, a, b, c] = wide;
        Case::new(origin, direction, [a, b, c]).on(self.ray.t_min.to_f64(), self.ray.t_max.to_f64())
    }

    /// The case in another arithmetic, number by number.
    pub fn lift<R: Real>(&self, number: impl Fn(F) -> R) -> (Ray<Triple<R>>, Triangle<Triple<R>>) {
        let numbers = self.numbers();
        lifted(|i| number(numbers[i]))
    }

    /// The case in exact numbers.
    pub fn exact(&self) -> (Ray<ExactVector>, Triangle<ExactVector>) {
        self.widen().lift(Exact::from_f64)
    }
}

/// A ray and a triangle whose numbers are made from their places among the seventeen of a case.
pub fn lifted<R: Real>(number: impl Fn(usize) -> R) -> (Ray<Triple<R>>, Triangle<Triple<R>>) {
    let triple = |i: usize| Triple::from([number(i), number(i + 1), number(i + 2)]);
    let ray = Ray {
        origin: triple(0),
        direction: triple(3),
        t_min: number(15),
        t_max: number(16),
    };
    (
        ray,
        Triangle {
            a: triple(6),
            b: triple(9),
            c: triple(12),
        },
    )
}

/// This many finite numbers between colons.
fn between_colons<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |n: &str| n.parse().ok().filter(|x: &f64| x.is_finite());
    text.split(':')
        .map(number)
        .collect::<Option<Vec<f64>>>()?
        .try_into()
        .ok()
}

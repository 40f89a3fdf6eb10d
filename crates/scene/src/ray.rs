//! A ray with its interval.

use hairline_core::{Case, Float};
use std::error::Error;
use std::fmt;

/// The points `origin + t * direction` with t in the closed interval `[t_min, t_max]`. The direction has any length but
/// zero and is used exactly as given; t is in units of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<F> {
    /// The point at t = 0.
    pub origin: [F; 3],
    /// Any length but zero.
    pub direction: [F; 3],
    /// The start of the interval; may be negative, and minus infinity.
    pub t_min: F,
    /// The end of the interval; may be infinite.
    pub t_max: F,
}

impl<F: Float> Ray<F> {
    /// From an origin and a direction, with the interval `[0, +inf]`.
    pub fn new(origin: [F; 3], direction: [F; 3]) -> Ray<F> {
        Ray {
            origin,
            direction,
            t_min: F::zero(),
            t_max: F::infinity(),
        }
    }

    /// The same ray on another interval.
    pub fn on(mut self, t_min: F, t_max: F) -> Ray<F> {
        self.t_min = t_min;
        self.t_max = t_max;
        self
    }

    /// An error if the ray means nothing.
    pub fn check(&self) -> Result<(), InvalidRay> {
        self.checked().map(drop)
    }

    /// The same ray in `f64`, which holds every `f32` exactly; an error if the ray means nothing.
    pub(crate) fn checked(&self) -> Result<Ray<f64>, InvalidRay> {
        let wide = Ray {
            origin: self.origin.map(F::to_f64),
            direction: self.direction.map(F::to_f64),
            t_min: self.t_min.to_f64(),
            t_max: self.t_max.to_f64(),
        };
        let is_finite = |point: &[f64; 3]| point.iter().all(|x| x.is_finite());
        if !is_finite(&wide.origin) || !is_finite(&wide.direction) {
            return Err(InvalidRay::NotFinite);
        }
        if wide.direction == [0.0; 3] {
            return Err(InvalidRay::NoDirection);
        }
        // Refuses a NaN too.
        let is_ordered = wide.t_min <= wide.t_max;
        if !is_ordered {
            return Err(InvalidRay::Interval);
        }
        Ok(wide)
    }
}

impl Ray<f64> {
    /// The ray against one triangle.
    pub(crate) fn against(&self, triangle: &[[f64; 3]; 3]) -> Case<f64> {
        Case::<f64>::new(self.origin, self.direction, *triangle).on(self.t_min, self.t_max)
    }
}

/// The reason why a ray has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InvalidRay {
    /// A NaN or an infinity in the origin or the direction.
    NotFinite,
    /// A direction of zero.
    NoDirection,
    /// An end of the interval that is NaN, or t_min > t_max.
    Interval,
}

impl fmt::Display for InvalidRay {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            InvalidRay::NotFinite => "the ray has a coordinate that is not finite",
            InvalidRay::NoDirection => "the ray's direction is zero",
            InvalidRay::Interval => "the ray's interval needs t_min <= t_max",
        })
    }
}

impl Error for InvalidRay {}

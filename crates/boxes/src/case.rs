//! A box, a ray with its interval, and both together as a case.

use hairline_core::arith::{Real, Triple, Vector};
use hairline_core::case::Target;
use hairline_core::{Float, Ray};
use std::array;

/// The closed box of all points between two corners, its faces, edges and corners included. A box that is flat on an axis
/// is a rectangle, a segment or a point. A box with `min > max` on some axis has no points at all: no ray meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<V> {
    /// The corner with the least coordinates.
    pub min: V,
    /// The corner with the greatest coordinates.
    pub max: V,
}

/// One question to a slab test: does this ray meet this box?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxCase<F: Float> {
    /// The ray and its interval.
    pub ray: Ray<F::Vector>,
    /// The box.
    pub bounds: Bounds<F::Vector>,
}

/// The results of a function for the axes x, y and z.
#[inline(always)]
pub fn each_axis<T>(of_axis: impl FnMut(usize) -> T) -> [T; 3] {
    array::from_fn(of_axis)
}

/// True if a condition holds on some axis.
#[inline(always)]
pub fn any_axis(holds: impl Fn(usize) -> bool) -> bool {
    (0..3).any(holds)
}

impl<V: Vector> Bounds<V> {
    /// True if a coordinate is below the plane at min, or above the plane at max.
    #[inline(always)]
    pub fn is_beside(&self, axis: usize, x: &V::Real) -> bool {
        let is_below = x.is_less(&self.min.at(axis));
        is_below || self.max.at(axis).is_less(x)
    }
}

/// How many numbers a case has.
pub const NUMBERS: usize = 14;

impl<F: Float> BoxCase<F> {
    /// From a ray's origin and direction and a box's two corners, with the default interval `[0, +inf]`.
    pub fn new(origin: [F; 3], direction: [F; 3], [min, max]: [[F; 3]; 2]) -> Self {
        let ray = Ray {
            origin: origin.into(),
            direction: direction.into(),
            t_min: F::zero(),
            t_max: F::infinity(),
        };
        let bounds = Bounds {
            min: min.into(),
            max: max.into(),
        };
        BoxCase { ray, bounds }
    }

    /// This case on another interval.
    pub fn on(mut self, t_min: F, t_max: F) -> Self {
        self.ray.t_min = t_min;
        self.ray.t_max = t_max;
        self
    }

    /// This case with other vectors: origin, direction, min and max.
    pub fn with(&self, vectors: [[F; 3]; 4]) -> Self {
        let [origin, direction, min, max] = vectors;
        let case = BoxCase::new(origin, direction, [min, max]);
        case.on(self.ray.t_min, self.ray.t_max)
    }

    /// Origin, direction, min and max.
    pub fn vectors(&self) -> [[F; 3]; 4] {
        [
            self.ray.origin.into(),
            self.ray.direction.into(),
            self.bounds.min.into(),
            self.bounds.max.into(),
        ]
    }

    /// All numbers: origin, direction, min, max, t_min and t_max.
    pub fn numbers(&self) -> [F; NUMBERS] {
        let vectors = self.vectors();
        array::from_fn(|i| match i {
            12 => self.ray.t_min,
            13 => self.ray.t_max,
            _ => vectors[i / 3][i % 3],
        })
    }

    /// The case in `f64`, which holds every `f32` exactly.
    pub fn widen(&self) -> BoxCase<f64> {
        let wide = |vector: [F; 3]| vector.map(F::to_f64);
        let [origin, direction, min, max] = self.vectors().map(wide);
        let case = BoxCase::new(origin, direction, [min, max]);
        let t_min = self.ray.t_min.to_f64();
        let t_max = self.ray.t_max.to_f64();
        case.on(t_min, t_max)
    }

    /// JSON that reads back to the same finite numbers: the shortest decimals of doubles.
    pub fn json(&self) -> String {
        let wide = self.widen();
        let [origin, direction, min, max] = wide.vectors();
        let mut json = format!(
            r#"{{"scalar":"{}","origin":{origin:?},"direction":{direction:?},"min":{min:?},"max":{max:?}"#,
            F::NAME
        );
        let Ray { t_min, t_max, .. } = wide.ray;
        if t_min != 0.0 {
            json += &format!(r#","t_min":{t_min:?}"#);
        }
        if t_max.is_finite() {
            json += &format!(r#","t_max":{t_max:?}"#);
        }
        json + "}"
    }

    /// The bit patterns of all numbers, in hexadecimal.
    pub fn hex(&self) -> String {
        let hex = |vector: [F; 3]| vector.map(F::hex).join(",");
        let [o, d, min, max] = self.vectors().map(hex);
        let t_min = self.ray.t_min.hex();
        let t_max = self.ray.t_max.hex();
        format!("o={o} d={d} min={min} max={max} t={t_min},{t_max}")
    }
}

/// Rays against axis-aligned boxes.
#[derive(Clone, Copy, Debug)]
pub struct Boxes;

impl Target for Boxes {
    type Shape<V: Vector> = Bounds<V>;
    type Case<F: Float> = BoxCase<F>;

    #[inline(always)]
    fn ray<F: Float>(case: &BoxCase<F>) -> &Ray<F::Vector> {
        &case.ray
    }

    #[inline(always)]
    fn shape<F: Float>(case: &BoxCase<F>) -> &Bounds<F::Vector> {
        &case.bounds
    }

    fn lift<F: Float, R: Real>(
        case: &BoxCase<F>,
        number: impl Fn(F) -> R,
    ) -> (Ray<Triple<R>>, Bounds<Triple<R>>) {
        let numbers = case.numbers();
        Boxes::placed(|place| number(numbers[place]))
    }

    fn placed<R: Real>(number: impl Fn(usize) -> R) -> (Ray<Triple<R>>, Bounds<Triple<R>>) {
        let triple = |first: usize| Triple::from(each_axis(|axis| number(first + axis)));
        let ray = Ray {
            origin: triple(0),
            direction: triple(3),
            t_min: number(12),
            t_max: number(13),
        };
        let bounds = Bounds {
            min: triple(6),
            max: triple(9),
        };
        (ray, bounds)
    }
}

//! A ray-triangle test that is right for every ray, and computes little more than Möller and Trumbore's.
//!
//! ```
//! use glam::Vec3;
//! use hairline_core::exact::{Ray, Triangle};
//!
//! // Once for each triangle, and once for each ray.
//! let triangle = Triangle::new(Vec3::ZERO, Vec3::X, Vec3::Y);
//! let ray = Ray::new(Vec3::new(0.25, 0.25, 1.0), Vec3::NEG_Z);
//! let hit = triangle.hit(&ray, 0.0, f32::INFINITY).unwrap();
//! assert_eq!((hit.t, hit.u, hit.v, hit.is_front), (1.0, 0.25, 0.25, true));
//! ```
//!
//! Hit or miss is right for all finite inputs: it is the answer of exact arithmetic on the numbers that the caller stored.
//! There is no epsilon. A ray through an edge or a vertex where triangles meet hits exactly one of them, so closed meshes
//! do not leak; [`Edges`] has the other rules. A ray in the plane of a triangle misses it, every ray misses a triangle
//! without area, and NaN or an infinite coordinate is a miss.
//!
//! | triangle and ray | coordinates | numbers |
//! |---|---|---|
//! | [`Triangle`], [`Ray`] | `f32` | `f64`: what most programs want |
//! | [`DTriangle`], [`DRay`] | `f64` | `f64` |
//! | [`SingleTriangle`], [`SingleRay`] | `f32` | `f32`: half the memory, and it needs exact arithmetic more often |
//!
//! It computes Möller and Trumbore's numbers and compares them with a margin that is known before: two factors of the
//! triangle times two of the ray. Where the margin leaves the answer open, exact arithmetic decides, which takes
//! about 0.1 microseconds at an edge. `docs/design/margin.md` has the proof.

#![forbid(unsafe_code)]

mod number;

mod prepared;

mod asked;

mod row;

#[cfg(test)]
mod tests;

pub use asked::{Edges, Hit};
pub use prepared::{Answer, PreparedRay, PreparedTriangle, Values};
#[doc(hidden)]
pub use row::{NAME, entry};

/// Three `f32` points, tested with numbers in `f64`.
pub type Triangle = PreparedTriangle<f32, f64>;
/// A ray in `f32`, tested with numbers in `f64`.
pub type Ray = PreparedRay<f32, f64>;
/// Three `f64` points.
pub type DTriangle = PreparedTriangle<f64, f64>;
/// A ray in `f64`.
pub type DRay = PreparedRay<f64, f64>;
/// Three `f32` points, tested with numbers in `f32`.
pub type SingleTriangle = PreparedTriangle<f32, f32>;
/// A ray in `f32`, tested with numbers in `f32`.
pub type SingleRay = PreparedRay<f32, f32>;

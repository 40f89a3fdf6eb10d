//! How far an answer is off, in floats: these distances name a judgement and decide no hit.

use super::{Judged, Judgement, VISIBLE};
use crate::bounds::Bounds;
use crate::distance::{distance_to, length, longest_edge, normal, of_size_1};
use crate::mesh::Triangle;
use crate::ray::{InvalidRay, Ray};
use crate::scene::{Nearest, Scene};
use glam::DVec3;
use hairline_core::Float;

/// Bounds of t that are nearer to each other, in longest edges, tell how far an answer is off.
const TELLING: f64 = 1e-9;

/// Rays are moved aside by this share of a hair, so that t stays right where the ray does not graze.
const SHARE: f64 = 1.0 / 8.0;

/// In so many directions.
const WAYS: u32 = 16;

impl<F: Float> Scene<F> {
    /// A judgement, or that of a neighbour if the answer is right for a ray beside this one, nearer than anybody sees.
    pub(super) fn or_neighbour(
        &self,
        ray: &Ray<F>,
        judged: Judged,
        judge: impl Fn(&Ray<F>) -> Result<Judgement, InvalidRay>,
    ) -> Result<Judged, InvalidRay> {
        let is_of_a_place = matches!(
            judged.judgement,
            Judgement::Lost
                | Judgement::Farther
                | Judgement::Ghost
                | Judgement::TooFew
                | Judgement::TooMany
        );
        let Some(hit) = judged.hit.as_ref().filter(|_| is_of_a_place) else {
            return Ok(judged);
        };
        let distance = SHARE * VISIBLE * self.longest_edge_of(hit.faces[0]);
        for way in 0..WAYS {
            let angle = f64::from(way) * std::f64::consts::TAU / f64::from(WAYS);
            let beside = moved(ray, distance, angle);
            // Far from 0 it may be the ray itself, and at the end of the range no ray at all.
            let is_ray = beside.checked().is_ok();
            if is_ray && judge(&beside)?.is_right() {
                return Ok(Judged::new(Judgement::Neighbour, judged.hit, None));
            }
        }
        Ok(judged)
    }

    /// The t of a point of the ray that is nearer to a face than anybody sees, on the interval and at `latest` at the most; the one that
    /// is given, if one is.
    pub(super) fn missed_by_a_hair(
        &self,
        ray: &Ray<F>,
        face: u32,
        t: Option<f64>,
        latest: f64,
    ) -> Option<f64> {
        let place = self.place_of(face)?;
        let triangle = self.triangle_at(place);
        let origin = DVec3::from(ray.origin.map(F::to_f64));
        let direction = DVec3::from(ray.direction.map(F::to_f64));
        let hair = VISIBLE * longest_edge(&triangle);
        let (first, last) = (ray.t_min.to_f64(), ray.t_max.to_f64().min(latest));
        let is_near = |t: &f64| {
            let point = origin + *t * direction;
            first <= *t && *t <= last && distance_to(&triangle, point.into()) <= hair
        };
        match t {
            Some(t) => Some(t).filter(is_near),
            // The distance falls up to the nearest point and grows behind it: on the interval it is least there, or at an end.
            None => nearest_ts(&triangle, origin, direction)
                .map(|t| t.min(last).max(first))
                .find(is_near),
        }
    }

    /// True if a ray passes a face, which it misses, by a hair.
    pub(super) fn is_missed_by_a_hair(&self, ray: &Ray<F>, face: u32, t: Option<f64>) -> bool {
        self.missed_by_a_hair(ray, face, t, f64::INFINITY).is_some()
    }

    /// The length of a face's longest edge; 0 if there is no such face.
    pub(super) fn longest_edge_of(&self, face: u32) -> f64 {
        let place = self.place_of(face);
        place.map_or(0.0, |place| longest_edge(&self.triangle_at(place)))
    }

    /// The step of t that is too short to be seen at a face.
    pub fn hair(&self, ray: &Ray<F>, face: u32) -> f64 {
        VISIBLE * self.longest_edge_of(face) / length_of(ray)
    }

    /// True if a t is so near to a hit that nobody sees the difference.
    pub fn is_near(&self, ray: &Ray<F>, hit: &Nearest, t: f64) -> bool {
        let hair = VISIBLE / self.edges_to_a_t(ray, hit);
        (hit.t.lower - hair..=hit.t.upper + hair).contains(&t)
    }

    /// How many longest edges of the nearest faces the ray covers while t grows by 1.
    pub(super) fn edges_to_a_t(&self, ray: &Ray<F>, nearest: &Nearest) -> f64 {
        let edges = nearest.faces.iter().map(|face| self.longest_edge_of(*face));
        length_of(ray) / edges.fold(0.0, f64::max)
    }

    /// How far the point at t lies behind the nearest one, in longest edges of the nearest face; none if that is no number.
    pub(super) fn behind(
        &self,
        ray: &Ray<F>,
        nearest: &Nearest,
        t: f64,
    ) -> Result<Option<f64>, InvalidRay> {
        let edges = self.edges_to_a_t(ray, nearest);
        let Bounds { lower, upper } = nearest.t;
        let later = match (upper - lower) * edges <= TELLING {
            true => t - lower.midpoint(upper),
            // The bounds are too wide to say it.
            false => {
                let exact = self.t(ray, nearest.faces[0])?;
                exact.map_or(f64::NAN, |[first, _]| t - first)
            }
        };
        // Faces that are points have no edge to measure by.
        let behind = if later == 0.0 { 0.0 } else { later * edges };
        Ok(Some(behind).filter(|behind| behind.is_finite()))
    }

    /// True if a ray that meets no face passes one by a hair.
    pub(super) fn passes_by_a_hair(&self, ray: &Ray<F>) -> bool {
        let Ok(checked) = ray.checked() else {
            return false;
        };
        self.is_any_near(&checked, VISIBLE, |place| {
            self.is_missed_by_a_hair(ray, self.face_at(place), None)
        })
    }
}

/// Where a line may be nearest to a triangle: in its plane, at one of its corners, or beside one of its edges. Some may be NaN.
fn nearest_ts(
    triangle: &Triangle<f64>,
    origin: DVec3,
    direction: DVec3,
) -> impl Iterator<Item = f64> {
    let corners = triangle.map(|corner| DVec3::from(corner) - origin);
    let size = direction.abs().max_element();
    let direction = of_size_1(direction);
    let normal = normal(triangle);
    let in_plane = corners[0].dot(normal) / direction.dot(normal);
    let at_corners = corners.map(|corner| corner.dot(direction) / direction.length_squared());
    let beside_edges = [0, 1, 2].map(|i| {
        let edge = of_size_1(corners[(i + 1) % 3] - corners[i]);
        let across = direction.cross(edge);
        corners[i].cross(edge).dot(across) / across.length_squared()
    });
    let all = [in_plane].into_iter().chain(at_corners).chain(beside_edges);
    all.map(move |t| t / size)
}

/// The length of a ray's direction, in floats.
fn length_of<F: Float>(ray: &Ray<F>) -> f64 {
    length(DVec3::from(ray.direction.map(F::to_f64)))
}

/// The ray, moved aside.
fn moved<F: Float>(ray: &Ray<F>, distance: f64, angle: f64) -> Ray<F> {
    let direction = DVec3::from(ray.direction.map(F::to_f64));
    let direction = of_size_1(direction).normalize_or(DVec3::X);
    let (one, other) = direction.any_orthonormal_pair();
    let step = distance * (angle.cos() * one + angle.sin() * other);
    let origin = DVec3::from(ray.origin.map(F::to_f64)) + step;
    Ray {
        origin: origin.to_array().map(F::from_f64),
        ..*ray
    }
}

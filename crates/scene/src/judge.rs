//! The nearest hit that another program answered, beside the truth.

use crate::bounds::Bounds;
use crate::distance::{distance_to, longest_edge};
use crate::ray::{InvalidRay, Ray};
use crate::scene::{Nearest, Scene};
use glam::DVec3;
use hairline_core::Float;

/// A t that is off by more than this share of the face's longest edge is wrong: the point lies visibly elsewhere.
pub const VISIBLE: f64 = 1e-3;

/// Bounds of t that are nearer to each other, in longest edges, tell how far an answer is off.
const TELLING: f64 = 1e-9;

/// The nearest hit as a program answered it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The face, by number; none for a miss.
    pub face: Option<u32>,
    /// Its t, if the program gives one.
    pub t: Option<f64>,
}

/// The judgement of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Judgement {
    /// The one nearest face, or a miss where there is no hit.
    Right,
    /// One of several nearest faces: each of them is right.
    Tie,
    /// The right face with a t that is off by more than [`VISIBLE`], or that is no number.
    WrongT,
    /// A miss where there is a hit.
    Lost,
    /// A face that the ray meets behind the nearest one.
    Farther,
    /// A face that the ray misses by a hair, by less than [`VISIBLE`] of its longest edge, and nothing is hit in front of it: a
    /// neighbour of the nearest face, or a silhouette. Another answer, and nothing that anybody sees.
    Neighbour,
    /// A face that the ray does not meet, elsewhere.
    Ghost,
}

impl Judgement {
    /// True if it may be seen: the ray is lost, or hits elsewhere.
    pub fn is_wrong(self) -> bool {
        match self {
            Judgement::Right | Judgement::Tie | Judgement::Neighbour => false,
            Judgement::WrongT | Judgement::Lost | Judgement::Farther | Judgement::Ghost => true,
        }
    }
}

/// An answer with its judgement.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The judgement.
    pub judgement: Judgement,
    /// The truth.
    pub nearest: Option<Nearest>,
    /// How far the answered point lies behind the exact one, in longest edges of the nearest face: by its t, or of a farther
    /// face by that face's exact t. None without such a number, and where it is beyond the range of `f64`.
    pub behind: Option<f64>,
}

impl<F: Float> Scene<F> {
    /// Judges an answer to a ray. An error if the ray means nothing.
    pub fn judge(&self, ray: &Ray<F>, answer: &Answer) -> Result<Judged, InvalidRay> {
        let Some(nearest) = self.nearest(ray)? else {
            let judgement = match answer.face {
                None => Judgement::Right,
                Some(face) if self.is_missed_by_a_hair(ray, face, answer.t, f64::INFINITY) => {
                    Judgement::Neighbour
                }
                Some(_) => Judgement::Ghost,
            };
            return Ok(Judged {
                judgement,
                nearest: None,
                behind: None,
            });
        };
        let (judgement, behind) = match answer.face {
            None => (Judgement::Lost, None),
            Some(face) if nearest.faces.contains(&face) => {
                self.of_nearest(ray, &nearest, answer)?
            }
            Some(face) => match self.values(ray, face)? {
                None => self.of_unmet(ray, &nearest, face, answer.t)?,
                Some(values) => {
                    let behind = self.behind(ray, &nearest, values.t[0])?;
                    (Judgement::Farther, behind)
                }
            },
        };
        Ok(Judged {
            judgement,
            nearest: Some(nearest),
            behind,
        })
    }

    /// Judges an answer with one of the nearest faces: by its t.
    fn of_nearest(
        &self,
        ray: &Ray<F>,
        nearest: &Nearest,
        answer: &Answer,
    ) -> Result<(Judgement, Option<f64>), InvalidRay> {
        let right = match nearest.faces.len() {
            1 => Judgement::Right,
            _ => Judgement::Tie,
        };
        let Some(t) = answer.t else {
            return Ok((right, None));
        };
        let behind = self.behind(ray, nearest, t)?;
        // Without a number t is NaN, infinite, or as far as that.
        let is_visible = behind.is_none_or(|behind| VISIBLE < behind.abs());
        Ok(match is_visible {
            true => (Judgement::WrongT, behind),
            false => (right, behind),
        })
    }

    /// Judges an answer with a face that the ray does not meet.
    fn of_unmet(
        &self,
        ray: &Ray<F>,
        nearest: &Nearest,
        face: u32,
        t: Option<f64>,
    ) -> Result<(Judgement, Option<f64>), InvalidRay> {
        let behind = t.map_or(Ok(None), |t| self.behind(ray, nearest, t))?;
        // Not farther behind the nearest face than anybody sees.
        let latest = nearest.t.upper + VISIBLE / self.edges_to_a_t(ray, nearest);
        Ok(match self.is_missed_by_a_hair(ray, face, t, latest) {
            true => (Judgement::Neighbour, behind),
            false => (Judgement::Ghost, behind),
        })
    }

    /// True if the point at which a ray meets a face's plane is nearer to the face than anybody sees, on the interval and at
    /// `latest` at the most; at t, if it is given. In floats.
    fn is_missed_by_a_hair(&self, ray: &Ray<F>, face: u32, t: Option<f64>, latest: f64) -> bool {
        let Some(place) = self.place_of(face) else {
            return false;
        };
        let triangle = self.triangle_at(place);
        let [a, b, c] = triangle.map(DVec3::from);
        let origin = DVec3::from(ray.origin.map(F::to_f64));
        let direction = DVec3::from(ray.direction.map(F::to_f64));
        let normal = (b - a).cross(c - a);
        let crossing = (a - origin).dot(normal) / direction.dot(normal);
        // A ray along the plane has no crossing of it, but a t perhaps.
        let t = t.unwrap_or(crossing);
        let point = origin + t * direction;
        let ends = ray.t_min.to_f64()..=ray.t_max.to_f64().min(latest);
        let hair = VISIBLE * longest_edge(&triangle);
        ends.contains(&t) && distance_to(&triangle, point.into()) <= hair
    }

    /// How many longest edges of the nearest faces the ray covers while t grows by 1.
    fn edges_to_a_t(&self, ray: &Ray<F>, nearest: &Nearest) -> f64 {
        let places = nearest.faces.iter().filter_map(|face| self.place_of(*face));
        let longest = places
            .map(|place| longest_edge(&self.triangle_at(place)))
            .fold(0.0, f64::max);
        let length = DVec3::from(ray.direction.map(F::to_f64)).length();
        length / longest
    }

    /// How far the point at t lies behind the nearest one, in longest edges of the nearest face; none if that is no number.
    fn behind(&self, ray: &Ray<F>, nearest: &Nearest, t: f64) -> Result<Option<f64>, InvalidRay> {
        let edges = self.edges_to_a_t(ray, nearest);
        let Bounds { lower, upper } = nearest.t;
        let later = match (upper - lower) * edges <= TELLING {
            true => t - lower.midpoint(upper),
            // The bounds are too wide to say it.
            false => {
                let exact = self.values(ray, nearest.faces[0])?;
                exact.map_or(f64::NAN, |exact| t - exact.t[0])
            }
        };
        // Faces that are points have no edge to measure by.
        let behind = if later == 0.0 { 0.0 } else { later * edges };
        Ok(Some(behind).filter(|behind| behind.is_finite()))
    }
}

//! The answers of another program, beside the truth: the nearest hit here; all hits, counts and places of points below.

mod hair;
mod hits;
mod places;

pub use hits::NamedHit;
pub use places::NamedPlace;

use crate::ray::{InvalidRay, Ray};
use crate::scene::{Nearest, Scene};
use hairline_core::Float;

/// A t that is off by more than this share of the face's longest edge is wrong: the point lies visibly elsewhere.
pub const VISIBLE: f64 = 1e-3;

/// The nearest hit as a program answered it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The face, by number; none for a miss.
    pub face: Option<u32>,
    /// Its t, if the program gives one.
    pub t: Option<f64>,
}

named! {
    pub names
    /// The judgement of an answer, the worst first.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Judgement {
        /// A miss where the mesh is hit.
        Lost = "lost",
        /// A face behind the nearest one: slipped through.
        Farther = "farther face",
        /// A face elsewhere, that the ray does not meet, or a hit where nothing is.
        Ghost = "ghost",
        /// The face that the ray starts at and misses by a hair, in front of where it hits: rounding took the start to its other side.
        SelfHit = "self-hit",
        /// Fewer hits than there are.
        TooFew = "too few",
        /// More hits than there are.
        TooMany = "too many",
        /// One hit named twice.
        Twice = "twice",
        /// A hit named before one that is nearer.
        WrongOrder = "wrong order",
        /// The other side of the surface.
        WrongSide = "wrong side",
        /// The right face, with a t that is off by over 1/1000 of its longest edge, or that is no number.
        WrongT = "wrong t",
        /// Off by a hair, which nobody sees.
        Neighbour = "neighbour",
        /// Not defined: the surface is open.
        NotDefined = "not defined",
        /// One of several right answers.
        Tie = "tie" | "right, a tie",
        /// The exact answer.
        Right = "right",
    }
}

impl Judgement {
    /// True if it may be seen: a ray is lost, or hits elsewhere.
    pub fn is_wrong(self) -> bool {
        self < Judgement::Neighbour
    }

    /// True if it is the exact answer, or one of several.
    pub fn is_right(self) -> bool {
        matches!(self, Judgement::Right | Judgement::Tie)
    }
}

/// An answer with its judgement.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The judgement.
    pub judgement: Judgement,
    /// The exact hit that it is about: the nearest one; of all hits the first that is lost, if one is.
    pub hit: Option<Nearest>,
    /// How far the answered point lies behind the exact one, in longest edges of the nearest face: by its t, or of a farther
    /// face by that face's exact t. Of a point on the wrong side the distance from the surface, in longest edges of the face there.
    /// None without such a number, and where it is beyond the range of `f64`.
    pub off: Option<f64>,
}

impl Judged {
    fn new(judgement: Judgement, hit: Option<Nearest>, off: Option<f64>) -> Judged {
        Judged {
            judgement,
            hit,
            off,
        }
    }
}

impl<F: Float> Scene<F> {
    /// Judges the nearest hit that a program answered. An error if the ray means nothing.
    ///
    /// An answer that is right for a ray beside this one, nearer than anybody sees, is a neighbour: that holds at silhouettes, and
    /// along walls in which the ray runs.
    pub fn judge(&self, ray: &Ray<F>, answer: &Answer) -> Result<Judged, InvalidRay> {
        let judged = self.judge_strictly(ray, answer)?;
        let may_be_aside = matches!(judged.judgement, Judgement::Lost | Judgement::Farther);
        if may_be_aside && self.is_right_aside(ray, answer)? {
            return Ok(Judged::new(Judgement::Neighbour, judged.hit, None));
        }
        self.or_neighbour(ray, judged, |beside| {
            Ok(self.judge_strictly(beside, answer)?.judgement)
        })
    }

    fn judge_strictly(&self, ray: &Ray<F>, answer: &Answer) -> Result<Judged, InvalidRay> {
        let Some(nearest) = self.nearest(ray)? else {
            let judgement = match answer.face {
                None => Judgement::Right,
                Some(face) => {
                    self.of_face_nearby(ray, face, answer.t, f64::INFINITY, f64::INFINITY)
                }
            };
            return Ok(Judged::new(judgement, None, None));
        };
        let (judgement, off) = match answer.face {
            None => (Judgement::Lost, None),
            Some(face) if nearest.faces.contains(&face) => {
                self.of_nearest(ray, &nearest, answer)?
            }
            Some(face) => match self.t(ray, face)? {
                None => self.of_unmet(ray, &nearest, face, answer.t)?,
                Some([first, _]) if self.is_self_hit(ray, face, answer.t, first) => {
                    let t = answer.t.unwrap_or(first);
                    (Judgement::SelfHit, self.behind(ray, &nearest, t)?)
                }
                Some([first, _]) => {
                    let behind = self.behind(ray, &nearest, first)?;
                    // Near an edge the ray may meet both faces, one just behind the other.
                    match behind.is_some_and(|behind| behind <= VISIBLE) {
                        true => (Judgement::Neighbour, behind),
                        false => (Judgement::Farther, behind),
                    }
                }
            },
        };
        Ok(Judged::new(judgement, Some(nearest), off))
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
        let face = answer.face.unwrap_or(nearest.faces[0]);
        Ok(match is_visible {
            false => (right, behind),
            // A ray in the face's plane has other points of the face.
            true if self.is_at(ray, face, Some(t))? => (Judgement::Neighbour, behind),
            true if self.is_self_hit(ray, face, Some(t), nearest.t.lower) => {
                (Judgement::SelfHit, behind)
            }
            true => (Judgement::WrongT, behind),
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
        let judgement = self.of_face_nearby(ray, face, t, latest, nearest.t.lower);
        Ok((judgement, behind))
    }

    /// Judges a point of a face that the ray does not meet there, and that it may pass by a hair at `latest`; an exact hit is at
    /// `first`.
    fn of_face_nearby(
        &self,
        ray: &Ray<F>,
        face: u32,
        t: Option<f64>,
        latest: f64,
        first: f64,
    ) -> Judgement {
        let Some(t) = self.missed_by_a_hair(ray, face, t, latest) else {
            return Judgement::Ghost;
        };
        let hair = self.hair(ray, face);
        match hair < first - t {
            true => self.of_hit_before(ray, face, t),
            false => Judgement::Neighbour,
        }
    }

    /// True if a program named a face at the ray's start, which the ray passes there by a hair and meets later, first at `first`.
    fn is_self_hit(&self, ray: &Ray<F>, face: u32, t: Option<f64>, first: f64) -> bool {
        let judgement = |t| self.of_face_nearby(ray, face, Some(t), f64::INFINITY, first);
        t.is_some_and(|t| judgement(t) == Judgement::SelfHit)
    }

    /// Judges a face that the ray passes by a hair at a t, where no exact hit is: at the ray's start everybody sees it.
    fn of_hit_before(&self, ray: &Ray<F>, face: u32, t: f64) -> Judgement {
        match t - ray.t_min.to_f64() <= self.hair(ray, face) {
            true => Judgement::SelfHit,
            false => Judgement::Neighbour,
        }
    }

    /// True if an answer is right for a ray that is moved aside by less than any number.
    fn is_right_aside(&self, ray: &Ray<F>, answer: &Answer) -> Result<bool, InvalidRay> {
        for passage in self.passages(ray)? {
            if let Some(face) = answer.face.filter(|face| passage.faces.contains(face)) {
                return self.is_at(ray, face, answer.t);
            }
            if !passage.is_silhouette {
                return Ok(false);
            }
        }
        Ok(answer.face.is_none())
    }

    /// True if a ray meets a face at a t, as near as anybody sees; at any t, if none is given.
    fn is_at(&self, ray: &Ray<F>, face: u32, t: Option<f64>) -> Result<bool, InvalidRay> {
        let (Some([first, last]), Some(t)) = (self.t(ray, face)?, t) else {
            return Ok(t.is_none());
        };
        let hair = self.hair(ray, face);
        Ok((first - hair..=last + hair).contains(&t))
    }
}

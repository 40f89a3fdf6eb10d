//! The questions to a program, and its answers.

use crate::kernel::Scalar;
use hairline_scene::{Answer, InvalidRay, Judged, NamedHit, NamedPlace, Ray, Scene};
use rayon::prelude::*;

named! {
    pub names
    /// The kind of answers that a program gives.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum AnswerKind {
        /// The nearest hit of a ray.
        Nearest = "nearest",
        /// True if there is any hit.
        Any = "any",
        /// All hits, in order.
        All = "all",
        /// The number of hits.
        Count = "count",
        /// The place of a point: inside, outside, or on the surface.
        Inside = "inside",
    }
}

/// The answers, in the order of the rays or points.
pub enum Answers {
    /// The nearest hit of each ray.
    Nearest(Vec<Answer>),
    /// True for each ray that hits something.
    Any(Vec<bool>),
    /// The hits of each ray, in the program's order.
    All(Vec<Vec<NamedHit>>),
    /// The number of hits of each ray.
    Count(Vec<u64>),
    /// The place of each point.
    Inside(Vec<NamedPlace>),
}

impl Answers {
    /// The kind of them.
    pub fn kind(&self) -> AnswerKind {
        match self {
            Answers::Nearest(_) => AnswerKind::Nearest,
            Answers::Any(_) => AnswerKind::Any,
            Answers::All(_) => AnswerKind::All,
            Answers::Count(_) => AnswerKind::Count,
            Answers::Inside(_) => AnswerKind::Inside,
        }
    }

    /// True if they are of points.
    pub fn are_of_points(&self) -> bool {
        self.kind() == AnswerKind::Inside
    }

    /// An answer in words.
    pub(crate) fn in_words(&self, index: usize) -> String {
        match self {
            Answers::Nearest(all) => match all[index].face {
                None => "a miss".to_owned(),
                Some(face) => format!("face {face}"),
            },
            Answers::Any(all) => match all[index] {
                true => "a hit".to_owned(),
                false => "no hit".to_owned(),
            },
            Answers::All(all) if all[index].is_empty() => "no hit".to_owned(),
            Answers::All(all) => {
                let faces: Vec<String> = all[index].iter().map(|it| it.face.to_string()).collect();
                format!("faces {}", faces.join(", "))
            }
            Answers::Count(all) => format!("{} hits", all[index]),
            Answers::Inside(all) => all[index].name().to_owned(),
        }
    }
}

/// The rays, or else the points.
pub enum Asked<F> {
    /// Rays.
    Rays(Vec<Ray<F>>),
    /// Points.
    Points(Vec<[F; 3]>),
}

impl<F: Scalar> Asked<F> {
    /// How many.
    pub fn count(&self) -> usize {
        match self {
            Asked::Rays(rays) => rays.len(),
            Asked::Points(points) => points.len(),
        }
    }

    /// The rays; none of points.
    pub(crate) fn rays(&self) -> &[Ray<F>] {
        match self {
            Asked::Rays(rays) => rays,
            Asked::Points(_) => &[],
        }
    }

    /// Judges the answers, as many as there are rays or points, on all threads.
    pub(crate) fn judged(
        &self,
        scene: &Scene<F>,
        answers: &Answers,
    ) -> Result<Vec<Judged>, BadRay> {
        let rays = self.rays();
        let points = match self {
            Asked::Rays(_) => &[][..],
            Asked::Points(points) => points,
        };
        of_all(self.count(), |i| match answers {
            Answers::Nearest(all) => scene.judge(&rays[i], &all[i]),
            Answers::Any(all) => scene.judge_any(&rays[i], all[i]),
            Answers::All(all) => scene.judge_hits(&rays[i], &all[i]),
            Answers::Count(all) => scene.judge_count(&rays[i], all[i]),
            Answers::Inside(all) => scene.judge_place(points[i], all[i]),
        })
    }
}

/// A ray or point that means nothing.
#[derive(Debug)]
pub struct BadRay {
    /// Its number, from 0.
    pub index: usize,
    /// Why.
    pub error: InvalidRay,
}

/// An answer about each of so many rays, found on all threads.
pub(crate) fn of_all<T: Send>(
    count: usize,
    of_ray: impl Fn(usize) -> Result<T, InvalidRay> + Sync,
) -> Result<Vec<T>, BadRay> {
    let indices = (0..count).into_par_iter();
    indices
        .map(|index| of_ray(index).map_err(|error| BadRay { index, error }))
        .collect()
}

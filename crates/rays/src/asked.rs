//! The questions to a program, and its answers.

use crate::kernel::Scalar;
use crate::record::number_of;
use crate::single::joined;
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
#[derive(Clone)]
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
                Some(face) => at_t(face, all[index].t),
            },
            Answers::Any(all) => match all[index] {
                true => "a hit".to_owned(),
                false => "no hit".to_owned(),
            },
            Answers::All(all) if all[index].is_empty() => "no hit".to_owned(),
            Answers::All(all) => {
                let shown = all[index].iter().take(TOLD);
                let mut hits: Vec<String> = shown.map(|it| at_t(it.face, it.t)).collect();
                if TOLD < all[index].len() {
                    hits.push(format!("{} more", all[index].len() - TOLD));
                }
                hits.join(", ")
            }
            Answers::Count(all) => number_of(all[index], "hit", "hits"),
            Answers::Inside(all) => all[index].name().to_owned(),
        }
    }

    /// An answer as a cell of a table: faces, a number or a word.
    pub(crate) fn in_short(&self, index: usize) -> String {
        match self {
            Answers::Nearest(_) | Answers::All(_) => joined(&self.faces(index)),
            Answers::Count(all) => all[index].to_string(),
            Answers::Any(_) | Answers::Inside(_) => self.in_words(index),
        }
    }

    /// The answers with each t divided by a length.
    pub(crate) fn with_t_divided(&self, lengths: &[f64]) -> Answers {
        match self {
            Answers::Nearest(all) => {
                let divided = all.iter().zip(lengths).map(|(it, length)| Answer {
                    t: it.t.map(|t| t / length),
                    ..*it
                });
                Answers::Nearest(divided.collect())
            }
            Answers::All(all) => {
                let divided = all.iter().zip(lengths).map(|(hits, length)| {
                    let hits = hits.iter().map(|it| NamedHit {
                        t: it.t.map(|t| t / length),
                        ..*it
                    });
                    hits.collect()
                });
                Answers::All(divided.collect())
            }
            Answers::Any(all) => Answers::Any(all.clone()),
            Answers::Count(all) => Answers::Count(all.clone()),
            Answers::Inside(all) => Answers::Inside(all.clone()),
        }
    }

    /// The faces that an answer names.
    pub(crate) fn faces(&self, index: usize) -> Vec<u32> {
        match self {
            Answers::Nearest(all) => all[index].face.into_iter().collect(),
            Answers::All(all) => all[index].iter().map(|hit| hit.face).collect(),
            Answers::Any(_) | Answers::Count(_) | Answers::Inside(_) => Vec::new(),
        }
    }

    /// A face that an answer names and that a mesh of so many faces does not have.
    pub(crate) fn beyond(&self, index: usize, faces: usize) -> Option<u32> {
        let named = self.faces(index);
        named.into_iter().find(|face| faces <= *face as usize)
    }

    /// The t of a nearest hit, if the program gave one.
    pub(crate) fn t(&self, index: usize) -> Option<f64> {
        match self {
            Answers::Nearest(all) => all[index].t,
            _ => None,
        }
    }
}

/// How many hits of a ray are told.
const TOLD: usize = 6;

fn at_t(face: u32, t: Option<f64>) -> String {
    match t {
        None => format!("face {face}"),
        Some(t) => format!("face {face} at t = {t:?}"),
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

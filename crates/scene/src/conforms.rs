//! A program held to the truth from its own tests: rays are made, the program answers, and what is wrong is told.

use crate::aimed::{NoTargets, RayKind, Targets};
use crate::judge::{Answer, Judged};
use crate::ray::Ray;
use crate::scene::Scene;
use hairline_core::Float;
use std::error::Error;
use std::fmt;

/// Why a program does not conform.
#[derive(Clone, Debug)]
pub enum NotConforming<F> {
    /// It was not asked, since no rays can be made at this scene.
    NotAsked(NoTargets),
    /// Some answers are wrong.
    Wrong(WrongAnswers<F>),
}

/// The wrong answers of a program.
#[derive(Clone, Debug)]
pub struct WrongAnswers<F> {
    /// How many rays were asked about.
    pub asked: u64,
    /// How many answers are wrong.
    pub count: u64,
    /// The worst one.
    pub worst: WrongAnswer<F>,
}

/// A wrong answer to a ray.
#[derive(Clone, Debug)]
pub struct WrongAnswer<F> {
    /// The ray.
    pub ray: Ray<F>,
    /// The program's answer.
    pub answer: Answer,
    /// Its judgement, with the exact hit.
    pub judged: Judged,
}

impl<F: Float> Scene<F> {
    /// Asks a program for its nearest hits of so many rays at this scene, of every [`RayKind`] in turn, and judges them. An error has
    /// the wrong answers, or says why no rays can be made.
    ///
    /// ```
    /// use hairline_scene::{Answer, Scene};
    ///
    /// let vertices = [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let tetrahedron = Scene::new(&vertices, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).unwrap();
    /// // A program that never finds anything.
    /// let nothing = |_: &_| Answer { face: None, t: None };
    /// let error = tetrahedron.conforms(600, 1, nothing).unwrap_err();
    /// assert!(error.to_string().contains("lost"));
    /// ```
    pub fn conforms(
        &self,
        count: u64,
        seed: u64,
        mut answer: impl FnMut(&Ray<F>) -> Answer,
    ) -> Result<(), NotConforming<F>> {
        let targets = Targets::new(self.in_order_of_faces()).map_err(NotConforming::NotAsked)?;
        let mut worst: Option<WrongAnswer<F>> = None;
        let mut wrong = 0;
        for ray in targets.rays(&RayKind::ALL, count, seed) {
            let answer = answer(&ray);
            // A ray that is made means something.
            let Ok(judged) = self.judge(&ray, &answer) else {
                continue;
            };
            if !judged.judgement.is_wrong() {
                continue;
            }
            wrong += 1;
            let size = |judged: &Judged| judged.off.map_or(0.0, f64::abs);
            let is_worse = worst.as_ref().is_none_or(|worst| {
                let by_kind = judged.judgement.cmp(&worst.judged.judgement);
                let by_size = size(&worst.judged).total_cmp(&size(&judged));
                by_kind.then(by_size).is_lt()
            });
            if is_worse {
                worst = Some(WrongAnswer {
                    ray,
                    answer,
                    judged,
                });
            }
        }
        match worst {
            None => Ok(()),
            Some(worst) => Err(NotConforming::Wrong(WrongAnswers {
                asked: count,
                count: wrong,
                worst,
            })),
        }
    }
}

impl<F: Float> fmt::Display for WrongAnswers<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let WrongAnswer {
            ray,
            answer,
            judged,
        } = &self.worst;
        let named = match answer.face {
            None => "a miss".to_owned(),
            Some(face) => format!("face {face}"),
        };
        let exact = match &judged.hit {
            None => "no face is hit".to_owned(),
            Some(hit) => format!("the nearest face is {}", hit.faces[0]),
        };
        write!(
            f,
            "{} of {} answers are wrong; the worst ({}): from {:?} along {:?} {exact}, and {named} was answered",
            self.count, self.asked, judged.judgement, ray.origin, ray.direction
        )?;
        match judged.off {
            Some(off) if off < 0.0 => write!(f, ", {:.3} longest edges in front of it", -off),
            Some(off) => write!(f, ", {off:.3} longest edges behind it"),
            None => Ok(()),
        }
    }
}

impl<F: Float> fmt::Display for NotConforming<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotConforming::NotAsked(why) => write!(f, "nothing was asked: {why}"),
            NotConforming::Wrong(wrong) => wrong.fmt(f),
        }
    }
}

impl<F: Float> Error for NotConforming<F> {}

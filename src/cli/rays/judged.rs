//! The answers of a program to a file of rays, judged.

mod page;

use super::RaysArguments;
use super::found::of_all;
use super::one::{case_of, explain_command};
use super::read;
use crate::arith::ScalarName;
use crate::audit::Row as KernelRow;
use crate::case::Case;
use crate::cli::exit::{Failure, Status};
use crate::corpus::lines::AnyCase;
use crate::files::mesh::Mesh;
use crate::kernel::{KERNELS, Scalar, Verdict, verdicts_of};
use crate::report::Format;
use hairline_scene::{Answer, Judged, Judgement, Ray};
use page::short;
use serde::Serialize;
use std::cmp::Reverse;

/// How many wrong answers are shown with their commands.
const SHOWN: usize = 3;

/// The fewest wrong faces by which a shift of their numbers is known.
const FEWEST: usize = 5;

/// How a program did.
#[derive(Serialize)]
struct JudgedAnswers {
    scalar: &'static str,
    rays: u64,
    /// Rays that hit the mesh.
    hits: u64,
    counts: Vec<JudgementCount>,
    /// How many are right by mesh and rays as they are written, in f64, if f32 was chosen because more are right there.
    right_in_f64: Option<u64>,
    /// The number that added to the faces of wrong answers makes most of them right, if one does.
    shift: Option<i64>,
    /// How many nearest hits the program missed, or answered with another face.
    lost: u64,
    /// How many of these each kernel misses by itself, on every nearest face.
    missed_by: Vec<KernelMisses>,
    worst: Vec<WrongAnswer>,
}

/// How often a judgement was made.
#[derive(Serialize)]
struct JudgementCount {
    #[serde(skip)]
    kind: Judgement,
    judgement: &'static str,
    meaning: &'static str,
    count: u64,
    /// The median distance behind the exact hit, in longest edges of the face, where it is known.
    median: Option<f64>,
    /// The largest.
    most: Option<f64>,
}

/// A kernel, and how many of the lost hits it misses too.
#[derive(Serialize)]
struct KernelMisses {
    kernel: &'static str,
    count: u64,
}

/// A wrong answer.
#[derive(Serialize)]
struct WrongAnswer {
    /// The ray's number, from 0.
    ray: usize,
    text: String,
    /// Shows the nearest face, or the one that was answered.
    command: Option<String>,
}

/// The judgements in the order of a screen, with a name and a meaning.
const KINDS: [(Judgement, &str, &str); 7] = [
    (Judgement::Lost, "lost", "a miss where the mesh is hit"),
    (
        Judgement::Farther,
        "farther face",
        "a face behind the nearest one: slipped through",
    ),
    (
        Judgement::Ghost,
        "ghost",
        "a face elsewhere, that the ray does not meet",
    ),
    (
        Judgement::WrongT,
        "wrong t",
        "the right face, off by over 1/1000 of its longest edge",
    ),
    (
        Judgement::Neighbour,
        "neighbour",
        "a face that the ray misses by a hair: nobody sees it",
    ),
    (
        Judgement::Tie,
        "right, a tie",
        "one of several nearest faces",
    ),
    (Judgement::Right, "right", "the nearest face, or no hit"),
];

/// Judges all answers: in a scalar, or else in the one in which more are right.
pub(super) fn run(
    arguments: &RaysArguments,
    mesh: &Mesh,
    file: &str,
    scalar: Option<ScalarName>,
) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let in_f32 = || judged::<f32>(arguments, mesh, file);
    let in_f64 = || judged::<f64>(arguments, mesh, file);
    let result = match scalar {
        Some(ScalarName::F32) => in_f32()?,
        Some(ScalarName::F64) => in_f64()?,
        // Standard input is read once.
        None if [arguments.rays_file(), file].contains(&"-") => in_f64()?,
        None => more_right(in_f64()?, in_f32)?,
    };
    arguments.output.write(outputs, &result)?;
    Ok(match result.wrong_count() {
        0 => Status::Success,
        _ => Status::Disagreements,
    })
}

/// The judgements in f64 if all are right there, or no fewer than in f32: most programs compute in one of the two, and name the
/// exact face most often by the numbers that they have.
fn more_right(
    in_f64: JudgedAnswers,
    in_f32: impl FnOnce() -> Result<JudgedAnswers, Failure>,
) -> Result<JudgedAnswers, Failure> {
    let right = in_f64.right_count();
    if right == in_f64.rays {
        return Ok(in_f64);
    }
    // Numbers that f32 does not hold are of a program that computes in f64.
    let Ok(in_f32) = in_f32() else {
        return Ok(in_f64);
    };
    Ok(match right < in_f32.right_count() {
        true => JudgedAnswers {
            right_in_f64: Some(right),
            ..in_f32
        },
        false => in_f64,
    })
}

fn judged<F: Scalar>(
    arguments: &RaysArguments,
    mesh: &Mesh,
    file: &str,
) -> Result<JudgedAnswers, Failure>
where
    Case<F>: Into<AnyCase>,
{
    let scene = super::scene::<F>(mesh)?;
    let rays = read::rays::<F>(arguments.rays_file())?;
    let answers = read::answers(file, rays.len(), mesh.triangles.len())?;
    let judged = of_all(arguments, rays.len(), |index| {
        scene.judge(&rays[index], &answers[index])
    })?;
    let run = JudgedRun {
        mesh,
        rays: &rays,
        answers: &answers,
        judged: &judged,
    };
    Ok(run.result())
}

impl JudgedAnswers {
    fn wrong_count(&self) -> u64 {
        let wrong = self.counts.iter().filter(|it| it.kind.is_wrong());
        wrong.map(|it| it.count).sum()
    }

    /// Answers with the exact face, ties included.
    fn right_count(&self) -> u64 {
        let is_right = |it: &&JudgementCount| matches!(it.kind, Judgement::Right | Judgement::Tie);
        self.counts.iter().filter(is_right).map(|it| it.count).sum()
    }
}

/// Rays with their answers and judgements, each list in the order of the rays.
struct JudgedRun<'a, F: Scalar> {
    mesh: &'a Mesh,
    rays: &'a [Ray<F>],
    answers: &'a [Answer],
    judged: &'a [Judged],
}

impl<F: Scalar> JudgedRun<'_, F>
where
    Case<F>: Into<AnyCase>,
{
    fn result(&self) -> JudgedAnswers {
        let hits = self.judged.iter().filter(|it| it.nearest.is_some()).count();
        let (lost, missed_by) = self.kernels_that_miss();
        JudgedAnswers {
            scalar: F::NAME.name(),
            rays: self.rays.len() as u64,
            hits: hits as u64,
            counts: KINDS.iter().map(|kind| self.count(kind)).collect(),
            right_in_f64: None,
            shift: self.shift(),
            lost,
            missed_by,
            worst: self.worst(),
        }
    }

    fn count(
        &self,
        (judgement, name, meaning): &(Judgement, &'static str, &'static str),
    ) -> JudgementCount {
        let of_kind = self.judged.iter().filter(|it| it.judgement == *judgement);
        let mut behind: Vec<f64> = of_kind
            .clone()
            .filter_map(|it| it.behind.map(f64::abs))
            .collect();
        behind.sort_by(f64::total_cmp);
        JudgementCount {
            kind: *judgement,
            judgement: name,
            meaning,
            count: of_kind.count() as u64,
            median: behind.get(behind.len() / 2).copied(),
            most: behind.last().copied(),
        }
    }

    /// How many nearest hits were missed or answered with another face, and how many of them each kernel misses by itself, the most
    /// first.
    fn kernels_that_miss(&self) -> (u64, Vec<KernelMisses>) {
        let is_lost = |judged: &(usize, &Judged)| {
            let kind = judged.1.judgement;
            judged.1.nearest.is_some() && kind.is_wrong() && kind != Judgement::WrongT
        };
        let lost: Vec<(usize, &Judged)> = self.judged.iter().enumerate().filter(is_lost).collect();
        let mut all: Vec<KernelMisses> = KERNELS
            .iter()
            .filter_map(|entry| {
                let row = KernelRow::named(entry.info.name, None, "own").ok()?;
                let subject = F::subject(entry)?;
                let misses = |(index, judged): &&(usize, &Judged)| {
                    let nearest = judged.nearest.as_ref().map_or(&[][..], |it| &it.faces);
                    let cases: Vec<Case<F>> = nearest
                        .iter()
                        .map(|face| case_of(self.mesh, &self.rays[*index], *face))
                        .collect();
                    let mut verdicts = vec![Verdict::miss(None); cases.len()];
                    verdicts_of(subject, &cases, &row.epsilons::<F>(), &mut verdicts);
                    verdicts.iter().all(|verdict| !verdict.hit)
                };
                Some(KernelMisses {
                    kernel: entry.info.name,
                    count: lost.iter().filter(misses).count() as u64,
                })
            })
            .collect();
        all.sort_by_key(|it| (Reverse(it.count), it.kernel));
        (lost.len() as u64, all)
    }

    /// Some wrong answers: the farthest of each kind.
    fn worst(&self) -> Vec<WrongAnswer> {
        let wrong = self.judged.iter().enumerate();
        let mut wrong: Vec<(usize, &Judged)> =
            wrong.filter(|(_, it)| it.judgement.is_wrong()).collect();
        let size = |judged: &Judged| judged.behind.map_or(0.0, f64::abs);
        wrong.sort_by(|(_, a), (_, b)| {
            let by_kind = a.judgement.cmp(&b.judgement);
            by_kind.then(size(b).total_cmp(&size(a)))
        });
        // One of each kind first.
        let mut seen = Vec::new();
        let (first, others): (Vec<_>, Vec<_>) = wrong.into_iter().partition(|(_, judged)| {
            let is_first = !seen.contains(&judged.judgement);
            seen.push(judged.judgement);
            is_first
        });
        let all = first.into_iter().chain(others).take(SHOWN);
        all.map(|(index, judged)| self.told(index, judged))
            .collect()
    }

    fn told(&self, index: usize, judged: &Judged) -> WrongAnswer {
        let ray = &self.rays[index];
        let nearest = judged.nearest.as_ref().map(|it| it.faces[0]);
        let answer = match self.answers[index].face {
            None => "a miss".to_owned(),
            Some(face) => format!("face {face}"),
        };
        let truth = match nearest {
            None => "no face is hit".to_owned(),
            Some(face) => format!("the nearest is face {face}"),
        };
        let behind = match judged.behind {
            Some(behind) if behind < 0.0 => {
                format!(", {} longest edges in front of it", short(-behind))
            }
            Some(behind) => format!(", {} longest edges behind it", short(behind)),
            None => String::new(),
        };
        let shown = nearest.or(self.answers[index].face);
        let command = shown
            .filter(|face| (*face as usize) < self.mesh.triangles.len())
            .map(|face| explain_command(self.mesh, ray, face));
        WrongAnswer {
            ray: index,
            text: format!("ray {index}: {truth}; answered {answer}{behind}"),
            command,
        }
    }

    /// The shift of face numbers with which most wrong faces are right: a program that counts from 1, for example.
    fn shift(&self) -> Option<i64> {
        let wrong = self.judged.iter().zip(self.answers);
        let wrong: Vec<(&[u32], u32)> = wrong
            .filter(|(judged, _)| judged.judgement.is_wrong())
            .filter_map(|(judged, answer)| Some((&*judged.nearest.as_ref()?.faces, answer.face?)))
            .collect();
        let makes_right = |shift: i64| {
            let is_right = |(nearest, face): &&(&[u32], u32)| {
                let shifted = u32::try_from(i64::from(*face) + shift);
                shifted.is_ok_and(|face| nearest.contains(&face))
            };
            wrong.iter().filter(is_right).count()
        };
        let is_most = |shift: &i64| FEWEST <= wrong.len() && wrong.len() < 2 * makes_right(*shift);
        [-1, 1].into_iter().find(is_most)
    }
}

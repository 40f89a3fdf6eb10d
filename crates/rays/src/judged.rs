//! The answers of a program, judged and counted, with the worst of them.

use crate::arith::Float;
use crate::asked::{Answers, Asked, BadRay};
use crate::blame::{HitOfRay, lost_hits};
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::files::hex;
use crate::kernel::Scalar;
use crate::picture;
use crate::record::number_of;
use crate::report::page::Picture;
use crate::result::{JudgementCount, RaysResult, WrongAnswer, mesh_label, short};
use crate::scalar::JudgedRun;
use crate::single::explain_command;
use hairline_scene::{Answer, InvalidRay, Judged, Judgement, Ray, Scene};
use hmac_sha256::Hash;

/// How many wrong answers are told with their commands.
const TOLD: usize = 3;

/// The fewest faces by which a shift of their numbers is known.
const FEWEST: usize = 5;

/// Judges answers, by the rays as they are, or with directions of length 1 if more are right then.
pub fn judged<F: Scalar>(run: &JudgedRun<F>) -> Result<RaysResult, BadRay>
where
    Case<F>: Into<AnyCase>,
{
    let as_written = counted(run)?;
    let wrong_t = as_written.count(Judgement::WrongT);
    if wrong_t == 0 {
        return Ok(as_written);
    }
    let rays = run.asked.rays().iter().map(with_unit_direction);
    let Some(rays) = rays.collect() else {
        return Ok(as_written);
    };
    let asked = Asked::Rays(rays);
    let with_units = counted(&JudgedRun {
        asked: &asked,
        program: run.program.clone(),
        ..*run
    })?;
    // A program that loses rays at edges is right more often by any rays that are rounded: t has to be better too.
    let is_better = as_written.right_count() < with_units.right_count()
        && 2 * with_units.count(Judgement::WrongT) < wrong_t;
    Ok(match is_better {
        true => RaysResult {
            has_unit_directions: true,
            right_as_written: Some(as_written.right_count()),
            cases: as_written.cases,
            ..with_units
        },
        false => as_written,
    })
}

/// The judgements in f64 if all are right there, or no fewer than in f32: most programs compute in one of the two, and name the
/// exact face most often by the numbers that they have.
pub fn more_right<E>(
    in_f64: RaysResult,
    in_f32: impl FnOnce() -> Result<RaysResult, E>,
) -> RaysResult {
    let right = in_f64.right_count();
    if right == in_f64.asked {
        return in_f64;
    }
    // Numbers that f32 does not hold are of a program that computes in f64.
    let Ok(in_f32) = in_f32() else {
        return in_f64;
    };
    match right < in_f32.right_count() {
        true => RaysResult {
            right_as_written: in_f64.right_as_written.or(Some(right)),
            ..in_f32
        },
        false => in_f64,
    }
}

/// The ray of a program that makes directions of length 1 first; none if floats do not hold it.
fn with_unit_direction<F: Scalar>(ray: &Ray<F>) -> Option<Ray<F>> {
    let [x, y, z] = ray.direction;
    let length = (x * x + y * y + z * z).sqrt();
    let direction = ray.direction.map(|component| component / length);
    // Its square may over- or underflow.
    let is_ray = length.is_finite() && direction.iter().all(|x| x.is_finite());
    let on = [ray.t_min, ray.t_max].map(|t| t * length);
    is_ray.then(|| Ray::new(ray.origin, direction).on(on[0], on[1]))
}

fn counted<F: Scalar>(run: &JudgedRun<F>) -> Result<RaysResult, BadRay>
where
    Case<F>: Into<AnyCase>,
{
    let judged = run.asked.judged(run.scene, run.answers)?;
    let lost = hits_of(run, &judged, is_of_a_lost_hit);
    let found = hits_of(run, &judged, Judgement::is_right);
    Ok(RaysResult {
        mesh: mesh_label(run.mesh),
        cases: cases_label(run.asked),
        program: run.program.clone(),
        kind: run.answers.kind(),
        scalar: F::NAME,
        has_unit_directions: false,
        asked: judged.len() as u64,
        counts: Judgement::ALL
            .into_iter()
            .map(|kind| counted_as(kind, &judged))
            .collect(),
        right_as_written: None,
        shift: shift(run.answers, &judged),
        lost: lost_hits(run.mesh, run.scene, &lost, &found),
        worst: worst(run, &judged),
    })
}

/// The exact hits of rays whose answers have a judgement.
fn hits_of<'a, F: Scalar>(
    run: &'a JudgedRun<F>,
    judged: &'a [Judged],
    is_meant: impl Fn(Judgement) -> bool,
) -> Vec<HitOfRay<'a, F>> {
    let mut hits = Vec::new();
    for (ray, judged) in run.asked.rays().iter().zip(judged) {
        if let Some(hit) = judged.hit.as_ref().filter(|_| is_meant(judged.judgement)) {
            hits.push(HitOfRay { ray, hit });
        }
    }
    hits
}

/// True if the exact hit is missed, or another face is named in its place.
fn is_of_a_lost_hit(judgement: Judgement) -> bool {
    matches!(
        judgement,
        Judgement::Lost | Judgement::Farther | Judgement::Ghost | Judgement::TooFew
    )
}

/// The number of the rays or points, and a digest of their numbers.
fn cases_label<F: Scalar>(asked: &Asked<F>) -> String {
    let count = asked.count() as u64;
    let (name, numbers): (String, Vec<F>) = match asked {
        Asked::Rays(rays) => {
            let numbers = rays.iter().flat_map(|ray| {
                let vectors = ray.origin.into_iter().chain(ray.direction);
                vectors.chain([ray.t_min, ray.t_max])
            });
            (number_of(count, "ray", "rays"), numbers.collect())
        }
        Asked::Points(points) => {
            let numbers = points.iter().flatten().copied();
            (number_of(count, "point", "points"), numbers.collect())
        }
    };
    let mut hash = Hash::new();
    for number in numbers {
        hash.update(number.to_f64().to_bits().to_le_bytes());
    }
    let digest = hex(&hash.finalize());
    format!("{name}, {}", &digest[..8])
}

fn counted_as(judgement: Judgement, judged: &[Judged]) -> JudgementCount {
    let of_kind = judged.iter().filter(|it| it.judgement == judgement);
    let mut off: Vec<f64> = of_kind
        .clone()
        .filter_map(|it| it.off.map(f64::abs))
        .collect();
    off.sort_by(f64::total_cmp);
    JudgementCount {
        judgement,
        count: of_kind.count() as u64,
        median_off: off.get(off.len() / 2).copied(),
        most_off: off.last().copied(),
    }
}

/// Some wrong answers: the farthest of each kind, and then the next ones.
fn worst<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> Vec<WrongAnswer>
where
    Case<F>: Into<AnyCase>,
{
    let all = judged.iter().enumerate();
    let mut wrong: Vec<(usize, &Judged)> = all.filter(|(_, it)| it.judgement.is_wrong()).collect();
    let size = |judged: &Judged| judged.off.map_or(0.0, f64::abs);
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
    let all = first.into_iter().chain(others).take(TOLD);
    all.map(|(index, judged)| told(run, index, judged))
        .collect()
}

fn told<F: Scalar>(run: &JudgedRun<F>, index: usize, judged: &Judged) -> WrongAnswer
where
    Case<F>: Into<AnyCase>,
{
    let words = in_words(run.answers, index, judged);
    let (text, picture, commands) = match run.asked {
        Asked::Points(points) => {
            let text = format!("point {index}: {words}");
            let picture = picture::of_point(run.scene, points[index], &text);
            (text, picture, Vec::new())
        }
        Asked::Rays(rays) => {
            let text = format!("ray {index}: {words}");
            let answered = Some((run.answers, index));
            let hit = judged.hit.as_ref();
            let picture = picture::of_ray(run.scene, &rays[index], hit, answered, &text);
            let command = command(run, index, judged);
            // A judged ray means something.
            (text, picture.ok().flatten(), command.into_iter().collect())
        }
    };
    WrongAnswer {
        index: index as u64,
        judgement: judged.judgement,
        text,
        commands,
        picture,
    }
}

/// The command that shows a wrong answer about a ray, if it is about a face.
fn command<F: Scalar>(run: &JudgedRun<F>, index: usize, judged: &Judged) -> Option<String>
where
    Case<F>: Into<AnyCase>,
{
    let named = match run.answers {
        Answers::Nearest(all) => all[index].face,
        _ => None,
    };
    let face = nearest_face(judged).or(named)?;
    let exists = (face as usize) < run.mesh.triangles.len();
    exists.then(|| explain_command(run.mesh, &run.asked.rays()[index], face))
}

/// The picture of a ray, and of the nearest hit that a program answered, if one is given. None if the mesh has no finite face; an
/// error if the ray means nothing.
pub fn pictured<F: Float>(
    scene: &Scene<F>,
    ray: &Ray<F>,
    answer: Option<Answer>,
) -> Result<Option<Picture>, InvalidRay> {
    let Some(answer) = answer else {
        let hit = scene.nearest(ray)?;
        let words = match &hit {
            None => "no face is hit".to_owned(),
            Some(hit) => format!("the nearest is face {}", hit.faces[0]),
        };
        return picture::of_ray(scene, ray, hit.as_ref(), None, &words);
    };
    let judged = scene.judge(ray, &answer)?;
    let answers = Answers::Nearest(vec![answer]);
    let words = in_words(&answers, 0, &judged);
    picture::of_ray(scene, ray, judged.hit.as_ref(), Some((&answers, 0)), &words)
}

fn nearest_face(judged: &Judged) -> Option<u32> {
    judged.hit.as_ref().map(|hit| hit.faces[0])
}

/// The truth, the answer, and how far it is off.
fn in_words(answers: &Answers, index: usize, judged: &Judged) -> String {
    let answer = answers.in_words(index);
    let off = match judged.off {
        Some(off) if answers.are_of_points() => {
            format!(", {} longest edges from the surface", short(off))
        }
        Some(off) if off < 0.0 => format!(", {} longest edges in front of it", short(-off)),
        Some(off) => format!(", {} longest edges behind it", short(off)),
        None => String::new(),
    };
    let truth = match (nearest_face(judged), answers) {
        (_, Answers::Inside(_)) => return format!("answered {answer}{off}"),
        (None, Answers::All(_)) => "the faces that are met are others".to_owned(),
        (None, _) => "no face is hit".to_owned(),
        (Some(face), Answers::All(_)) => format!("face {face} is met too"),
        (Some(face), _) => format!("the nearest is face {face}"),
    };
    format!("{truth}; answered {answer}{off}")
}

/// The shift of face numbers with which most faces are right, and more than without: of a program that counts from 1, for
/// example.
fn shift(answers: &Answers, judged: &[Judged]) -> Option<i64> {
    let Answers::Nearest(answers) = answers else {
        return None;
    };
    let mut named = Vec::new();
    for (judged, answer) in judged.iter().zip(answers) {
        if let (Some(hit), Some(face)) = (&judged.hit, answer.face) {
            named.push((&hit.faces, face));
        }
    }
    let right = |shift: i64| {
        let is_right = |face: u32, nearest: &[u32]| {
            let shifted = u32::try_from(i64::from(face) + shift);
            shifted.is_ok_and(|face| nearest.contains(&face))
        };
        let right = named
            .iter()
            .filter(|(nearest, face)| is_right(*face, nearest));
        right.count()
    };
    let as_written = right(0);
    let is_most = |shift: &i64| {
        let shifted = right(*shift);
        as_written + FEWEST <= shifted && named.len() < 2 * shifted
    };
    [-1, 1].into_iter().find(is_most)
}

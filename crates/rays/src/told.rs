//! Wrong answers in words: the truth, the answer, and how far it is off.

use crate::arith::Float;
use crate::asked::{Answers, Asked, BadRay, of_all};
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::kernel::Scalar;
use crate::picture;
use crate::record::{group_digits, number_of};
use crate::report::page::Picture;
use crate::result::{EachAnswer, WrongAnswer, short};
use crate::run::JudgedRun;
use crate::single::{explain_command, faces_in_words, joined, place_name};
use hairline_scene::{Answer, InvalidRay, Judged, Judgement, Location, Nearest, Ray, Scene};

/// How many wrong answers are told with their commands.
const TOLD: usize = 3;

/// How many meetings of a ray with the mesh, or faces of one, are told.
const MEETINGS: usize = 6;

/// Some wrong answers: the farthest of each kind, and then the next ones.
pub fn worst<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> Result<Vec<WrongAnswer>, BadRay>
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
    all.map(|(index, judged)| told(run, index, judged).map_err(|error| BadRay { index, error }))
        .collect()
}

fn told<F: Scalar>(
    run: &JudgedRun<F>,
    index: usize,
    judged: &Judged,
) -> Result<WrongAnswer, InvalidRay>
where
    Case<F>: Into<AnyCase>,
{
    let (scene, answers) = (&run.scene, &run.answers);
    let (text, picture) = match &run.asked {
        Asked::Rays(rays) => {
            let ray = &rays[index];
            let truth = truth_of_ray(scene, ray, answers, judged)?;
            let words = beside(&truth, answers, index, judged);
            let beyond = answers.beyond(index, run.mesh.triangles.len());
            let beyond = beyond.map(|face| format!("; the mesh has no face {face}"));
            let text = format!("ray {index}: {words}{}", beyond.unwrap_or_default());
            let hit = judged.hit.as_ref();
            let picture = picture::of_ray(scene, ray, hit, Some((answers, index)), &text)?;
            (text, picture)
        }
        Asked::Points(points) => {
            let [x, y, z] = points[index].map(F::to_f64);
            let truth = truth_of_point(scene, points[index])?;
            let words = beside(truth, answers, index, judged);
            let text = format!("point {index} ({x:?}, {y:?}, {z:?}): {words}");
            let picture = picture::of_point(scene, points[index], &text);
            (text, picture)
        }
    };
    Ok(WrongAnswer {
        index: index as u64,
        judgement: judged.judgement,
        text,
        commands: command(run, index, judged).into_iter().collect(),
        picture,
    })
}

/// The truth, the answer, and how far it is off.
fn beside(truth: &str, answers: &Answers, index: usize, judged: &Judged) -> String {
    let off = match judged.off {
        Some(off) if answers.are_of_points() => {
            format!(", {} longest edges from the surface", short(off))
        }
        Some(off) if judged.judgement == Judgement::Farther => {
            format!(", which it meets {} longest edges behind", short(off))
        }
        Some(off) if off < 0.0 => format!(", {} longest edges in front of it", short(-off)),
        Some(off) => format!(", {} longest edges behind it", short(off)),
        None => String::new(),
    };
    let answer = answers.in_words(index);
    format!("{}: {truth}; answered {answer}{off}", judged.judgement)
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
        let words = nearest_in_words(scene, ray, hit.as_ref())?;
        return picture::of_ray(scene, ray, hit.as_ref(), None, &words);
    };
    let judged = scene.judge(ray, &answer)?;
    let answers = Answers::Nearest(vec![answer]);
    let truth = truth_of_ray(scene, ray, &answers, &judged)?;
    let words = beside(&truth, &answers, 0, &judged);
    picture::of_ray(scene, ray, judged.hit.as_ref(), Some((&answers, 0)), &words)
}

/// Shows what kernels answer on the exact nearest face, or else on the one that is named.
fn command<F: Scalar>(run: &JudgedRun<F>, index: usize, judged: &Judged) -> Option<String>
where
    Case<F>: Into<AnyCase>,
{
    let is_about_a_face = matches!(&run.answers, Answers::Nearest(_) | Answers::Any(_));
    let is_lost = judged.judgement == Judgement::Lost;
    if !is_about_a_face && !is_lost {
        return None;
    }
    let ray = run.asked.rays().get(index)?;
    let nearest = judged.hit.as_ref().map(|it| it.faces[0]);
    let named = match &run.answers {
        Answers::Nearest(all) => all[index].face,
        _ => None,
    };
    let face = nearest.or(named)?;
    let is_face = (face as usize) < run.mesh.triangles.len();
    is_face.then(|| explain_command(run.mesh, ray, face))
}

fn truth_of_ray<F: Float>(
    scene: &Scene<F>,
    ray: &Ray<F>,
    answers: &Answers,
    judged: &Judged,
) -> Result<String, InvalidRay> {
    match answers {
        Answers::All(_) => meetings(scene, ray),
        Answers::Count(_) => {
            let points = scene.passages(ray)?.len() as u64;
            let hits = scene.hits(ray)?;
            let faces = hits.iter().map(|hit| hit.faces.len() as u64).sum();
            Ok(format!(
                "it meets the surface {}, {} in all",
                match points {
                    1 => "once".to_owned(),
                    points => format!("{} times", group_digits(points)),
                },
                number_of(faces, "face", "faces")
            ))
        }
        _ => nearest_in_words(scene, ray, judged.hit.as_ref()),
    }
}

fn nearest_in_words<F: Float>(
    scene: &Scene<F>,
    ray: &Ray<F>,
    nearest: Option<&Nearest>,
) -> Result<String, InvalidRay> {
    let Some(nearest) = nearest else {
        return Ok("no face is hit".to_owned());
    };
    let t = scene.t(ray, nearest.faces[0])?;
    let faces = faces_in_words(&nearest.faces, MEETINGS);
    let t = t.map_or(String::new(), |[first, _]| format!(" at t = {first:?}"));
    Ok(format!("the nearest is {faces}{t}"))
}

/// The faces that a ray meets, in order.
fn meetings<F: Float>(scene: &Scene<F>, ray: &Ray<F>) -> Result<String, InvalidRay> {
    let passages = scene.passages(ray)?;
    if passages.is_empty() {
        return Ok("it meets no face".to_owned());
    }
    let mut words = Vec::new();
    for passage in passages.iter().take(MEETINGS) {
        let [from, to] = scene.ends(ray, passage)?;
        let faces = faces_in_words(&passage.faces, MEETINGS);
        words.push(match passage.is_segment {
            true => format!("{faces} from t = {from:?} to {to:?}"),
            false => format!("{faces} at t = {from:?}"),
        });
    }
    if MEETINGS < passages.len() {
        words.push(format!("{} more", passages.len() - MEETINGS));
    }
    Ok(format!("it meets {}", words.join(", then ")))
}

fn truth_of_point<F: Float>(scene: &Scene<F>, point: [F; 3]) -> Result<&'static str, InvalidRay> {
    Ok(match scene.locate(point)? {
        Location::On(_) => "it is on the surface",
        Location::NotDefined(_) => "the surface is open",
        Location::Off(winding) if winding.is_zero() => "it is outside",
        Location::Off(_) => "it is inside",
    })
}

/// Every answer beside the truth.
pub fn each<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> Result<Vec<EachAnswer>, BadRay> {
    of_all(judged.len(), |index| {
        let exact = exact_of(run, index, &judged[index])?;
        Ok(EachAnswer {
            judgement: judged[index].judgement,
            exact: exact.text,
            t: exact.t,
            answered: run.answers.in_short(index),
            answered_t: run.answers.t(index),
            off: judged[index].off,
        })
    })
}

/// An exact answer as cells of a table.
struct ExactCells {
    text: String,
    t: Option<f64>,
}

fn exact_of<F: Scalar>(
    run: &JudgedRun<F>,
    index: usize,
    judged: &Judged,
) -> Result<ExactCells, InvalidRay> {
    let ray = match &run.asked {
        Asked::Rays(rays) => &rays[index],
        Asked::Points(points) => {
            let location = run.scene.locate(points[index])?;
            return Ok(ExactCells {
                text: place_name(&location).to_owned(),
                t: None,
            });
        }
    };
    let faces = match &run.answers {
        Answers::All(_) => {
            let hits = run.scene.hits(ray)?;
            hits.into_iter().flat_map(|hit| hit.faces).collect()
        }
        _ => judged
            .hit
            .as_ref()
            .map_or(Vec::new(), |it| it.faces.clone()),
    };
    let t = match faces.first() {
        Some(face) => run.scene.t(ray, *face)?,
        None => None,
    };
    Ok(ExactCells {
        text: joined(&faces),
        t: t.map(|[first, _]| first),
    })
}

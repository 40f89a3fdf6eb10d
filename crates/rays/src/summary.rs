//! Judged answers, counted and told: how many are wrong, who loses the hits, and the worst of them.

use crate::asked::{AnswerKind, Answers, Asked, BadRay, of_all};
use crate::blame::{HitOfRay, lost_hits};
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::kernel::Scalar;
use crate::plain::{self, PlainProgram};
use crate::result::{GivenScene, JudgementCount, RaysResult, WithoutBoxes, WrongRays, mesh_label};
use crate::run::{JudgedRun, Judgements};
use crate::told::{each, worst};
use glam::DVec3;
use hairline_scene::{Answer, Judged, Judgement, Location, NamedPlace, Ray, Scene, Winding};

/// The fewest faces by which a shift of their numbers is known.
const FEWEST: usize = 5;

/// All that is told of judged answers.
pub fn summary<F: Scalar>(judgements: &Judgements<F>) -> Result<RaysResult, BadRay>
where
    Case<F>: Into<AnyCase>,
{
    let Judgements { run, judged, .. } = judgements;
    let lost = hits_of(run, judged, |it| is_of_a_lost_hit(run, it));
    let found = hits_of(run, judged, Judgement::is_right);
    let mut lost = lost_hits(run.mesh, &run.scene, &lost, &found);
    lost.without_boxes = without_boxes(run, judged)?;
    Ok(RaysResult {
        mesh: mesh_label(run.mesh),
        cases: judgements.cases.clone(),
        program: run.program.as_ref().map(PlainProgram::label),
        kind: run.answers.kind(),
        scalar: F::NAME,
        has_unit_directions: judgements.has_unit_directions,
        asked: judged.len() as u64,
        counts: Judgement::ALL
            .into_iter()
            .map(|kind| counted_as(kind, judged))
            .collect(),
        right_as_written: judgements.right_as_written,
        given: run.given.clone().map(|given| GivenScene {
            has_written_t: judgements.has_written_t,
            ..given
        }),
        right_as_given: None,
        shift: shift(run, judged)?,
        beyond_the_mesh: beyond_the_mesh(run),
        lost,
        wrong_rays: wrong_rays(run, judged)?,
        outside_interval: outside_interval(run, judged),
        wound_evenly: wound_evenly(run, judged)?,
        worst: worst(run, judged)?,
        each: match run.tells_each {
            true => each(run, judged)?,
            false => Vec::new(),
        },
    })
}

/// The rays whose answers have a judgement, with their numbers.
fn rays_of<'a, F: Scalar>(
    run: &'a JudgedRun<F>,
    judged: &'a [Judged],
    is_meant: impl Fn(Judgement) -> bool,
) -> Vec<(usize, &'a Ray<F>)> {
    let all = run.asked.rays().iter().enumerate();
    all.filter(|(index, _)| is_meant(judged[*index].judgement))
        .collect()
}

/// A ray that meets a face nearer to an edge than this share of it meets it near the edge.
const NEAR: f64 = 1e-6;

/// A ray that meets a face at a lower slope grazes it.
const SLOPE: f64 = 1e-3;

/// How the rays of wrong answers meet the mesh: at the hit that is judged, or else where that is most delicate.
fn wrong_rays<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> Result<WrongRays, BadRay> {
    let wrong = rays_of(run, judged, Judgement::is_wrong);
    let passages = of_all(wrong.len(), |i| run.scene.passages(wrong[i].1));
    let passages = passages.map_err(|bad| BadRay {
        index: wrong[bad.index].0,
        ..bad
    })?;
    let is_of_one = matches!(run.answers.kind(), AnswerKind::Nearest | AnswerKind::Any);
    let mut counts = WrongRays::default();
    for ((index, ray), passages) in wrong.into_iter().zip(passages) {
        let Judged { judgement, hit, .. } = &judged[index];
        let met: Vec<&[u32]> = match is_of_one || *judgement == Judgement::Lost {
            true => hit.iter().map(|hit| &hit.faces[..]).collect(),
            false => passages.iter().map(|it| &it.faces[..]).collect(),
        };
        let meetings = met.iter().map(|faces| match faces {
            [face] => meeting(&run.scene, ray, *face),
            _ => Meeting::AtEdge,
        });
        let is_in_plane = passages.iter().any(|it| it.is_segment);
        let count = match meetings.min() {
            None => &mut counts.nothing,
            Some(_) if is_in_plane => &mut counts.in_plane,
            Some(Meeting::AtEdge) => &mut counts.at_edge,
            Some(Meeting::NearEdge) => &mut counts.near_edge,
            Some(Meeting::Grazing) => &mut counts.grazing,
            Some(Meeting::Inside) => &mut counts.inside,
        };
        *count += 1;
    }
    Ok(counts)
}

/// How a ray meets a face, the most delicate first.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Meeting {
    AtEdge,
    NearEdge,
    Grazing,
    Inside,
}

/// How a ray meets the inside of a face, in floats: it decides no hit.
fn meeting<F: Scalar>(scene: &Scene<F>, ray: &Ray<F>, face: u32) -> Meeting {
    let Some(triangle) = scene.triangle(face) else {
        return Meeting::Inside;
    };
    let [a, b, c] = triangle.map(DVec3::from);
    let origin = DVec3::from(ray.origin.map(F::to_f64));
    let direction = DVec3::from(ray.direction.map(F::to_f64)).normalize_or_zero();
    let [e, f, s] = [b - a, c - a, origin - a];
    let normal = e.cross(f);
    let determinant = direction.dot(normal);
    // Weights of b and c as Möller and Trumbore have them.
    let v = s.cross(direction).dot(e) / determinant;
    let u = direction.cross(s).dot(f) / determinant;
    let least = u.min(v).min(1.0 - u - v).abs();
    match (least <= NEAR, determinant.abs() < SLOPE * normal.length()) {
        (true, _) => Meeting::NearEdge,
        (false, true) => Meeting::Grazing,
        (false, false) => Meeting::Inside,
    }
}

/// How many wrong answers have a t outside of the ray's interval.
fn outside_interval<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> u64 {
    let is_outside = |ray: &Ray<F>, face: u32, t: f64| {
        let hair = run.scene.hair(ray, face);
        t < ray.t_min.to_f64() - hair || ray.t_max.to_f64() + hair < t
    };
    let wrong = rays_of(run, judged, Judgement::is_wrong);
    let outside = wrong.into_iter().filter(|(index, ray)| match &run.answers {
        Answers::Nearest(all) => {
            let Answer { face, t } = all[*index];
            face.zip(t)
                .is_some_and(|(face, t)| is_outside(ray, face, t))
        }
        Answers::All(all) => all[*index]
            .iter()
            .any(|hit| hit.t.is_some_and(|t| is_outside(ray, hit.face, t))),
        _ => false,
    });
    outside.count() as u64
}

/// How many points are taken to be outside where the surface winds around them twice, or another even number of times.
fn wound_evenly<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> Result<u64, BadRay> {
    let (Asked::Points(points), Answers::Inside(named)) = (&run.asked, &run.answers) else {
        return Ok(0);
    };
    let is_wound_evenly = |index: usize| {
        if !judged[index].judgement.is_wrong() || named[index] != NamedPlace::Outside {
            return Ok(false);
        }
        let location = run.scene.locate(points[index])?;
        Ok(matches!(location, Location::Off(Winding::Number(n)) if n % 2 == 0))
    };
    let all = of_all(judged.len(), is_wound_evenly)?;
    Ok(all.into_iter().filter(|is| *is).count() as u64)
}

/// The most faces that are asked about to see what a program loses without boxes, of all rays together.
const ASKED: usize = 30_000_000;

/// The rays that a plain program with boxes loses, traced again without boxes.
fn without_boxes<F: Scalar>(
    run: &JudgedRun<F>,
    judged: &[Judged],
) -> Result<Option<WithoutBoxes>, BadRay>
where
    Case<F>: Into<AnyCase>,
{
    let Some(program) = run
        .program
        .as_ref()
        .filter(|program| program.box_test.is_some())
    else {
        return Ok(None);
    };
    let lost = rays_of(run, judged, |it| is_of_a_lost_hit(run, it));
    let most = ASKED / run.mesh.triangles.len().max(1);
    let step = lost.len().div_ceil(most.max(1)).max(1);
    let rays: Vec<Ray<F>> = lost.iter().step_by(step).map(|(_, ray)| **ray).collect();
    let plain = PlainProgram {
        kernel: program.kernel.clone(),
        box_test: None,
    };
    let Ok(answers) = plain::answered(&plain, run.mesh, &rays) else {
        return Ok(None);
    };
    let judged = Asked::Rays(rays).judged(&run.scene, &answers)?;
    let lost = judged
        .iter()
        .filter(|it| is_of_a_lost_hit(run, it.judgement));
    Ok(Some(WithoutBoxes {
        tried: judged.len() as u64,
        lost: lost.count() as u64,
    }))
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

/// True if the exact hit is missed, or another face is named in its place. Which hits a count leaves out is not known.
fn is_of_a_lost_hit<F: Scalar>(run: &JudgedRun<F>, judgement: Judgement) -> bool {
    match run.answers.kind() {
        AnswerKind::Nearest => matches!(
            judgement,
            Judgement::Lost | Judgement::Farther | Judgement::Ghost
        ),
        _ => judgement == Judgement::Lost,
    }
}

fn counted_as(judgement: Judgement, judged: &[Judged]) -> JudgementCount {
    let of_kind = judged.iter().filter(|it| it.judgement == judgement);
    // A silhouette that is left out is as far from what is answered as you like, and nobody sees it.
    let wrong = of_kind.clone().filter(|it| it.judgement.is_wrong());
    let mut off: Vec<f64> = wrong.filter_map(|it| it.off.map(f64::abs)).collect();
    off.sort_by(f64::total_cmp);
    JudgementCount {
        judgement,
        count: of_kind.count() as u64,
        median_off: off.get(off.len() / 2).copied(),
        most_off: off.last().copied(),
    }
}

/// The faces that a program named for a ray, and the exact ones: of the nearest hit, or of all hits.
struct FacesOfRay {
    named: Vec<u32>,
    exact: Vec<u32>,
}

impl FacesOfRay {
    /// How many named faces are exact ones if their numbers are shifted.
    fn right_after(&self, shift: i64) -> usize {
        let is_right = |face: &&u32| {
            let shifted = u32::try_from(i64::from(**face) + shift);
            shifted.is_ok_and(|face| self.exact.contains(&face))
        };
        self.named.iter().filter(is_right).count()
    }
}

/// The shift of face numbers with which most faces are right, and more than without: of a program that counts from 1, for
/// example.
fn shift<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> Result<Option<i64>, BadRay> {
    if !judged.iter().any(|it| it.judgement.is_wrong()) {
        return Ok(None);
    }
    let rays = faces_of_hits(run, judged)?;
    let right = |shift: i64| -> usize { rays.iter().map(|ray| ray.right_after(shift)).sum() };
    let named: usize = rays.iter().map(|ray| ray.named.len()).sum();
    let as_written = right(0);
    let is_most = |shift: &i64| {
        let shifted = right(*shift);
        as_written + FEWEST <= shifted && named < 2 * shifted
    };
    Ok([-1, 1].into_iter().find(is_most))
}

/// The faces of each ray that hits the mesh, if faces are named.
fn faces_of_hits<F: Scalar>(
    run: &JudgedRun<F>,
    judged: &[Judged],
) -> Result<Vec<FacesOfRay>, BadRay> {
    let rays = run.asked.rays();
    let exact: Vec<Vec<u32>> = match run.answers.kind() {
        AnswerKind::Nearest => {
            let hits = judged.iter().map(|it| it.hit.as_ref());
            hits.map(|hit| hit.map_or(Vec::new(), |hit| hit.faces.clone()))
                .collect()
        }
        AnswerKind::All => of_all(rays.len(), |i| {
            let hits = run.scene.hits(&rays[i])?;
            Ok(hits.into_iter().flat_map(|hit| hit.faces).collect())
        })?,
        AnswerKind::Any | AnswerKind::Count | AnswerKind::Inside => Vec::new(),
    };
    let all = exact
        .into_iter()
        .enumerate()
        .map(|(index, exact)| FacesOfRay {
            named: run.answers.faces(index),
            exact,
        });
    Ok(all.filter(|ray| !ray.exact.is_empty()).collect())
}

/// How many answers name a face that the mesh does not have.
fn beyond_the_mesh<F: Scalar>(run: &JudgedRun<F>) -> u64 {
    let faces = run.mesh.triangles.len();
    let all = (0..run.asked.count()).filter(|i| run.answers.beyond(*i, faces).is_some());
    all.count() as u64
}

//! Judged answers, counted and told: how many are wrong, who loses the hits, and the worst of them.

use crate::asked::{AnswerKind, Answers, Asked, BadRay, of_all};
use crate::blame::{HitOfRay, lost_hits};
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::kernel::Scalar;
use crate::plain::{self, PlainProgram};
use crate::result::{JudgementCount, RaysResult, WithoutBoxes, WrongRays, mesh_label};
use crate::run::{JudgedRun, Judgements};
use crate::told::{each, worst};
use hairline_scene::{Judged, Judgement, Ray};

/// The fewest faces by which a shift of their numbers is known.
const FEWEST: usize = 5;

/// All that is told of judged answers.
pub fn summary<F: Scalar>(judgements: &Judgements<F>) -> Result<RaysResult, BadRay>
where
    Case<F>: Into<AnyCase>,
{
    let Judgements { run, judged, .. } = judgements;
    let lost = hits_of(run, judged, is_of_a_lost_hit);
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
        shift: shift(&run.answers, judged),
        lost,
        wrong_rays: wrong_rays(run, judged)?,
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

/// How the rays of wrong answers meet the mesh: of a nearest hit there, of others anywhere.
fn wrong_rays<F: Scalar>(run: &JudgedRun<F>, judged: &[Judged]) -> Result<WrongRays, BadRay> {
    let wrong = rays_of(run, judged, Judgement::is_wrong);
    let mut counts = WrongRays::default();
    let meets_first_alone = matches!(run.answers.kind(), AnswerKind::Nearest | AnswerKind::Any);
    let passages = of_all(wrong.len(), |i| run.scene.passages(wrong[i].1));
    let passages = passages.map_err(|bad| BadRay {
        index: wrong[bad.index].0,
        ..bad
    })?;
    for mut passages in passages {
        let is_in_plane = passages.iter().any(|it| it.is_segment);
        if meets_first_alone {
            passages.truncate(1);
        }
        let is_at_edge = passages.iter().any(|it| 1 < it.faces.len());
        let count = match passages.is_empty() {
            true => &mut counts.nothing,
            false if is_in_plane => &mut counts.in_plane,
            false if is_at_edge => &mut counts.at_edge,
            false => &mut counts.inside,
        };
        *count += 1;
    }
    Ok(counts)
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
    let lost = rays_of(run, judged, is_of_a_lost_hit);
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
    let lost = judged.iter().filter(|it| is_of_a_lost_hit(it.judgement));
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
fn is_of_a_lost_hit(judgement: Judgement) -> bool {
    matches!(
        judgement,
        Judgement::Lost | Judgement::Farther | Judgement::Ghost
    )
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

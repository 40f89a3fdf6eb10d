//! The answers of a program, judged by the reading of its rays that explains most.

use crate::asked::{Answers, Asked, BadRay};
use crate::kernel::Scalar;
use crate::run::{JudgedRun, Judgements, Tally, cases_label};
use hairline_scene::{Judged, Ray};

/// Judges answers, by the rays as they are, or with directions of length 1 or another unit of t if more are right then: as a program
/// has it that makes them so, or one that multiplies t alone.
pub fn judged<F: Scalar>(run: JudgedRun<F>) -> Result<Judgements<F>, BadRay> {
    let judged = run.asked.judged(&run.scene, &run.answers)?;
    let as_written = Judgements {
        tally: Tally::of(&judged),
        has_unit_directions: false,
        has_written_t: false,
        right_as_written: None,
        cases: cases_label(&run.asked),
        judged,
        run,
    };
    match as_written.tally.wrong_t {
        0 => Ok(as_written),
        _ => with_another_t(as_written),
    }
}

/// A way in which a program may count t.
struct CountedT<F> {
    /// The rays, if they are others.
    asked: Option<Asked<F>>,
    /// The answers with t as these rays have it.
    answers: Answers,
    has_unit_directions: bool,
    has_written_t: bool,
}

/// The ways in which t may be counted, the likeliest last: as a length, and in a scene of another size as in the written one.
fn counted_ts<F: Scalar>(run: &JudgedRun<F>) -> Vec<CountedT<F>> {
    let rays = run.asked.rays();
    let units: Option<Vec<Ray<F>>> = rays.iter().map(with_unit_direction).collect();
    let lengths: Vec<f64> = rays.iter().map(length_of).collect();
    let scale = run.given.as_ref().map_or(1.0, |given| given.scale);
    let written =
        (scale != 1.0).then(|| run.answers.with_t_divided(&vec![1.0 / scale; rays.len()]));
    let mut all = Vec::new();
    for (answers, has_written_t) in [(written.as_ref(), true), (Some(&run.answers), false)] {
        let (Some(answers), Some(units)) = (answers, &units) else {
            continue;
        };
        let counted = |asked: Option<Asked<F>>, answers: Answers| CountedT {
            asked,
            answers,
            has_unit_directions: true,
            has_written_t,
        };
        all.push(counted(None, answers.with_t_divided(&lengths)));
        all.push(counted(Some(Asked::Rays(units.clone())), answers.clone()));
    }
    all.extend(written.map(|answers| CountedT {
        asked: None,
        answers,
        has_unit_directions: false,
        has_written_t: true,
    }));
    all
}

/// The same with t counted otherwise, if that explains more.
fn with_another_t<F: Scalar>(as_written: Judgements<F>) -> Result<Judgements<F>, BadRay> {
    let Judgements { run, tally, .. } = &as_written;
    let mut best: Option<(CountedT<F>, Vec<Judged>, Tally)> = None;
    for counted in counted_ts(run) {
        let asked = counted.asked.as_ref().unwrap_or(&run.asked);
        let judged = asked.judged(&run.scene, &counted.answers)?;
        let tally = Tally::of(&judged);
        if best
            .as_ref()
            .is_none_or(|(_, _, best)| best.right_hits <= tally.right_hits)
        {
            best = Some((counted, judged, tally));
        }
    }
    // A program that loses rays at edges is right more often by any rays that are rounded: t has to be better too.
    let explains_more =
        |better: &Tally| tally.right_hits < better.right_hits && 2 * better.wrong_t < tally.wrong_t;
    let Some((counted, judged, better)) = best.filter(|(_, _, tally)| explains_more(tally)) else {
        return Ok(as_written);
    };
    let right_as_written = Some(tally.right);
    let Judgements { run, cases, .. } = as_written;
    Ok(Judgements {
        run: JudgedRun {
            asked: counted.asked.unwrap_or(run.asked),
            answers: counted.answers,
            ..run
        },
        judged,
        tally: better,
        has_unit_directions: counted.has_unit_directions,
        has_written_t: counted.has_written_t,
        right_as_written,
        cases,
    })
}

/// The ray of a program that makes directions of length 1 first; none if floats do not hold it.
fn with_unit_direction<F: Scalar>(ray: &Ray<F>) -> Option<Ray<F>> {
    // In the scalar, as the program does it.
    let [x, y, z] = ray.direction;
    let length = (x * x + y * y + z * z).sqrt();
    let direction = ray.direction.map(|component| component / length);
    // Its square may over- or underflow.
    let is_ray = length.is_finite() && direction.iter().all(|x| x.is_finite());
    let on = [ray.t_min, ray.t_max].map(|t| t * length);
    is_ray.then(|| Ray::new(ray.origin, direction).on(on[0], on[1]))
}

fn length_of<F: Scalar>(ray: &Ray<F>) -> f64 {
    let [x, y, z] = ray.direction.map(F::to_f64);
    x.hypot(y).hypot(z)
}

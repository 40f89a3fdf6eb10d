//! The answers of a program, judged by the reading of its rays that explains most.

use crate::asked::{Asked, BadRay};
use crate::kernel::Scalar;
use crate::run::{JudgedRun, Judgements, Tally, cases_label};
use hairline_scene::Ray;

/// Judges answers, by the rays as they are, or with directions of length 1 if more are right then: as a program has it that makes them
/// so, or one that multiplies t alone.
pub fn judged<F: Scalar>(run: JudgedRun<F>) -> Result<Judgements<F>, BadRay> {
    let judged = run.asked.judged(&run.scene, &run.answers)?;
    let as_written = Judgements {
        tally: Tally::of(&judged),
        has_unit_directions: false,
        right_as_written: None,
        cases: cases_label(&run.asked),
        judged,
        run,
    };
    match as_written.tally.wrong_t {
        0 => Ok(as_written),
        _ => with_unit_directions(as_written),
    }
}

/// The same with directions of length 1, if that explains more.
fn with_unit_directions<F: Scalar>(as_written: Judgements<F>) -> Result<Judgements<F>, BadRay> {
    let Judgements { run, tally, .. } = &as_written;
    let rays = run.asked.rays();
    let units: Option<Vec<Ray<F>>> = rays.iter().map(with_unit_direction).collect();
    let Some(units) = units else {
        return Ok(as_written);
    };
    let units = Asked::Rays(units);
    let lengths: Vec<f64> = rays.iter().map(length_of).collect();
    let divided = run.answers.with_t_divided(&lengths);
    let by_length = run.asked.judged(&run.scene, &divided)?;
    let by_units = units.judged(&run.scene, &run.answers)?;
    let tallies = [&by_length, &by_units].map(|judged| Tally::of(judged));
    let has_units = tallies[0].right_hits <= tallies[1].right_hits;
    let better = match has_units {
        true => tallies[1],
        false => tallies[0],
    };
    // A program that loses rays at edges is right more often by any rays that are rounded: t has to be better too.
    let explains_more = tally.right_hits < better.right_hits && 2 * better.wrong_t < tally.wrong_t;
    if !explains_more {
        return Ok(as_written);
    }
    let right_as_written = Some(tally.right);
    let Judgements { run, cases, .. } = as_written;
    let (run, judged) = match has_units {
        true => {
            let run = JudgedRun {
                asked: units,
                ..run
            };
            (run, by_units)
        }
        false => {
            let run = JudgedRun {
                answers: divided,
                ..run
            };
            (run, by_length)
        }
    };
    Ok(Judgements {
        run,
        judged,
        tally: better,
        has_unit_directions: true,
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

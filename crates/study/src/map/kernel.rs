//! A ray-triangle kernel on the cases of a grid.

use super::{AxisText, Grid, Map, PixelStep, RayPixel};
use crate::arith::Float;
use crate::audit::Row;
use crate::case::Case;
use crate::contract::Contract;
use crate::engine::{self, Observer};
use crate::judge::{Obligation, asked, judge, obligation};
use crate::kernel::{Scalar, Subject, Verdict, verdicts_of};
use crate::oracle::{self, Layers};
use crate::truth::{Crossing, Feature, Truth};
use hairline_core::{Error, ErrorKind};

named! {
    pub names
    /// A vector of a case.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CaseVector {
        /// Where the ray starts.
        Origin = "origin",
        /// Where it goes.
        Direction = "direction",
        /// The first vertex.
        A = "a",
        /// The second vertex.
        B = "b",
        /// The third vertex.
        C = "c",
    }
}

/// The grid of a case in which one vector is varied, in two coordinates or those that lie most in the
/// triangle's plane, so that the picture shows the triangle's boundary: all but the one in which its
/// normal, computed in `f64`, is longest (the last, where there is no normal).
pub fn grid_of_case<F: Float>(
    case: &Case<F>,
    part: CaseVector,
    coordinates: Option<[usize; 2]>,
    step: Option<PixelStep>,
    size: [usize; 2],
) -> Result<Grid<F>, Error> {
    let vectors = case.vectors();
    let [origin, _, a, b, c] = vectors;
    let extent = [origin, a, b, c]
        .as_flattened()
        .iter()
        .map(F::abs)
        .fold(F::zero(), F::larger);
    let coordinates = coordinates.unwrap_or_else(|| plane_axes(case));
    Grid::about(
        part as usize,
        &vectors[part as usize],
        coordinates,
        step,
        size,
        extent,
    )
}

/// The coordinates in order without the one in which the normal is longest.
fn plane_axes<F: Float>(case: &Case<F>) -> [usize; 2] {
    let [_, _, a, b, c] = case.widen().vectors();
    let edge = |p: [f64; 3]| glam::DVec3::from_array(p) - glam::DVec3::from_array(a);
    let normal = edge(b).cross(edge(c)).abs().to_array();
    let longest = (0..3)
        .rev()
        .fold(2, |best, i| if normal[i] > normal[best] { i } else { best });
    match longest {
        0 => [1, 2],
        1 => [0, 2],
        _ => [0, 1],
    }
}

/// Runs a row on the case of each pixel, and judges it by the row's contract. No case counts as one
/// whose ray starts at a hit point of a kernel.
pub fn of_kernel<F: Scalar>(
    case: &Case<F>,
    row: &Row,
    grid: &Grid<F>,
    observer: &dyn Observer,
) -> Result<Map, Error> {
    let name = row.entry.info.name;
    let subject = F::subject(row.entry).ok_or_else(|| {
        let line = format!("kernel '{name}' does not run in {}", F::NAME);
        Error::new(ErrorKind::Unsupported, line)
    })?;
    let epsilons = row.epsilons::<F>();
    let [width, height] = grid.size();
    let line = |&y: &usize| {
        let cases: Vec<Case<F>> = (0..width).map(|x| case_at(case, grid, [x, y])).collect();
        let pixels = pixels(&cases, row, subject, &epsilons);
        observer.advance(width as u64);
        pixels
    };
    let from_the_top: Vec<usize> = (0..height).rev().collect();
    let pixels = engine::map(&from_the_top, line).concat();
    let part = CaseVector::ALL[grid.point];
    Ok(Map {
        subject: row.label(),
        scalar: F::NAME,
        measure: row.contract.describe(),
        axes: grid.axes.map(|axis| AxisText::of(&axis, part.name())),
        pixels,
    })
}

/// The case of a pixel, counted from the left and from the bottom.
pub fn case_at<F: Float>(case: &Case<F>, grid: &Grid<F>, pixel: [usize; 2]) -> Case<F> {
    let mut vectors = case.vectors();
    vectors[grid.point] = grid.moved(vectors[grid.point], pixel);
    let [origin, direction, vertices @ ..] = vectors;
    Case::new(origin, direction, vertices).on(case.ray.t_min, case.ray.t_max)
}

fn pixels<F: Float>(
    cases: &[Case<F>],
    row: &Row,
    subject: &dyn Subject<F>,
    epsilons: &[F],
) -> Vec<RayPixel> {
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    verdicts_of(subject, cases, epsilons, &mut verdicts);
    let mut truths = Vec::with_capacity(cases.len());
    oracle::truths(cases, &mut truths, &mut Layers::default());
    let pixel = |((case, verdict), truth): ((&Case<F>, &Verdict<F>), Truth)| {
        let asked = asked(case, &truth, &row.contract, false);
        RayPixel {
            hit: verdict.failure.is_none().then_some(verdict.hit),
            truth,
            asked,
            on_boundary: is_on_boundary(&truth, asked, &row.contract),
            finding: judge(
                (&row.contract, asked),
                (case, &truth),
                row.entry.info.gives,
                verdict,
            ),
        }
    };
    cases.iter().zip(&verdicts).zip(truths).map(pixel).collect()
}

/// True if the ray crosses the boundary where it would have to hit the inside.
fn is_on_boundary(truth: &Truth, asked: Obligation, contract: &Contract) -> bool {
    let Some(crossing) = truth.crossing() else {
        return false;
    };
    if !(crossing.feature.is_edge() || crossing.feature.is_vertex()) {
        return false;
    }
    let inside = Truth::Transversal(Crossing {
        feature: Feature::Interior,
        ..*crossing
    });
    // Within a band nothing is asked, on the boundary or not.
    let freed = asked != obligation(truth, contract, false);
    !freed && obligation(&inside, contract, false) == Obligation::MustHit
}

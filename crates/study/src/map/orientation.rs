//! An orientation predicate on the points of a grid.

use super::{AxisText, Grid, Map, MapError, Pixels, SignPixel, Step};
use crate::arith::Float;
use crate::engine::Observer;
use crate::orientation::{Points, Row, Scalar, ScaledPoints, judge};
use rayon::prelude::*;

/// The names of points.
pub const POINT_NAMES: [&str; 4] = ["a", "b", "c", "d"];

/// The grid of points of which one is varied, in two coordinates or the first two.
pub fn grid_of_points<F: Float>(
    points: &Points<F>,
    point: usize,
    coordinates: Option<[usize; 2]>,
    step: Option<Step>,
    size: [usize; 2],
) -> Result<Grid<F>, MapError> {
    let larger = |m: F, x: F| if m < x { x } else { m };
    let extent = points.iter().flatten().map(F::abs).fold(F::zero(), larger);
    let count = points.iter().count();
    let values = points
        .iter()
        .nth(point)
        .ok_or_else(|| MapError(format!("there are {count} points, counted from 0")))?;
    Grid::about(point, values, coordinates.unwrap_or([0, 1]), step, size, extent)
}

/// Runs a row on the points of each pixel, beside the exact sign.
pub fn of_predicate<F: Scalar>(
    points: &Points<F>,
    row: &Row,
    grid: &Grid<F>,
    observer: &dyn Observer,
) -> Result<Map, MapError> {
    if !row.runs::<F>(points.dimension()) {
        let (name, dimension) = (row.predicate.name, points.dimension().number());
        let message = format!(
            "predicate '{name}' does not run in {} on points of {dimension} coordinates",
            F::NAME
        );
        return Err(MapError(message));
    }
    let [width, height] = grid.size();
    let pixel = |index: usize| {
        observer.advance(1);
        let (x, y) = (index % width, height - 1 - index / width);
        let points = points_at(points, grid, [x, y]);
        let exact = ScaledPoints::new(&points).map(|points| points.determinant().sign());
        let (_, answer) = row.answer(&points)?;
        Some(SignPixel { answer, exact, finding: exact.and_then(|exact| judge(answer, exact)) })
    };
    let pixels: Option<Vec<SignPixel>> = (0..width * height).into_par_iter().map(pixel).collect();
    Ok(Map {
        subject: row.label(),
        scalar: F::NAME,
        measure: "the sign of the exact determinant".to_owned(),
        axes: grid.axes.map(|axis| AxisText::of(&axis, POINT_NAMES[grid.point])),
        pixels: Pixels::Signs(pixels.expect("the row runs on these points")),
    })
}

/// The points of a pixel, counted from the left and from the bottom.
pub fn points_at<F: Float>(points: &Points<F>, grid: &Grid<F>, pixel: [usize; 2]) -> Points<F> {
    points.with_moved(grid.point, |point| grid.moved(point, pixel))
}

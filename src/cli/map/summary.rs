//! A map in words: counts, and for each kind of finding a case to look at.

use crate::arith::{Exact, Float};
use crate::audit::{Row, exact_severity, quoted};
use crate::case::Case;
use crate::corpus::lines::{StoredCase, write_case};
use crate::kernel::Scalar;
use crate::map::{Grid, Ink, Map};
use crate::oracle;
use std::fmt::Write;

/// Counts of both sides, the axes, and the pixel nearest to the middle of each kind of finding with a
/// command that shows it (`again`, by the pixel's place from the left and from the bottom).
pub fn of_map<F: Float>(map: &Map, grid: &Grid<F>, again: &dyn Fn([usize; 2]) -> String) -> String {
    let [width, height] = map.size();
    let mut out = format!(
        "{} in {}: {width} x {height} pixels, {} wrong\n    what is right: {}\n",
        map.subject,
        map.scalar,
        map.wrong(),
        map.measure
    );
    for (way, axis) in ["to the right", "upwards"].into_iter().zip(&map.axes) {
        let _ = writeln!(
            out,
            "    {way}: {} in steps of {} about {} (bits {})",
            axis.name,
            axis.step.describe(),
            axis.centre,
            axis.bits
        );
    }
    for (side, legend) in [
        ("computed", map.computed_legend()),
        ("exact", map.exact_legend()),
    ] {
        let _ = writeln!(out, "{side}");
        for (ink, words, count) in legend {
            let _ = writeln!(out, "    {count:>8}  {words}");
            if let (true, Some(pixel)) = (side == "computed" && is_wrong(ink), nearest(map, ink)) {
                let [x, y] = [0, 1].map(|i| grid.axes[i].offset(pixel[i]));
                let _ = writeln!(
                    out,
                    "              nearest, {x:+},{y:+} steps off: {}",
                    again(pixel)
                );
            }
        }
    }
    out
}

fn is_wrong(ink: Ink) -> bool {
    matches!(ink, Ink::FalseYes | Ink::FalseNo | Ink::Bad | Ink::Failed)
}

/// The pixel of an ink on the computed side that is nearest to the middle, from the left and from the
/// bottom; the first of equals.
fn nearest(map: &Map, ink: Ink) -> Option<[usize; 2]> {
    let [width, height] = map.size();
    let place = |pixel: usize| [pixel % width, height - 1 - pixel / width];
    let distance = |pixel: &usize| {
        let [x, y] = place(*pixel);
        x.abs_diff(width / 2).pow(2) + y.abs_diff(height / 2).pow(2)
    };
    let pixels = (0..width * height).filter(|pixel| map.computed(*pixel) == ink);
    pixels.min_by_key(distance).map(place)
}

/// The command that shows a case with a row.
pub fn explain<F: Scalar>(case: &Case<F>, row: &Row) -> String {
    let stored = StoredCase::of(*case);
    row.explain_command(&quoted(&write_case(&stored)))
}

/// A drawing in words, and the command that says all about its case.
pub fn of_drawing<F: Scalar>(case: &Case<F>, row: &Row) -> String {
    let definition = oracle::define(case);
    let mut out = format!(
        "{} in {}\n    truth {}",
        row.label(),
        F::NAME,
        definition.truth
    );
    if let Some(t) = &definition.exact.t {
        let _ = write!(out, ", t = {}", Exact::from_rational(t).approximate());
    }
    out.push('\n');
    if let Some(severity) = exact_severity(case, row.contract.extent) {
        let _ = writeln!(
            out,
            "    the line passes {:.3e} of the longest edge ({:.3e} ulps) from the boundary",
            severity.in_space,
            severity.in_space * severity.edge_in_ulps
        );
    }
    let _ = writeln!(out, "    {}", explain(case, row));
    out
}

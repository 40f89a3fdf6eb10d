//! Which of the triangles around an edge or a vertex a ray hits that meets it exactly, so that it hits exactly one of them.
//!
//! The ray counts as moved by less than any number, always in the same direction. With W the number of the edge from p to q,
//! a move of the origin along axis i changes W by component i of (q-p)×d. The ray is moved by ε along the axis after the
//! one on which d is largest, and by ε² along the next. A number that is 0 takes the sign of the first change that is not
//! 0. Both are 0 only if the edge is parallel to d, and then the triangle has no area as seen along d. The move does not
//! depend on the triangle, and a ray that is off all edges meets exactly one of the triangles around them.
//! `include/hairline_exact.h` has the same rule.

use super::integer::{ExactInteger, Integer, align, minus};
use crate::arith::Vector;
use crate::case::Case;
use crate::truth::{Crossing, Facing, Feature};
use num_bigint::BigInt;
use std::cmp::Ordering;

/// True if the ray's line, moved by less than any number, passes through the inside of the triangle. `crossing` is the truth
/// of the case. The interval is not looked at.
pub fn is_met_once(case: &Case<f64>, crossing: &Crossing) -> bool {
    let [_, d, a, b, c] = case.vectors();
    let edges = [[b, c], [c, a], [a, b]];
    let touched: &[usize] = match crossing.feature {
        Feature::Interior => &[],
        Feature::Outside => return false,
        Feature::EdgeBc => &[0],
        Feature::EdgeCa => &[1],
        Feature::EdgeAb => &[2],
        Feature::VertexA => &[1, 2],
        Feature::VertexB => &[0, 2],
        Feature::VertexC => &[0, 1],
    };
    let needed = match crossing.facing {
        Facing::Front => Ordering::Greater,
        Facing::Back => Ordering::Less,
    };
    let largest = case.ray.direction.largest_axis();
    touched
        .iter()
        .all(|edge| moved(edges[*edge], d, largest) == needed)
}

/// The sign of an edge's number next to the ray.
fn moved([from, to]: [[f64; 3]; 2], d: [f64; 3], largest: usize) -> Ordering {
    let ([from, to], _) = align([from, to]);
    let ([d], _) = align([d]);
    let edge = minus(&to, &from);
    let along = |axis: usize| {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        ExactInteger::sign(&BigInt::minor(&edge[j], &d[k], &edge[k], &d[j]))
    };
    along((largest + 1) % 3).then_with(|| along((largest + 2) % 3))
}

//! `polygon`: exactly planar convex lattice polygons, as the fan of their first vertex. The truth is
//! that of the union of the fan's triangles; `convex-polygon` tests the polygon as a whole.

use super::integer::{
    IntegerCase, LatticePoint, cross, dot, independent, minus, plus, times, transversal,
};
use super::{Grouping, Made, Recipe};
use crate::case::Draw;
use crate::kernel::Scalar;
use crate::truth::Truth;

pub(super) struct Polygon;

/// A strictly convex octagon, counter-clockwise; any of its vertices in turn are convex too.
const OCTAGON: [[i64; 2]; 8] =
    [[6, 2], [4, 5], [1, 6], [-3, 5], [-6, 1], [-5, -3], [-1, -6], [4, -4]];

impl Recipe for Polygon {
    const NAME: &'static str = "polygon";
    const PROMISE: &'static str =
        "a planar convex polygon of 4 to 8 vertices in its fan's triangles, all transversal";
    const GROUPING: Grouping = Grouping::Polygon;

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let corners = draw.integer(4, 8) as usize;
        let skip = draw.below(8);
        let outline: Vec<[i64; 2]> = (0..corners).map(|i| OCTAGON[(skip + i) % 8]).collect();
        let base = draw.lattice_point(16);
        let x = draw.lattice_point(2);
        let x = if x == [0; 3] { [1, 0, 0] } else { x };
        let y = independent(draw, x, 2);
        let at = |[i, j]: [i64; 2]| plus(base, plus(times(x, i), times(y, j)));
        let vertices: Vec<LatticePoint> = outline.iter().map(|corner| at(*corner)).collect();
        let (first, second) = (draw.pick(&vertices), draw.pick(&vertices));
        // The middle of two vertices (doubled), a vertex, or a lattice point of the plane.
        let target = match draw.below(3) {
            0 => plus(first, second),
            1 => times(first, 2),
            _ => times(at([draw.integer(-7, 7), draw.integer(-7, 7)]), 2),
        };
        let n = cross(x, y);
        let direction = transversal(draw, n, 4);
        debug_assert_ne!(dot(direction, n), 0);
        let origin = minus(target, times(direction, draw.integer(1, 4)));
        let corner = |i: usize| times(vertices[i], 2);
        let case = |i: usize| {
            let triangle = [corner(0), corner(i), corner(i + 1)];
            IntegerCase { origin, direction, triangle }.case()
        };
        Made::Group((1..corners - 1).map(case).collect())
    }

    fn keeps(truths: &[Truth]) -> bool {
        let facing = |truth: &Truth| truth.crossing().map(|crossing| crossing.facing);
        (2..=6).contains(&truths.len())
            && facing(&truths[0]).is_some()
            && truths.iter().all(|truth| facing(truth) == facing(&truths[0]))
    }
}

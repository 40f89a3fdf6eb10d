//! `polygon`: exactly planar convex lattice polygons, as the fan of their first vertex. The truth is
//! that of the union of the fan's triangles; `convex-polygon` tests the polygon as a whole.

use super::integer::{IntegerCase, LatticePoint, independent, lattice_point, transversal};
use super::neighbours::face_alike;
use super::{CaseGroup, Grouping, Promise, Recipe};
use crate::case::Draw;
use crate::kernel::Scalar;

pub(super) struct Polygon;

/// A strictly convex octagon, counter-clockwise; any of its vertices in turn are convex too.
const OCTAGON: [[i64; 2]; 8] = [
    [6, 2],
    [4, 5],
    [1, 6],
    [-3, 5],
    [-6, 1],
    [-5, -3],
    [-1, -6],
    [4, -4],
];

impl Recipe for Polygon {
    const NAME: &'static str = "polygon";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "a planar convex polygon of 4 to 8 vertices in its fan's triangles, all transversal";
    const GROUPING: Grouping = Grouping::Polygon;
    const KEEPS: Promise =
        Promise::Together(|truths| (2..=6).contains(&truths.len()) && face_alike(truths));

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let corners = draw.integer(4, 8) as usize;
        let skip = draw.below(8);
        let outline: Vec<[i64; 2]> = (0..corners).map(|i| OCTAGON[(skip + i) % 8]).collect();
        let base = lattice_point(draw, 16);
        let x = lattice_point(draw, 2);
        let x = if x == LatticePoint::ZERO {
            LatticePoint::X
        } else {
            x
        };
        let y = independent(draw, x, 2);
        let at = |[i, j]: [i64; 2]| base + x * i + y * j;
        let vertices: Vec<LatticePoint> = outline.iter().map(|corner| at(*corner)).collect();
        let (first, second) = (draw.pick(&vertices), draw.pick(&vertices));
        // The middle of two vertices (doubled), a vertex, or a lattice point of the plane.
        let target = match draw.below(3) {
            0 => first + second,
            1 => first * 2,
            _ => at([draw.integer(-7, 7), draw.integer(-7, 7)]) * 2,
        };
        let n = x.cross(y);
        let direction = transversal(draw, n, 4);
        let origin = target - direction * draw.integer(1, 4);
        let corner = |i: usize| vertices[i] * 2;
        let case = |i: usize| {
            let triangle = [corner(0), corner(i), corner(i + 1)];
            IntegerCase {
                origin,
                direction,
                triangle,
            }
            .case()
        };
        CaseGroup::Group((1..corners - 1).map(case).collect())
    }
}

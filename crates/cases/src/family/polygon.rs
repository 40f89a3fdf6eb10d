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
        let corner_count = draw.integer(4, 8) as usize;
        let first_corner = draw.below(OCTAGON.len());
        let base = lattice_point(draw, 16);
        let mut x = lattice_point(draw, 2);
        if x == LatticePoint::ZERO {
            x = LatticePoint::X;
        }
        let y = independent(draw, x, 2);
        let mut vertices = Vec::with_capacity(corner_count);
        for k in 0..corner_count {
            let [i, j] = OCTAGON[(first_corner + k) % OCTAGON.len()];
            vertices.push(base + x * i + y * j);
        }
        let one = draw.pick(&vertices);
        let other = draw.pick(&vertices);
        // The polygon is doubled, so that the middle of two vertices is a lattice point. The ray is at that, at a vertex, or
        // at any lattice point of the plane.
        let target = match draw.below(3) {
            0 => one + other,
            1 => one * 2,
            _ => {
                let i = draw.integer(-7, 7);
                let j = draw.integer(-7, 7);
                (base + x * i + y * j) * 2
            }
        };
        let direction = transversal(draw, x.cross(y), 4);
        let origin = target - direction * draw.integer(1, 4);
        let mut cases = Vec::with_capacity(corner_count - 2);
        for pair in vertices[1..].windows(2) {
            let triangle = [vertices[0], pair[0], pair[1]];
            let case = IntegerCase {
                origin,
                direction,
                triangle: triangle.map(|vertex| vertex * 2),
            };
            cases.push(case.case());
        }
        CaseGroup::Group(cases)
    }
}

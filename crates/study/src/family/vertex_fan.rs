//! `vertex-fan`: a closed fan around a vertex of any coordinates, and a line through that vertex.
//!
//! A spoke is an edge of two triangles, and a line through the vertex meets it: the edge's value is 0 without rounding, and
//! of either sign with it. A kernel that computes the value of each spoke by itself finds it of one sign in all triangles
//! of some fans, and reports none of them. On lattice points, as of `fan`, it finds 0.

use super::control::is_steep;
use super::exact_ray::exact_ray;
use super::integer::turned;
use super::neighbours::{face_alike, meets_line};
use super::scene::{HEXAGON, RayAxes, any_direction, rounded, wide};
use super::{Grouping, Kept, Made, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;

pub(super) struct VertexFan;

impl Recipe for VertexFan {
    const NAME: &'static str = "vertex-fan";
    const PROMISE: &'static str = "a closed fan of three to six triangles, all transversal and facing alike, the line \
                                   through its vertex where floats allow it";
    const GROUPING: Grouping = Grouping::Fan;
    const KEEPS: Kept =
        Kept::Together(|truths| face_alike(truths) && truths.iter().any(meets_line));

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        loop {
            let centre = draw.point::<F>();
            let away = any_direction(draw) * (0.5 + draw.unit());
            let (origin, direction) = exact_ray([centre; 2], away.to_array());
            let ring = ring(draw, centre);
            let triangle = |i: usize| [centre, ring[i], ring[(i + 1) % ring.len()]];
            let triangles: Vec<[[F; 3]; 3]> = (0..ring.len()).map(triangle).collect();
            if !is_one_sheet(direction, &triangles) {
                continue;
            }
            // The centre may be any corner: kernels do not treat a, b and c alike.
            let case = |corners| Case::new(origin, direction, turned(draw, corners));
            return Made::Group(triangles.into_iter().map(case).collect());
        }
    }
}

/// The other ends of three to six spokes, around an axis of any direction, and at some height over its plane.
fn ring<F: Float>(draw: &mut Draw, centre: [F; 3]) -> Vec<[F; 3]> {
    let frame = RayAxes::draw(draw);
    let mut ring = Vec::with_capacity(HEXAGON.len());
    for (i, [x, y]) in HEXAGON.into_iter().enumerate() {
        if i % 2 == 0 || draw.coin() {
            let (length, height) = (0.25 + 0.75 * draw.unit(), 0.4 * draw.unit() - 0.2);
            let spoke = frame.flat(x, y) * length + frame.normal * height;
            ring.push(rounded(wide(centre) + spoke));
        }
    }
    ring
}

/// True if a direction is steep to all triangles, and crosses all of them from the same side.
fn is_one_sheet<F: Float>(direction: [F; 3], triangles: &[[[F; 3]; 3]]) -> bool {
    let is_front = |[a, b, c]: &[[F; 3]; 3]| {
        let normal = (wide(*b) - wide(*a)).cross(wide(*c) - wide(*a));
        0.0 < normal.dot(wide(direction))
    };
    let first = is_front(&triangles[0]);
    triangles
        .iter()
        .all(|it| is_steep(direction, *it) && is_front(it) == first)
}

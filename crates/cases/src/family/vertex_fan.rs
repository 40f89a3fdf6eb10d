//! `vertex-fan`: a closed fan around a vertex of any coordinates, and a line through that vertex.
//!
//! A spoke is an edge of two triangles, and a line through the vertex meets it: the edge's value is 0 without rounding, and
//! of either sign with it. A kernel that computes the value of each spoke by itself finds it of one sign in all triangles
//! of some fans, and reports none of them. On the lattice points of `fan` it finds 0.

use super::control::is_steep;
use super::exact_ray::exact_ray;
use super::neighbours::{face_alike, meets_line, turned_cases};
use super::scene::{Corners, HEXAGON, RayAxes, any_direction, rounded, wide};
use super::{CaseGroup, Grouping, Promise, Recipe};
use crate::arith::Float;
use crate::case::Draw;
use crate::kernel::Scalar;

pub(super) struct VertexFan;

impl Recipe for VertexFan {
    const NAME: &'static str = "vertex-fan";
    const PROMISE: &'static str = "a closed fan of three to six triangles, all transversal and facing alike, the line \
                                   through its vertex where floats allow it";
    const GROUPING: Grouping = Grouping::Fan;
    const KEEPS: Promise =
        Promise::Together(|truths| face_alike(truths) && truths.iter().any(meets_line));

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        loop {
            let centre = draw.point::<F>();
            let way = any_direction(draw);
            let distance = 0.5 + draw.unit();
            let away = (way * distance).to_array();
            let (origin, direction) = exact_ray([centre; 2], away);
            let rim = rim(draw, centre);
            let triangles = fan(centre, &rim);
            if is_one_sheet(direction, &triangles) {
                return CaseGroup::Group(turned_cases(draw, origin, direction, &triangles));
            }
        }
    }
}

/// The other ends of three to six spokes, around an axis of any direction, and at some height over its plane.
fn rim<F: Float>(draw: &mut Draw, centre: [F; 3]) -> Vec<[F; 3]> {
    let frame = RayAxes::draw(draw);
    let mut rim = Vec::with_capacity(HEXAGON.len());
    for (i, [x, y]) in HEXAGON.into_iter().enumerate() {
        if i % 2 == 0 || draw.coin() {
            let length = 0.25 + 0.75 * draw.unit();
            let height = 0.4 * draw.unit() - 0.2;
            let spoke = frame.flat(x, y) * length + frame.normal * height;
            rim.push(rounded(wide(centre) + spoke));
        }
    }
    rim
}

/// The triangles from a centre to each edge of a closed rim.
fn fan<F: Float>(centre: [F; 3], rim: &[[F; 3]]) -> Vec<Corners<F>> {
    let mut triangles = Vec::with_capacity(rim.len());
    for (i, corner) in rim.iter().enumerate() {
        let next = (i + 1) % rim.len();
        triangles.push([centre, *corner, rim[next]]);
    }
    triangles
}

/// True if a direction is steep to all triangles, and crosses all of them from the same side.
fn is_one_sheet<F: Float>(direction: [F; 3], triangles: &[Corners<F>]) -> bool {
    let mut fronts = 0;
    for triangle in triangles {
        if !is_steep(direction, *triangle) {
            return false;
        }
        if is_front(direction, *triangle) {
            fronts += 1;
        }
    }
    fronts == 0 || fronts == triangles.len()
}

/// True if a direction points to the side of a triangle to which its normal points.
fn is_front<F: Float>(direction: [F; 3], triangle: Corners<F>) -> bool {
    let [a, b, c] = triangle.map(wide);
    let normal = (b - a).cross(c - a);
    0.0 < normal.dot(wide(direction))
}

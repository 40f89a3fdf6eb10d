//! `shared-edge`, `fan`: two triangles on one edge, and a closed fan around a vertex.

use super::boundary::{nudged, nudged_ray};
use super::control::{combination, is_steep, well_shaped};
use super::integer::{
    IntegerCase, LatticePoint, float, lattice_point, normal, triangle_with_edge_point, turned,
};
use super::{CaseGroup, Corners, Grouping, Promise, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::{Feature, Truth};

pub(super) struct SharedEdgeFamily;
pub(super) struct Fan;

impl Recipe for SharedEdgeFamily {
    const NAME: &'static str = "shared-edge";
    const VERSION: u32 = 3;
    const PROMISE: &'static str =
        "two triangles on one edge, both transversal: crossings and folds, exact and near";
    const GROUPING: Grouping = Grouping::SharedEdge;
    const KEEPS: Promise = Promise::Together(are_two_crossings);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        CaseGroup::Group(if draw.coin() {
            exact_pair(draw)
        } else {
            near_pair(draw)
        })
    }
}

/// On the lattice, exactly through a point of the edge.
fn exact_pair<F: Float>(draw: &mut Draw) -> Vec<Case<F>> {
    let reach = draw.pick(&[32, 2048]);
    loop {
        let ([a, b, c], target) = triangle_with_edge_point(draw, reach);
        let other = a + lattice_point(draw, reach / 4);
        let direction = lattice_point(draw, reach / 8);
        let first = [a, b, c];
        let second = [b, a, other];
        if direction.dot(normal(first)) == 0 || direction.dot(normal(second)) == 0 {
            continue;
        }
        let origin = target - direction * draw.integer(1, 4);
        let mut case = |triangle: [LatticePoint; 3]| {
            IntegerCase {
                origin,
                direction,
                triangle: turned(draw, triangle),
            }
            .case()
        };
        return [first, second].map(&mut case).into();
    }
}

/// At the float nearest to a point of the edge, nudged.
fn near_pair<F: Float>(draw: &mut Draw) -> Vec<Case<F>> {
    loop {
        let [a, b, c] = well_shaped::<F>(draw);
        let second = [b, a, draw.point()];
        let s = 0.0625 + 0.875 * draw.unit();
        let target = combination([a, b, c], [s, 1.0 - s, 0.0].map(F::from_f64));
        let (origin, direction) = nudged_ray(draw, target);
        if is_steep(direction, [a, b, c]) && is_steep(direction, second) {
            return turned_cases(draw, origin, direction, &[[a, b, c], second]);
        }
    }
}

/// Directions around the axis, counter-clockwise; consecutive ones of any choice that leaves out no
/// two neighbours are less than half a turn apart.
const RING: [[i64; 2]; 8] = [
    [2, 0],
    [2, 2],
    [0, 2],
    [-2, 2],
    [-2, 0],
    [-2, -2],
    [0, -2],
    [2, -2],
];

impl Recipe for Fan {
    const NAME: &'static str = "fan";
    const VERSION: u32 = 3;
    const PROMISE: &'static str =
        "a closed fan around a vertex, all transversal and facing alike, the line in its inside";
    const GROUPING: Grouping = Grouping::Fan;
    const KEEPS: Promise =
        Promise::Together(|truths| face_alike(truths) && truths.iter().any(meets_line));

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let size = draw.pick(&[4, 64]);
        let center = lattice_point(draw, 8 * size);
        let mut ring: Vec<LatticePoint> = Vec::with_capacity(8);
        for (i, [x, y]) in RING.into_iter().enumerate() {
            if i % 2 == 0 || draw.coin() {
                let stretch = size * draw.integer(1, 2);
                // Heights are small enough that every triangle faces up.
                let height = draw.integer(-size / 4, size / 4);
                ring.push(center + LatticePoint::new(x * stretch, y * stretch, height));
            }
        }
        // Steeper than any triangle: down, with a small sideways part.
        let depth = 8 * size;
        let [x, y] = [(); 2].map(|()| draw.integer(-size / 4, size / 4));
        let down = LatticePoint::new(x, y, -depth);
        let direction = if draw.coin() { down } else { -down };
        let spoke = draw.pick(&ring);
        // The centre, a point of a spoke (half way, a lattice point of the doubled fan), or near them.
        let target = if draw.coin() {
            center * 2
        } else {
            center + spoke
        };
        let origin = target - direction * 2;
        let nudge = draw.pick(&[0, 1, 4, 16]);
        let origin = nudged(draw, float::<F>(origin), nudge);
        let case = |i: usize| {
            let (from, to) = (ring[i], ring[(i + 1) % ring.len()]);
            // The centre may be any corner: kernels do not treat a, b and c alike.
            let corners = turned(draw, [center, from, to]);
            Case::new(origin, float(direction), corners.map(|p| float(p * 2)))
        };
        CaseGroup::Group((0..ring.len()).map(case).collect())
    }
}

/// The cases of one ray and several triangles. The first corner of each triangle is drawn, because kernels do not
/// treat a, b and c alike.
pub(super) fn turned_cases<F: Float>(
    draw: &mut Draw,
    origin: [F; 3],
    direction: [F; 3],
    triangles: &[Corners<F>],
) -> Vec<Case<F>> {
    let mut cases = Vec::with_capacity(triangles.len());
    for triangle in triangles {
        let corners = turned(draw, *triangle);
        cases.push(Case::new(origin, direction, corners));
    }
    cases
}

/// True if a line crosses the planes of both triangles of a pair.
pub(super) fn are_two_crossings(truths: &[Truth]) -> bool {
    truths.len() == 2 && truths.iter().all(|truth| truth.crossing().is_some())
}

/// True if the line of a case crosses its closed triangle.
pub(super) fn meets_line(truth: &Truth) -> bool {
    truth
        .crossing()
        .is_some_and(|crossing| crossing.feature != Feature::Outside)
}

/// True if a line crosses all triangles from the same side.
pub(super) fn face_alike(truths: &[Truth]) -> bool {
    let facing = |truth: &Truth| truth.crossing().map(|crossing| crossing.facing);
    let first = facing(&truths[0]);
    first.is_some() && truths.iter().all(|truth| facing(truth) == first)
}

//! `shared-edge`, `fan`: two triangles on one edge, and a closed fan around a vertex.

use super::boundary::{nudged, nudged_ray};
use super::control::{combination, is_steep, well_shaped};
use super::integer::{
    LatticePoint, float, lattice_point, normal, triangle_with_edge_point, turned,
};
use super::scene::either_sign;
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
        let cases = if draw.coin() {
            exact_pair(draw)
        } else {
            near_pair(draw)
        };
        CaseGroup::Group(cases)
    }
}

/// Two triangles on the lattice, and a ray exactly through a point of their edge.
fn exact_pair<F: Float>(draw: &mut Draw) -> Vec<Case<F>> {
    let reach = draw.pick(&[32, 2048]);
    loop {
        let ([a, b, c], target) = triangle_with_edge_point(draw, reach);
        let other = a + lattice_point(draw, reach / 4);
        let direction = lattice_point(draw, reach / 8);
        let triangles = [[a, b, c], [b, a, other]];
        let is_parallel = |triangle: &[LatticePoint; 3]| direction.dot(normal(*triangle)) == 0;
        if triangles.iter().any(is_parallel) {
            continue;
        }
        let origin = target - direction * draw.integer(1, 4);
        let corners = triangles.map(|triangle| triangle.map(float));
        return turned_cases(draw, float(origin), float(direction), &corners);
    }
}

/// Two triangles, and a ray at the float nearest to a point of their edge, nudged.
fn near_pair<F: Float>(draw: &mut Draw) -> Vec<Case<F>> {
    loop {
        let first = well_shaped::<F>(draw);
        let [a, b, _] = first;
        let second = [b, a, draw.point()];
        let s = 0.0625 + 0.875 * draw.unit();
        let weights = [s, 1.0 - s, 0.0].map(F::from_f64);
        let target = combination(first, weights);
        let (origin, direction) = nudged_ray(draw, target);
        if is_steep(direction, first) && is_steep(direction, second) {
            return turned_cases(draw, origin, direction, &[first, second]);
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
        let ring = ring_around(draw, center, size);
        // Steeper than any triangle: down, with a small sideways part.
        let depth = 8 * size;
        let [x, y] = [(); 2].map(|()| draw.integer(-size / 4, size / 4));
        let direction = either_sign(draw, LatticePoint::new(x, y, -depth));
        let end_of_spoke = draw.pick(&ring);
        // The fan is doubled, so that the middle of a spoke is a lattice point. The ray is at that or at the centre.
        let target = if draw.coin() {
            center * 2
        } else {
            center + end_of_spoke
        };
        let exact_origin = target - direction * 2;
        let ulps = draw.pick(&[0, 1, 4, 16]);
        let origin = nudged(draw, float::<F>(exact_origin), ulps);
        let mut triangles = Vec::with_capacity(ring.len());
        for (i, from) in ring.iter().enumerate() {
            let to = ring[(i + 1) % ring.len()];
            triangles.push([center, *from, to].map(|corner| float(corner * 2)));
        }
        CaseGroup::Group(turned_cases(draw, origin, float(direction), &triangles))
    }
}

/// The ends of four to eight spokes, so little above or below the centre that all triangles between them face up.
fn ring_around(draw: &mut Draw, center: LatticePoint, size: i64) -> Vec<LatticePoint> {
    let mut ring = Vec::with_capacity(RING.len());
    for (i, [x, y]) in RING.into_iter().enumerate() {
        if i % 2 == 0 || draw.coin() {
            let stretch = size * draw.integer(1, 2);
            let height = draw.integer(-size / 4, size / 4);
            ring.push(center + LatticePoint::new(x * stretch, y * stretch, height));
        }
    }
    ring
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
    let Some(first) = truths[0].crossing() else {
        return false;
    };
    truths.iter().all(|truth| {
        let crossing = truth.crossing();
        crossing.is_some_and(|crossing| crossing.facing == first.facing)
    })
}

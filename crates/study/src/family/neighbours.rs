//! `shared-edge`, `fan`: two triangles on one edge, and a closed fan around a vertex.

use super::control::{combination, is_steep, well_shaped};
use super::integer::{
    IntegerCase, LatticePoint, dot, minus, normal, plus, times, triangle_with_edge_point, turned,
};
use super::{Grouping, Made, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::Truth;

pub(super) struct SharedEdgeFamily;
pub(super) struct Fan;

impl Recipe for SharedEdgeFamily {
    const NAME: &'static str = "shared-edge";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "two triangles on one edge, both transversal: crossings and folds, exact and near";
    const GROUPING: Grouping = Grouping::SharedEdge;

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        Made::Group(if draw.coin() { exact_pair(draw) } else { near_pair(draw) })
    }

    fn keeps(truths: &[Truth]) -> bool {
        truths.len() == 2 && truths.iter().all(|truth| truth.crossing().is_some())
    }
}

/// On the lattice, exactly through a point of the edge.
fn exact_pair<F: Float>(draw: &mut Draw) -> Vec<Case<F>> {
    let reach = draw.pick(&[32, 2048]);
    loop {
        let ([a, b, c], target) = triangle_with_edge_point(draw, reach);
        let other = plus(a, draw.lattice_point(reach / 4));
        let direction = draw.lattice_point(reach / 8);
        let first = [a, b, c];
        let second = [b, a, other];
        if dot(direction, normal(first)) == 0 || dot(direction, normal(second)) == 0 {
            continue;
        }
        let origin = minus(target, times(direction, draw.integer(1, 4)));
        let mut case = |triangle: [LatticePoint; 3]| {
            IntegerCase { origin, direction, triangle: turned(draw, triangle) }.case()
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
        let origin = draw.point::<F>();
        let ulps = draw.pick(&[0, 1, 4, 16]);
        let direction =
            std::array::from_fn(|i| (target[i] - origin[i]).offset_ulps(draw.integer(-ulps, ulps)));
        if is_steep(direction, [a, b, c]) && is_steep(direction, second) {
            let case = |triangle| Case::new(origin, direction, triangle);
            return [[a, b, c], second].map(|triangle| case(turned(draw, triangle))).into();
        }
    }
}

/// Directions around the axis, counter-clockwise; consecutive ones of any choice that leaves out no
/// two neighbours are less than half a turn apart.
const RING: [[i64; 2]; 8] = [[2, 0], [2, 2], [0, 2], [-2, 2], [-2, 0], [-2, -2], [0, -2], [2, -2]];

impl Recipe for Fan {
    const NAME: &'static str = "fan";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "a closed fan around a vertex, all transversal and facing alike, the line in its inside";
    const GROUPING: Grouping = Grouping::Fan;

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let size = draw.pick(&[4, 64]);
        let center = draw.lattice_point(8 * size);
        let mut ring: Vec<LatticePoint> = Vec::with_capacity(8);
        for (i, [x, y]) in RING.into_iter().enumerate() {
            if i % 2 == 0 || draw.coin() {
                let stretch = size * draw.integer(1, 2);
                // Heights are small enough that every triangle faces up.
                let height = draw.integer(-size / 4, size / 4);
                ring.push(plus(center, [x * stretch, y * stretch, height]));
            }
        }
        // Steeper than any triangle: down, with a small sideways part.
        let depth = 8 * size;
        let direction =
            [draw.integer(-size / 4, size / 4), draw.integer(-size / 4, size / 4), -depth];
        let direction = if draw.coin() { direction } else { times(direction, -1) };
        let spoke = draw.pick(&ring);
        // The centre, a point of a spoke (half way, a lattice point of the doubled fan), or near them.
        let target = if draw.coin() { times(center, 2) } else { plus(center, spoke) };
        let origin = minus(target, times(direction, 2));
        let nudge = draw.pick(&[0, 1, 4, 16]);
        let float = |p: LatticePoint| p.map(|x| F::from_f64(x as f64));
        let doubled = |p: LatticePoint| float(times(p, 2));
        let origin = float(origin).map(|x| x.offset_ulps(draw.integer(-nudge, nudge)));
        let case = |i: usize| {
            let (from, to) = (ring[i], ring[(i + 1) % ring.len()]);
            // The centre may be any corner: kernels do not treat a, b and c alike.
            let corners = turned(draw, [center, from, to]);
            Case::new(origin, float(direction), corners.map(doubled))
        };
        Made::Group((0..ring.len()).map(case).collect())
    }

    fn keeps(truths: &[Truth]) -> bool {
        let facing = |truth: &Truth| truth.crossing().map(|crossing| crossing.facing);
        facing(&truths[0]).is_some()
            && truths.iter().all(|truth| facing(truth) == facing(&truths[0]))
            && truths.iter().any(|truth| truth.hits_closed() == Some(true))
    }
}

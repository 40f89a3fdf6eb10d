//! `parallel-off`, `coplanar`, `grazing`: lines parallel to the plane, in it, and almost so.

use super::integer::{
    IntegerCase, LatticePoint, normal, shuffle, transversal, triangle_with_edge_point,
};
use super::scene::{Stratum, grazing_sine};
use super::{CaseGroup, Promise, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw, Parameters};
use crate::kernel::Scalar;
use crate::truth::Truth;

pub(super) struct ParallelOff;
pub(super) struct Coplanar;
pub(super) struct Grazing;

/// A non-zero combination of two edges.
fn in_plane(draw: &mut Draw, [a, b, c]: [LatticePoint; 3]) -> LatticePoint {
    loop {
        let (i, j) = (draw.integer(-3, 3), draw.integer(-3, 3));
        if (i, j) != (0, 0) {
            return (b - a) * i + (c - a) * j;
        }
    }
}

/// The axes in a random order, so that axis-aligned planes come in all three directions.
fn axes(draw: &mut Draw) -> [usize; 3] {
    draw.pick(&[[0, 1, 2], [1, 2, 0], [2, 0, 1]])
}

/// A point given in (x, y, height) of an axis-aligned plane.
pub(super) fn placed<F: Float>(axes: [usize; 3], x: F, y: F, height: F) -> [F; 3] {
    let mut point = [F::zero(); 3];
    for (axis, value) in axes.into_iter().zip([x, y, height]) {
        point[axis] = value;
    }
    point
}

/// A triangle with area in the axis-aligned plane at a height.
fn level_triangle<F: Float>(draw: &mut Draw, axes: [usize; 3], height: F) -> [[F; 3]; 3] {
    loop {
        let corners: [[f64; 2]; 3] =
            std::array::from_fn(|_| std::array::from_fn(|_| draw.symmetric::<F>().to_f64()));
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area.abs() > 0.0625 {
            return corners.map(|[x, y]| placed(axes, F::from_f64(x), F::from_f64(y), height));
        }
    }
}

impl Recipe for ParallelOff {
    const NAME: &'static str = "parallel-off";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "D = 0 exactly, the line off the plane, down to one ulp off";
    const KEEPS: Promise = Promise::Truths(|truth| *truth == Truth::Parallel);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        if draw.coin() {
            // On axis-aligned planes, some ulps off.
            let axes = axes(draw);
            let height = draw.symmetric::<F>();
            let triangle = level_triangle(draw, axes, height);
            let ulps = draw.pick(&[1, 1, 2, 64, 1 << 16]);
            let off = height.offset_ulps(if draw.coin() { ulps } else { -ulps });
            let origin = placed(axes, draw.symmetric(), draw.symmetric(), off);
            let direction = placed(axes, draw.symmetric(), draw.symmetric(), F::zero());
            return CaseGroup::One(Case::new(origin, direction, triangle));
        }
        let (triangle, point) = triangle_with_edge_point(draw, 64);
        let triangle = shuffle(draw, triangle);
        let direction = in_plane(draw, triangle);
        let off = transversal(draw, normal(triangle), 2);
        IntegerCase {
            origin: point - direction + off,
            direction,
            triangle,
        }
        .made()
    }
}

impl Recipe for Coplanar {
    const NAME: &'static str = "coplanar";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "in the plane: through the interior, along an edge, through or touching a vertex, missing";
    const KEEPS: Promise = Promise::Truths(|truth| matches!(truth, Truth::Coplanar(_)));

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let (triangle, edge_point) = triangle_with_edge_point(draw, 64);
        let [a, b, c] = triangle;
        let triangle = shuffle(draw, triangle);
        let outside = a + (b - a) * draw.pick(&[-1, 2]);
        let target = draw.pick(&[a, b, c, edge_point, edge_point, outside]);
        let along = draw.pick(&[b - a, c - a, c - b, edge_point - c]);
        let direction = if draw.coin() {
            along
        } else {
            in_plane(draw, triangle)
        };
        let origin = target - direction * draw.integer(-2, 3);
        IntegerCase {
            origin,
            direction,
            triangle,
        }
        .made()
    }
}

impl Recipe for Grazing {
    const NAME: &'static str = "grazing";
    const VERSION: u32 = 4;
    const PROMISE: &'static str =
        "transversal, sines from 1/2 down to below an ulp of 1, half of them on generic planes";

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        if draw.coin() {
            return Stratum::Grazing.make(&Parameters::default(), draw);
        }
        if draw.coin() {
            // The plane at height 0: the height of the origin and of the direction are exact.
            let axes = axes(draw);
            let triangle = level_triangle(draw, axes, F::zero());
            let [x, y] = [draw.symmetric::<F>(), draw.symmetric()];
            let steps = F::from_f64(draw.pick(&[0.5, 1.0, 2.0, 4.0]));
            // As on generic planes, so that no limit of these cases alone decides an epsilon.
            let fall = F::from_f64(grazing_sine::<F>(draw));
            let [dx, dy] = [draw.symmetric::<F>(), draw.symmetric()];
            let origin = placed(axes, x - dx * steps, y - dy * steps, -(fall * steps));
            return CaseGroup::One(Case::new(origin, placed(axes, dx, dy, fall), triangle));
        }
        // A lattice direction in the plane, 2^k times, plus a small one off it: D is that one's.
        let (triangle, point) = triangle_with_edge_point(draw, 64);
        let triangle = shuffle(draw, triangle);
        let flat = in_plane(draw, triangle);
        let off = transversal(draw, normal(triangle), 2);
        let steepness = draw.integer(1, i64::from(F::DIGITS) - 14);
        let direction = flat * (1 << steepness) + off;
        IntegerCase {
            origin: point - direction,
            direction,
            triangle,
        }
        .made()
    }
}

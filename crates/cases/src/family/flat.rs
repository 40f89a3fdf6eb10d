//! `parallel-off`, `coplanar`, `grazing`: lines parallel to the plane, in it, and almost so.

use super::integer::{
    IntegerCase, LatticePoint, normal, shuffle, transversal, triangle_with_edge_point,
};
use super::scene::{Stratum, either_sign, grazing_sine};
use super::{CaseGroup, Promise, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw, Parameters};
use crate::kernel::Scalar;
use crate::truth::Truth;
use glam::DVec2;

pub(super) struct ParallelOff;
pub(super) struct Coplanar;
pub(super) struct Grazing;

/// A non-zero combination of two edges.
fn in_plane(draw: &mut Draw, [a, b, c]: [LatticePoint; 3]) -> LatticePoint {
    loop {
        let i = draw.integer(-3, 3);
        let j = draw.integer(-3, 3);
        if i != 0 || j != 0 {
            return (b - a) * i + (c - a) * j;
        }
    }
}

/// The axes in cyclic order from any of them on, so that axis-aligned planes come in all three directions.
pub(super) fn axes(draw: &mut Draw) -> [usize; 3] {
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
        let corners = [(); 3].map(|()| [(); 2].map(|()| draw.symmetric::<F>()));
        let [a, b, c] = corners.map(|corner| DVec2::from(corner.map(F::to_f64)));
        let twice_the_area = (b - a).perp_dot(c - a);
        if twice_the_area.abs() > 0.0625 {
            return corners.map(|[x, y]| placed(axes, x, y, height));
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
            CaseGroup::One(ulps_off_level(draw))
        } else {
            off_lattice_plane(draw).made()
        }
    }
}

/// A ray parallel to an axis-aligned plane, some ulps off it.
fn ulps_off_level<F: Float>(draw: &mut Draw) -> Case<F> {
    let axes = axes(draw);
    let height = draw.symmetric::<F>();
    let triangle = level_triangle(draw, axes, height);
    let ulps = draw.pick(&[1, 1, 2, 64, 1 << 16]);
    let beside = height.offset_ulps(either_sign(draw, ulps));
    let origin = placed(axes, draw.symmetric(), draw.symmetric(), beside);
    let direction = placed(axes, draw.symmetric(), draw.symmetric(), F::zero());
    Case::new(origin, direction, triangle)
}

/// A ray parallel to the plane of lattice points, and off it.
fn off_lattice_plane(draw: &mut Draw) -> IntegerCase {
    let plane = LatticePlane::draw(draw);
    IntegerCase {
        origin: plane.point - plane.along + plane.off,
        direction: plane.along,
        triangle: plane.triangle,
    }
}

/// The plane of a triangle of lattice points.
struct LatticePlane {
    triangle: [LatticePoint; 3],
    /// A point of an edge.
    point: LatticePoint,
    /// A vector in the plane.
    along: LatticePoint,
    /// A short vector that is not in the plane.
    off: LatticePoint,
}

impl LatticePlane {
    fn draw(draw: &mut Draw) -> LatticePlane {
        let (corners, point) = triangle_with_edge_point(draw, 64);
        let triangle = shuffle(draw, corners);
        LatticePlane {
            triangle,
            point,
            along: in_plane(draw, triangle),
            off: transversal(draw, normal(triangle), 2),
        }
    }
}

impl Recipe for Coplanar {
    const NAME: &'static str = "coplanar";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "in the plane: through the interior, along an edge, through or touching a vertex, missing";
    const KEEPS: Promise = Promise::Truths(|truth| matches!(truth, Truth::Coplanar(_)));

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let ([a, b, c], edge_point) = triangle_with_edge_point(draw, 64);
        let triangle = shuffle(draw, [a, b, c]);
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
            CaseGroup::One(grazing_level(draw))
        } else {
            grazing_lattice_plane(draw, F::DIGITS).made()
        }
    }
}

/// A ray that grazes an axis-aligned plane at height 0, where the heights of the origin and of the direction are exact.
fn grazing_level<F: Float>(draw: &mut Draw) -> Case<F> {
    let axes = axes(draw);
    let triangle = level_triangle(draw, axes, F::zero());
    let x: F = draw.symmetric();
    let y: F = draw.symmetric();
    let t = F::from_f64(draw.pick(&[0.5, 1.0, 2.0, 4.0]));
    // As on generic planes, so that no limit of these cases alone decides an epsilon.
    let rise = F::from_f64(grazing_sine::<F>(draw));
    let dx: F = draw.symmetric();
    let dy: F = draw.symmetric();
    let origin = placed(axes, x - dx * t, y - dy * t, -(rise * t));
    let direction = placed(axes, dx, dy, rise);
    Case::new(origin, direction, triangle)
}

/// A ray along 2^k times a vector of a lattice plane, plus a small vector off it, which alone makes D.
fn grazing_lattice_plane(draw: &mut Draw, digits: u32) -> IntegerCase {
    let plane = LatticePlane::draw(draw);
    let k = draw.integer(1, i64::from(digits) - 14);
    let direction = plane.along * (1 << k) + plane.off;
    IntegerCase {
        origin: plane.point - direction,
        direction,
        triangle: plane.triangle,
    }
}

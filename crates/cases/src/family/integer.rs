//! Small integer vectors, which the exact families share: every sum and product of them is exact.

use super::CaseGroup;
use crate::arith::Float;
use crate::case::{Case, Draw};
use glam::I64Vec3;

/// A point of small integers.
pub type LatticePoint = I64Vec3;

/// A point in floats.
pub fn float<F: Float>(point: LatticePoint) -> [F; 3] {
    point.to_array().map(|x| F::from_f64(x as f64))
}

/// Three integers in `-bound..=bound`.
pub(super) fn lattice_point(draw: &mut Draw, bound: i64) -> LatticePoint {
    draw.lattice_point(bound).into()
}

/// A case in integers, times a power of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntegerCase {
    pub origin: LatticePoint,
    pub direction: LatticePoint,
    pub triangle: [LatticePoint; 3],
}

impl IntegerCase {
    pub fn case<F: Float>(&self) -> Case<F> {
        Case::new(
            float(self.origin),
            float(self.direction),
            self.triangle.map(float),
        )
    }

    pub fn made<F: Float>(&self) -> CaseGroup<F> {
        CaseGroup::One(self.case())
    }
}

/// (b-a)×(c-a).
pub(super) fn normal([a, b, c]: [LatticePoint; 3]) -> LatticePoint {
    (b - a).cross(c - a)
}

/// A direction within the bound that is not parallel to the plane of a normal.
pub(super) fn transversal(draw: &mut Draw, normal: LatticePoint, bound: i64) -> LatticePoint {
    loop {
        let direction = lattice_point(draw, bound);
        if direction.dot(normal) != 0 {
            return direction;
        }
    }
}

/// A vector within the bound that is not parallel to another.
pub(super) fn independent(draw: &mut Draw, other: LatticePoint, bound: i64) -> LatticePoint {
    loop {
        let vector = lattice_point(draw, bound);
        if vector.cross(other) != LatticePoint::ZERO {
            return vector;
        }
    }
}

/// The vertices in a random one of the six orders.
pub(super) fn shuffle<T: Copy>(draw: &mut Draw, triangle: [T; 3]) -> [T; 3] {
    let [a, b, c] = triangle;
    draw.pick(&[
        [a, b, c],
        [b, c, a],
        [c, a, b],
        [a, c, b],
        [c, b, a],
        [b, a, c],
    ])
}

/// The vertices in a random one of the three orders with the same winding.
pub fn turned<T: Copy>(draw: &mut Draw, triangle: [T; 3]) -> [T; 3] {
    let [a, b, c] = triangle;
    draw.pick(&[[a, b, c], [b, c, a], [c, a, b]])
}

/// A triangle with area whose first edge holds lattice points, and one of those points: vertices are
/// multiples of small steps, so that everything stays within `reach`.
pub(super) fn triangle_with_edge_point(
    draw: &mut Draw,
    reach: i64,
) -> ([LatticePoint; 3], LatticePoint) {
    let parts = draw.integer(2, 4);
    let step = loop {
        let step = lattice_point(draw, reach / 16);
        if step != LatticePoint::ZERO {
            break step;
        }
    };
    let a = lattice_point(draw, reach / 4);
    let side = independent(draw, step, reach / 4);
    let point = a + step * draw.integer(1, parts - 1);
    ([a, a + step * parts, a + side], point)
}

/// A doubled triangle with area, and a doubled lattice point of its first edge: the middle of that point and the third
/// vertex is a lattice point too.
pub(super) fn doubled_triangle(draw: &mut Draw, reach: i64) -> ([LatticePoint; 3], LatticePoint) {
    let (triangle, edge_point) = triangle_with_edge_point(draw, reach);
    (triangle.map(|vertex| vertex * 2), edge_point * 2)
}

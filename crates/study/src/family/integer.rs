//! Small integer vectors, which the exact families share: every sum and product of them is exact.

use super::Made;
use crate::arith::Float;
use crate::case::{Case, Draw};

pub(crate) type LatticePoint = [i64; 3];

/// A case in integers, times a power of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntegerCase {
    pub origin: LatticePoint,
    pub direction: LatticePoint,
    pub triangle: [LatticePoint; 3],
}

impl IntegerCase {
    pub fn case<F: Float>(&self) -> Case<F> {
        let float = |p: LatticePoint| p.map(|x| F::from_f64(x as f64));
        Case::new(float(self.origin), float(self.direction), self.triangle.map(float))
    }

    pub fn made<F: Float>(&self) -> Made<F> {
        Made::One(self.case())
    }
}

pub(crate) fn plus(a: LatticePoint, b: LatticePoint) -> LatticePoint {
    std::array::from_fn(|i| a[i] + b[i])
}

pub(crate) fn minus(a: LatticePoint, b: LatticePoint) -> LatticePoint {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(crate) fn times(a: LatticePoint, factor: i64) -> LatticePoint {
    a.map(|x| x * factor)
}

pub(super) fn dot(a: LatticePoint, b: LatticePoint) -> i64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

pub(super) fn cross(a: LatticePoint, b: LatticePoint) -> LatticePoint {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// (b-a)×(c-a).
pub(super) fn normal([a, b, c]: [LatticePoint; 3]) -> LatticePoint {
    cross(minus(b, a), minus(c, a))
}

/// A direction within the bound that is not parallel to the plane of a normal.
pub(super) fn transversal(draw: &mut Draw, normal: LatticePoint, bound: i64) -> LatticePoint {
    loop {
        let direction = draw.lattice_point(bound);
        if dot(direction, normal) != 0 {
            return direction;
        }
    }
}

/// A vector within the bound that is not parallel to another.
pub(super) fn independent(draw: &mut Draw, other: LatticePoint, bound: i64) -> LatticePoint {
    loop {
        let vector = draw.lattice_point(bound);
        if cross(vector, other) != [0; 3] {
            return vector;
        }
    }
}

/// The vertices in a random one of the six orders.
pub(super) fn shuffle<T: Copy>(draw: &mut Draw, triangle: [T; 3]) -> [T; 3] {
    let [a, b, c] = triangle;
    draw.pick(&[[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]])
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
        let step = draw.lattice_point(reach / 16);
        if step != [0; 3] {
            break step;
        }
    };
    let a = draw.lattice_point(reach / 4);
    let side = independent(draw, step, reach / 4);
    let point = plus(a, times(step, draw.integer(1, parts - 1)));
    ([a, plus(a, times(step, parts)), plus(a, side)], point)
}

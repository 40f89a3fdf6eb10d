//! Degenerate constructions: a ray at an exactly known place of a triangle in small integers, scaled by
//! powers of two, then nudged by ulps.

use super::bytes::Bytes;
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::Case;
use crate::family::integer::{LatticePoint, float};

/// The constructions, in the order of their byte. What the line meets, before any nudge:
pub const CONSTRUCTIONS: [&str; 10] = [
    "the interior",
    "an edge",
    "a vertex",
    "the plane, outside",
    "edge or interior, in the plane",
    "nothing, parallel to the plane",
    "a shared edge, from the triangle on its other side",
    "the triangle at the origin of the ray",
    "a segment instead of a triangle",
    "a far triangle's edge",
];

const IN_PLANE: u8 = 4;
const PARALLEL: u8 = 5;
const SHARED_EDGE: u8 = 6;
const AT_ORIGIN: u8 = 7;
const SEGMENT: u8 = 8;
const FAR: u8 = 9;

/// Reads a construction, its powers of two, its interval and its nudges.
pub(super) fn construct<F: Float>(bytes: &mut Bytes) -> Case<F> {
    let kind = bytes.below(CONSTRUCTIONS.len() as u8);
    let point =
        |bytes: &mut Bytes, bound: u8| LatticePoint::from([(); 3].map(|()| bytes.small(bound)));
    // Doubled, so that midpoints are integers.
    let offset = if kind == FAR {
        point(bytes, 100) * (1 << 10)
    } else {
        point(bytes, 8)
    };
    let a = offset * 2;
    let (step, side) = (point(bytes, 4) * 2, point(bytes, 8) * 2);
    let parts = 2 + i64::from(bytes.below(3));
    let b = a + step * parts;
    let on_edge = a + step * (1 + i64::from(bytes.below(parts as u8 - 1)));
    let c = match kind {
        SEGMENT => a + step * bytes.small(4),
        SHARED_EDGE => a - side,
        _ => a + side,
    };
    let half_way = (on_edge + c) / 2;
    let target = match kind {
        0 | AT_ORIGIN => half_way,
        2 => [a, b, c][usize::from(bytes.below(3))],
        3 => on_edge * 2 - half_way,
        _ => on_edge,
    };
    let in_plane = step * bytes.small(2) + side * bytes.small(2);
    let free = point(bytes, 8);
    let direction = if [IN_PLANE, PARALLEL].contains(&kind) {
        in_plane
    } else {
        free
    };
    let steps = if kind == AT_ORIGIN { 0 } else { bytes.small(4) };
    let mut origin = target - direction * steps;
    if kind == PARALLEL {
        origin += free;
    }
    let triangle = if kind == SHARED_EDGE {
        [b, a, c]
    } else {
        [a, b, c]
    };
    let case = Case::new(
        float(origin),
        float(direction),
        rotated(bytes, triangle).map(float),
    );
    finish(bytes, case, steps)
}

fn rotated(bytes: &mut Bytes, [a, b, c]: [LatticePoint; 3]) -> [LatticePoint; 3] {
    let orders = [
        [a, b, c],
        [b, c, a],
        [c, a, b],
        [a, c, b],
        [c, b, a],
        [b, a, c],
    ];
    orders[usize::from(bytes.below(orders.len() as u8))]
}

/// Powers of two on points and direction, ends of the interval at the exact t, and nudges.
fn finish<F: Float>(bytes: &mut Bytes, case: Case<F>, t: i64) -> Case<F> {
    let [points, direction] = [(); 2].map(|()| power::<F>(bytes));
    let mut vectors = case.vectors();
    for (i, vector) in vectors.iter_mut().enumerate() {
        let power = if i == 1 { direction } else { points };
        *vector = vector.map(|x| F::from_f64(scale_by_power_of_two(x.to_f64(), power)));
    }
    let t = F::from_f64(scale_by_power_of_two(t as f64, points - direction));
    let mut ends = match bytes.below(6) {
        0 => [t, F::infinity()],
        1 => [F::zero(), t],
        2 => [t, t],
        _ => [F::zero(), F::infinity()],
    };
    for _ in 0..bytes.below(9) {
        let place = usize::from(bytes.below(17));
        let by = bytes.byte() as i8;
        let number = match place {
            15 | 16 => &mut ends[place - 15],
            _ => &mut vectors[place / 3][place % 3],
        };
        *number = number.offset_ulps(by.into());
    }
    let [origin, direction, a, b, c] = vectors;
    Case::new(origin, direction, [a, b, c]).on(ends[0], ends[1])
}

/// Zero for every even byte; odd ones cover the scalar's range.
fn power<F: Float>(bytes: &mut Bytes) -> i32 {
    let byte = bytes.byte();
    let reach = if F::NAME == f32::NAME { 1 } else { 8 };
    if byte.is_multiple_of(2) {
        0
    } else {
        i32::from(byte as i8) * reach
    }
}

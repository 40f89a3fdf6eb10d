//! Hard cases for the tests of this crate: what its layers and its kernels' sinks meet on every path.

use super::{Case, Draw};
use crate::arith::Float;

/// As many cases as asked for: rays at vertices, edges, the inside and the plane of triangles on small grids, then
/// triangles of many exponents with rays through points near their edges, then numbers of any exponent.
pub fn hard_cases<F: Float>(seed: u64, count: u64) -> Vec<Case<F>> {
    (0..count)
        .map(|index| hard_case(&mut Draw::new("hard", seed, index), index))
        .collect()
}

fn hard_case<F: Float>(draw: &mut Draw, index: u64) -> Case<F> {
    match index % 8 {
        0 | 4 => on_a_grid(draw),
        1 => near_an_edge(draw, 8),
        2 | 5 | 6 => near_an_edge(draw, F::MAX_EXPONENT as i64 / 3),
        _ => of_any_exponents(draw),
    }
}

/// The weights of two vertices, of points on two edges, of one inside and one outside. Their sums differ from 1.
const WEIGHTS: [[i64; 3]; 6] = [
    [2, 0, 0],
    [0, 2, 0],
    [1, 1, 0],
    [0, 1, 1],
    [1, 2, 1],
    [3, -1, 0],
];

/// A small triangle of integers, and a ray exactly at a point of its plane.
fn on_a_grid<F: Float>(draw: &mut Draw) -> Case<F> {
    let [a, b, c] = [(); 3].map(|()| draw.lattice_point(4));
    let [of_a, of_b, of_c] = draw.pick(&WEIGHTS);
    let direction = draw.lattice_point(3);
    // All points are multiplied by the sum of the weights, so that nothing is divided.
    let sum = of_a + of_b + of_c;
    let origin = [0, 1, 2].map(|axis| {
        let target = of_a * a[axis] + of_b * b[axis] + of_c * c[axis];
        target - 2 * sum * direction[axis]
    });
    let vertices = [a, b, c].map(|vertex| vertex.map(|x| sum * x));
    Case::new(floats(origin), floats(direction), vertices.map(floats))
}

fn floats<F: Float>(point: [i64; 3]) -> [F; 3] {
    point.map(|x| F::from_f64(x as f64))
}

/// A triangle of a drawn size, and a ray through a point near an edge of it.
fn near_an_edge<F: Float>(draw: &mut Draw, most_exponent: i64) -> Case<F> {
    let exponent = draw.integer(-most_exponent, most_exponent) as i32;
    let corners = [(); 3].map(|()| vector::<F>(draw, exponent));
    let u = draw.unit();
    let other_v = draw.unit();
    let v = draw.pick(&[0.0, 1e-7, -1e-7, other_v]);
    let origin = vector::<F>(draw, exponent + 1);
    let direction = [0, 1, 2].map(|axis| {
        let [a, b, c] = corners.map(|corner| corner[axis].to_f64());
        let target = a + u * (b - a) + v * (c - a);
        F::from_f64(target - origin[axis].to_f64())
    });
    Case::new(origin, direction, corners)
}

/// Coordinates of any sign and digits, all with one exponent.
fn vector<F: Float>(draw: &mut Draw, exponent: i32) -> [F; 3] {
    [(); 3].map(|()| draw.with_exponent(exponent))
}

/// Numbers each of which has an exponent of its own.
fn of_any_exponents<F: Float>(draw: &mut Draw) -> Case<F> {
    let least = F::MIN_EXPONENT as i64;
    let most = F::MAX_EXPONENT as i64;
    let mut vectors = [[F::zero(); 3]; 5];
    for coordinate in vectors.as_flattened_mut() {
        let exponent = draw.integer(least, most) as i32;
        *coordinate = draw.with_exponent(exponent);
    }
    let [origin, direction, a, b, c] = vectors;
    Case::new(origin, direction, [a, b, c])
}

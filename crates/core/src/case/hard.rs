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
    let number = |value: i64| F::from_f64(value as f64);
    match index % 4 {
        0 => {
            let corners: [[i64; 3]; 3] = [(); 3].map(|()| draw.lattice_point(4));
            let weights = [
                [2, 0, 0],
                [0, 2, 0],
                [1, 1, 0],
                [0, 1, 1],
                [1, 2, 1],
                [3, -1, 0],
            ];
            let weights = draw.pick(&weights);
            let direction = draw.lattice_point(3);
            let sum: i64 = weights.iter().sum();
            let at = |axis: usize| -> i64 { (0..3).map(|i| weights[i] * corners[i][axis]).sum() };
            let origin = std::array::from_fn(|axis| number(at(axis) - sum * 2 * direction[axis]));
            let corners = corners.map(|corner| corner.map(|c| number(sum * c)));
            Case::new(origin, direction.map(number), corners)
        }
        1 | 2 => {
            let limit = if index % 8 == 1 {
                8
            } else {
                F::MAX_EXPONENT as i64 / 3
            };
            let scale = draw.integer(-limit, limit) as i32;
            let corners: [[F; 3]; 3] =
                [(); 3].map(|()| [(); 3].map(|()| draw.with_exponent(scale)));
            let (u, v) = (draw.unit(), [0.0, 1e-7, -1e-7, draw.unit()][draw.below(4)]);
            let origin: [F; 3] = [(); 3].map(|()| draw.with_exponent(scale + 1));
            let target = |axis: usize| {
                let [a, b, c] = corners.map(|corner| corner[axis].to_f64());
                a + u * (b - a) + v * (c - a)
            };
            let towards = |axis: usize| F::from_f64(target(axis) - origin[axis].to_f64());
            Case::new(origin, std::array::from_fn(towards), corners)
        }
        _ => {
            let mut any = || -> [F; 3] {
                [(); 3].map(|()| {
                    let exponent = draw.integer(F::MIN_EXPONENT as i64, F::MAX_EXPONENT as i64);
                    draw.with_exponent(exponent as i32)
                })
            };
            Case::new(any(), any(), [any(), any(), any()])
        }
    }
}

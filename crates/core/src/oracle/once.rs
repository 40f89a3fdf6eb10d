//! Which of the triangles around an edge or a vertex a ray hits that meets it exactly, so that it hits exactly one of them.
//!
//! The ray counts as moved by less than any number, always in the same direction. With W the number of the edge from p to q,
//! a move of the origin along axis i changes W by component i of (q-p)×d. The ray is moved by ε along the axis after the
//! one on which d is largest, and by ε² along the next. A number that is 0 takes the sign of the first change that is not
//! 0. Both are 0 only if the edge is parallel to d, and then the triangle has no area as seen along d. The move does not
//! depend on the triangle, and a ray that is off all edges meets exactly one of the triangles around them.
//! `include/hairline_exact.h` has the same rule.

use super::integer::{ExactInteger, Integer, align, minus};
use crate::arith::Vector;
use crate::case::Case;
use crate::truth::{Crossing, Facing, Feature};
use num_bigint::BigInt;
use std::cmp::Ordering;

/// True if the ray's line, moved by less than any number, passes through the inside of the triangle. `crossing` is the truth
/// of the case. The interval is not looked at.
pub fn is_met_once(case: &Case<f64>, crossing: &Crossing) -> bool {
    let [_, d, a, b, c] = case.vectors();
    let edges = [[b, c], [c, a], [a, b]];
    let touched: &[usize] = match crossing.feature {
        Feature::Interior => &[],
        Feature::Outside => return false,
        Feature::EdgeBc => &[0],
        Feature::EdgeCa => &[1],
        Feature::EdgeAb => &[2],
        Feature::VertexA => &[1, 2],
        Feature::VertexB => &[0, 2],
        Feature::VertexC => &[0, 1],
    };
    let needed = match crossing.facing {
        Facing::Front => Ordering::Greater,
        Facing::Back => Ordering::Less,
    };
    let largest = case.ray.direction.largest_axis();
    touched
        .iter()
        .all(|edge| moved(edges[*edge], d, largest) == needed)
}

/// The sign of an edge's number next to the ray.
fn moved([from, to]: [[f64; 3]; 2], d: [f64; 3], largest: usize) -> Ordering {
    let along = |axis: usize| {
        let rounded = rounded_sign([from, to], d, axis);
        rounded.unwrap_or_else(|| exact_sign([from, to], d, axis))
    };
    along((largest + 1) % 3).then_with(|| along((largest + 2) % 3))
}

/// The sign of component `axis` of (to-from)×d, if floats tell it.
///
/// Each product of a rounded difference is off by at most 2u of its size to first order, and the difference of both by u of it: 4u of
/// their sum is more, with second order and the sum's own roundings. `LEAST` is more than underflow can add, and where a product
/// overflows the comparison fails. A product is 0 without underflow only if a factor is.
fn rounded_sign([from, to]: [[f64; 3]; 2], d: [f64; 3], axis: usize) -> Option<Ordering> {
    const SLACK: f64 = 2.0 * f64::EPSILON;
    const LEAST: f64 = 1e-290;
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let edge = [to[j] - from[j], to[k] - from[k]];
    let is_zero = [(edge[0], d[k]), (edge[1], d[j])].map(|(x, y)| x == 0.0 || y == 0.0);
    if is_zero == [true; 2] {
        return Some(Ordering::Equal);
    }
    let products = [edge[0] * d[k], edge[1] * d[j]];
    let minor = products[0] - products[1];
    let bound = SLACK * (products[0].abs() + products[1].abs()) + LEAST;
    (bound < minor.abs()).then(|| minor.total_cmp(&0.0))
}

/// The same in integers of any size.
fn exact_sign([from, to]: [[f64; 3]; 2], d: [f64; 3], axis: usize) -> Ordering {
    let ([from, to], _) = align([from, to]);
    let ([d], _) = align([d]);
    let edge = minus(&to, &from);
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    ExactInteger::sign(&BigInt::minor(&edge[j], &d[k], &edge[k], &d[j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;

    #[test]
    fn a_sign_that_floats_tell_is_that_of_integers() {
        let mut told = [0, 0];
        for index in 0..20_000 {
            let draw = &mut Draw::new("signs", 1, index);
            // Small integers times powers of two, so that many minors are 0, and some under- or overflow.
            let exponent = draw.pick(&[0, 0, 0, -540, 500, -1060]);
            let scale = 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
            let mut point = || {
                [(); 3].map(|()| {
                    let digits = draw.integer(-6, 6) as f64;
                    let last = draw.integer(-1, 1) as f64 * f64::EPSILON;
                    scale * (digits + digits * last)
                })
            };
            let (edge, d) = ([point(), point()], point());
            for axis in 0..3 {
                let rounded = rounded_sign(edge, d, axis);
                let exact = exact_sign(edge, d, axis);
                assert!(rounded.is_none_or(|sign| sign == exact), "{edge:?} {d:?}");
                told[usize::from(rounded.is_some())] += 1;
            }
        }
        assert!(1_000 < told[0] && 30_000 < told[1], "{told:?}");
    }
}

//! `noise`: two triangles on one edge, with coordinates of about 1 and coordinates that only rounding keeps from 0, as a
//! program leaves them that computes sin π.
//!
//! In one or two axes an end of the edge and both third corners have noise. The line passes through the middle of the edge,
//! and in those axes its direction is noise too. Seen along it, the corners with noise differ by less than an ulp of their
//! distance from the origin. So a kernel that subtracts the origin from them makes one point of several.

use super::exact_ray::exact_ray;
use super::integer::shuffle;
use super::neighbours::{are_two_crossings, turned_cases};
use super::scene::any_direction;
use super::{CaseGroup, Grouping, Promise, Recipe};
use crate::arith::Float;
use crate::case::Draw;
use crate::kernel::Scalar;

pub(super) struct Noise;

/// The exponent of noise: sin π is 2^-53 in `f64`, and stays so where a program reads it into `f32`.
const EXPONENT: i32 = -53;

impl Recipe for Noise {
    const NAME: &'static str = "noise";
    const PROMISE: &'static str =
        "two transversal triangles on one edge, with coordinates of about 1 and of about 2^-53";
    const GROUPING: Grouping = Grouping::SharedEdge;
    const KEEPS: Promise = Promise::Together(are_two_crossings);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let axes = shuffle(draw, [0, 1, 2]);
        let noisy_count = 1 + draw.below(2);
        let noisy = &axes[..noisy_count];
        let without_noise = axes[2];
        let p = [(); 3].map(|()| draw.with_exponent::<F>(-1));
        let q = beside(draw, p, noisy);
        let mut first = beside(draw, q, noisy);
        let mut second = beside(draw, q, noisy);
        // This puts them on the two sides of the edge.
        let apart = F::from_f64(0.125 + draw.unit());
        first[without_noise] = q[without_noise] + apart;
        second[without_noise] = q[without_noise] - apart;

        let way = any_direction(draw);
        let distance = 0.5 + draw.unit();
        let away = (way * distance).to_array();
        let (mut origin, mut direction) = exact_ray([p, q], away);
        let half = F::from_f64(0.5);
        for &axis in noisy {
            // At t = 1/2 the ray is at p/2 + q/2, the middle, exactly.
            origin[axis] = p[axis] * half;
            direction[axis] = q[axis];
        }
        let triangles = [[p, q, first], [q, p, second]];
        CaseGroup::Group(turned_cases(draw, origin, direction, &triangles))
    }
}

/// A corner up to 1 from another along each axis, but with noise along the noisy ones.
fn beside<F: Float>(draw: &mut Draw, corner: [F; 3], noisy: &[usize]) -> [F; 3] {
    [0, 1, 2].map(|axis| {
        if noisy.contains(&axis) {
            draw.with_exponent(EXPONENT)
        } else {
            corner[axis] + draw.symmetric::<F>()
        }
    })
}

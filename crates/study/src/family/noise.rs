//! `noise`: two triangles on one edge, with coordinates of about 1 and coordinates that only rounding keeps from 0, as a
//! program leaves them that computes sin π.
//!
//! In one or two axes an end of the edge and both third corners have noise. The line passes through the middle of the edge,
//! and in those axes its direction is noise too. Seen along it, the corners with noise differ by less than an ulp of their
//! distance from the origin. So a kernel that subtracts the origin from them makes one point of several.

use super::exact_ray::exact_ray;
use super::integer::{shuffle, turned};
use super::scene::any_direction;
use super::{Grouping, Kept, Made, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;

pub(super) struct Noise;

/// The exponent of noise: sin π is 2^-53 in `f64`, and stays so where a program reads it into `f32`.
const EXPONENT: i32 = -53;

impl Recipe for Noise {
    const NAME: &'static str = "noise";
    const PROMISE: &'static str =
        "two transversal triangles on one edge, with coordinates of about 1 and of about 2^-53";
    const GROUPING: Grouping = Grouping::SharedEdge;
    const KEEPS: Kept = Kept::Together(|truths| {
        truths.len() == 2 && truths.iter().all(|truth| truth.crossing().is_some())
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let axes = shuffle(draw, [0, 1, 2]);
        let noisy = &axes[..1 + draw.below(2)];
        let p = [(); 3].map(|()| draw.with_exponent::<F>(-1));
        let q = beside(draw, p, noisy);
        let [mut first, mut second] = [(); 2].map(|()| beside(draw, q, noisy));
        // On both sides of the edge along an axis without noise.
        let (along, apart) = (axes[2], F::from_f64(0.125 + draw.unit()));
        first[along] = q[along] + apart;
        second[along] = q[along] - apart;

        let away = any_direction(draw) * (0.5 + draw.unit());
        let (mut origin, mut direction) = exact_ray([p, q], away.to_array());
        for axis in noisy {
            // Half way from here to the end of the ray at t = 1 is the middle of p and q, exactly.
            origin[*axis] = p[*axis] * F::from_f64(0.5);
            direction[*axis] = q[*axis];
        }
        let case = |corners: [[F; 3]; 3]| Case::new(origin, direction, turned(draw, corners));
        Made::Group([[p, q, first], [q, p, second]].map(case).into())
    }
}

/// A corner up to 1 from another in each axis, or with noise in some.
fn beside<F: Float>(draw: &mut Draw, corner: [F; 3], noisy: &[usize]) -> [F; 3] {
    std::array::from_fn(|axis| match noisy.contains(&axis) {
        true => draw.with_exponent(EXPONENT),
        false => corner[axis] + draw.symmetric::<F>(),
    })
}

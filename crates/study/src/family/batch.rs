//! `mixed-batch`: cases that stand beside others which they have something in common with. A kernel that tests eight rays
//! at a time may let the NaN of one lane reach the others; one that keeps what it computed of a triangle may take it for
//! another.

use super::control::{combination, interior_weights, is_steep, well_shaped};
use super::integer::shuffle;
use super::{Kept, Made, Recipe};
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::Truth;

pub(super) struct MixedBatch;

/// So many cases in a row share their vertices a and b.
const SHARING: u64 = 4;

/// One case of so many in a row has a NaN.
const LANES: u64 = 8;

impl Recipe for MixedBatch {
    const NAME: &'static str = "mixed-batch";
    const PROMISE: &'static str = "four in a row share a and b, and every eighth has a NaN; the others are transversal, at t > 0";
    const KEEPS: Kept =
        Kept::Truths(|truth| *truth == Truth::Invalid || truth.crossing().is_some());

    fn make<F: Scalar>(draw: &mut Draw, index: u64) -> Made<F> {
        // Neighbours have this stream in common, whatever the seed is.
        let mut shared = Draw::new(Self::NAME, 0, index / SHARING);
        let lane = shared.below(LANES as usize) as u64;
        let case = loop {
            let [a, b, _] = well_shaped::<F>(&mut shared.clone());
            let triangle = [a, b, draw.point()];
            // Half of the rays miss.
            let [u, v, w] = interior_weights(draw);
            let weights = if draw.coin() {
                [u, v, w]
            } else {
                [u + w, v + w, -w]
            };
            let weights = shuffle(draw, weights);
            let origin = draw.point::<F>();
            let target = combination(triangle, weights.map(F::from_f64));
            let direction = std::array::from_fn(|i| target[i] - origin[i]);
            if is_steep(direction, triangle) {
                break Case::new(origin, direction, triangle);
            }
        };
        // Of two groups that share vertices, one has the NaN.
        if index % LANES != lane {
            return Made::One(case);
        }
        let mut vectors = case.vectors();
        vectors[draw.below(5)][draw.below(3)] = F::from_f64(f64::NAN);
        let [origin, direction, a, b, c] = vectors;
        Made::One(Case::new(origin, direction, [a, b, c]))
    }
}

//! `mixed-batch`: cases that stand beside others which they have something in common with. A kernel that tests eight rays
//! at a time may let the NaN of one lane reach the others; one that keeps what it computed of an edge or of a ray may take it
//! for another's.

use super::control::{combination, interior_weights, is_steep};
use super::integer::shuffle;
use super::{CaseGroup, Promise, Recipe};
use crate::arith::Float;
use crate::case::{Case, Draw};
use crate::kernel::Scalar;
use crate::truth::Truth;
use glam::DVec3;

pub(super) struct MixedBatch;

/// So many cases in a row have something in common.
const SHARING: u64 = 4;

/// One case of so many in a row has a number that is not finite.
const LANES: u64 = 8;

/// Two points that are at least 1/2 apart: far enough for a ray through both to be steep.
fn apart<F: Float>(draw: &mut Draw) -> [[F; 3]; 2] {
    loop {
        let points = [draw.point::<F>(), draw.point()];
        let [p, q] = points.map(|point| DVec3::from(point.map(F::to_f64)));
        if 0.25 < (q - p).length_squared() {
            return points;
        }
    }
}

/// Numbers that some cases in a row have in common.
enum Common<F> {
    /// Two vertices, the one at this place and the next.
    Vertices { first: usize, points: [[F; 3]; 2] },
    /// The origin and the direction, which go through one point.
    Ray { origin: [F; 3], through: [F; 3] },
}

impl<F: Float> Common<F> {
    fn drawn(shared: &mut Draw) -> Common<F> {
        let [p, q] = apart(shared);
        match shared.below(4) {
            3 => Common::Ray {
                origin: p,
                through: q,
            },
            first => Common::Vertices {
                first,
                points: [p, q],
            },
        }
    }

    /// A case, its own numbers drawn: the ray meets the plane where the triangle has these weights.
    fn case(&self, weights: [F; 3], draw: &mut Draw) -> Case<F> {
        match self {
            Common::Vertices { first, points } => {
                // Two of the three are replaced: the one that is left is the case's own.
                let mut triangle = [draw.point::<F>(); 3];
                triangle[*first] = points[0];
                triangle[(first + 1) % 3] = points[1];
                let origin = draw.point::<F>();
                let target = combination(triangle, weights);
                let direction = std::array::from_fn(|i| target[i] - origin[i]);
                Case::new(origin, direction, triangle)
            }
            Common::Ray { origin, through } => {
                let direction = std::array::from_fn(|i| through[i] - origin[i]);
                let t = F::from_f64(0.5 + draw.unit());
                let [a, b] = [draw.point::<F>(), draw.point()];
                let c = std::array::from_fn(|i| {
                    let target = origin[i] + direction[i] * t;
                    (target - a[i] * weights[0] - b[i] * weights[1]) / weights[2]
                });
                Case::new(*origin, direction, [a, b, c])
            }
        }
    }
}

impl Recipe for MixedBatch {
    const NAME: &'static str = "mixed-batch";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "four in a row share two vertices or the ray but for its interval, and every eighth has a NaN or an infinity; the others are transversal, at t > 0";
    const KEEPS: Promise =
        Promise::Truths(|truth| *truth == Truth::Invalid || truth.crossing().is_some());

    fn make<F: Scalar>(draw: &mut Draw, index: u64) -> CaseGroup<F> {
        // Neighbours have this stream in common, whatever the seed is.
        let mut shared = Draw::new(Self::NAME, 0, index / SHARING);
        let lane = shared.below(LANES as usize) as u64;
        let spoils = if shared.coin() {
            f64::NAN
        } else {
            f64::INFINITY
        };
        let common = Common::<F>::drawn(&mut shared);
        let case = loop {
            // Half of the rays miss.
            let [u, v, w] = interior_weights(draw);
            let weights = if draw.coin() {
                [u, v, w]
            } else {
                [u + w, v + w, -w]
            };
            let weights = shuffle(draw, weights);
            let case = common.case(weights.map(F::from_f64), draw);
            let [_, direction, a, b, c] = case.vectors();
            if is_steep(direction, [a, b, c]) {
                break case;
            }
        };
        // Of two groups in a row, one has a number that is not finite.
        if index % LANES != lane {
            return CaseGroup::One(case);
        }
        let mut vectors = case.vectors();
        vectors[draw.below(5)][draw.below(3)] = F::from_f64(spoils);
        let [origin, direction, a, b, c] = vectors;
        CaseGroup::One(Case::new(origin, direction, [a, b, c]))
    }
}

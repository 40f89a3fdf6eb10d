//! The five determinants whose signs decide a truth, and the way from their signs to the truth of a transversal case: the
//! one place of that logic.

use crate::truth::{Crossing, Facing, Feature, Place, Truth};
use std::cmp::Ordering;

/// The determinants that decide a truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Determinant {
    /// U, V or W: the weight of vertex 0, 1 or 2.
    Weight(usize),
    /// D = d·((b-a)×(c-a)).
    D,
    /// T = (a-o)·((b-o)×(c-o)).
    T,
}

pub(super) type FloatPoint = [f64; 3];

/// The rows of a determinant first·(second × third): d or a point, and points from which a base is
/// subtracted. D and the weights have d first; from the a of T the base is subtracted too.
#[inline]
pub(super) fn rows<V>(determinant: Determinant, [o, d, a, b, c]: [V; 5]) -> [V; 4] {
    match determinant {
        Determinant::Weight(0) => [d, c, b, o],
        Determinant::Weight(1) => [d, a, c, o],
        Determinant::Weight(_) => [d, b, a, o],
        Determinant::D => [d, b, c, a],
        Determinant::T => [a, b, c, o],
    }
}

#[cfg(test)]
pub(super) const ALL: [Determinant; 5] = [
    Determinant::Weight(0),
    Determinant::Weight(1),
    Determinant::Weight(2),
    Determinant::D,
    Determinant::T,
];

/// The signs that decide a transversal case. D is not zero.
pub(super) struct DecidingSigns {
    /// The sign of D = d·N.
    pub d: Ordering,
    /// The signs of U, V, W, the scalar triple products that weigh a, b and c.
    pub weights: [Ordering; 3],
    /// The sign of T = N·(a-o).
    pub t: Ordering,
    /// The sign of t - t_min.
    pub from_min: Ordering,
    /// The sign of t - t_max.
    pub from_max: Ordering,
}

impl DecidingSigns {
    /// U+V+W = -D, so the weights divided by their sum have the sign of U·(-D).
    #[inline(always)]
    pub fn truth(&self) -> Truth {
        let d = self.d as i8;
        // Of a quotient by D, without a branch.
        let over_d = |sign: Ordering| (sign as i8 * d).cmp(&0);
        Truth::Transversal(Crossing {
            facing: [Facing::Front, Facing::Back][usize::from(d > 0)],
            place: place(self.from_min, self.from_max),
            t_sign: over_d(self.t),
            feature: Feature::from_weight_signs(self.weights.map(|sign| over_d(sign.reverse()))),
        })
    }

    /// The same where no sign is zero, without branches: `front` is D < 0, `inside` says whether each
    /// weight has the sign of their sum, and t is not at an end.
    #[inline(always)]
    pub const fn certain(
        front: bool,
        inside: bool,
        positive_t: bool,
        past_min: bool,
        before_max: bool,
    ) -> Truth {
        // Tables, since these signs are as random as the cases.
        const FACINGS: [Facing; 2] = [Facing::Back, Facing::Front];
        const PLACES: [Place; 4] = [Place::Before, Place::Before, Place::Beyond, Place::Within];
        const SIGNS: [Ordering; 2] = [Ordering::Less, Ordering::Greater];
        const FEATURES: [Feature; 2] = [Feature::Outside, Feature::Interior];
        Truth::Transversal(Crossing {
            facing: FACINGS[front as usize],
            place: PLACES[2 * past_min as usize + before_max as usize],
            t_sign: SIGNS[positive_t as usize],
            feature: FEATURES[inside as usize],
        })
    }
}

/// Where t lies; t_min comes before t_max where both are met.
#[inline]
pub(super) fn place(from_min: Ordering, from_max: Ordering) -> Place {
    // By the two signs: below, at and above zero.
    const PLACES: [[Place; 3]; 3] = [
        [Place::Before; 3],
        [Place::AtMin; 3],
        [Place::Within, Place::AtMax, Place::Beyond],
    ];
    let [from_min, from_max] = [from_min, from_max].map(|sign| (sign as i8 + 1) as usize);
    PLACES[from_min][from_max]
}

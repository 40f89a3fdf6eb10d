//! From the signs of the predicates to the truth of a transversal case: the one place of that logic.

use crate::truth::{Crossing, Facing, Feature, Place, Truth};
use std::cmp::Ordering;

/// The signs that decide a transversal case. D is not zero.
pub(super) struct Signs {
    /// Of D = d·N.
    pub d: Ordering,
    /// Of U, V, W, the scalar triple products that weigh a, b and c.
    pub weights: [Ordering; 3],
    /// Of T = N·(a-o).
    pub t: Ordering,
    /// Of t - t_min.
    pub from_min: Ordering,
    /// Of t - t_max.
    pub from_max: Ordering,
}

impl Signs {
    /// U+V+W = -D, so the weights divided by their sum have the sign of U·(-D).
    pub fn truth(&self) -> Truth {
        let front = self.d == Ordering::Less;
        let relative = |sign: Ordering| if front { sign } else { sign.reverse() };
        Truth::Transversal(Crossing {
            facing: if front { Facing::Front } else { Facing::Back },
            place: place(self.from_min, self.from_max),
            t_sign: if front { self.t.reverse() } else { self.t },
            feature: Feature::from_weight_signs(self.weights.map(relative)),
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
pub(super) fn place(from_min: Ordering, from_max: Ordering) -> Place {
    match (from_min, from_max) {
        (Ordering::Less, _) => Place::Before,
        (Ordering::Equal, _) => Place::AtMin,
        (_, Ordering::Less) => Place::Within,
        (_, Ordering::Equal) => Place::AtMax,
        (_, Ordering::Greater) => Place::Beyond,
    }
}

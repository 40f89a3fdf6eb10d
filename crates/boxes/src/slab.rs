//! An axis of a ray and a box, turned so that the direction is positive there.

use std::ops::Neg;

/// The line enters the slab between two planes at near/size, and leaves it at far/size.
pub struct Slab<N> {
    /// From the origin to the plane where the line enters.
    pub near: N,
    /// From the origin to the plane where the line leaves.
    pub far: N,
    /// The size of the direction; not zero.
    pub size: N,
}

impl<N: Neg<Output = N>> Slab<N> {
    /// From the distances of the planes and a direction above zero.
    pub fn forward(from_min: N, from_max: N, direction: N) -> Slab<N> {
        Slab {
            near: from_min,
            far: from_max,
            size: direction,
        }
    }

    /// From the distances of the planes and a direction below zero.
    pub fn backward(from_min: N, from_max: N, direction: N) -> Slab<N> {
        Slab {
            near: -from_max,
            far: -from_min,
            size: -direction,
        }
    }
}

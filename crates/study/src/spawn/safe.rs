//! The smallest offset along the normal that is safe, of one case.

use super::hit::HitPoint;
use super::published::{along, largest};
use crate::arith::{Float, ordered_midpoint};

/// The smallest offset along the normal whose start is right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Least<F: Float> {
    /// The distance; the float below it is not enough.
    pub distance: F,
    /// The start.
    pub origin: [F; 3],
}

/// The smallest float s at which `point + normal * s`, as `--scheme normal=s` rounds it, is right. Found by
/// bisection over the floats: along the normal the height over the plane never falls, but where rounding
/// gave a coordinate of the normal the wrong sign. None if no finite distance is right.
pub fn least<F: Float>(hit: &HitPoint<F>, is_right: impl Fn([F; 3]) -> bool) -> Option<Least<F>> {
    let at = |distance: F| along(hit.point, hit.normal, distance);
    if is_right(hit.point) {
        return Some(Least { distance: F::zero(), origin: hit.point });
    }
    let (mut low, mut high) = (F::zero(), largest(hit.point).ulp());
    while !is_right(at(high)) {
        (low, high) = (high, high + high);
        if !high.is_finite() {
            return None;
        }
    }
    while let Some(middle) = ordered_midpoint(low, high) {
        *(if is_right(at(middle)) { &mut high } else { &mut low }) = middle;
    }
    Some(Least { distance: high, origin: at(high) })
}

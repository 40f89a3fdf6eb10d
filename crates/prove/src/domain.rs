//! The domain of a proof, and the format of its floats.

use super::bound::SIZE_DIGITS;
use super::dyadic::{Big, ceil_log2};
use super::{Dyadic, Measures};
use crate::arith::Float;
use crate::case::Case;
use num_traits::Zero;

/// A binary float format, rounded to nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// The digits of a significand, the leading one included: p.
    pub digits: u32,
    /// The exponent of the smallest subnormal number.
    pub smallest: i32,
    /// Every number below 2^largest is finite.
    pub largest: i32,
}

impl Format {
    /// IEEE 754's binary32.
    pub const F32: Format = Format {
        digits: 24,
        smallest: -149,
        largest: 127,
    };
    /// IEEE 754's binary64.
    pub const F64: Format = Format {
        digits: 53,
        smallest: -1074,
        largest: 1023,
    };

    /// The error of rounding a number of at most this size: half the distance of the floats just below the
    /// power of two at or above it. It covers subnormal results too.
    pub fn half_ulp_of(self, size: &Big) -> Dyadic {
        if size.is_zero() {
            return Dyadic::ZERO;
        }
        let exponent = (ceil_log2(size) - 1 - self.digits as i32).max(self.smallest - 1);
        Dyadic::power(exponent)
    }

    /// An error if a whole number is above 2^digits. Larger powers of two are floats too, but the checker of certificates refuses
    /// them.
    pub fn check_whole(self, number: i32) -> Result<(), String> {
        if u64::from(number.unsigned_abs()) <= 1 << self.digits {
            Ok(())
        } else {
            Err("it has a number of more digits than a float has".to_owned())
        }
    }

    /// Half the smallest subnormal number.
    pub fn tiny(self) -> Dyadic {
        Dyadic::power(self.smallest - 1)
    }

    /// The unit roundoff 2^-p.
    pub fn unit(self) -> Dyadic {
        Dyadic::power(-(self.digits as i32))
    }
}

/// The inputs that a program may have. Every bound is of the absolute values of coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// The bound of the edge vectors b-a, c-a and c-b.
    pub edge: Dyadic,
    /// The bound of the vectors from the origin of the ray to the vertices.
    pub reach: Dyadic,
    /// The bound of the origin and the vertices themselves.
    pub world: Dyadic,
    /// The bound of the direction.
    pub direction: Dyadic,
    /// The bound of t_min and t_max.
    pub extent: Dyadic,
    /// The largest coordinate of the direction is at least this, where a program divides by it.
    pub direction_floor: Dyadic,
    /// Every other divisor is at least this, and every root too.
    pub floor: Dyadic,
    /// Every quotient is at most this, but those of one and a divisor.
    pub quotient: Dyadic,
    /// A quotient that is a barycentric coordinate, or 1 less one, is at least minus this. Where it is not below
    /// `quotient`, that says nothing.
    pub below: Dyadic,
    /// The limits that a scene knows of divisors and quotients, instead of `floor` and `quotient`.
    pub measures: Option<Measures>,
}

impl Domain {
    /// Points and their differences just below 1: at 1 itself some sizes would reach a power of two, and the
    /// errors there twice the size. Directions up to 1.
    pub const UNIT: Domain = Domain {
        edge: Dyadic::BELOW_ONE,
        reach: Dyadic::BELOW_ONE,
        world: Dyadic::BELOW_ONE,
        direction: Dyadic::ONE,
        extent: Dyadic::ONE,
        direction_floor: Dyadic::HALF,
        floor: Dyadic::HALF,
        quotient: Dyadic::ONE,
        below: Dyadic::ZERO,
        measures: None,
    };
    /// The longest interval of a ray that begins at its origin; in a scene it is as long as the scene says.
    pub(super) fn interval<F: Float>(&self) -> [F; 2] {
        let end = self
            .measures
            .map_or(self.extent.to_f64(), |measures| measures.scene.distance);
        [F::zero(), F::from_f64(end)]
    }

    /// Half of a box that holds all points, along each axis: only their differences count.
    pub(super) fn half_box(&self) -> Dyadic {
        self.edge.max(self.reach) * Dyadic::HALF
    }

    /// All inputs with the extents of a case: its largest coordinate, its largest difference of coordinates, its largest
    /// coordinate of the direction. Nothing is known of divisors but that last one.
    pub fn of_sizes<F: Float>(case: &Case<F>) -> Option<Domain> {
        let [origin, direction, a, b, c] = case.vectors().map(|v| v.map(F::to_f64));
        let up = |x: f64| Some(Dyadic::from_f64(x.next_up())?.round_up(SIZE_DIGITS));
        let largest = |all: &[f64]| all.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let points = [origin, a, b, c];
        let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
        let apart = pairs.map(|(p, q): (usize, usize)| {
            largest(&[0, 1, 2].map(|axis| points[p][axis] - points[q][axis]))
        });
        let reach = up(largest(&apart))?;
        let world = up(largest(points.as_flattened()))?;
        let ends = [case.ray.t_min, case.ray.t_max].map(F::to_f64);
        let direction = Dyadic::from_f64(largest(&direction))?;
        let direction_floor = direction.round_down(SIZE_DIGITS);
        Some(Domain {
            edge: reach,
            reach,
            world,
            direction: direction.round_up(SIZE_DIGITS),
            extent: up(largest(&ends)).unwrap_or(Dyadic::OVERFLOW),
            direction_floor,
            floor: Dyadic::ZERO,
            // Larger than any: what limits a quotient is its numerator.
            quotient: Dyadic::power(1 << 12),
            below: Dyadic::power(1 << 12),
            measures: None,
        })
    }
}

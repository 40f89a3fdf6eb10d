//! The format of a program's floats, and the bounds of one rounding: "One rounding" in the guide.

use super::number::{Number, ceil_log2, integer, power, show, up_to};
use super::reader::Outcome;
use num_traits::{Signed, Zero};

/// The numbers that describe a format.
#[derive(Clone, Copy, PartialEq)]
pub struct Parameters {
    pub digits: i64,
    /// The exponent of the smallest subnormal number.
    pub smallest: i64,
    /// Every number below 2 to this power is finite.
    pub largest: i64,
}

pub const F32: Parameters = Parameters {
    digits: 24,
    smallest: -149,
    largest: 127,
};

pub const F64: Parameters = Parameters {
    digits: 53,
    smallest: -1074,
    largest: 1023,
};

/// A binary float format, rounded to nearest.
#[derive(Clone)]
pub struct Format {
    pub parameters: Parameters,
    /// The unit roundoff.
    pub unit: Number,
    /// Half the smallest subnormal number.
    pub tiny: Number,
}

/// Bounds of a number of a program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bound {
    /// A bound of the exact number.
    pub size: Number,
    /// A bound of the computed number.
    pub computed: Number,
    /// A bound of the difference of both.
    pub error: Number,
}

impl Bound {
    /// The bounds of a number without an error.
    pub fn exactly(size: &Number) -> Bound {
        Bound {
            size: size.clone(),
            computed: size.clone(),
            error: Number::zero(),
        }
    }
}

impl Format {
    pub fn of(parameters: Parameters) -> Format {
        Format {
            parameters,
            unit: power(-parameters.digits),
            tiny: power(parameters.smallest - 1),
        }
    }

    /// True if a whole number is a float, with at most as many digits.
    pub fn has(&self, value: i64) -> bool {
        integer(value).abs() <= power(self.parameters.digits)
    }

    /// True if it is f32 or f64, the formats in which a `minor` is defined.
    pub fn has_minor(&self) -> bool {
        [F32, F64].contains(&self.parameters)
    }

    /// The exponent of the last place of numbers that are at most as large as x, and not all smaller than half of it.
    /// Below the normal numbers it stays that of the smallest one.
    fn last_place(&self, x: &Number) -> i64 {
        let place = ceil_log2(x) - self.parameters.digits;
        place.max(self.parameters.smallest)
    }

    /// H(size): the largest error of rounding a number of at most this size. Floats are one last place apart or less
    /// there, and the nearest one is off by half of it at most.
    pub fn half_ulp(&self, size: &Number) -> Number {
        if size.is_zero() {
            return size.clone();
        }
        power(self.last_place(size) - 1)
    }

    /// F(x): the smallest float that is at least x. Rounding is monotone, so no number of at most this size is rounded
    /// above it.
    pub fn float_up(&self, x: &Number) -> Number {
        if x.is_zero() {
            return x.clone();
        }
        up_to(x, self.last_place(x))
    }

    /// An error if the number may overflow.
    pub fn finite(&self, x: &Number) -> Outcome<()> {
        if *x < power(self.parameters.largest) {
            return Ok(());
        }
        Err(format!("found {}, which may overflow", show(x)))
    }

    /// The bound of a number of this exact size, from its largest size before it is rounded.
    pub fn rounded(&self, size: Number, before: &Number) -> Bound {
        Bound {
            size,
            computed: self.float_up(before),
            error: self.half_ulp(before),
        }
    }
}

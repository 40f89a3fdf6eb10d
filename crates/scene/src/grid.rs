//! The grid on which numbers lie: the power of two of which all are multiples, and the one below which all stay.

use hairline_core::arith::decompose;

/// The grid of some floats.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// All are multiples of 2 to this power.
    lowest: i64,
    /// All are below 2 to this power.
    above: i64,
}

impl Grid {
    /// The grid of no number, or of zeros.
    pub const NONE: Grid = Grid {
        lowest: i64::MAX,
        above: i64::MIN,
    };

    /// The grid with a finite number more.
    pub fn with(self, x: f64) -> Grid {
        let (digits, exponent) = decompose(x);
        if digits == 0 {
            return self;
        }
        let bits = 64 - i64::from(digits.unsigned_abs().leading_zeros());
        Grid {
            lowest: self.lowest.min(exponent),
            above: self.above.max(exponent + bits),
        }
    }

    /// True if each number has at most this many bits on the grid.
    pub fn has_bits(self, most: i64) -> bool {
        self.is_empty() || self.above - self.lowest <= most
    }

    /// The power of two that is the unit.
    pub fn unit(self) -> i64 {
        if self.is_empty() { 0 } else { self.lowest }
    }

    /// A number of the grid in its unit.
    pub fn integer(self, x: f64) -> i128 {
        let (digits, exponent) = decompose(x);
        if digits == 0 {
            return 0;
        }
        i128::from(digits) << (exponent - self.unit())
    }

    /// True if all numbers are zero.
    fn is_empty(self) -> bool {
        self.above <= self.lowest
    }
}

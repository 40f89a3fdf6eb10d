//! Binary fractions m·2^e, exact or rounded up, for bounds.
//!
//! A bound takes few digits, so 128 bits are enough. Where they are not, the number becomes
//! [`Dyadic::OVERFLOW`], which stays what it is in every operation and is larger than any other number:
//! no bound then, never a wrong one.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// `mantissa * 2^exponent`, the mantissa odd or zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dyadic {
    mantissa: i128,
    exponent: i32,
}

impl Dyadic {
    /// Zero.
    pub const ZERO: Dyadic = Dyadic {
        mantissa: 0,
        exponent: 0,
    };
    /// One.
    pub const ONE: Dyadic = Dyadic {
        mantissa: 1,
        exponent: 0,
    };
    /// 1 - 2^-10.
    pub const BELOW_ONE: Dyadic = Dyadic {
        mantissa: 1023,
        exponent: -10,
    };
    /// 1 + 2^-9.
    pub const ABOVE_ONE: Dyadic = Dyadic {
        mantissa: 513,
        exponent: -9,
    };
    /// A half.
    pub const HALF: Dyadic = Dyadic {
        mantissa: 1,
        exponent: -1,
    };
    /// A result that needed more than 128 bits.
    pub const OVERFLOW: Dyadic = Dyadic {
        mantissa: i128::MAX,
        exponent: i32::MAX,
    };

    /// `mantissa * 2^exponent`.
    pub fn new(mantissa: i128, exponent: i32) -> Dyadic {
        if mantissa == 0 {
            return Dyadic::ZERO;
        }
        let zeros = mantissa.trailing_zeros();
        Dyadic {
            mantissa: mantissa >> zeros,
            exponent: exponent + zeros as i32,
        }
    }

    /// 2^exponent.
    pub fn power(exponent: i32) -> Dyadic {
        Dyadic {
            mantissa: 1,
            exponent,
        }
    }

    /// The exact value of a finite float; none of others.
    pub fn from_f64(value: f64) -> Option<Dyadic> {
        let (mantissa, exponent) = value.is_finite().then(|| crate::arith::decompose(value))?;
        Some(Dyadic::new(mantissa.into(), exponent as i32))
    }

    /// True if it is a number.
    pub fn is_number(self) -> bool {
        self != Dyadic::OVERFLOW
    }

    /// True if it is zero.
    pub fn is_zero(self) -> bool {
        self.mantissa == 0
    }

    /// The mantissa, odd or zero, and the exponent.
    pub fn parts(self) -> (i128, i32) {
        (self.mantissa, self.exponent)
    }

    /// Its absolute value.
    pub fn abs(self) -> Dyadic {
        if self.mantissa < 0 { -self } else { self }
    }

    /// The smallest e with self <= 2^e, for a positive number.
    pub fn ceil_log2(self) -> i32 {
        let bits = 128 - self.mantissa.leading_zeros() as i32;
        self.exponent + if self.mantissa == 1 { 0 } else { bits }
    }

    /// A positive number rounded up to so many binary digits.
    pub fn round_up(self, digits: u32) -> Dyadic {
        let bits = 128 - self.mantissa.leading_zeros();
        if bits <= digits || !self.is_number() {
            return self;
        }
        let drop = bits - digits;
        Dyadic::new((self.mantissa >> drop) + 1, self.exponent + drop as i32)
    }

    /// A positive number rounded down to so many binary digits.
    pub fn round_down(self, digits: u32) -> Dyadic {
        let bits = 128 - self.mantissa.leading_zeros();
        let drop = bits.saturating_sub(digits);
        Dyadic::new(self.mantissa >> drop, self.exponent + drop as i32)
    }

    /// The nearest float, for people.
    pub fn to_f64(self) -> f64 {
        if !self.is_number() {
            return f64::INFINITY;
        }
        let shift = (128 - self.mantissa.unsigned_abs().leading_zeros()).saturating_sub(60);
        let mantissa = (self.mantissa >> shift) as f64;
        let exponent = self.exponent + shift as i32;
        // In two steps, so that the power itself does not leave the floats' range.
        mantissa * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
    }

    /// self + other, rounded up if it must be; neither is negative.
    pub fn plus_up(self, other: Dyadic) -> Dyadic {
        let exact = self + other;
        if exact.is_number() || !self.is_number() || !other.is_number() {
            return exact;
        }
        let large = self.max(other).round_up(60);
        let small = self.min(other).round_up(60);
        let rounded = large + small;
        if rounded.is_number() {
            return rounded;
        }
        // The small one lies below the sixtieth digit of the large one.
        let (_, exponent) = large.parts();
        let bits = 128 - large.mantissa.leading_zeros() as i32;
        large + Dyadic::power(exponent + bits - 60)
    }

    /// A mantissa of 64 bits: sums and products of such need no test of their size.
    fn short(self) -> Option<i64> {
        i64::try_from(self.mantissa).ok()
    }

    fn aligned(self, exponent: i32) -> Option<i128> {
        let shift = (self.exponent - exponent) as u32;
        let free = self.mantissa.unsigned_abs().leading_zeros();
        if self.mantissa == 0 {
            Some(0)
        } else if shift + 2 <= free {
            Some(self.mantissa << shift)
        } else {
            None
        }
    }
}

impl Add for Dyadic {
    type Output = Dyadic;
    fn add(self, other: Dyadic) -> Dyadic {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        if !self.is_number() || !other.is_number() {
            return Dyadic::OVERFLOW;
        }
        let exponent = self.exponent.min(other.exponent);
        let shifts = [self.exponent - exponent, other.exponent - exponent];
        if let (Some(a), Some(b), true) =
            (self.short(), other.short(), shifts[0].max(shifts[1]) < 62)
        {
            return Dyadic::new(
                (i128::from(a) << shifts[0]) + (i128::from(b) << shifts[1]),
                exponent,
            );
        }
        match (self.aligned(exponent), other.aligned(exponent)) {
            (Some(a), Some(b)) => Dyadic::new(a + b, exponent),
            _ => Dyadic::OVERFLOW,
        }
    }
}

impl Neg for Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        if self.is_number() {
            Dyadic {
                mantissa: -self.mantissa,
                ..self
            }
        } else {
            self
        }
    }
}

impl Sub for Dyadic {
    type Output = Dyadic;
    fn sub(self, other: Dyadic) -> Dyadic {
        self + -other
    }
}

impl Mul for Dyadic {
    type Output = Dyadic;
    fn mul(self, other: Dyadic) -> Dyadic {
        if self.is_zero() || other.is_zero() {
            return Dyadic::ZERO;
        }
        if !self.is_number() || !other.is_number() {
            return Dyadic::OVERFLOW;
        }
        let product = match (self.short(), other.short()) {
            (Some(a), Some(b)) => Some(i128::from(a) * i128::from(b)),
            _ => self.mantissa.checked_mul(other.mantissa),
        };
        match product {
            // The product of odd numbers is odd.
            Some(mantissa) => Dyadic {
                mantissa,
                exponent: self.exponent + other.exponent,
            },
            None => Dyadic::OVERFLOW,
        }
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Dyadic) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Dyadic) -> Ordering {
        if !self.is_number() || !other.is_number() {
            return other.is_number().cmp(&self.is_number());
        }
        let signs = self.mantissa.signum().cmp(&other.mantissa.signum());
        if signs != Ordering::Equal || self.mantissa == 0 {
            return signs;
        }
        // The exponent of the leading digit, and the digits aligned there: so both fit.
        let size = |x: &Dyadic| {
            let digits = x.mantissa.unsigned_abs();
            let zeros = digits.leading_zeros();
            (x.exponent - zeros as i32, digits << zeros)
        };
        let sizes = size(self).cmp(&size(other));
        if self.mantissa < 0 {
            sizes.reverse()
        } else {
            sizes
        }
    }
}

/// An exact number of any length.
pub type Big = BigRational;

impl From<Dyadic> for Big {
    /// Panics for what is no number.
    fn from(x: Dyadic) -> Big {
        assert!(x.is_number(), "a number that needed more digits");
        let power = BigInt::one() << x.exponent.unsigned_abs();
        let mantissa = BigInt::from(x.mantissa);
        // An odd number over a power of two has no common factor.
        if x.exponent < 0 {
            Big::new_raw(mantissa, power)
        } else {
            Big::from(mantissa * power)
        }
    }
}

/// A whole number.
pub fn whole(x: i64) -> Big {
    Big::from_integer(x.into())
}

/// The smallest e with x <= 2^e, for a positive x.
pub fn ceil_log2(x: &Big) -> i32 {
    let bits = |n: &BigInt| n.bits() as i32;
    let exponent = bits(x.numer()) - bits(x.denom());
    // One less or one more than the difference of the lengths.
    (exponent - 1..exponent + 1)
        .find(|e| above(x, *e).is_one())
        .unwrap_or(exponent + 1)
}

/// The smallest whole number that is at least x / 2^exponent, for a positive x. It is no fraction on the way, so that no
/// common factors are sought.
fn above(x: &Big, exponent: i32) -> BigInt {
    let by = exponent.unsigned_abs();
    let (down, up) = if exponent < 0 { (0, by) } else { (by, 0) };
    let (numerator, divisor) = (x.numer() << up, x.denom() << down);
    (numerator + &divisor - BigInt::one()) / divisor
}

/// The smallest number of so many binary digits that is at least x, which is not negative.
pub fn round_up(x: &Big, digits: u32) -> Dyadic {
    if !x.is_positive() {
        return Dyadic::ZERO;
    }
    let last = ceil_log2(x) - digits as i32;
    Dyadic::new(above(x, last).to_i128().expect("few digits"), last)
}

/// The smallest number of so many binary digits whose square is at least x, which is not negative.
pub fn root_up(x: &Big, digits: u32) -> Dyadic {
    if !x.is_positive() {
        return Dyadic::ZERO;
    }
    let last = (ceil_log2(x) + 1).div_euclid(2) - digits as i32;
    let scaled = above(x, 2 * last);
    let root = scaled.sqrt();
    let is_exact = &root * &root == scaled;
    let root = root.to_i128().expect("few digits") + i128::from(!is_exact);
    round_up(&Big::from(Dyadic::new(root, last)), digits)
}

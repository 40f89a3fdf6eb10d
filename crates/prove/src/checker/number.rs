//! Exact numbers, rounded up where a rule says so, and the format of a program's floats.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};
use std::str::FromStr;

/// An exact number.
pub type Number = BigRational;

/// Binary digits of a lemma's errors.
pub const ERROR_DIGITS: i64 = 24;
/// Binary digits of a lemma's size.
pub const SIZE_DIGITS: i64 = 12;
/// Larger exponents are not read.
const MOST_EXPONENT: i64 = 1 << 12;

/// A number as `show` writes it: the mantissa odd, no sign that says nothing.
pub fn number(word: &str) -> Option<Number> {
    let (mantissa, exponent) = word.split_once("*2^").unwrap_or((word, "0"));
    let (mantissa, exponent) = (
        mantissa.parse::<i128>().ok()?,
        exponent.parse::<i64>().ok()?,
    );
    let is_fair = 0 <= mantissa && (-MOST_EXPONENT..=MOST_EXPONENT).contains(&exponent);
    let found = is_fair.then(|| shifted(&Number::from(BigInt::from(mantissa)), exponent));
    found.filter(|found| show(found) == word)
}

/// A whole number, written in the one way.
pub fn whole<T: FromStr + ToString>(word: &str) -> Option<T> {
    word.parse()
        .ok()
        .filter(|found: &T| found.to_string() == word)
}

pub fn show(x: &Number) -> String {
    match split(x) {
        (mantissa, 0) => mantissa.to_string(),
        (mantissa, exponent) => format!("{mantissa}*2^{exponent}"),
    }
}

pub fn power(exponent: i64) -> Number {
    let power = BigInt::one() << exponent.unsigned_abs();
    if exponent < 0 {
        Number::new_raw(BigInt::one(), power)
    } else {
        Number::from(power)
    }
}

/// x * 2^exponent. Only factors of two are common to numerator and denominator.
pub fn shifted(x: &Number, exponent: i64) -> Number {
    let part = |of: &BigInt, most: u64| of.trailing_zeros().unwrap_or(0).min(most);
    let size = exponent.unsigned_abs();
    let (numer, denom) = (x.numer(), x.denom());
    if x.is_zero() {
        x.clone()
    } else if exponent < 0 {
        let common = part(numer, size);
        Number::new_raw(numer >> common, denom << (size - common))
    } else {
        let common = part(denom, size);
        Number::new_raw(numer << (size - common), denom >> common)
    }
}

/// The odd mantissa and the exponent of a binary fraction.
pub fn split(x: &Number) -> (BigInt, i64) {
    let zeros = x.numer().trailing_zeros().unwrap_or(0);
    (
        x.numer() >> zeros,
        zeros as i64 - (x.denom().bits() as i64 - 1),
    )
}

/// The smallest e with x <= 2^e, for a positive x.
fn ceil_log2(x: &Number) -> i64 {
    let least = x.numer().bits() as i64 - x.denom().bits() as i64 - 1;
    (least..)
        .find(|e| *x <= power(*e))
        .expect("2^e is above x at last")
}

/// The smallest multiple of 2^last that is at least x.
fn up_to(x: &Number, last: i64) -> Number {
    shifted(&shifted(x, -last).ceil(), last)
}

/// The smallest number of so many binary digits that is at least x.
pub fn round_up(x: &Number, digits: i64) -> Number {
    if x.is_zero() {
        x.clone()
    } else {
        up_to(x, ceil_log2(x) - digits)
    }
}

/// The smallest number of so many binary digits whose square is at least x.
pub fn root_up(x: &Number, digits: i64) -> Number {
    if x.is_zero() {
        return x.clone();
    }
    // The root lies in (2^(e-1), 2^e].
    let e = (ceil_log2(x) + 1).div_euclid(2);
    let scaled = shifted(x, 2 * (digits - e)).ceil().to_integer();
    let root = scaled.sqrt();
    let root = if &root * &root < scaled {
        root + 1
    } else {
        root
    };
    round_up(&shifted(&Number::from(root), e - digits), digits)
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

/// Digits, exponent of the smallest subnormal number, and L: every number below 2^L is finite.
pub const F32: [i64; 3] = [24, -149, 127];
pub const F64: [i64; 3] = [53, -1074, 1023];

/// A binary float format, rounded to nearest.
#[derive(Clone)]
pub struct Format {
    pub parameters: [i64; 3],
    /// The unit roundoff.
    pub unit: Number,
    /// Half the smallest subnormal number.
    pub tiny: Number,
}

impl Format {
    pub fn of(parameters: [i64; 3]) -> Format {
        let [digits, smallest, _] = parameters;
        Format {
            parameters,
            unit: power(-digits),
            tiny: power(smallest - 1),
        }
    }

    /// The largest error of rounding a number of at most this size.
    pub fn half_ulp(&self, size: &Number) -> Number {
        let [digits, smallest, _] = self.parameters;
        if size.is_zero() {
            size.clone()
        } else {
            power((ceil_log2(size) - digits).max(smallest) - 1)
        }
    }

    /// An error if the number may overflow.
    pub fn finite(&self, x: &Number) -> Result<(), String> {
        let is_finite = *x < power(self.parameters[2]);
        is_finite
            .then_some(())
            .ok_or_else(|| format!("found {}, which may overflow", show(x)))
    }

    /// The bound of a number of this exact size, from its largest size before it is rounded.
    pub fn rounded(&self, size: Number, before: &Number) -> Bound {
        Bound {
            size,
            computed: self.float_up(before),
            error: self.half_ulp(before),
        }
    }

    /// The smallest float that is at least x: no number of at most this size is rounded above it.
    pub fn float_up(&self, x: &Number) -> Number {
        let [digits, smallest, _] = self.parameters;
        if x.is_zero() {
            x.clone()
        } else {
            up_to(x, (ceil_log2(x) - digits).max(smallest))
        }
    }
}

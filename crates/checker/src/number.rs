//! Exact numbers: how a certificate writes them, and how a rule rounds them up.

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

/// Reads a number, if it is written as `show` writes it: the mantissa odd, no sign that says nothing.
pub fn number(word: &str) -> Option<Number> {
    let parts = word.split_once("*2^");
    let (mantissa, exponent) = parts.unwrap_or((word, "0"));
    let mantissa: i128 = mantissa.parse().ok()?;
    let exponent: i64 = exponent.parse().ok()?;
    let is_near = (-MOST_EXPONENT..=MOST_EXPONENT).contains(&exponent);
    if mantissa < 0 || !is_near {
        return None;
    }
    let mantissa = BigInt::from(mantissa);
    let found = shifted(&mantissa.into(), exponent);
    (show(&found) == word).then_some(found)
}

/// Reads a whole number, if it is written in the one way.
pub fn whole<T: FromStr + ToString>(word: &str) -> Option<T> {
    let found: T = word.parse().ok()?;
    (found.to_string() == word).then_some(found)
}

/// The one way to write a number.
pub fn show(x: &Number) -> String {
    let Binary { mantissa, exponent } = split(x);
    match exponent {
        0 => mantissa.to_string(),
        _ => format!("{mantissa}*2^{exponent}"),
    }
}

/// A whole number.
pub fn integer(value: i64) -> Number {
    Number::from_integer(value.into())
}

/// A power of two.
pub fn power(exponent: i64) -> Number {
    let power = BigInt::one() << exponent.unsigned_abs();
    let found = Number::from(power);
    if exponent < 0 { found.recip() } else { found }
}

/// x * 2^exponent. Only factors of two are common to numerator and denominator.
pub fn shifted(x: &Number, exponent: i64) -> Number {
    if x.is_zero() {
        return x.clone();
    }
    let size = exponent.unsigned_abs();
    let halved = if exponent < 0 { x.numer() } else { x.denom() };
    let common = twos(halved).min(size);
    let left = size - common;
    if exponent < 0 {
        Number::new_raw(x.numer() >> common, x.denom() << left)
    } else {
        Number::new_raw(x.numer() << left, x.denom() >> common)
    }
}

/// How many times a number can be halved; 0 for 0.
fn twos(x: &BigInt) -> u64 {
    x.trailing_zeros().unwrap_or(0)
}

/// A binary fraction: an odd mantissa, or 0, times a power of two.
pub struct Binary {
    mantissa: BigInt,
    pub exponent: i64,
}

/// The parts of a number whose denominator is a power of two.
pub fn split(x: &Number) -> Binary {
    let zeros = twos(x.numer());
    let places = x.denom().bits() as i64 - 1;
    Binary {
        mantissa: x.numer() >> zeros,
        exponent: zeros as i64 - places,
    }
}

/// The smallest e with x <= 2^e, for a positive x.
pub fn ceil_log2(x: &Number) -> i64 {
    let of_numerator = x.numer().bits() as i64;
    let of_denominator = x.denom().bits() as i64;
    let mut exponent = of_numerator - of_denominator - 1;
    while power(exponent) < *x {
        exponent += 1;
    }
    exponent
}

/// The smallest multiple of 2^last that is at least x.
pub fn up_to(x: &Number, last: i64) -> Number {
    shifted(&shifted(x, -last).ceil(), last)
}

/// The smallest number with this many binary digits that is at least x.
pub fn round_up(x: &Number, digits: i64) -> Number {
    if x.is_zero() {
        return x.clone();
    }
    up_to(x, ceil_log2(x) - digits)
}

/// The smallest number with this many binary digits whose square is at least x.
pub fn root_up(x: &Number, digits: i64) -> Number {
    if x.is_zero() {
        return x.clone();
    }
    // The root lies in (2^(e-1), 2^e].
    let e = (ceil_log2(x) + 1).div_euclid(2);
    let places = digits - e;
    let scaled = shifted(x, 2 * places).ceil().to_integer();
    let mut root = scaled.sqrt();
    if &root * &root < scaled {
        root += 1;
    }
    let found = shifted(&root.into(), -places);
    round_up(&found, digits)
}

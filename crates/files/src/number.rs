//! Floats as text: read correctly rounded, written so that every reader gets the same float back.

use super::json::quoted;
use crate::arith::Float;
use std::num::IntErrorKind;

/// The most characters of a number. The exact decimal of an `f64` has at most 1,077.
const LONGEST: usize = 4096;

/// The float nearest to a text, ties to even, straight from the text (an `f32` never through
/// `f64`): a decimal (`-1.5e-3`), a hexadecimal float with its binary exponent (`0x1.8p-3`), a bit pattern
/// (`0x3e4ccccd` of an `f32`, 16 digits of an `f64`), or an infinity or a NaN as programs print it (`inf`, `-Infinity`,
/// `NaN`, `-nan(ind)`). A decimal may end in the `f` of a C literal, or in the scalar's name, as in Rust.
///
/// A finite text that overflows is an error; one that underflows is a zero of its sign.
pub fn parse<F: Float>(text: &str) -> Result<F, String> {
    if text.len() > LONGEST {
        return Err(format!(
            "{} has more than {LONGEST} characters",
            quoted(text)
        ));
    }
    let magnitude = text.strip_prefix(['-', '+']).unwrap_or(text);
    let value = match magnitude.to_ascii_lowercase().as_str() {
        "inf" | "infinity" => Some(F::infinity()),
        word if word == "nan" || word.starts_with("nan(") && word.ends_with(')') => F::parse("nan"),
        _ => finite(magnitude).map_err(|wrong| format!("{} {wrong}", quoted(text)))?,
    };
    match value {
        Some(value) if text.starts_with('-') => Ok(-value),
        Some(value) => Ok(value),
        None => Err(format!(
            "{} is not a number: write a decimal (-1.5e-3), a hexadecimal float (0x1.8p-3), a bit pattern (0x3e4ccccd), inf \
             or nan",
            quoted(text)
        )),
    }
}

/// JSON text that reads back to the very same float from every reader that parses IEEE doubles: the
/// shortest decimal of the value as an `f64`, and for what JSON has no number the strings `"nan"`,
/// `"inf"` and `"-inf"`.
pub fn write<F: Float>(value: F) -> String {
    write_shortest(value.to_f64())
}

/// JSON text that reads back to the very same float where it is read in its own scalar, as all commands do: the shortest
/// decimal that does so.
pub fn write_shortest<F: Float>(value: F) -> String {
    let size = value.to_f64().abs();
    if size.is_nan() {
        "\"nan\"".to_owned()
    } else if size.is_infinite() {
        format!("\"{value}\"")
    } else if size == 0.0 {
        // `-0` is an integer to some readers, and loses its sign.
        if value.is_sign_negative() {
            "-0.0"
        } else {
            "0"
        }
        .to_owned()
    } else if (1e-5..1e15).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// An unsigned finite number; none if the text is none.
fn finite<F: Float>(text: &str) -> Result<Option<F>, String> {
    let value = match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        // A pattern is what it is, an infinity too.
        Some(digits) if digits.len() == F::zero().hex().len() && is_pattern(digits) => {
            return Ok(u64::from_str_radix(digits, 16).ok().map(F::from_bits));
        }
        Some(digits) if !digits.is_empty() && !digits.contains(['p', 'P']) => {
            let digits = F::zero().hex().len();
            return Err(format!(
                "needs a binary exponent, as 0x1.8p-3, or {digits} digits, as the bits of an {} have",
                F::NAME
            ));
        }
        Some(digits) => hexadecimal(digits),
        None if text.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
            let suffix = text
                .strip_suffix(F::NAME.name())
                .map(|rest| rest.trim_end_matches('_'));
            let decimal = suffix.or_else(|| text.strip_suffix(['f', 'F']));
            let decimal = decimal.filter(|rest| !rest.ends_with(['e', 'E']));
            F::parse(decimal.unwrap_or(text))
        }
        None => None,
    };
    match value {
        Some(value) if !value.is_finite() => Err(format!("overflows {}", F::NAME)),
        value => Ok(value),
    }
}

fn is_pattern(digits: &str) -> bool {
    digits.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// `digits.digits p exponent`, after the 0x; infinity if it overflows.
fn hexadecimal<F: Float>(text: &str) -> Option<F> {
    let (significand, power) = text.split_once(['p', 'P'])?;
    let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    let mut exponent = binary_exponent(power)?;
    let (mut integer, mut inexact) = (0u128, false);
    for (place, digit) in whole.chars().chain(fraction.chars()).enumerate() {
        let digit = digit.to_digit(16)?;
        let in_fraction = place >= whole.len();
        if integer >> 120 == 0 {
            integer = integer << 4 | u128::from(digit);
            exponent -= if in_fraction { 4 } else { 0 };
        } else {
            inexact |= digit != 0;
            exponent += if in_fraction { 0 } else { 4 };
        }
    }
    Some(rounded(integer, inexact, exponent))
}

/// A decimal exponent; what is beyond every float's is cut off well beyond every float's.
fn binary_exponent(text: &str) -> Option<i64> {
    const MOST: i64 = 1 << 30;
    // A number that is too large is one before its last characters are read.
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    if !digits.bytes().all(|digit| digit.is_ascii_digit()) {
        return None;
    }
    match text.parse::<i64>() {
        Ok(exponent) => Some(exponent.clamp(-MOST, MOST)),
        Err(error) => match error.kind() {
            IntErrorKind::PosOverflow => Some(MOST),
            IntErrorKind::NegOverflow => Some(-MOST),
            _ => None,
        },
    }
}

/// The float nearest to `integer * 2^exponent`, or to a little more where `inexact` (by less than
/// one unit of an integer that then has more than 120 bits); ties to even. `integer` is below
/// 2^124.
pub fn rounded<F: Float>(integer: u128, inexact: bool, exponent: i64) -> F {
    if integer == 0 {
        return F::zero();
    }
    let [digits, lowest, highest] = [
        i64::from(F::DIGITS),
        F::MIN_EXPONENT.into(),
        F::MAX_EXPONENT.into(),
    ];
    let top = exponent + i64::from(integer.ilog2());
    if top > highest {
        return F::infinity();
    }
    // The result counts units of 2^unit.
    let unit = (top + 1 - digits).max(lowest);
    let shift = unit - exponent;
    let units = match shift {
        ..=0 => integer << -shift,
        1..=127 => {
            let (units, rest, half) = (
                integer >> shift,
                integer & ((1 << shift) - 1),
                1 << (shift - 1),
            );
            let up = rest > half || rest == half && (inexact || units & 1 == 1);
            units + u128::from(up)
        }
        _ => 0,
    };
    // The hidden bit, and a carry out of the significand, add one to the exponent field.
    F::from_bits((((unit - lowest) as u64) << (digits - 1)) + units as u64)
}

#[cfg(test)]
mod tests;

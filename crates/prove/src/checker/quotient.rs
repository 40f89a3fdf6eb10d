//! The rule of quotients: n/d, or by a rounded reciprocal n*(1/d). The guide has it in "Quotients".

use super::format::{Bound, Format};
use super::formula::Formula;
use super::number::{ERROR_DIGITS, Number, SIZE_DIGITS, round_up};
use super::program::{Fraction, Program};
use super::reader::{Outcome, Reader, ensure};
use super::variables::Quotient;
use num_traits::One;

pub const UNFIT: &str = "found a rule that does not fit its operation";

/// The fraction that an operation is, computed by a reciprocal or by a division as the rule says.
pub fn fraction(program: &Program, place: usize, by_reciprocal: bool) -> Outcome<Fraction> {
    let fraction = program.fraction(place).ok_or(UNFIT)?;
    let is_product = program.name(place) == "mul";
    ensure(is_product == by_reciprocal, UNFIT)?;
    Ok(fraction)
}

/// The least size of a computed divisor: of an exact one, less its error. It must not be rounded to zero.
pub fn least(program: &Program, divisor: usize) -> Outcome<Number> {
    let least = program.floor(divisor) - &program.bound(divisor)?.error;
    let tiny = &program.format.tiny;
    ensure(
        least > tiny + tiny,
        "found a divisor that may be rounded to zero, expected a larger floor",
    )?;
    Ok(least)
}

/// The least size of the divisor that a formula uses: if its last rounding is left out, the divisor is as it was before.
pub fn closest(program: &Program, formula: &Formula, divisor: usize) -> Outcome<Number> {
    if formula.leaves_out(program, divisor) {
        Ok(program.floor(divisor) - &program.lemma(divisor)?.before)
    } else {
        least(program, divisor)
    }
}

/// The change of a quotient by one rounding that is left out: at most this share of its size, and this number.
///
/// With e = u + tiny, the rounding is a factor between 1 - e and 1 + e of numerator or divisor, or the numerator
/// underflows. (1 + e)/(1 - e) is 1 + 2e/(1 - e), so of each rounding e/(1 - e) is enough.
pub struct LeftOut {
    pub share: Number,
    pub tiny: Number,
}

impl LeftOut {
    pub fn by(format: &Format, least: &Number) -> LeftOut {
        let tiny = &format.tiny / least;
        let e = &format.unit + &tiny;
        let share = &e / (Number::one() - &e);
        LeftOut { share, tiny }
    }
}

/// The change of a quotient of this size if the divisor's reciprocal is rounded before it is multiplied: the reciprocal
/// is off by a relative u, and by a tiny number if it underflows.
pub fn of_reciprocal(format: &Format, size: &Number, numerator: &Bound) -> Number {
    &format.unit * size + &format.tiny * &numerator.computed
}

/// The bound of a number that is rounded once more: its exact size, and its error and size before that.
pub fn rounded(format: &Format, size: Number, error: Number, before: &Number) -> Outcome<Bound> {
    let mut bound = format.rounded(size, before);
    format.finite(&bound.computed)?;
    bound.error = round_up(&(error + bound.error), ERROR_DIGITS);
    Ok(bound)
}

/// The bound of a quotient.
///
/// n*/d* - n/d is (n* - q*d*)/d*. The formula n - q*d is 0 in exact arithmetic, so its error bounds the numerator, and d*
/// is at least as large as the `closest` divisor. Then the roundings that the formula leaves out are added.
pub fn bound(
    program: &Program,
    place: usize,
    by_reciprocal: bool,
    reader: &mut Reader,
) -> Outcome<Bound> {
    let format = &program.format;
    let Fraction { numerator, divisor } = fraction(program, place, by_reciprocal)?;
    let mut numerators = vec![numerator];
    let mut above = Bound::exactly(&Number::one());
    if !by_reciprocal && program.is_one(numerator) {
        numerators.clear();
    } else {
        above = program.bound(numerator)?.clone();
    }
    let least = least(program, divisor)?;
    if by_reciprocal {
        // The reciprocal must not overflow, although the product may be small.
        format.finite(&round_up(&least.recip(), ERROR_DIGITS))?;
    }
    let is_ordered = is_ordered(program, numerator, divisor);
    let size = if is_ordered {
        Number::one()
    } else if numerators.is_empty() {
        program.floor(divisor).recip()
    } else {
        let size = &above.size / program.floor(divisor);
        size.min(program.most(place).clone())
    };
    let size = round_up(&size, SIZE_DIGITS);
    let quotient = Quotient {
        size: &size,
        down_to: program.down_to(place),
    };
    let formula = Formula::read(program, Some(quotient), reader)?;
    ensure(
        formula.is_quotient_of(&numerators, divisor),
        "found other last steps, expected numerator - quotient * divisor",
    )?;
    let closest = closest(program, &formula, divisor)?;
    let mut error = formula.maximum(format, reader)?.error / closest;
    let mut count = i64::from(formula.leaves_out(program, divisor));
    for numerator in numerators {
        count += i64::from(formula.leaves_out(program, numerator));
    }
    if count > 0 {
        let left_out = LeftOut::by(format, &least);
        let largest = &size + &error;
        error += left_out.share * Number::from_integer(count.into()) * largest;
        error += left_out.tiny;
    }
    let mut before = &size + &error;
    if by_reciprocal {
        let change = of_reciprocal(format, &before, &above);
        error += &change;
        before += change;
    } else if is_ordered {
        // |n| <= |d|, both without errors, and rounding is monotone: it is rounded to at most 1. With a reciprocal that
        // is a subnormal number the product can be rounded above 1.
        before = Number::one();
    }
    rounded(format, size, error, &before)
}

/// True if a numerator is at most as large as the divisor because the path says so of these inputs.
fn is_ordered(program: &Program, numerator: usize, divisor: usize) -> bool {
    match (program.input(numerator), program.input(divisor)) {
        (Some(smaller), Some(larger)) => program.orders.contains(&(smaller, larger)),
        _ => false,
    }
}

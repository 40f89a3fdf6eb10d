//! The rule of quotients: n/d, or by a rounded reciprocal n*(1/d). The guide has it in "Quotients".

use super::format::{Bound, Format};
use super::formula::Formula;
use super::number::{ERROR_DIGITS, Number, SIZE_DIGITS, integer, round_up};
use super::program::{Fraction, Program};
use super::reader::{Outcome, Reader, ensure};
use super::variables::Quotient;

pub const UNFIT: &str = "found a rule that does not fit its operation";

/// The fraction that an operation is, computed by a reciprocal or by a division as the rule says.
pub fn fraction(program: &Program, place: usize, by_reciprocal: bool) -> Outcome<Fraction> {
    let fraction = program.fraction(place).ok_or(UNFIT)?;
    let is_product = program.name(place) == "mul";
    ensure(is_product == by_reciprocal, UNFIT)?;
    Ok(fraction)
}

/// The divisor of a quotient, or of two.
pub struct Divisor<'p> {
    program: &'p Program,
    place: usize,
    /// The least size of the computed divisor: φ - E_d in the guide.
    least: Number,
    /// The change of a quotient by one rounding that is left out, as a share of its size: ε/(1 - ε) in the guide.
    ///
    /// The rounding is a factor between 1 - ε and 1 + ε of numerator or divisor, or the numerator underflows.
    /// (1 + ε)/(1 - ε) is 1 + 2ε/(1 - ε), so of each rounding ε/(1 - ε) is enough.
    pub share: Number,
    /// The change of a quotient by an underflow that is left out.
    pub tiny: Number,
}

impl<'p> Divisor<'p> {
    /// An error if the computed divisor may be rounded to zero.
    pub fn new(program: &'p Program, place: usize) -> Outcome<Self> {
        let Format { unit, tiny, .. } = &program.format;
        let error = &program.bound(place)?.error;
        let least = program.floor(place) - error;
        ensure(
            least > tiny + tiny,
            "found a divisor that may be rounded to zero, expected a larger floor",
        )?;
        let tiny = tiny / &least;
        let epsilon = unit + &tiny;
        let rest = integer(1) - &epsilon;
        Ok(Divisor {
            program,
            place,
            least,
            share: epsilon / rest,
            tiny,
        })
    }

    /// C in the guide's "Quotients": the error of n*/d*.
    ///
    /// n*/d* - n/d is (n* - q*d*)/d*. The formula n - q*d is 0 in exact arithmetic, so its error bounds the numerator.
    pub fn error(&self, formula: &Formula, reader: &mut Reader) -> Outcome<Number> {
        let closest = self.closest(formula)?;
        let shown = formula.maximum(reader)?;
        Ok(shown.bound.error / closest)
    }

    /// The least size of d*: if its last rounding is left out, the divisor is as it was before.
    fn closest(&self, formula: &Formula) -> Outcome<Number> {
        if !formula.leaves_out(self.place) {
            return Ok(self.least.clone());
        }
        let lemma = self.program.lemma(self.place)?;
        Ok(self.program.floor(self.place) - &lemma.before)
    }

    /// The change of a quotient of this size by a rounding that is left out, and by an underflow.
    pub fn left_out(&self, size: &Number) -> Number {
        &self.share * size + &self.tiny
    }
}

/// R in the guide: the change of a quotient of this size if the divisor's reciprocal is rounded before it is multiplied.
/// The reciprocal is off by a relative u, and by a tiny number if it underflows.
pub fn of_reciprocal(format: &Format, size: &Number, numerator: &Bound) -> Number {
    &format.unit * size + &format.tiny * &numerator.computed
}

/// The bound of a number that is rounded once more: its exact size, and its error and size before that.
pub fn rounded(format: &Format, size: Number, error: Number, before: &Number) -> Outcome<Bound> {
    let mut bound = format.rounded(size, before);
    format.finite(&bound.computed)?;
    bound.error += error;
    bound.error = round_up(&bound.error, ERROR_DIGITS);
    Ok(bound)
}

/// The bound of a quotient: C, the roundings that its formula leaves out, and those of the division.
pub fn bound(
    program: &Program,
    place: usize,
    by_reciprocal: bool,
    reader: &mut Reader,
) -> Outcome<Bound> {
    let format = &program.format;
    let Fraction { numerator, divisor } = fraction(program, place, by_reciprocal)?;
    let is_inverse = program.is_one(numerator) && !by_reciprocal;
    let numerators = if is_inverse { vec![] } else { vec![numerator] };
    let above = if is_inverse {
        Bound::exactly(&integer(1))
    } else {
        program.bound(numerator)?.clone()
    };
    let by = Divisor::new(program, divisor)?;
    if by_reciprocal {
        // The reciprocal must not overflow, although the product may be small.
        let reciprocal = by.least.recip();
        format.finite(&round_up(&reciprocal, ERROR_DIGITS))?;
    }
    let is_ordered = is_ordered(program, numerator, divisor);
    let mut size = &above.size / program.floor(divisor);
    if is_ordered {
        size = integer(1);
    } else if !is_inverse {
        size = size.min(program.most(place).clone());
    }
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
    let mut error = by.error(&formula, reader)?;
    let mut operands = numerators;
    operands.push(divisor);
    operands.retain(|operand| formula.leaves_out(*operand));
    if !operands.is_empty() {
        let count = integer(operands.len() as i64);
        let largest = &size + &error;
        error += by.left_out(&(count * largest));
    }
    let mut before = &size + &error;
    if by_reciprocal {
        let change = of_reciprocal(format, &before, &above);
        error += &change;
        before += change;
    } else if is_ordered {
        // |n| <= |d|, both without errors, and rounding is monotone: it is rounded to at most 1. With a reciprocal that
        // is a subnormal number the product can be rounded above 1.
        before = integer(1);
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

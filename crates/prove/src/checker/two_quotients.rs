//! The rules of two quotients by one divisor together: "Two quotients by one divisor" in the guide.

use super::format::Bound;
use super::formula::Formula;
use super::number::{Number, SIZE_DIGITS, round_up};
use super::program::Program;
use super::quotient::{LeftOut, UNFIT, closest, fraction, least, of_reciprocal, rounded};
use super::reader::{Outcome, Reader, ensure};
use super::variables::Quotient;
use num_traits::One;

/// Two quotients that have lemmas, and what is known of their sum in exact arithmetic.
struct Pair {
    u: usize,
    v: usize,
    by_reciprocal: bool,
    /// The largest size of the sum.
    size: Number,
    /// How far below zero the sum may be, if that is supposed.
    down_to: Option<Number>,
}

/// The bound of u + v.
pub fn sum(
    program: &Program,
    place: usize,
    by_reciprocal: bool,
    reader: &mut Reader,
) -> Outcome<Bound> {
    let (u, v) = operands(program, place, "add")?;
    let both = &program.bound(u)?.size + &program.bound(v)?.size;
    let pair = Pair {
        u,
        v,
        by_reciprocal,
        size: at_most(both, program.most(place)),
        down_to: program.down_to(place).cloned(),
    };
    let error = pair.error(program, reader)?;
    let before = &pair.size + &error;
    rounded(&program.format, pair.size, error, &before)
}

/// The bound of (1 - u) - v, where 1 - u has a lemma too.
///
/// The sum of both is 1 less this number. So it lies between 1 - `quotient` and 1 + X, if this number is supposed to be
/// at least -X; else it is at most 1 + `quotient` in size.
pub fn rest(
    program: &Program,
    place: usize,
    by_reciprocal: bool,
    reader: &mut Reader,
) -> Outcome<Bound> {
    let (remainder, v) = operands(program, place, "sub")?;
    let (one, u) = operands(program, remainder, "sub")?;
    ensure(program.is_one(one), UNFIT)?;
    let both = &program.bound(u)?.size + &program.bound(v)?.size;
    let most = program.most(place);
    let mut sum_down_to = None;
    let mut sum_most = Number::one() + most;
    if let Some(down_to) = program.down_to(place) {
        let below = most - Number::one();
        sum_most = below.clone().max(Number::one() + down_to);
        sum_down_to = Some(below);
    }
    let size = at_most(&both + Number::one(), most);
    let pair = Pair {
        u,
        v,
        by_reciprocal,
        size: at_most(both, &sum_most),
        down_to: sum_down_to,
    };
    let mut error = pair.error(program, reader)?;
    let first = program.bound(remainder)?;
    error += program.format.half_ulp(&(&first.size + &first.error));
    let before = &size + &error;
    rounded(&program.format, size, error, &before)
}

/// Both operands of an operation with this name.
fn operands(program: &Program, place: usize, name: &str) -> Outcome<(usize, usize)> {
    match program.operands(place) {
        &[left, right] if program.name(place) == name => Ok((left, right)),
        _ => Err(UNFIT.to_owned()),
    }
}

/// A size that has another bound, with a lemma's digits.
fn at_most(size: Number, most: &Number) -> Number {
    round_up(&size.min(most.clone()), SIZE_DIGITS)
}

impl Pair {
    /// The error of the sum of both computed quotients.
    ///
    /// The formula is n + m - q*d, q being u + v. It is 0 in exact arithmetic, and the errors that n, m and d have in
    /// common count once in it, as for one quotient. The roundings that it leaves out are added, then those of u and v.
    fn error(&self, program: &Program, reader: &mut Reader) -> Outcome<Number> {
        let format = &program.format;
        let u = fraction(program, self.u, self.by_reciprocal)?;
        let v = fraction(program, self.v, self.by_reciprocal)?;
        ensure(self.u != self.v && u.divisor == v.divisor, UNFIT)?;
        let divisor = u.divisor;
        let left_out = LeftOut::by(format, &least(program, divisor)?);
        let quotient = Quotient {
            size: &self.size,
            down_to: self.down_to.as_ref(),
        };
        let formula = Formula::read(program, Some(quotient), reader)?;
        ensure(
            formula.is_quotient_of(&[u.numerator, v.numerator], divisor),
            "found other last steps, expected numerator + numerator - quotient * divisor",
        )?;
        let closest = closest(program, &formula, divisor)?;
        let mut error = formula.maximum(format, reader)?.error / closest;
        if formula.leaves_out(program, divisor) {
            let largest = &self.size + &error;
            error += &left_out.share * largest;
            error += &left_out.tiny;
        }
        for (place, numerator) in [(self.u, u.numerator), (self.v, v.numerator)] {
            let own = program.bound(place)?;
            // P of the guide: it bounds the quotient, whatever its own lemma or this formula leaves out.
            let mut largest = &own.size + &own.error + &left_out.tiny;
            largest *= Number::one() + &left_out.share + &left_out.share;
            if formula.leaves_out(program, numerator) {
                error += &left_out.share * &largest;
                error += &left_out.tiny;
            }
            if self.by_reciprocal {
                let change = of_reciprocal(format, &largest, program.bound(numerator)?);
                error += &change;
                largest += change;
            }
            error += format.half_ulp(&largest);
        }
        Ok(error)
    }
}

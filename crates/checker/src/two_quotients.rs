//! The rules of two quotients by one divisor together: "Two quotients by one divisor" in the guide.

use super::format::Bound;
use super::formula::Formula;
use super::number::{Number, SIZE_DIGITS, integer, round_up};
use super::program::{Fraction, Program};
use super::quotient::{Divisor, UNFIT, fraction, of_reciprocal, rounded};
use super::reader::{Outcome, Reader, ensure};
use super::variables::Quotient;

/// Two quotients that have lemmas, and what is known of their sum in exact arithmetic.
struct Pair<'p> {
    program: &'p Program,
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
    let [u, v] = operands(program, place, "add")?;
    let mut pair = Pair {
        program,
        u,
        v,
        by_reciprocal,
        size: program.most(place).clone(),
        down_to: program.down_to(place).cloned(),
    };
    let both = pair.sizes()?;
    pair.size = least(pair.size, both);
    let error = pair.error(reader)?;
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
    let [remainder, v] = operands(program, place, "sub")?;
    let [one, u] = operands(program, remainder, "sub")?;
    ensure(program.is_one(one), UNFIT)?;
    let most = program.most(place);
    let mut pair = Pair {
        program,
        u,
        v,
        by_reciprocal,
        size: integer(1) + most,
        down_to: None,
    };
    let both = pair.sizes()?;
    if let Some(down_to) = program.down_to(place) {
        let above = integer(1) + down_to;
        let below = most - integer(1);
        pair.size = above.max(below.clone());
        pair.down_to = Some(below);
    }
    let size = least(&both + integer(1), most.clone());
    pair.size = least(pair.size, both);
    let mut error = pair.error(reader)?;
    let first = program.bound(remainder)?;
    let largest = &first.size + &first.error;
    error += program.format.half_ulp(&largest);
    let before = &size + &error;
    rounded(&program.format, size, error, &before)
}

/// Both operands of an operation with this name.
fn operands(program: &Program, place: usize, name: &str) -> Outcome<[usize; 2]> {
    ensure(program.name(place) == name, UNFIT)?;
    let operands: [usize; 2] = program.operands(place).try_into().expect("two");
    Ok(operands)
}

/// The smaller one of two bounds of a size, with a lemma's digits.
fn least(one: Number, other: Number) -> Number {
    round_up(&one.min(other), SIZE_DIGITS)
}

impl<'p> Pair<'p> {
    /// Q_u + Q_v in the guide.
    fn sizes(&self) -> Outcome<Number> {
        let u = self.program.bound(self.u)?;
        let v = self.program.bound(self.v)?;
        Ok(&u.size + &v.size)
    }

    /// B in the guide: the error of the sum of both computed quotients.
    ///
    /// The formula is n + m - q*d, q being u + v. It is 0 in exact arithmetic, and the errors that n, m and d have in
    /// common count once in it, as for one quotient. The roundings that it leaves out are added, then those of u and v.
    fn error(&self, reader: &mut Reader) -> Outcome<Number> {
        let u = fraction(self.program, self.u, self.by_reciprocal)?;
        let v = fraction(self.program, self.v, self.by_reciprocal)?;
        ensure(self.u != self.v && u.divisor == v.divisor, UNFIT)?;
        let by = Divisor::new(self.program, u.divisor)?;
        let quotient = Quotient {
            size: &self.size,
            down_to: self.down_to.as_ref(),
        };
        let formula = Formula::read(self.program, Some(quotient), reader)?;
        ensure(
            formula.is_quotient_of(&[u.numerator, v.numerator], u.divisor),
            "found other last steps, expected numerator + numerator - quotient * divisor",
        )?;
        let mut error = by.error(&formula, reader)?;
        if formula.leaves_out(u.divisor) {
            let largest = &self.size + &error;
            error += by.left_out(&largest);
        }
        error += self.own_error(self.u, u, &formula, &by)?;
        error += self.own_error(self.v, v, &formula, &by)?;
        Ok(error)
    }

    /// The rounding of one of both quotients, and that of its numerator where the formula leaves it out.
    fn own_error(
        &self,
        place: usize,
        fraction: Fraction,
        formula: &Formula,
        by: &Divisor,
    ) -> Outcome<Number> {
        let format = &self.program.format;
        let own = self.program.bound(place)?;
        let mut error = integer(0);
        // P of the guide: it bounds the quotient, whatever its own lemma or this formula leaves out.
        let mut largest = &own.size + &own.error + &by.tiny;
        largest *= integer(1) + &by.share + &by.share;
        if formula.leaves_out(fraction.numerator) {
            error += by.left_out(&largest);
        }
        if self.by_reciprocal {
            let numerator = self.program.bound(fraction.numerator)?;
            let change = of_reciprocal(format, &largest, numerator);
            error += &change;
            largest += change;
        }
        error += format.half_ulp(&largest);
        Ok(error)
    }
}

//! The rule of unit vectors: a coordinate of a vector that is divided by its length. The guide has it in "Unit vectors".

use super::format::{Bound, Format};
use super::number::{ERROR_DIGITS, Number, root_up, round_up, shifted};
use super::program::{Fraction, Lemma, Length, Program, Unit};
use super::reader::{Outcome, ensure};
use num_traits::{One, Signed, Zero};

/// The vector before it is divided.
struct Vector {
    /// The root of the sum of the squares of its coordinates' errors before they are rounded: a in the guide.
    before: Number,
    /// A bound of its computed length: M in the guide.
    size: Number,
    /// The least exact length.
    floor: Number,
}

/// The lemma of a coordinate of a unit vector. Its error is that of the whole vector.
pub fn lemma(program: &Program, place: usize) -> Outcome<Lemma> {
    const EXPECTED: &str = "found another operation, expected a part of a vector by its length";
    let Fraction {
        numerator,
        divisor: length,
    } = program.fraction(place).ok_or(EXPECTED)?;
    let coordinates = squares(program, length).ok_or(EXPECTED)?;
    let is_vector = coordinates.len() == 3 && coordinates.contains(&numerator);
    ensure(is_vector, EXPECTED)?;
    let mut before = Number::zero();
    let mut size = Number::zero();
    for coordinate in coordinates {
        let lemma = program.lemma(coordinate)?;
        before += square(&lemma.before);
        size += square(&lemma.bound.computed);
    }
    let vector = Vector {
        before: root_up(&before, ERROR_DIGITS),
        size: root_up(&size, ERROR_DIGITS),
        floor: program.floor(length).clone(),
    };
    let bound = vector.bound_of_unit(&program.format)?;
    let length = Length {
        place: length,
        by_reciprocal: program.name(place) == "mul",
    };
    Ok(Lemma {
        before: bound.error.clone(),
        bound,
        unit: Some(Unit {
            coordinate: numerator,
            length,
        }),
    })
}

impl Vector {
    /// The bound that the coordinates of the unit vector share. In the guide's letters: A is `shift`, D is `turn`, the
    /// angle's part of the error, Theta is `stretch`, the length's part, and G is `before`.
    fn bound_of_unit(&self, format: &Format) -> Outcome<Bound> {
        let one = Number::one();
        let unit = &format.unit;
        let twice_tiny = times(2, &format.tiny);
        let before_and_floor = &self.before + &self.floor;
        let shift = &self.before + unit * before_and_floor + &twice_tiny;
        let least = &self.floor - &shift;
        // The share of what underflows in the squares is so small that the root moves by 2u at most.
        let share = unit * unit * square(&least);
        ensure(
            least.is_positive() && times(6, &format.tiny) <= share,
            "found a length that may be rounded to zero, expected a larger floor",
        )?;
        let third = &one - times(3, unit);
        self.ensure_finite(format, &least, &third)?;
        // Dunkl and Williams: unit vectors are no farther apart than 2‖x - y‖ over the sum of both lengths.
        let turn = &shift / (&self.floor - shifted(&shift, -1));
        let stretch = times(4, unit) / third;
        // An error of the length is at a right angle to one of the direction.
        let squared = square(&stretch) + (&one + &stretch) * square(&turn);
        let before = root_up(&squared, ERROR_DIGITS) + &self.size * &format.tiny;
        let longest = &one + &before;
        let error = &before + unit * &longest + twice_tiny;
        let computed = format.float_up(&longest);
        format.finite(&computed)?;
        Ok(Bound {
            size: one,
            computed,
            error: round_up(&error, ERROR_DIGITS),
        })
    }

    /// An error if a square, their sum or the reciprocal of the length may overflow.
    fn ensure_finite(&self, format: &Format, least: &Number, third: &Number) -> Outcome<()> {
        let longest = &self.size * (Number::one() + times(2, &format.unit));
        let reciprocal = (least * third).recip();
        format.finite(&round_up(&square(&longest), ERROR_DIGITS))?;
        format.finite(&round_up(&reciprocal, ERROR_DIGITS))
    }
}

fn times(n: i64, x: &Number) -> Number {
    Number::from_integer(n.into()) * x
}

fn square(x: &Number) -> Number {
    x * x
}

/// The numbers whose squares an operation adds up before it takes the root; more than three if they are too many.
fn squares(program: &Program, root: usize) -> Option<Vec<usize>> {
    if program.name(root) != "sqrt" {
        return None;
    }
    let mut squares = Vec::new();
    let mut open = program.operands(root).to_vec();
    while let Some(place) = open.pop() {
        match (program.name(place), program.operands(place)) {
            ("mul", &[a, b]) if a == b => squares.push(a),
            ("fma", &[a, b, c]) if a == b => {
                squares.push(a);
                open.push(c);
            }
            ("add", &[a, b]) => open.extend([a, b]),
            _ => return None,
        }
        if 3 < squares.len() {
            break;
        }
    }
    Some(squares)
}

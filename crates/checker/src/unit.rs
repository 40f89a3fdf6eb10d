//! The rule of unit vectors: a coordinate of a vector that is divided by its length. The guide has it in "Unit vectors".

use super::format::{Bound, Format};
use super::number::{ERROR_DIGITS, Number, integer, root_up, round_up, shifted};
use super::program::{Lemma, Length, Program, Unit};
use super::reader::{Outcome, ensure};
use num_traits::Signed;

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
    let fraction = program.fraction(place).ok_or(EXPECTED)?;
    let coordinate = fraction.numerator;
    let length = fraction.divisor;
    let coordinates = squares(program, length).ok_or(EXPECTED)?;
    let is_vector = coordinates.len() == 3 && coordinates.contains(&coordinate);
    ensure(is_vector, EXPECTED)?;
    let mut before = integer(0);
    let mut size = integer(0);
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
        unit: Some(Unit { coordinate, length }),
    })
}

impl Vector {
    /// The bound that the coordinates of the unit vector share. In the guide's letters: A is `shift`, D is `turn`, the
    /// angle's part of the error, Theta is `stretch`, the length's part, and G is `before`.
    fn bound_of_unit(&self, format: &Format) -> Outcome<Bound> {
        let Format { unit, tiny, .. } = format;
        let twice_tiny = tiny * integer(2);
        let before_and_floor = &self.before + &self.floor;
        let shift = &self.before + unit * before_and_floor + &twice_tiny;
        let least = &self.floor - &shift;
        // The share of what underflows in the squares is so small that the root moves by 2u at most.
        let share = square(unit) * square(&least);
        ensure(
            least.is_positive() && tiny * integer(6) <= share,
            "found a length that may be rounded to zero, expected a larger floor",
        )?;
        let third = integer(1) - unit * integer(3);
        self.ensure_finite(format, &(&least * &third))?;
        // Dunkl and Williams: unit vectors are no farther apart than 2‖x - y‖ over the sum of both lengths.
        let half_of_lengths = &self.floor - shifted(&shift, -1);
        let turn = shift / half_of_lengths;
        let stretch = unit * integer(4) / third;
        // An error of the length is at a right angle to one of the direction.
        let of_turn = (integer(1) + &stretch) * square(&turn);
        let squared = square(&stretch) + of_turn;
        let before = root_up(&squared, ERROR_DIGITS) + &self.size * tiny;
        let longest = integer(1) + &before;
        let error = before + unit * &longest + twice_tiny;
        let computed = format.float_up(&longest);
        format.finite(&computed)?;
        Ok(Bound {
            size: integer(1),
            computed,
            error: round_up(&error, ERROR_DIGITS),
        })
    }

    /// An error if a square, their sum or the reciprocal of the computed length may overflow.
    fn ensure_finite(&self, format: &Format, shortest: &Number) -> Outcome<()> {
        let factor = integer(1) + &format.unit * integer(2);
        let longest = &self.size * factor;
        let reciprocal = shortest.recip();
        format.finite(&round_up(&square(&longest), ERROR_DIGITS))?;
        format.finite(&round_up(&reciprocal, ERROR_DIGITS))
    }
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
        match program.operations[place].parts() {
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

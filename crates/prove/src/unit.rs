//! Bounds of unit vectors: of vectors that are divided by their lengths.

use super::Dyadic;
use super::bound::{Bound, Lemma, Prover, Rule};
use super::dyadic::{Big, root_up, round_up, whole};
use super::formula::{DIGITS, Formula, Maximum};
use crate::arith::recorded::{Operation, Place};
use num_traits::{Signed, Zero};

/// A vector that is divided by its length.
#[derive(Clone, Copy)]
pub struct Unit {
    pub vector: [Place; 3],
    pub length: Place,
}

impl Prover<'_> {
    /// The vector that a number is a coordinate of, if it is one over the vector's length.
    pub(super) fn unit(&self, place: Place) -> Option<Unit> {
        let fraction = self.quotient(place)?;
        let length = fraction.divisor;
        let Operation::Sqrt(inner) = self.operation(length) else {
            return None;
        };
        let vector = self.squares(inner)?;
        let is_coordinate = vector.contains(&fraction.numerator?);
        is_coordinate.then_some(Unit { vector, length })
    }

    /// The lemma of a coordinate of a unit vector. The error is that of the whole vector, by Euclid. Its length is at
    /// least the floor.
    pub(super) fn lemma_of_unit(&mut self, place: Place, unit: Unit) -> Result<Lemma, String> {
        let Unit { vector, length } = unit;
        let limit = self.floor(length);
        let mut errors = Big::zero();
        let mut sizes = Big::zero();
        for coordinate in vector {
            errors += square(&self.error_before_rounding(coordinate)?);
            sizes += square(&self.bound(coordinate)?.computed.into());
        }
        let before = Big::from(root_up(&errors, DIGITS));
        let size = Big::from(root_up(&sizes, DIGITS));
        let floor = Big::from(limit.size());
        let unit = self.unit_roundoff();
        let tiny = self.tiny();
        // Of the vector: each coordinate's last rounding is in proportion to the coordinate.
        let shift = &before + &unit * (&before + &floor) + whole(2) * &tiny;
        let least = &floor - &shift;
        if !least.is_positive() || whole(6) * &tiny > square(&unit) * square(&least) {
            return Err(
                "lengths may be so small in this domain that rounding makes one zero".to_owned(),
            );
        }
        // The squares, their sum, and the reciprocal of the root.
        let longest = &size * (whole(1) + whole(2) * &unit);
        let largest = Big::from(Dyadic::power(self.format.largest));
        let third = whole(1) - whole(3) * &unit;
        if square(&longest) >= largest || largest * least * &third <= whole(1) {
            return Err("the square of a length or its reciprocal may overflow".to_owned());
        }
        let turn = &shift / (floor - &shift / whole(2));
        let stretch = whole(4) * &unit / third;
        let squared = square(&stretch) + (whole(1) + &stretch) * square(&turn);
        let before = Big::from(root_up(&squared, DIGITS)) + size * &tiny;
        let rounded = whole(1) + &before;
        let error = before + unit * &rounded + whole(2) * tiny;
        let computed = round_up(&rounded, self.format.digits);
        self.check_range(computed)?;
        Ok(Lemma {
            place,
            rule: Rule::Unit {
                vector,
                length,
                floor: limit,
            },
            formula: Formula::default(),
            maximum: Maximum::default(),
            bound: Bound {
                size: Dyadic::ONE,
                computed,
                error: round_up(&error, DIGITS),
            },
        })
    }

    /// Squares that are added up to a number, if that is what it is.
    fn squares(&self, place: Place) -> Option<[Place; 3]> {
        let mut squares = Vec::new();
        let mut open = vec![place];
        while let Some(place) = open.pop() {
            match self.operation(place) {
                Operation::Mul(a, b) if a == b => squares.push(a),
                Operation::Fma(a, b, c) if a == b => {
                    squares.push(a);
                    open.push(c);
                }
                Operation::Add(a, b) => open.extend([a, b]),
                _ => return None,
            }
        }
        squares.sort_unstable();
        squares.try_into().ok()
    }
}

fn square(x: &Big) -> Big {
    x * x
}

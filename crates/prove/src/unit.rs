//! Bounds of unit vectors: of vectors that are divided by their lengths.

use super::Dyadic;
use super::bound::{Bound, Prover, Rule};
use super::dyadic::{Big, root_up, round_up};
use super::formula::DIGITS;
use super::order::unsigned;
use crate::arith::recorded::{Operation, Place};
use num_traits::{Signed, Zero};

impl Prover<'_> {
    /// The vector and its length, if the number is a coordinate of the vector divided by it.
    pub(super) fn unit(&self, place: Place) -> Option<([Place; 3], Place)> {
        let (numerator, length, _) = self.quotient(place)?;
        let Operation::Sqrt(inner) = self.operation(length) else { return None };
        let vector = self.squares(inner)?;
        vector.contains(&numerator?).then_some((vector, length))
    }

    /// The bounds of each coordinate of a unit vector. The error is that of the whole vector, by Euclid. Its
    /// length is at least the floor.
    pub(super) fn bound_of_unit(
        &mut self,
        vector: [Place; 3],
        floor: Dyadic,
    ) -> Result<Bound, String> {
        let (mut before, mut sizes) = (Big::zero(), Big::zero());
        for place in vector {
            let error = self.error_before_rounding(place)?;
            before += &error * &error;
            let computed = Big::from(self.bound(place)?.computed);
            sizes += &computed * &computed;
        }
        let (before, size) = (Big::from(root_up(&before, DIGITS)), root_up(&sizes, DIGITS));
        let whole = |n: i128| Big::from(Dyadic::new(n, 0));
        let (one, two, floor) = (whole(1), whole(2), Big::from(floor));
        let (unit, tiny) = (Big::from(self.format.unit()), Big::from(self.format.tiny()));
        // Of the vector: each coordinate's last rounding is in proportion to the coordinate.
        let shift = &before + &unit * (&before + &floor) + &two * &tiny;
        let least = &floor - &shift;
        if !least.is_positive() || whole(6) * &tiny > &unit * &unit * &least * &least {
            return Err(
                "lengths may be so small in this domain that rounding makes one zero".to_owned()
            );
        }
        // The squares, their sum, and the reciprocal of the root.
        let longest = Big::from(size) * (&one + &two * &unit);
        let largest = Big::from(Dyadic::power(self.format.largest));
        let third = &one - whole(3) * &unit;
        if &longest * &longest >= largest || &largest * &least * &third <= one {
            return Err("the square of a length or its reciprocal may overflow".to_owned());
        }
        let turn = &shift / (&floor - &shift / &two);
        let stretch = whole(4) * &unit / third;
        let before = &stretch * &stretch + (&one + &stretch) * &turn * &turn;
        let before = Big::from(root_up(&before, DIGITS)) + Big::from(size) * &tiny;
        let rounded = one + &before;
        let error = before + unit * &rounded + two * tiny;
        let computed = round_up(&rounded, self.format.digits);
        self.check_range(computed)?;
        Ok(Bound { size: Dyadic::ONE, computed, error: round_up(&error, DIGITS) })
    }

    /// The error of a number before its last operation rounds, where that is known to be smaller.
    pub(super) fn error_before_rounding(&mut self, place: Place) -> Result<Big, String> {
        let error = Big::from(self.bound(place)?.error);
        let place = unsigned(self.path, place);
        let lemma = self.lemmas.iter().find(|lemma| lemma.place == place).expect("it has a bound");
        let formula = &lemma.formula;
        let last = match lemma.rule {
            Rule::Sum => formula.steps.len() - 1,
            _ => return Ok(error),
        };
        if !formula.rounds[last] || formula.relative[last] {
            return Ok(error);
        }
        Ok(lemma.maximum.error() - Big::from(formula.bounds[last].error))
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

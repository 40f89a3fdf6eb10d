//! Bounds of quotients.

use super::bound::{Bound, Prover, SIZE_DIGITS};
use super::dyadic::{Big, round_up};
use super::formula::{DIGITS, Formula, Maximum};
use super::measures::{Kind, LARGEST, Limit};
use super::{Domain, Dyadic};
use crate::arith::recorded::{Operation, Place};

impl Prover<'_> {
    /// The least size of a divisor.
    pub(super) fn floor(&self, divisor: Place) -> Limit {
        let Domain { direction_floor, floor, measures, .. } = self.domain;
        if self.is_largest_of_direction(divisor) {
            return match measures {
                None => Limit::Domain(direction_floor),
                Some(_) => Limit::Scene("|d_k|", direction_floor),
            };
        }
        let found = measures.and_then(|it| self.samples().find(divisor, &it, Kind::Divisor));
        found.unwrap_or(Limit::Domain(floor))
    }

    /// The largest size of a quotient; none if a scene knows nothing of it.
    pub(super) fn most(&self, quotient: Place) -> Option<Limit> {
        match &self.domain.measures {
            None => Some(Limit::Domain(self.domain.quotient)),
            Some(measures) => self.samples().find(quotient, measures, Kind::Quotient),
        }
    }

    /// Numerator (none is one), divisor, and whether a reciprocal is multiplied, if the number is a quotient.
    pub(super) fn quotient(&self, place: Place) -> Option<(Option<Place>, Place, bool)> {
        let reciprocal = |place: Place| match self.operation(place) {
            Operation::Div(one, divisor) if self.operation(one) == Operation::Number(1) => {
                Some(divisor)
            }
            _ => None,
        };
        match self.operation(place) {
            Operation::Div(_, divisor) if reciprocal(place).is_some() => {
                Some((None, divisor, false))
            }
            Operation::Div(numerator, divisor) => Some((Some(numerator), divisor, false)),
            Operation::Mul(a, b) => reciprocal(b)
                .map(|divisor| (Some(a), divisor, true))
                .or_else(|| reciprocal(a).map(|divisor| (Some(b), divisor, true))),
            _ => None,
        }
    }

    /// The bound of a quotient, and the formula that it follows from. Given the least size of the divisor, and the
    /// largest of the quotient if it is known.
    pub(super) fn divide(
        &mut self,
        numerator: Option<Place>,
        divisor: Place,
        twice: bool,
        (floor, most): (Limit, Option<Limit>),
    ) -> Result<(Formula, Maximum, Bound), String> {
        let below = self.bound(divisor)?;
        // Else another coordinate may be larger by more than 1 %: 2E is that share of the floor.
        let least = below.error * Dyadic::new(200, 0);
        if matches!(floor, Limit::Scene(LARGEST, size) if size < least) {
            return Err(
                "rounding may hide which coordinate of (b-a)×(c-a) is the largest".to_owned()
            );
        }
        let floor = floor.size();
        let least = Big::from(floor) - Big::from(below.error);
        if least <= Big::from(self.format.tiny() * Dyadic::new(2, 0)) {
            return Err(
                "divisors may be so small in this domain that rounding makes one zero".to_owned()
            );
        }
        let above = match numerator {
            Some(numerator) => self.bound(numerator)?,
            None => Bound { size: Dyadic::ONE, computed: Dyadic::ONE, error: Dyadic::ZERO },
        };
        let limit = Big::from(above.size) / Big::from(floor);
        // The path compares computed numbers, which says nothing of the exact ones unless they are equal.
        let at_most_one = above.error.is_zero()
            && below.error.is_zero()
            && numerator.is_some_and(|n| self.is_at_most_in_size(n, divisor));
        let size = match numerator {
            Some(_) if at_most_one => Big::from(Dyadic::ONE),
            Some(_) => most.map_or(limit.clone(), |most| limit.min(Big::from(most.size()))),
            None => limit,
        };
        let size = round_up(&size, SIZE_DIGITS);
        let (formula, maximum, left_out) =
            self.formula_of_quotient(numerator, divisor, size, floor)?;
        // The quotient of the numbers before their last roundings against the exact one, then these roundings,
        // then those of the division.
        let [_, of_divisor] = left_out;
        let closest = match of_divisor {
            true => Big::from(floor) - self.error_before_rounding(divisor)?,
            false => least.clone(),
        };
        let mut before = maximum.error() / closest;
        let left_out = left_out.into_iter().filter(|yes| *yes).count() as i128;
        if left_out > 0 {
            let tiny = Big::from(self.format.tiny()) / &least;
            let one = Big::from(self.format.unit()) + &tiny;
            let share =
                &one / (Big::from(Dyadic::ONE) - &one) * Big::from(Dyadic::new(left_out, 0));
            before = &before + share * (Big::from(size) + &before) + tiny;
        }
        let quotient = Big::from(size) + &before;
        let mut error = before;
        let mut rounded = quotient.clone();
        if twice {
            let tiny = Big::from(self.format.tiny()) * Big::from(above.computed);
            let reciprocal = Big::from(self.format.unit()) * quotient + tiny;
            error += &reciprocal;
            rounded += reciprocal;
        }
        let largest = Big::from(Dyadic::power(self.format.largest));
        if twice && largest * least <= Big::from(Dyadic::ONE) {
            return Err(
                "divisors may be so small in this domain that a reciprocal overflows".to_owned()
            );
        }
        if at_most_one && !twice {
            // The quotient of two floats that is at most one is rounded to at most one.
            rounded = Big::from(Dyadic::ONE);
        }
        self.bound_of_rounded(size, error, &rounded).map(|bound| (formula, maximum, bound))
    }

    /// One more rounding of a number of the given size before it.
    fn bound_of_rounded(&self, size: Dyadic, error: Big, rounded: &Big) -> Result<Bound, String> {
        let error = round_up(&(error + Big::from(self.format.half_ulp_of(rounded))), DIGITS);
        let computed = round_up(rounded, self.format.digits);
        self.check_range(computed)?;
        Ok(Bound { size, computed, error })
    }
}

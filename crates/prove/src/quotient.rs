//! Bounds of quotients, and of unit vectors: of vectors that are divided by their lengths.

use super::bound::{Bound, Prover, Ratio, Rule, SIZE_DIGITS};
use super::dyadic::{Big, root_up, round_up};
use super::formula::{DIGITS, Formula, Maximum};
use super::measures::{Kind, LARGEST, Limit};
use super::order::{is_at_most, unsigned};
use super::{Domain, Dyadic};
use crate::arith::recorded::{Operation, Place};
use num_traits::{Signed, Zero};

/// Two quotients by one divisor that a number is made of.
pub(super) struct Quotients {
    pub ratio: Ratio,
    pub parts: [Place; 2],
    pub numerators: [Place; 2],
    pub divisor: Place,
    /// By a reciprocal and a product.
    pub twice: bool,
    /// 1 less the first one, if the number is that less the second one.
    pub rest: Option<Place>,
}

impl Prover<'_> {
    /// The least size of a divisor.
    pub(super) fn floor(&self, divisor: Place) -> Limit {
        let Domain {
            direction_floor,
            floor,
            measures,
            ..
        } = self.domain;
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
        let is_one = |place: &Place| self.operation(*place) == Operation::Number(1);
        let reciprocal = |place: Place| match self.operation(place) {
            Operation::Div(one, divisor) if is_one(&one) => Some(divisor),
            _ => None,
        };
        match self.operation(place) {
            Operation::Div(numerator, divisor) => {
                Some((Some(numerator).filter(|it| !is_one(it)), divisor, false))
            }
            Operation::Mul(a, b) => reciprocal(b)
                .map(|divisor| (Some(a), divisor, true))
                .or_else(|| reciprocal(a).map(|divisor| (Some(b), divisor, true))),
            _ => None,
        }
    }

    /// The two quotients by one divisor that a number is made of, if it is and something is known of its size.
    pub(super) fn quotients(&self, place: Place) -> Option<Quotients> {
        let (ratio, parts, rest) = match self.operation(place) {
            Operation::Add(a, b) => (Ratio::Sum, [a, b], None),
            Operation::Sub(rest, b) => match self.operation(rest) {
                Operation::Sub(one, a) if self.operation(one) == Operation::Number(1) => {
                    (Ratio::Rest, [a, b], Some(rest))
                }
                _ => return None,
            },
            _ => return None,
        };
        let [(first, divisor, twice), (second, other, also)] =
            [self.quotient(parts[0])?, self.quotient(parts[1])?];
        let is_known = || match self.domain.measures {
            None => self.samples().is_share(place),
            Some(_) => self.most(place).is_some(),
        };
        let is_fit = (divisor, twice) == (other, also) && parts[0] != parts[1] && is_known();
        let numerators = [first?, second?];
        is_fit.then_some(Quotients {
            ratio,
            parts,
            numerators,
            divisor,
            twice,
            rest,
        })
    }

    /// How far below zero a quotient may be, if that is supposed and less than its size.
    pub(super) fn below(&self, quotient: Place) -> Option<Dyadic> {
        let Domain {
            below,
            quotient: most,
            ..
        } = self.domain;
        (below < most && self.samples().is_share(quotient)).then_some(below)
    }

    /// The least size of a computed divisor.
    fn least(&mut self, divisor: Place, floor: Limit) -> Result<Big, String> {
        let error = self.bound(divisor)?.error;
        // Else another coordinate may be larger by more than 1 %: 2E is that share of the floor.
        let least = error * Dyadic::new(200, 0);
        if matches!(floor, Limit::Scene(LARGEST, size) if size < least) {
            return Err(
                "rounding may hide which coordinate of (b-a)×(c-a) is the largest".to_owned(),
            );
        }
        let least = Big::from(floor.size()) - Big::from(error);
        if least <= Big::from(self.format.tiny() * Dyadic::new(2, 0)) {
            return Err(
                "divisors may be so small in this domain that rounding makes one zero".to_owned(),
            );
        }
        Ok(least)
    }

    /// The bound of a number that is made of two quotients by one divisor, whose error is one for both.
    pub(super) fn divide_both(
        &mut self,
        place: Place,
        (floor, most, below): (Limit, Option<Limit>, Option<Dyadic>),
    ) -> Result<(Formula, Maximum, Bound), String> {
        let Quotients {
            parts,
            numerators,
            divisor,
            twice,
            rest,
            ..
        } = self.quotients(place).expect("it is made of two");
        let least = self.least(divisor, floor)?;
        let floor = floor.size();
        let bounds = [self.bound(parts[0])?, self.bound(parts[1])?];
        let rest = rest.map(|rest| self.bound(rest)).transpose()?;
        let both = Big::from(bounds[0].size) + Big::from(bounds[1].size);
        let most = most.map(Limit::size);
        let limited = |x: &Big, most: Option<Dyadic>| {
            round_up(
                &most.map_or(x.clone(), |most| x.clone().min(most.into())),
                SIZE_DIGITS,
            )
        };
        // The number's size, and that of the sum of both, which it may be 1 less.
        let (size, sum) = if rest.is_some() {
            let lower = most.zip(below).map(|(most, _)| most - Dyadic::ONE);
            let upper = most.map(|most| below.unwrap_or(most) + Dyadic::ONE);
            let upper = upper.map(|upper| lower.map_or(upper, |lower| upper.max(lower)));
            (
                limited(&(&both + Big::from(Dyadic::ONE)), most),
                (limited(&both, upper), lower),
            )
        } else {
            let size = limited(&both, most);
            (size, (size, below))
        };
        let (formula, maximum, left_out) = self.formula_of_quotient(&numerators, divisor, sum)?;
        let tiny = Big::from(self.format.tiny());
        let one = Big::from(self.format.unit()) + &tiny / &least;
        let share = &one / (Big::from(Dyadic::ONE) - &one);
        let mut error = maximum.error();
        if left_out[2] {
            error /= Big::from(floor) - self.error_before_rounding(divisor)?;
            error = &error + &share * (Big::from(sum.0) + &error) + &tiny / &least;
        } else {
            error /= &least;
        }
        for (i, bound) in bounds.iter().enumerate() {
            // Of the quotient of the numbers before they are rounded, or after.
            let mut largest = Big::from(bound.size) + Big::from(bound.error) + &tiny / &least;
            largest *= Big::from(Dyadic::ONE) + &share + &share;
            if left_out[i] {
                error += &share * &largest + &tiny / &least;
            }
            if twice {
                let above = Big::from(self.bound(numerators[i])?.computed);
                let reciprocal = Big::from(self.format.unit()) * &largest + &tiny * above;
                error += &reciprocal;
                largest += reciprocal;
            }
            error += Big::from(self.format.half_ulp_of(&largest));
        }
        if let Some(rest) = rest {
            let largest = Big::from(rest.size) + Big::from(rest.error);
            error += Big::from(self.format.half_ulp_of(&largest));
        }
        let rounded = Big::from(size) + &error;
        self.bound_of_rounded(size, error, &rounded)
            .map(|bound| (formula, maximum, bound))
    }

    /// The bound of a quotient, and the formula that it follows from. Given the least size of the divisor, the
    /// largest of the quotient if it is known, and how far it may be below zero.
    pub(super) fn divide(
        &mut self,
        numerator: Option<Place>,
        divisor: Place,
        twice: bool,
        (floor, most, down_to): (Limit, Option<Limit>, Option<Dyadic>),
    ) -> Result<(Formula, Maximum, Bound), String> {
        let least = self.least(divisor, floor)?;
        let (below, floor) = (self.bound(divisor)?, floor.size());
        let above = match numerator {
            Some(numerator) => self.bound(numerator)?,
            None => Bound {
                size: Dyadic::ONE,
                computed: Dyadic::ONE,
                error: Dyadic::ZERO,
            },
        };
        let limit = Big::from(above.size) / Big::from(floor);
        // The path compares computed numbers, which says nothing of the exact ones unless they are equal.
        let at_most_one = above.error.is_zero()
            && below.error.is_zero()
            && matches!(
                (numerator.map(|n| self.operation(n)), self.operation(divisor)),
                (Some(Operation::Input(n)), Operation::Input(d)) if is_at_most(self.path, n, d)
            );
        let size = match numerator {
            Some(_) if at_most_one => Big::from(Dyadic::ONE),
            Some(_) => most.map_or(limit.clone(), |most| limit.min(Big::from(most.size()))),
            None => limit,
        };
        let size = round_up(&size, SIZE_DIGITS);
        let (formula, maximum, left_out) =
            self.formula_of_quotient(numerator.as_slice(), divisor, (size, down_to))?;
        // The quotient of the numbers before their last roundings against the exact one, then these roundings,
        // then those of the division.
        let closest = match left_out[left_out.len() - 1] {
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
                "divisors may be so small in this domain that a reciprocal overflows".to_owned(),
            );
        }
        if at_most_one && !twice {
            // The quotient of two floats that is at most one is rounded to at most one.
            rounded = Big::from(Dyadic::ONE);
        }
        self.bound_of_rounded(size, error, &rounded)
            .map(|bound| (formula, maximum, bound))
    }

    /// One more rounding of a number of the given size before it.
    fn bound_of_rounded(&self, size: Dyadic, error: Big, rounded: &Big) -> Result<Bound, String> {
        let error = round_up(
            &(error + Big::from(self.format.half_ulp_of(rounded))),
            DIGITS,
        );
        let computed = round_up(rounded, self.format.digits);
        self.check_range(computed)?;
        Ok(Bound {
            size,
            computed,
            error,
        })
    }

    /// The vector and its length, if the number is a coordinate of the vector divided by it.
    pub(super) fn unit(&self, place: Place) -> Option<([Place; 3], Place)> {
        let (numerator, length, _) = self.quotient(place)?;
        let Operation::Sqrt(inner) = self.operation(length) else {
            return None;
        };
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
                "lengths may be so small in this domain that rounding makes one zero".to_owned(),
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
        Ok(Bound {
            size: Dyadic::ONE,
            computed,
            error: round_up(&error, DIGITS),
        })
    }

    /// The error of a number before its last operation rounds, where that is known to be smaller.
    pub(super) fn error_before_rounding(&mut self, place: Place) -> Result<Big, String> {
        let error = Big::from(self.bound(place)?.error);
        let place = unsigned(self.path, place);
        let lemma = self
            .lemmas
            .iter()
            .find(|lemma| lemma.place == place)
            .expect("it has a bound");
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

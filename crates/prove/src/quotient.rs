//! Bounds of quotients.

use super::bound::{Bound, Lemma, Proven, Prover, Ratio, Rule, SIZE_DIGITS};
use super::builder::{Ends, OfQuotient};
use super::dyadic::{Big, round_up, whole};
use super::formula::DIGITS;
use super::measures::{Kind, LARGEST, Limit};
use super::order::{is_at_most, unsigned};
use super::{Domain, Dyadic};
use crate::arith::recorded::{Operation, Place};

/// A quotient.
#[derive(Clone, Copy)]
pub struct Fraction {
    /// None is the number 1.
    pub numerator: Option<Place>,
    /// The divisor.
    pub divisor: Place,
    /// By a reciprocal and a product.
    pub twice: bool,
}

/// Two quotients by one divisor that a number is made of.
pub struct Quotients {
    ratio: Ratio,
    pub parts: [Place; 2],
    numerators: [Place; 2],
    /// One of both.
    fraction: Fraction,
    /// 1 less the first one, if the number is that less the second one.
    pub rest: Option<Place>,
}

/// The limits of a divisor and of a quotient.
struct Limits {
    /// The least size of the divisor.
    floor: Limit,
    /// The largest size of the quotient, if it is known.
    most: Option<Limit>,
    /// How far below zero the quotient may be, if that is supposed.
    below: Option<Dyadic>,
}

/// A divisor.
struct Divisor {
    place: Place,
    /// The least size.
    floor: Big,
    /// The least size of the computed divisor.
    least: Big,
    /// The change of a quotient by one rounding that is left out: a share of its size,
    share: Big,
    /// and a number where it underflows.
    tiny: Big,
}

impl Divisor {
    fn left_out(&self, size: &Big) -> Big {
        &self.share * size + &self.tiny
    }
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

    /// How far below zero a quotient may be, if that is supposed and less than its size.
    fn below(&self, quotient: Place) -> Option<Dyadic> {
        let below = self.domain.below;
        let is_less = below < self.domain.quotient;
        (is_less && self.samples().is_share(quotient)).then_some(below)
    }

    fn limits(&self, quotient: Place, divisor: Place) -> Limits {
        Limits {
            floor: self.floor(divisor),
            most: self.most(quotient),
            below: self.below(quotient),
        }
    }

    /// The fraction that a number is, if it is a quotient.
    pub(super) fn quotient(&self, place: Place) -> Option<Fraction> {
        match self.operation(place) {
            Operation::Div(numerator, divisor) => Some(Fraction {
                numerator: Some(numerator).filter(|it| !self.is_one(*it)),
                divisor,
                twice: false,
            }),
            Operation::Mul(a, b) => {
                let by_last = self.times_reciprocal(a, b);
                by_last.or_else(|| self.times_reciprocal(b, a))
            }
            _ => None,
        }
    }

    fn times_reciprocal(&self, numerator: Place, reciprocal: Place) -> Option<Fraction> {
        let Operation::Div(one, divisor) = self.operation(reciprocal) else {
            return None;
        };
        self.is_one(one).then_some(Fraction {
            numerator: Some(numerator),
            divisor,
            twice: true,
        })
    }

    fn is_one(&self, place: Place) -> bool {
        self.operation(place) == Operation::Number(1)
    }

    /// The two quotients by one divisor that a number is made of, if it is and something is known of its size.
    pub(super) fn quotients(&self, place: Place) -> Option<Quotients> {
        let (ratio, parts, rest) = match self.operation(place) {
            Operation::Add(a, b) => (Ratio::Sum, [a, b], None),
            Operation::Sub(rest, b) => match self.operation(rest) {
                Operation::Sub(one, a) if self.is_one(one) => (Ratio::Rest, [a, b], Some(rest)),
                _ => return None,
            },
            _ => return None,
        };
        let first = self.quotient(parts[0])?;
        let second = self.quotient(parts[1])?;
        let is_known = || match self.domain.measures {
            None => self.samples().is_share(place),
            Some(_) => self.most(place).is_some(),
        };
        let has_one_divisor = first.divisor == second.divisor && first.twice == second.twice;
        if !has_one_divisor || parts[0] == parts[1] || !is_known() {
            return None;
        }
        Some(Quotients {
            ratio,
            parts,
            numerators: [first.numerator?, second.numerator?],
            fraction: first,
            rest,
        })
    }

    /// An error if the divisor may be computed as zero.
    fn divisor(&mut self, place: Place, floor: Limit) -> Proven<Divisor> {
        let error = self.bound(place)?.error;
        if let Limit::Scene(LARGEST, size) = floor {
            let mut most = error;
            for compared in self.samples().compared_coordinates() {
                most = most.max(self.bound(compared)?.error);
            }
            // Else another coordinate may be larger by more than 1 %: 2E is that share of the floor.
            if size < most * Dyadic::new(200, 0) {
                return Err(
                    "rounding may hide which coordinate of (b-a)×(c-a) is the largest".to_owned(),
                );
            }
        }
        let floor = Big::from(floor.size());
        let least = &floor - Big::from(error);
        if least <= whole(2) * self.tiny() {
            return Err(
                "divisors may be so small in this domain that rounding makes one zero".to_owned(),
            );
        }
        let tiny = self.tiny() / &least;
        let epsilon = self.unit_roundoff() + &tiny;
        let rest = whole(1) - &epsilon;
        Ok(Divisor {
            place,
            floor,
            least,
            share: epsilon / rest,
            tiny,
        })
    }

    pub(super) fn tiny(&self) -> Big {
        self.format.tiny().into()
    }

    pub(super) fn unit_roundoff(&self) -> Big {
        self.format.unit().into()
    }

    /// The change of a quotient of this size by the rounding of its divisor's reciprocal.
    fn of_reciprocal(&self, size: &Big, numerator: &Bound) -> Big {
        self.unit_roundoff() * size + self.tiny() * Big::from(numerator.computed)
    }

    /// The error of the quotient of the numbers before their last roundings, if these are left out.
    fn error_of_quotient(&mut self, of: &OfQuotient, by: &Divisor) -> Proven<Big> {
        let closest = if of.leaves_out_divisor {
            &by.floor - self.error_before_rounding(by.place)?
        } else {
            by.least.clone()
        };
        Ok(of.maximum.error() / closest)
    }

    /// The lemma of a number that is made of two quotients by one divisor, whose error is one for both.
    pub(super) fn divide_both(&mut self, place: Place, both: Quotients) -> Proven<Lemma> {
        let fraction = both.fraction;
        let Fraction { divisor, twice, .. } = fraction;
        let limits = self.limits(place, divisor);
        let by = self.divisor(divisor, limits.floor)?;
        let bounds = [self.bound(both.parts[0])?, self.bound(both.parts[1])?];
        let rest = both.rest.map(|rest| self.bound(rest)).transpose()?;
        let sizes = Big::from(bounds[0].size) + Big::from(bounds[1].size);
        let most = limits.most.map(Limit::size);
        let mut size = limited(&sizes, most);
        // The sum of both, which the number may be 1 less.
        let mut sum = Ends {
            size,
            below: limits.below,
        };
        if rest.is_some() {
            size = limited(&(whole(1) + &sizes), most);
            sum = ends_of_sum(&sizes, most, limits.below);
        }
        let of = self.formula_of_quotient(&both.numerators, divisor, sum)?;
        let mut error = self.error_of_quotient(&of, &by)?;
        if of.leaves_out_divisor {
            let largest = Big::from(sum.size) + &error;
            error += by.left_out(&largest);
        }
        for (i, bound) in bounds.iter().enumerate() {
            // Of the quotient of the numbers before they are rounded, or after.
            let mut largest = bound.largest() + &by.tiny;
            largest *= whole(1) + &by.share + &by.share;
            if of.leaves_out_numerators[i] {
                error += by.left_out(&largest);
            }
            if twice {
                let numerator = self.bound(both.numerators[i])?;
                let change = self.of_reciprocal(&largest, &numerator);
                error += &change;
                largest += change;
            }
            error += Big::from(self.format.half_ulp_of(&largest));
        }
        if let Some(rest) = rest {
            error += Big::from(self.format.half_ulp_of(&rest.largest()));
        }
        let rounded = Big::from(size) + &error;
        let bound = self.bound_of_rounded(size, error, &rounded)?;
        Ok(limits.lemma(place, both.ratio, fraction, of, bound))
    }

    /// The lemma of a quotient.
    pub(super) fn divide(&mut self, place: Place, fraction: Fraction) -> Proven<Lemma> {
        let Fraction {
            numerator,
            divisor,
            twice,
        } = fraction;
        let mut limits = self.limits(place, divisor);
        if numerator.is_none() && self.domain.measures.is_some() {
            // A reciprocal is known by its divisor.
            limits.most = None;
        }
        let by = self.divisor(divisor, limits.floor)?;
        let below = self.bound(divisor)?;
        let above = match numerator {
            Some(numerator) => self.bound(numerator)?,
            None => Bound::exactly(Dyadic::ONE),
        };
        // The path compares computed numbers, which says nothing of the exact ones unless they are equal.
        let is_exact = above.error.is_zero() && below.error.is_zero();
        let is_at_most_one = is_exact && self.is_ordered(numerator, divisor);
        let limit = Big::from(above.size) / &by.floor;
        let size = if is_at_most_one {
            limited(&whole(1), None)
        } else {
            let most = limits.most.filter(|_| numerator.is_some());
            limited(&limit, most.map(Limit::size))
        };
        let ends = Ends {
            size,
            below: limits.below,
        };
        let of = self.formula_of_quotient(numerator.as_slice(), divisor, ends)?;
        // The quotient of the numbers before their last roundings against the exact one, then these roundings,
        // then those of the division.
        let mut error = self.error_of_quotient(&of, &by)?;
        let mut left_out = of.leaves_out_numerators.clone();
        left_out.push(of.leaves_out_divisor);
        left_out.retain(|is_left_out| *is_left_out);
        if !left_out.is_empty() {
            let largest = whole(left_out.len() as i64) * (Big::from(size) + &error);
            error += by.left_out(&largest);
        }
        let mut rounded = Big::from(size) + &error;
        if twice {
            let change = self.of_reciprocal(&rounded, &above);
            error += &change;
            rounded += change;
        }
        let largest = Big::from(Dyadic::power(self.format.largest));
        if twice && largest * by.least <= whole(1) {
            return Err(
                "divisors may be so small in this domain that a reciprocal overflows".to_owned(),
            );
        }
        if is_at_most_one && !twice {
            // The quotient of two floats that is at most one is rounded to at most one.
            rounded = whole(1);
        }
        let bound = self.bound_of_rounded(size, error, &rounded)?;
        Ok(limits.lemma(place, Ratio::One, fraction, of, bound))
    }

    /// True if the numerator is at most as large as the divisor, by the decisions of the path about inputs.
    fn is_ordered(&self, numerator: Option<Place>, divisor: Place) -> bool {
        let numerator = numerator.map(|numerator| self.operation(numerator));
        match (numerator, self.operation(divisor)) {
            (Some(Operation::Input(n)), Operation::Input(d)) => is_at_most(self.path, n, d),
            _ => false,
        }
    }

    /// The error of a number before its last operation rounds, where that is known to be smaller.
    pub(super) fn error_before_rounding(&mut self, place: Place) -> Proven<Big> {
        let error = Big::from(self.bound(place)?.error);
        let unsigned = unsigned(self.path, place);
        let mut lemmas = self.lemmas.iter();
        let lemma = lemmas.find(|lemma| lemma.place == unsigned);
        let lemma = lemma.expect("it has a bound");
        if lemma.rule != Rule::Sum {
            return Ok(error);
        }
        let formula = &lemma.formula;
        let last = formula.steps.len() - 1;
        if !formula.rounds[last] || formula.relative[last] {
            return Ok(error);
        }
        let rounding = formula.bounds[last].error;
        Ok(lemma.maximum.error() - Big::from(rounding))
    }

    /// One more rounding of a number of the given size before it.
    fn bound_of_rounded(&self, size: Dyadic, error: Big, rounded: &Big) -> Proven<Bound> {
        let rounding = Big::from(self.format.half_ulp_of(rounded));
        let computed = round_up(rounded, self.format.digits);
        self.check_range(computed)?;
        Ok(Bound {
            size,
            computed,
            error: round_up(&(error + rounding), DIGITS),
        })
    }
}

impl Limits {
    fn lemma(
        self,
        place: Place,
        ratio: Ratio,
        fraction: Fraction,
        of: OfQuotient,
        bound: Bound,
    ) -> Lemma {
        Lemma {
            place,
            rule: Rule::Quotient {
                ratio,
                twice: fraction.twice,
                divisor: fraction.divisor,
                floor: self.floor,
                most: self.most.unwrap_or(Limit::Own(bound.size)),
                below: self.below,
            },
            formula: of.formula,
            maximum: of.maximum,
            bound,
        }
    }
}

/// A size that may have another bound, with a lemma's digits.
fn limited(size: &Big, most: Option<Dyadic>) -> Dyadic {
    let mut least = size.clone();
    if let Some(most) = most {
        least = least.min(most.into());
    }
    round_up(&least, SIZE_DIGITS)
}

/// The ends of the sum of two quotients, of which both sizes add up to `sizes`, if 1 less that sum is limited.
fn ends_of_sum(sizes: &Big, most: Option<Dyadic>, below: Option<Dyadic>) -> Ends {
    let lower = below.and(most).map(|most| most - Dyadic::ONE);
    let upper = most.map(|most| below.unwrap_or(most) + Dyadic::ONE);
    // None is less than any number.
    let largest = upper.max(lower);
    Ends {
        size: limited(sizes, largest),
        below: lower,
    }
}

//! How far from zero a computed sum of products must be for its sign to be right, at every scale. docs/guide/repair.md
//! has the rule and why it holds.

use super::super::{
    Dyadic, Format,
    bound::Proven,
    dyadic::{Big, round_up},
    forms::Leaf,
};
use crate::arith::recorded::{Operation, Place};
use num_bigint::BigInt;
use num_traits::One;
use std::collections::HashMap;

/// The constants of a format.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// The format.
    pub format: Format,
    /// Added to a size before it is multiplied, if its number may have underflowed.
    pub slack: Dyadic,
    /// Added to each margin.
    pub tiny: Dyadic,
    /// Ends of the ray beyond it count as it, and then prove no miss.
    pub far: Dyadic,
}

impl Scale {
    /// Those of a format.
    pub fn of(format: Format) -> Scale {
        let normal = format.smallest + format.digits as i32 - 1;
        let far = if format == Format::F32 { 40 } else { 300 };
        let slack = Dyadic::power(normal + format.digits as i32 + 8);
        Scale {
            format,
            slack,
            tiny: Dyadic::power(normal + 10),
            far: Dyadic::power(far),
        }
    }
}

/// The margin of a number: the factor of its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Margin {
    /// How many roundings each of its products passes at most before the last one.
    pub roundings: u32,
    /// The factor; zero if the sign of the number is exact as it is.
    pub factor: Dyadic,
}

/// How wrong a sum of products may be, in whatever order it is added up, with fused products or without.
#[derive(Clone, Copy, Debug)]
struct Count {
    /// Roundings of each term, and terms.
    roundings: u32,
    terms: u32,
    /// Underflows of factors, each at most a share of the factor's size.
    shares: u32,
    /// Underflows of the sum itself.
    underflows: u32,
}

impl Count {
    const INPUT: Count = Count {
        roundings: 0,
        terms: 1,
        shares: 0,
        underflows: 1,
    };

    fn all(self) -> u32 {
        self.roundings + self.terms - 1
    }

    fn sum(self, other: Count) -> Count {
        Count {
            roundings: self.roundings.max(other.roundings),
            terms: self.terms + other.terms,
            shares: self.shares.max(other.shares),
            underflows: self.underflows + other.underflows + 1,
        }
    }

    fn product(self, other: Count) -> Count {
        let shares = |count: Count| count.shares + 2 * count.underflows;
        Count {
            roundings: self.all() + other.all() + 1,
            terms: 1,
            shares: shares(self) + shares(other),
            underflows: 1,
        }
    }
}

/// The counts so far, of numbers and of their sizes.
type Known = HashMap<(Place, bool), Count>;

/// Counts for the numbers of a program, and for their sizes.
pub struct Margins<'a> {
    /// The program.
    pub operations: &'a [Operation],
    /// The constants.
    pub scale: Scale,
}

impl Margins<'_> {
    /// True if a size needs slack where it is multiplied: of all but whole numbers.
    pub fn needs_slack(&self, place: Place) -> bool {
        match self.operations[place as usize] {
            Operation::Neg(a) | Operation::Abs(a) => self.needs_slack(a),
            operation => !matches!(operation, Operation::Number(_)),
        }
    }

    fn count(&self, place: Place, is_size: bool, known: &mut Known) -> Proven<Count> {
        if let Some(known) = known.get(&(place, is_size)) {
            return Ok(*known);
        }
        let operation = self.operations[place as usize];
        let is_difference = Leaf::of(operation, self.operations).is_some_and(Leaf::is_difference);
        let mut of = |place: Place| self.count(place, is_size, known);
        let found = match operation {
            _ if is_difference => Count {
                roundings: 1,
                underflows: 4,
                ..Count::INPUT
            },
            Operation::Input(_) => Count::INPUT,
            Operation::Number(value) => {
                self.scale.format.check_whole(value)?;
                Count {
                    underflows: 0,
                    ..Count::INPUT
                }
            }
            Operation::Neg(a) | Operation::Abs(a) => of(a)?,
            Operation::Add(a, b) | Operation::Sub(a, b) => of(a)?.sum(of(b)?),
            Operation::Mul(a, b) => {
                let mut factors = [of(a)?, of(b)?];
                for (place, factor) in [a, b].into_iter().zip(&mut factors) {
                    if is_size && self.needs_slack(place) {
                        factor.terms += 1;
                        factor.underflows += 1;
                    }
                }
                factors[0].product(factors[1])
            }
            Operation::Div(..) => return Err("it has a quotient of other numbers".to_owned()),
            Operation::Sqrt(_) => return Err("it has a root".to_owned()),
            Operation::Fma(..) | Operation::Minor(..) => {
                return Err("it has a product that is not rounded".to_owned());
            }
        };
        known.insert((place, is_size), found);
        Ok(found)
    }

    /// The margin of a number; an error in one sentence if it has none.
    pub fn of(&self, place: Place) -> Proven<Margin> {
        let mut known = Known::new();
        let count = self.count(place, false, &mut known)?;
        let size = self.count(place, true, &mut known)?;
        let format = self.scale.format;
        let operation = self.operations[place as usize];
        if Leaf::of(operation, self.operations).is_some() {
            return Ok(Margin {
                roundings: 0,
                factor: Dyadic::ZERO,
            });
        }
        if 500 < count.underflows + size.underflows {
            return Err("it has too many terms".to_owned());
        }
        let is_sum = matches!(operation, Operation::Add(..) | Operation::Sub(..));
        let roundings = count.all() - u32::from(is_sum);
        // (1 + 2^-place)^count; the numerator is odd.
        let power = |place: u32, count: u32| {
            let one_and_unit: BigInt = (BigInt::one() << place) + 1;
            Big::new_raw(one_and_unit.pow(count), BigInt::one() << (place * count))
        };
        let unit = format.digits;
        let share = format.digits + 8;
        let error = power(unit, roundings) * power(share, count.shares) - Big::one();
        let factor = error * power(unit, size.all() + 3) * power(share, size.shares);
        Ok(Margin {
            roundings,
            factor: round_up(&factor, format.digits),
        })
    }
}

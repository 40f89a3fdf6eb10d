//! The margins of a guarded kernel: how far from zero a number must be for its sign to be sure.
//!
//! The rule is "Margins" in docs/guide/repair.md, "Why it is right".

use super::number::{Number, round_up, show};
use super::program::Program;
use super::reader::{Outcome, ensure};
use num_bigint::BigInt;
use num_traits::One;
use std::collections::HashMap;

/// A number with more roundings, terms, shares or underflows has no margin.
const MOST_COUNT: u64 = 1 << 14;

/// The underflows of a margin's last sum are below 2^10 smallest normal numbers if they are no more than this.
const MOST_UNDERFLOWS: u64 = 500;

/// How wrong a number may be.
#[derive(Clone, Copy)]
struct Count {
    /// The roundings that each term passes at most, before the terms are added.
    roundings: u64,
    terms: u64,
    /// Shares of the number that underflows in factors may be.
    shares: u64,
    underflows: u64,
}

impl Count {
    const INPUT: Count = Count {
        roundings: 0,
        terms: 1,
        shares: 0,
        underflows: 1,
    };

    /// The roundings of a term that passes all additions, in whatever order they are.
    fn all(self) -> u64 {
        self.roundings + self.terms - 1
    }

    fn plus(self, other: Count) -> Count {
        Count {
            roundings: self.roundings.max(other.roundings),
            terms: self.terms + other.terms,
            shares: self.shares.max(other.shares),
            underflows: self.underflows + other.underflows + 1,
        }
    }

    fn is_small(self) -> bool {
        self.roundings <= MOST_COUNT
            && self.terms <= MOST_COUNT
            && self.shares <= MOST_COUNT
            && self.underflows <= MOST_COUNT
    }
}

/// A number, or its size, which is computed too.
#[derive(PartialEq, Eq, Hash)]
struct Counted {
    place: usize,
    of_size: bool,
}

/// The margins of a program's numbers.
pub struct Margins<'p> {
    program: &'p Program,
    counts: HashMap<Counted, Count>,
}

impl<'p> Margins<'p> {
    pub fn new(program: &'p Program) -> Margins<'p> {
        Margins {
            program,
            counts: HashMap::new(),
        }
    }

    /// The roundings and the factor of a number's margin; `0 0` for an input and a difference of two.
    pub fn margin(&mut self, place: usize) -> Outcome<String> {
        let number = self.count(place, false)?;
        let size = self.count(place, true)?;
        ensure(
            number.underflows + size.underflows <= MOST_UNDERFLOWS,
            format!("found operation {place} with too many terms"),
        )?;
        // The last sum cannot change a sign, so its rounding does not count.
        let is_sum = ["add", "sub"].contains(&self.program.name(place));
        let roundings = number.all() - u64::from(is_sum);
        let digits = self.program.format.parameters.digits;
        let share = digits + 8;
        let of_number = raised(digits, roundings) * raised(share, number.shares);
        let of_size = raised(digits, size.all() + 3) * raised(share, size.shares);
        let factor = (of_number - Number::one()) * of_size;
        Ok(format!("{roundings} {}", show(&round_up(&factor, digits))))
    }

    /// The count of a number or of its size, which is found once.
    fn count(&mut self, place: usize, of_size: bool) -> Outcome<Count> {
        let counted = Counted { place, of_size };
        if let Some(known) = self.counts.get(&counted) {
            return Ok(*known);
        }
        let count = self.counted(place, of_size)?;
        ensure(
            count.is_small(),
            format!("found operation {place} with too many roundings"),
        )?;
        self.counts.insert(counted, count);
        Ok(count)
    }

    fn counted(&mut self, place: usize, of_size: bool) -> Outcome<Count> {
        if let Some(leaf) = self.program.leaf(place) {
            let mut count = Count::INPUT;
            if leaf.less.is_some() {
                count.roundings = 1;
                count.underflows = 4;
            }
            return Ok(count);
        }
        match self.program.operations[place].parts() {
            ("number", _) => Ok(Count {
                underflows: 0,
                ..Count::INPUT
            }),
            ("neg" | "abs", &[a]) => self.count(a, of_size),
            ("add" | "sub", &[a, b]) => {
                let left = self.count(a, of_size)?;
                let right = self.count(b, of_size)?;
                Ok(left.plus(right))
            }
            ("mul", &[a, b]) => self.product([a, b], of_size),
            (name, _) => Err(format!(
                "found a margin of a number with `{name}`, which has none"
            )),
        }
    }

    /// The count of a product. An underflow in a factor is a share of the factor's size, to which the size of a factor that
    /// may underflow has a slack added; such a share counts twice.
    fn product(&mut self, factors: [usize; 2], of_size: bool) -> Outcome<Count> {
        let mut product = Count {
            roundings: 1,
            ..Count::INPUT
        };
        for factor in factors {
            let mut count = self.count(factor, of_size)?;
            if of_size && self.count(factor, false)?.underflows > 0 {
                count.terms += 1;
                count.underflows += 1;
            }
            product.roundings += count.all();
            product.shares += count.shares + 2 * count.underflows;
        }
        Ok(product)
    }
}

/// (1 + 2^-place)^count. The numerator is odd.
fn raised(place: i64, count: u64) -> Number {
    let one_and_unit: BigInt = (BigInt::one() << place) + 1;
    let denominator = BigInt::one() << (place as u64 * count);
    Number::new_raw(one_and_unit.pow(count as u32), denominator)
}

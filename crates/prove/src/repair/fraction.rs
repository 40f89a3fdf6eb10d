//! A kernel's numbers as fractions, so that what it decides is the signs of sums of products.
//!
//! A bound of a quotient needs a floor of its divisor, and nothing has one at every scale. The signs of numerator and
//! divisors decide the same, and each has a bound relative to its own products.

use crate::arith::recorded::{Operation, Place};
use crate::kernel::Path;
use std::collections::HashMap;

/// Operations of all paths, each once.
#[derive(Debug, Default)]
pub struct Arena {
    pub operations: Vec<Operation>,
    places: HashMap<Operation, Place>,
}

/// `numerator / (divisor * divisor * ...)`.
#[derive(Clone, Debug)]
struct Fraction {
    numerator: Place,
    /// In order.
    divisors: Vec<Place>,
}

/// A condition on signs: none of the numbers is zero, and so many negative ones are among those in `signs` that their
/// product is negative, or not.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Literal {
    /// True if the product is negative.
    pub is_negative: bool,
    /// The numbers whose signs count.
    pub signs: Vec<Place>,
    /// The numbers that are only not zero.
    pub nonzero: Vec<Place>,
}

impl Literal {
    /// The same condition on the negative.
    pub fn negated(&self) -> Literal {
        Literal {
            is_negative: !self.is_negative,
            ..self.clone()
        }
    }

    /// The condition that both hold or both fail, and no sign in them is unsure.
    pub fn times(&self, other: &Literal) -> Literal {
        let mut product = self.clone();
        product.is_negative ^= other.is_negative;
        product.nonzero.extend(&other.nonzero);
        for place in &other.signs {
            // A square is not negative.
            match product.signs.iter().position(|known| known == place) {
                Some(at) => product.nonzero.push(product.signs.remove(at)),
                None => product.signs.push(*place),
            }
        }
        let Literal { signs, nonzero, .. } = &mut product;
        signs.sort_unstable();
        nonzero.sort_unstable();
        nonzero.dedup();
        nonzero.retain(|place| !signs.contains(place));
        product
    }

    /// Every number in it.
    pub fn places(&self) -> impl Iterator<Item = Place> {
        self.signs.iter().chain(&self.nonzero).copied()
    }
}

impl Arena {
    pub fn push(&mut self, operation: Operation) -> Place {
        let next = self.operations.len() as Place;
        *self.places.entry(operation).or_insert_with(|| {
            self.operations.push(operation);
            next
        })
    }

    fn is_number(&self, place: Place, number: i32) -> bool {
        self.operations[place as usize] == Operation::Number(number)
    }

    fn product(&mut self, a: Place, b: Place) -> Place {
        // Zero times a number is zero: as a product, its size would be NaN where that of the other factor overflows.
        if self.is_number(a, 0) || self.is_number(b, 1) {
            a
        } else if self.is_number(a, 1) || self.is_number(b, 0) {
            b
        } else {
            self.push(Operation::Mul(a, b))
        }
    }

    fn negative(&mut self, a: Place) -> Place {
        if self.is_number(a, 0) {
            a
        } else {
            self.push(Operation::Neg(a))
        }
    }

    /// The number and its factors, without signs, into those whose sign counts and those of which only that it is not
    /// zero. Returns true if the sign turns.
    fn factors(&self, place: Place, signs: &mut Vec<Place>, nonzero: &mut Vec<Place>) -> bool {
        match self.operations[place as usize] {
            Operation::Neg(a) => !self.factors(a, signs, nonzero),
            Operation::Mul(a, b) => {
                self.factors(a, signs, nonzero) ^ self.factors(b, signs, nonzero)
            }
            Operation::Abs(a) | Operation::Sqrt(a) => {
                let mut inner = Vec::new();
                self.factors(a, &mut inner, nonzero);
                nonzero.extend(inner);
                false
            }
            Operation::Number(value) if value != 0 => value < 0,
            _ => {
                // A square is not negative.
                match signs.iter().position(|known| *known == place) {
                    Some(at) => nonzero.push(signs.swap_remove(at)),
                    None => signs.push(place),
                }
                false
            }
        }
    }
}

/// The numbers of one path in an arena: as they are, and as fractions.
pub struct Numbers<'a> {
    pub arena: &'a mut Arena,
    path: &'a Path,
    plain: Vec<Option<Place>>,
    fractions: Vec<Option<Fraction>>,
}

/// The first list without the second.
fn without(from: &[Place], of: &[Place]) -> Vec<Place> {
    let mut left = from.to_vec();
    for place in of {
        if let Some(at) = left.iter().position(|other| other == place) {
            left.remove(at);
        }
    }
    left
}

impl<'a> Numbers<'a> {
    pub fn new(arena: &'a mut Arena, path: &'a Path) -> Numbers<'a> {
        let count = path.operations.len();
        Numbers {
            arena,
            path,
            plain: vec![None; count],
            fractions: vec![None; count],
        }
    }

    /// A number as the kernel computes it.
    pub fn plain(&mut self, place: Place) -> Place {
        if let Some(known) = self.plain[place as usize] {
            return known;
        }
        let operation = self.path.operations[place as usize].with(|operand| self.plain(operand));
        let found = self.arena.push(operation);
        self.plain[place as usize] = Some(found);
        found
    }

    /// The condition that `b - a`, or `a` alone, is positive.
    pub fn difference(&mut self, a: Place, b: Option<Place>) -> Literal {
        let mut found = self.fraction(a);
        if let Some(b) = b {
            let b = self.fraction(b);
            found = self.sum(b, found, true);
        }
        let mut signs = Vec::new();
        let mut nonzero = Vec::new();
        let mut is_negative = self
            .arena
            .factors(found.numerator, &mut signs, &mut nonzero);
        for divisor in &found.divisors {
            is_negative ^= self.arena.factors(*divisor, &mut signs, &mut nonzero);
        }
        signs.sort_unstable();
        nonzero.retain(|place| !signs.contains(place));
        nonzero.sort_unstable();
        nonzero.dedup();
        Literal {
            is_negative,
            signs,
            nonzero,
        }
    }

    fn fraction(&mut self, place: Place) -> Fraction {
        if let Some(known) = &self.fractions[place as usize] {
            return known.clone();
        }
        let operation = self.path.operations[place as usize];
        let found = self.made(operation);
        self.fractions[place as usize] = Some(found.clone());
        found
    }

    fn made(&mut self, operation: Operation) -> Fraction {
        use Operation::*;
        match operation {
            Input(_) | Number(_) => Fraction {
                numerator: self.arena.push(operation),
                divisors: vec![],
            },
            Neg(a) => {
                let a = self.fraction(a);
                Fraction {
                    numerator: self.arena.negative(a.numerator),
                    ..a
                }
            }
            Abs(a) => {
                let Fraction {
                    numerator,
                    divisors,
                } = self.fraction(a);
                let numerator = if self.arena.is_number(numerator, 0) {
                    numerator
                } else {
                    self.arena.push(Abs(numerator))
                };
                let odd = |place: &Place| divisors.iter().filter(|d| *d == place).count() % 2 == 1;
                let mut last = None;
                let mut sized = Vec::new();
                for divisor in &divisors {
                    // A square is positive as it is.
                    let is_first = last.replace(*divisor) != Some(*divisor);
                    let is_single = is_first && odd(divisor);
                    sized.push(if is_single {
                        self.arena.push(Abs(*divisor))
                    } else {
                        *divisor
                    });
                }
                sized.sort_unstable();
                Fraction {
                    numerator,
                    divisors: sized,
                }
            }
            Sqrt(a) => {
                let a = self.fraction(a);
                // A root of a fraction is left a root, and then has no margin.
                let divided = |n: Place, d: &Place| self.arena.push(Div(n, *d));
                let inner = a.divisors.iter().fold(a.numerator, divided);
                Fraction {
                    numerator: self.arena.push(Sqrt(inner)),
                    divisors: vec![],
                }
            }
            Add(a, b) | Sub(a, b) => {
                let (a, b) = (self.fraction(a), self.fraction(b));
                self.sum(a, b, matches!(operation, Sub(..)))
            }
            Mul(a, b) => self.multiplied(a, b),
            Fma(a, b, c) => {
                let (product, c) = (self.multiplied(a, b), self.fraction(c));
                self.sum(product, c, false)
            }
            Minor(a, b, c, d) => {
                let p = self.multiplied(a, b);
                let q = self.multiplied(c, d);
                self.sum(p, q, true)
            }
            Div(a, b) => {
                let (a, b) = (self.fraction(a), self.fraction(b));
                let above = without(&b.divisors, &a.divisors);
                let mut divisors = without(&a.divisors, &b.divisors);
                let mut numerator = a.numerator;
                for factor in above {
                    numerator = self.arena.product(numerator, factor);
                }
                let mut divisor = b.numerator;
                if let Neg(inner) = self.arena.operations[divisor as usize] {
                    divisor = inner;
                    numerator = self.arena.negative(numerator);
                }
                divisors.push(divisor);
                divisors.sort_unstable();
                Fraction {
                    numerator,
                    divisors,
                }
            }
        }
    }

    fn multiplied(&mut self, a: Place, b: Place) -> Fraction {
        let (a, b) = (self.fraction(a), self.fraction(b));
        let numerator = self.arena.product(a.numerator, b.numerator);
        let mut divisors = [a.divisors, b.divisors].concat();
        divisors.sort_unstable();
        Fraction {
            numerator,
            divisors,
        }
    }

    /// a + b, or a - b.
    fn sum(&mut self, a: Fraction, b: Fraction, is_difference: bool) -> Fraction {
        let mut divisors = [&a.divisors[..], &without(&b.divisors, &a.divisors)].concat();
        divisors.sort_unstable();
        let [x, y] = [&a, &b].map(|part| {
            let missing = without(&divisors, &part.divisors);
            missing
                .iter()
                .fold(part.numerator, |n, factor| self.arena.product(n, *factor))
        });
        let is_zero = |place: Place| self.arena.is_number(place, 0);
        let numerator = match (is_zero(x), is_zero(y)) {
            (_, true) => x,
            (true, _) if is_difference => self.arena.negative(y),
            (true, _) => y,
            _ if is_difference => self.arena.push(Operation::Sub(x, y)),
            _ => self.arena.push(Operation::Add(x, y)),
        };
        Fraction {
            numerator,
            divisors,
        }
    }
}

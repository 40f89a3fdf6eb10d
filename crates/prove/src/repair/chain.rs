//! Gates in a row that one comparison decides: each wants a number to be positive, times the signs of some numbers that
//! all of them have in common. So the least of the numbers decides.
//!
//! A certificate has the gates one by one. Folding them leaves its proof as it is: a sign is looked at only where it is
//! farther from zero than a margin that is at least what the number needs.

use super::{Guarded, Literal, Pattern, Step};
use crate::arith::recorded::{Operation, Place};

/// A number, or its negative if true.
type Number = (bool, Place);

/// Gates in a row, and the numbers that they compare.
pub struct Chain<'a> {
    /// The gates, in their order. One that compares several numbers in a row is there once.
    pub gates: Vec<usize>,
    /// The numbers whose signs turn the others, and must be sure; twice if that is all they must be.
    pub sides: Vec<Place>,
    /// The numbers that must be positive then; negative if true stands beside them.
    pub numbers: Vec<Number>,
    /// Those of the numbers whose terms are not all among another's. The largest of their sizes is the size of all.
    pub widest: Vec<Place>,
    /// The largest of all factors.
    pub factor: f64,
    /// The step behind the gates.
    pub next: &'a Step,
}

impl Chain<'_> {
    /// Every number in it.
    pub fn places(&self) -> Vec<Place> {
        let numbers = self.numbers.iter().map(|(_, place)| *place);
        self.sides.iter().copied().chain(numbers).collect()
    }
}

impl Guarded {
    /// The chain of gates that begins with a step, as many as fit; none if its numbers are decided in another way.
    pub fn chain<'a>(&self, step: &'a Step) -> Option<Chain<'a>> {
        let Step::Gate(gate, patterns, next) = step else {
            return None;
        };
        let mut next: &Step = next;
        let mut gates = vec![*gate];
        let mut literals = vec![product(patterns)?];
        let (mut sides, mut numbers) = split(&literals)?;
        while let Step::Gate(gate, patterns, after) = next
            && let Some(literal) = product(patterns)
        {
            literals.push(literal);
            let Some(longer) = split(&literals).filter(|(_, numbers)| self.are_alike(numbers))
            else {
                break;
            };
            (sides, numbers) = longer;
            gates.push(*gate);
            next = after;
        }
        gates.dedup();
        let places: Vec<Place> = numbers.iter().map(|(_, place)| *place).collect();
        let factors = places.iter().map(|place| self.margins[place].factor);
        // The sign of an input is exact, and needs no margin.
        if factors.clone().any(|factor| factor.is_zero()) {
            return None;
        }
        Some(Chain {
            gates,
            widest: self.widest(&places),
            factor: factors.max()?.to_f64(),
            sides,
            numbers,
            next,
        })
    }

    /// True if numbers may share a margin: they have one unit, and none is made from an end, which has misses of its own.
    fn are_alike(&self, numbers: &[Number]) -> bool {
        let unit = self.unit(numbers[0].1);
        numbers.iter().all(|(_, place)| {
            let has_end = self.uses_end(*place, 0) || self.uses_end(*place, 1);
            !has_end && self.unit(*place) == unit
        })
    }

    /// The powers of length and of the direction's length in a number.
    fn unit(&self, place: Place) -> [i32; 2] {
        match self.operations[place as usize] {
            Operation::Input(3..6) => [0, 1],
            Operation::Input(_) => [1, 0],
            Operation::Mul(a, b) => {
                let ([x, y], [z, w]) = (self.unit(a), self.unit(b));
                [x + z, y + w]
            }
            Operation::Add(a, _) | Operation::Sub(a, _) => self.unit(a),
            Operation::Neg(a) | Operation::Abs(a) => self.unit(a),
            _ => [0, 0],
        }
    }

    /// The numbers but those whose terms are all among another's: their margins are no larger.
    fn widest(&self, places: &[Place]) -> Vec<Place> {
        let mut widest: Vec<Place> = Vec::new();
        for place in places {
            if widest.iter().any(|other| self.covers(*other, *place)) {
                continue;
            }
            widest.retain(|other| !self.covers(*place, *other));
            widest.push(*place);
        }
        widest
    }

    /// True if the terms of the second number are all among those of the first.
    fn covers(&self, first: Place, second: Place) -> bool {
        let mut terms = self.terms(first);
        self.terms(second).iter().all(|term| {
            let found = terms.iter().position(|other| other == term);
            found.map(|at| terms.swap_remove(at)).is_some()
        })
    }

    /// The terms of a sum of sums.
    fn terms(&self, place: Place) -> Vec<Place> {
        match self.operations[place as usize] {
            Operation::Add(a, b) | Operation::Sub(a, b) if !self.is_leaf(place) => {
                [self.terms(a), self.terms(b)].concat()
            }
            Operation::Neg(a) | Operation::Abs(a) => self.terms(a),
            _ => vec![place],
        }
    }
}

/// The condition that a gate accepts, if it rejects where the opposite holds: one literal, or two that hold or fail together.
fn product([hits, misses]: &[Vec<Pattern>; 2]) -> Option<Literal> {
    let are = |patterns: &[Pattern], expected: &[Pattern]| {
        patterns.len() == expected.len() && expected.iter().all(|it| patterns.contains(it))
    };
    let first = hits.first()?;
    match &first[..] {
        [one] => {
            let is_product = are(hits, &[vec![one.clone()]])
                && are(misses, &[vec![one.negated()]])
                && !one.signs.is_empty();
            is_product.then(|| one.clone())
        }
        [one, other] => {
            let pattern = |one: &Literal, other: &Literal| {
                let mut pattern = vec![one.clone(), other.clone()];
                pattern.sort();
                pattern
            };
            let (not_one, not_other) = (one.negated(), other.negated());
            let both = [pattern(one, other), pattern(&not_one, &not_other)];
            let either = [pattern(one, &not_other), pattern(&not_one, other)];
            (are(hits, &both) && are(misses, &either)).then(|| one.times(other))
        }
        _ => None,
    }
}

/// The numbers that literals have in common, and the one that each has for itself, negative if true stands beside it: the
/// last of a literal alone. None if they are not so alike.
fn split(literals: &[Literal]) -> Option<(Vec<Place>, Vec<Number>)> {
    let (first, others) = literals.split_first()?;
    let mut sides = first.signs.clone();
    if others.is_empty() {
        sides.pop();
    }
    sides.retain(|place| others.iter().all(|other| other.signs.contains(place)));
    let own = |literal: &Literal| {
        let is_alike = literal.signs.len() == sides.len() + 1 && literal.nonzero == first.nonzero;
        let place = literal.signs.iter().find(|place| !sides.contains(place))?;
        is_alike.then_some((literal.is_negative, *place))
    };
    let numbers = literals.iter().map(own).collect::<Option<_>>()?;
    // Squared, a sign is 0 or 1.
    sides.extend(first.nonzero.iter().flat_map(|place| [*place; 2]));
    Some((sides, numbers))
}

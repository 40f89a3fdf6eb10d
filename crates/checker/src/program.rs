//! One program of a certificate: the operations of a number, the suppositions of its proof, and the lemmas so far.

use super::domain::{Domain, INPUTS, Leaf, is_of_direction, is_of_point};
use super::format::{Bound, Format};
use super::names::Names;
use super::number::{Number, number};
use super::operations::{self, Operation, index};
use super::reader::{Outcome, Reader, ensure};
use std::collections::{BTreeSet, HashMap, HashSet};

/// A program of which a bound is proved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variant {
    /// Its operations, one a line.
    pub operations: String,
    /// Pairs of inputs of which the first must be at most as large as the second.
    pub orders: BTreeSet<(usize, usize)>,
}

/// The program of one number, the last one.
pub struct Program {
    pub format: Format,
    pub domain: Domain,
    pub operations: Vec<Operation>,
    /// Pairs of inputs: without their signs, the first is at most the second.
    pub orders: BTreeSet<(usize, usize)>,
    pub limits: Limits,
    /// Other names of axes and vertices, under which the same is claimed.
    also: Vec<Names>,
    pub lemmas: HashMap<usize, Lemma>,
}

/// Suppositions about single operations, in place of the domain's.
#[derive(Default)]
pub struct Limits {
    /// The least sizes of divisors.
    pub at_least: HashMap<usize, Number>,
    /// The largest sizes of quotients.
    pub at_most: HashMap<usize, Number>,
    /// How far below zero quotients may be, where that is supposed.
    pub down_to: HashMap<usize, Number>,
}

/// A lemma: the bound that is proved of a number.
pub struct Lemma {
    pub bound: Bound,
    /// The error before the operation rounds, if it rounds once; else that of the number.
    pub before: Number,
    /// Set if it is a coordinate of a vector divided by the vector's length.
    pub unit: Option<Unit>,
}

/// A coordinate of a vector, and how it is divided by the vector's length.
#[derive(Clone, Copy)]
pub struct Unit {
    pub coordinate: usize,
    pub length: Length,
}

/// The length that a vector is divided by.
#[derive(Clone, Copy, PartialEq)]
pub struct Length {
    pub place: usize,
    /// True if the vector is multiplied by the length's rounded reciprocal.
    pub by_reciprocal: bool,
}

/// The numerator and the divisor of n/d, or of n*(1/d).
#[derive(Clone, Copy)]
pub struct Fraction {
    pub numerator: usize,
    pub divisor: usize,
}

impl Program {
    /// Reads operations alone.
    pub fn of_operations(format: Format, reader: &mut Reader) -> Outcome<Program> {
        let operations = operations::read(&format, reader)?;
        Ok(Program {
            format,
            domain: Domain::default(),
            operations,
            orders: BTreeSet::new(),
            limits: Limits::default(),
            also: vec![],
            lemmas: HashMap::new(),
        })
    }

    /// Reads the operations and the suppositions of the proof.
    pub fn read(format: Format, domain: Domain, reader: &mut Reader) -> Outcome<Program> {
        reader.read_word("program")?;
        let mut program = Program::of_operations(format, reader)?;
        program.domain = domain;
        program.read_orders(reader)?;
        let count = program.operations.len();
        let limits = &mut program.limits;
        read_limits("at-least", count, &mut limits.at_least, reader)?;
        read_limits("at-most", count, &mut limits.at_most, reader)?;
        read_limits("down-to", count, &mut limits.down_to, reader)?;
        program.read_other_names(reader)?;
        Ok(program)
    }

    fn read_orders(&mut self, reader: &mut Reader) -> Outcome<()> {
        while reader.is_next("order") {
            let order = reader.read("order INPUT INPUT, each pair once", |words| {
                let &[smaller, larger] = words else {
                    return None;
                };
                let smaller = index(smaller, INPUTS)?;
                let larger = index(larger, INPUTS)?;
                let order = (smaller, larger);
                let is_new = smaller != larger && !self.orders.contains(&order);
                is_new.then_some(order)
            })?;
            self.orders.insert(order);
        }
        Ok(())
    }

    fn read_other_names(&mut self, reader: &mut Reader) -> Outcome<()> {
        while reader.is_next("also") {
            let known = self.variants();
            let form = "also AXES VERTICES, as yzx abc, for another program";
            let names = reader.read(form, |words| {
                let names = Names::parse(words)?;
                let is_other = !known.contains(&self.variant(names));
                is_other.then_some(names)
            })?;
            self.also.push(names);
        }
        Ok(())
    }

    /// The last operation; an error if there is none, or if something is written that no proof of its number uses.
    pub fn last_of_used(&self) -> Outcome<usize> {
        const UNUSED: &str = "found operations that the last one does not use, or none";
        let last = self.operations.len().checked_sub(1).ok_or(UNUSED)?;
        let mut used: HashSet<usize> = HashSet::new();
        for operation in &self.operations {
            used.extend(&operation.operands);
        }
        // Operands are earlier operations, so the last one is no operand. If all others are, each serves the last one.
        ensure(used.len() == last, UNUSED)?;
        for (smaller, larger) in &self.orders {
            ensure(
                self.uses_order(*smaller, *larger),
                format!("found `order {smaller} {larger}`, which no lemma uses"),
            )?;
        }
        Ok(last)
    }

    /// True if the lemma of some quotient uses an order: because it is that of its operands, or because it is part of
    /// why the divisor is the largest coordinate of the direction. "Paths and decisions" in the guide says why.
    fn uses_order(&self, smaller: usize, larger: usize) -> bool {
        for place in self.lemmas.keys() {
            let Some(fraction) = self.fraction(*place) else {
                continue;
            };
            if self.input(fraction.divisor) != Some(larger) {
                continue;
            }
            let is_of_operands = self.input(fraction.numerator) == Some(smaller);
            if is_of_operands || is_of_direction(smaller) && self.is_largest(larger) {
                return true;
            }
        }
        false
    }

    /// The program and its orders under these names.
    fn variant(&self, names: Names) -> Variant {
        let mut text = String::new();
        for (place, operation) in self.operations.iter().enumerate() {
            text.push_str(&format!("op {place} {}", operation.name));
            let numbers = match operation.name {
                "input" => vec![names.input(operation.value as usize) as i64],
                "number" => vec![operation.value],
                _ => operation.operands.iter().map(|i| *i as i64).collect(),
            };
            for number in numbers {
                text.push_str(&format!(" {number}"));
            }
            text.push('\n');
        }
        let mut orders = BTreeSet::new();
        for (smaller, larger) in &self.orders {
            let smaller = names.input(*smaller);
            let larger = names.input(*larger);
            orders.insert((smaller, larger));
        }
        Variant {
            operations: text,
            orders,
        }
    }

    /// The programs that the claim is about.
    pub fn variants(&self) -> Vec<Variant> {
        let mut variants = vec![self.variant(Names::SAME)];
        for names in &self.also {
            variants.push(self.variant(*names));
        }
        variants
    }

    /// The fraction that an operation computes, if it is a quotient or a product with a reciprocal.
    pub fn fraction(&self, place: usize) -> Option<Fraction> {
        match self.operations[place].parts() {
            ("div", &[numerator, divisor]) => Some(Fraction { numerator, divisor }),
            ("mul", &[left, right]) => {
                let by_right = self.times_reciprocal(left, right);
                by_right.or_else(|| self.times_reciprocal(right, left))
            }
            _ => None,
        }
    }

    /// The fraction of a number times another operation, if that one is a reciprocal.
    fn times_reciprocal(&self, numerator: usize, reciprocal: usize) -> Option<Fraction> {
        let ("div", &[one, divisor]) = self.operations[reciprocal].parts() else {
            return None;
        };
        let is_reciprocal = self.is_one(one);
        is_reciprocal.then_some(Fraction { numerator, divisor })
    }

    /// True if an operation is the number 1.
    pub fn is_one(&self, place: usize) -> bool {
        self.number(place) == Some(1)
    }

    /// The number that an operation is, if it is one.
    pub fn number(&self, place: usize) -> Option<i64> {
        let operation = &self.operations[place];
        (operation.name == "number").then_some(operation.value)
    }

    pub fn name(&self, place: usize) -> &'static str {
        self.operations[place].name
    }

    pub fn operands(&self, place: usize) -> &[usize] {
        &self.operations[place].operands
    }

    /// The input that an operation is, if it is one.
    pub fn input(&self, place: usize) -> Option<usize> {
        let operation = &self.operations[place];
        (operation.name == "input").then_some(operation.value as usize)
    }

    /// The leaf that an operation is: an input, or a difference of two points along an axis.
    pub fn leaf(&self, place: usize) -> Option<Leaf> {
        let ("sub", &[left, right]) = self.operations[place].parts() else {
            return self.input(place).map(Leaf::of);
        };
        let input = self.input(left)?;
        let less = self.input(right)?;
        let are_points = is_of_point(input) && is_of_point(less);
        let is_difference = are_points && input % 3 == less % 3 && input != less;
        is_difference.then_some(Leaf {
            input,
            less: Some(less),
        })
    }

    /// The least size of a divisor.
    pub fn floor(&self, divisor: usize) -> &Number {
        if let Some(floor) = self.limits.at_least.get(&divisor) {
            return floor;
        }
        match self.input(divisor) {
            Some(input) if self.is_largest(input) => self.domain.direction_floor(),
            _ => self.domain.floor(),
        }
    }

    /// True if an input is the largest coordinate of the direction, by the orders with both others: "Paths and decisions".
    fn is_largest(&self, input: usize) -> bool {
        if !is_of_direction(input) {
            return false;
        }
        let is_above = |other| other == input || self.orders.contains(&(other, input));
        (3..6).all(is_above)
    }

    /// How far below zero a quotient may be, if that is supposed: "Quotients that are not below zero" in the guide.
    pub fn down_to(&self, quotient: usize) -> Option<&Number> {
        self.limits.down_to.get(&quotient)
    }

    /// The largest size of a quotient.
    pub fn most(&self, quotient: usize) -> &Number {
        let own = self.limits.at_most.get(&quotient);
        own.unwrap_or(self.domain.quotient())
    }

    pub fn bound(&self, place: usize) -> Outcome<&Bound> {
        Ok(&self.lemma(place)?.bound)
    }

    /// The lemma of a number, or of the number in its neg or abs: a change of sign is exact.
    pub fn lemma(&self, place: usize) -> Outcome<&Lemma> {
        let mut inner = place;
        while let Some(("neg" | "abs", &[a])) = self.operations.get(inner).map(Operation::parts) {
            inner = a;
        }
        let missing = || format!("found operation {place}, expected one with a lemma above");
        self.lemmas.get(&inner).ok_or_else(missing)
    }
}

/// Reads the lines of a kind of limits, each for another operation.
fn read_limits(
    word: &str,
    operations: usize,
    limits: &mut HashMap<usize, Number>,
    reader: &mut Reader,
) -> Outcome<()> {
    while reader.is_next(word) {
        let form = format!("{word} OPERATION X, once for an operation");
        let (place, limit) = reader.read(&form, |words| {
            let &[place, limit] = words else { return None };
            let place = index(place, operations)?;
            let limit = number(limit)?;
            let is_new = !limits.contains_key(&place);
            is_new.then_some((place, limit))
        })?;
        limits.insert(place, limit);
    }
    Ok(())
}

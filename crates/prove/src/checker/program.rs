//! One program of a certificate: its operations, the decisions of its path, and the bounds so far.

use super::number::{Bound, Format, Number, number, power};
use super::reader::{Outcome, Reader};
use num_bigint::BigInt;
use num_traits::Signed;
use std::collections::{HashMap, HashSet};

/// Longer programs and formulas are refused.
pub const MOST_ROWS: usize = 1 << 12;

/// Bounds of the inputs, in the order of their names.
#[derive(Clone)]
pub struct Domain(pub [Number; 8]);

const EDGE: usize = 0;
const REACH: usize = 1;
const WORLD: usize = 2;
const DIRECTION: usize = 3;
const EXTENT: usize = 4;
const DIRECTION_FLOOR: usize = 5;
const FLOOR: usize = 6;
const QUOTIENT: usize = 7;

/// A leaf of a formula: an input, or the difference of two points' inputs along one axis.
pub type Leaf = (usize, Option<usize>);

impl Domain {
    pub fn parse(words: &[&str]) -> Option<Domain> {
        let names = "edge reach world direction extent direction-floor floor quotient".split(' ');
        let right = words.len() == 16 && words.iter().step_by(2).copied().eq(names);
        let numbers: Option<Vec<Number>> =
            words.iter().skip(1).step_by(2).map(|x| number(x)).collect();
        right.then_some(Domain(numbers?.try_into().ok()?))
    }

    pub fn bound(&self, leaf: Leaf) -> &Number {
        &self.0[match leaf {
            (0..3, Some(_)) | (_, Some(0..3)) => REACH,
            (_, Some(_)) => EDGE,
            (3..6, None) => DIRECTION,
            (0..15, None) => WORLD,
            _ => EXTENT,
        }]
    }
}

/// An input's or a number's value is `value`; everything else has operands.
pub struct Operation<'a> {
    pub name: &'a str,
    pub operands: Vec<usize>,
    pub value: i64,
}

/// A signed product of two numbers, or a signed number.
pub type Term = (bool, usize, Option<usize>);

/// The terms that an operation adds up; none for operations that are not sums.
pub fn terms(name: &str, operands: &[usize]) -> Option<Vec<Term>> {
    Some(match (name, operands) {
        ("neg", &[a]) => vec![(true, a, None)],
        ("add", &[a, b]) => vec![(false, a, None), (false, b, None)],
        ("sub", &[a, b]) => vec![(false, a, None), (true, b, None)],
        ("mul", &[a, b]) => vec![(false, a, Some(b))],
        ("fma", &[a, b, c]) => vec![(false, a, Some(b)), (false, c, None)],
        ("minor", &[a, b, c, d]) => vec![(false, a, Some(b)), (true, c, Some(d))],
        _ => return None,
    })
}

/// One path of a kernel.
pub struct Program<'a> {
    pub format: Format,
    pub domain: Domain,
    pub operations: Vec<Operation<'a>>,
    /// Pairs of inputs: without their signs, the first is at most the second.
    pub at_most: HashSet<(usize, usize)>,
    /// The limits of divisors and of quotients that stand in place of the domain's.
    pub limits: [HashMap<usize, Number>; 2],
    pub lemmas: HashMap<usize, Lemma>,
}

/// A coordinate of a vector, and the vector's length; and whether its rounded reciprocal is multiplied.
pub type Unit = (usize, (usize, bool));

/// A lemma: the bound that is proved of a number.
pub struct Lemma {
    pub bound: Bound,
    /// The error before the operation rounds, if it rounds once; else that of the number.
    pub before: Number,
    /// If it is a coordinate of a vector divided by the vector's length: of what.
    pub unit: Option<Unit>,
}

impl<'a> Program<'a> {
    /// The operations and the decisions.
    pub fn read(format: Format, domain: Domain, reader: &mut Reader<'a>) -> Outcome<Program<'a>> {
        reader.read("program", |words| words.is_empty().then_some(()))?;
        let mut operations: Vec<Operation> = Vec::new();
        let most = power(format.parameters[0]).to_integer();
        while reader.is_next("op") && operations.len() < MOST_ROWS {
            let next = operations.len();
            let form = format!("op {next} OPERATION OPERANDS, each an earlier one");
            operations.push(reader.read(&form, |words| {
                let (&[place, name], words) = words.split_first_chunk()?;
                let parsed: Option<Vec<i64>> = words.iter().map(|word| word.parse().ok()).collect();
                let parsed = parsed.filter(|_| place.parse() == Ok(next))?;
                if let ("input" | "number", &[value]) = (name, &parsed[..]) {
                    let is_input = name == "input" && (0..17).contains(&value);
                    let is_exact = name == "number" && BigInt::from(value).abs() <= most;
                    let operation = Operation { name, operands: vec![], value };
                    return (is_input || is_exact).then_some(operation);
                }
                let operands = indices(words, next)?;
                let is_known = matches!((name, operands.len()), ("abs" | "sqrt", 1) | ("div", 2));
                (is_known || terms(name, &operands).is_some()).then_some(Operation {
                    name,
                    operands,
                    value: 0,
                })
            })?);
        }
        let (at_most, lemmas) = (HashSet::new(), HashMap::new());
        let limits = [HashMap::new(), HashMap::new()];
        let mut program = Program { format, domain, operations, at_most, limits, lemmas };
        while reader.is_next("decision") {
            let count = program.operations.len();
            let fact = reader.read("decision COMPARISON OPERATIONS yes or no", |words| {
                let (&kind, rest) = words.split_first()?;
                let (&answer, rest) = rest.split_last()?;
                let places = indices(rest, count).filter(|_| ["yes", "no"].contains(&answer))?;
                match (kind, &places[..], answer) {
                    ("less" | "at-most", &[a, b], "yes") => Some((a, b)),
                    ("less" | "at-most", &[a, b], _) => Some((b, a)),
                    ("zero" | "negative", &[a], _) => Some((a, a)),
                    _ => None,
                }
            })?;
            // A decision is about computed numbers. Only inputs are certain to be exact, and not NaN.
            if let (Some(a), Some(b)) = (program.input_in_abs(fact.0), program.input_in_abs(fact.1))
            {
                program.at_most.insert((a, b));
            }
        }
        for (limits, word) in program.limits.iter_mut().zip(["at-least", "at-most"]) {
            while reader.is_next(word) {
                let count = program.operations.len();
                let form = format!("{word} OPERATION X, once for an operation");
                let (place, limit) = reader.read(&form, |words| {
                    let &[place, limit] = words else { return None };
                    let place = indices(&[place], count)?[0];
                    Some((place, number(limit)?)).filter(|_| !limits.contains_key(&place))
                })?;
                limits.insert(place, limit);
            }
        }
        // Warshall's closure.
        for k in 0..17 {
            let of_k: Vec<_> =
                program.at_most.iter().copied().filter(|(a, b)| *a == k || *b == k).collect();
            for (a, _) in of_k.iter().filter(|(_, to)| *to == k) {
                program
                    .at_most
                    .extend(of_k.iter().filter(|(from, _)| *from == k).map(|(_, b)| (*a, *b)));
            }
        }
        Ok(program)
    }

    pub fn name(&self, place: usize) -> &'a str {
        self.operations[place].name
    }

    pub fn operands(&self, place: usize) -> &[usize] {
        &self.operations[place].operands
    }

    pub fn input(&self, place: usize) -> Option<usize> {
        let operation = &self.operations[place];
        (operation.name == "input").then_some(operation.value as usize)
    }

    fn input_in_abs(&self, place: usize) -> Option<usize> {
        let operation = &self.operations[place];
        if operation.name == "abs" { self.input(operation.operands[0]) } else { None }
    }

    pub fn leaf(&self, place: usize) -> Option<Leaf> {
        let operation = &self.operations[place];
        if operation.name != "sub" {
            return self.input(place).map(|i| (i, None));
        }
        let (i, j) = (self.input(operation.operands[0])?, self.input(operation.operands[1])?);
        let are_points = [i, j].iter().all(|i| (0..3).contains(i) || (6..15).contains(i));
        (are_points && i % 3 == j % 3 && i != j).then_some((i, Some(j)))
    }

    /// The least size of a divisor.
    pub fn floor(&self, divisor: usize) -> &Number {
        self.limits[0].get(&divisor).unwrap_or_else(|| {
            let is_smaller = |axis: usize, d: usize| axis == d || self.at_most.contains(&(axis, d));
            let is_largest =
                |d: &usize| (3..6).contains(d) && (3..6).all(|axis| is_smaller(axis, *d));
            let largest = self.input(divisor).filter(is_largest);
            &self.domain.0[if largest.is_some() { DIRECTION_FLOOR } else { FLOOR }]
        })
    }

    /// The largest size of a quotient.
    pub fn most(&self, quotient: usize) -> &Number {
        self.limits[1].get(&quotient).unwrap_or(&self.domain.0[QUOTIENT])
    }

    pub fn bound(&self, place: usize) -> Outcome<&Bound> {
        Ok(&self.lemma(place)?.bound)
    }

    /// The lemma of a number, or of the number in its neg or abs.
    pub fn lemma(&self, place: usize) -> Outcome<&Lemma> {
        let mut inner = place;
        while let Some(Operation { name: "neg" | "abs", operands, .. }) = self.operations.get(inner)
        {
            inner = operands[0];
        }
        let missing = || format!("found operation {place}, expected one with a lemma above");
        self.lemmas.get(&inner).ok_or_else(missing)
    }
}

/// Whole numbers below `end`.
pub fn indices(words: &[&str], end: usize) -> Option<Vec<usize>> {
    let index = |word: &&str| word.parse().ok().filter(|i| *i < end && !word.starts_with('+'));
    words.iter().map(index).collect()
}

//! The operations of a program, and how their lines are read.

use super::domain::INPUTS;
use super::format::Format;
use super::number::whole;
use super::reader::{Outcome, Reader};

/// Longer programs and formulas are refused.
pub const MOST_ROWS: usize = 1 << 12;

/// The names of operations, and of steps of a formula.
const NAMES: [&str; 12] = [
    "input",
    "number",
    "variables",
    "neg",
    "abs",
    "add",
    "sub",
    "mul",
    "div",
    "sqrt",
    "fma",
    "minor",
];

pub fn known_name(word: &str) -> Option<&'static str> {
    NAMES.into_iter().find(|name| *name == word)
}

/// An input's or a number's value is `value`; everything else has operands.
pub struct Operation {
    pub name: &'static str,
    pub operands: Vec<usize>,
    pub value: i64,
}

/// A signed number, or a signed product of two.
pub struct Term {
    pub is_negative: bool,
    pub left: usize,
    pub right: Option<usize>,
}

impl Operation {
    /// The name and the operands, which together say what is computed.
    pub fn parts(&self) -> (&str, &[usize]) {
        (self.name, &self.operands)
    }

    /// True if it is an input, a number that is a float, or has as many operands as its name demands.
    fn is_right(&self, format: &Format) -> bool {
        match self.parts() {
            ("input", []) => (0..INPUTS as i64).contains(&self.value),
            ("number", []) => format.has(self.value),
            ("abs" | "sqrt", [_]) => true,
            ("div", [_, _]) => true,
            (name, operands) => terms(name, operands).is_some(),
        }
    }
}

impl Term {
    /// The numbers that it multiplies.
    pub fn factors(&self) -> impl Iterator<Item = usize> {
        [self.left].into_iter().chain(self.right)
    }

    fn negated(self) -> Term {
        Term {
            is_negative: !self.is_negative,
            ..self
        }
    }
}

fn alone(number: usize) -> Term {
    Term {
        is_negative: false,
        left: number,
        right: None,
    }
}

fn product(left: usize, right: usize) -> Term {
    Term {
        is_negative: false,
        left,
        right: Some(right),
    }
}

/// The terms that an operation adds up; none for operations that are not sums.
pub fn terms(name: &str, operands: &[usize]) -> Option<Vec<Term>> {
    let terms = match (name, operands) {
        ("neg", &[a]) => vec![alone(a).negated()],
        ("add", &[a, b]) => vec![alone(a), alone(b)],
        ("sub", &[a, b]) => vec![alone(a), alone(b).negated()],
        ("mul", &[a, b]) => vec![product(a, b)],
        ("fma", &[a, b, c]) => vec![product(a, b), alone(c)],
        ("minor", &[a, b, c, d]) => vec![product(a, b), product(c, d).negated()],
        _ => return None,
    };
    Some(terms)
}

/// Whole numbers below `end`.
pub fn indices(words: &[&str], end: usize) -> Option<Vec<usize>> {
    let mut indices = Vec::new();
    for word in words {
        indices.push(index(word, end)?);
    }
    Some(indices)
}

/// A whole number below `end`.
pub fn index(word: &str, end: usize) -> Option<usize> {
    let index = whole(word)?;
    (index < end).then_some(index)
}

/// Reads the lines of operations.
pub fn read(format: &Format, reader: &mut Reader) -> Outcome<Vec<Operation>> {
    let mut operations = Vec::new();
    while reader.is_next("op") && operations.len() < MOST_ROWS {
        let next = operations.len();
        let form = format!("op {next} OPERATION OPERANDS, each an earlier one");
        let operation = reader.read(&form, |words| parsed(words, next, format))?;
        operations.push(operation);
    }
    Ok(operations)
}

/// The operation of a line, which must be the next one.
fn parsed(words: &[&str], next: usize, format: &Format) -> Option<Operation> {
    let (&[place, name], operands) = words.split_first_chunk()?;
    if whole(place) != Some(next) {
        return None;
    }
    let mut operation = Operation {
        name: known_name(name)?,
        operands: vec![],
        value: 0,
    };
    match (name, operands) {
        ("input" | "number", &[value]) => operation.value = whole(value)?,
        ("input" | "number", _) => return None,
        _ => operation.operands = indices(operands, next)?,
    }
    operation.is_right(format).then_some(operation)
}

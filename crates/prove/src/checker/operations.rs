//! The operations of a program, and how their lines are read.

use super::domain::INPUTS;
use super::format::Format;
use super::number::whole;
use super::reader::{Outcome, Reader};
use num_bigint::BigInt;

/// Longer programs and formulas are refused.
pub const MOST_ROWS: usize = 1 << 12;

/// An input's or a number's value is `value`; everything else has operands.
pub struct Operation<'a> {
    pub name: &'a str,
    pub operands: Vec<usize>,
    pub value: i64,
}

/// A signed number, or a signed product of two.
#[derive(Clone)]
pub struct Term {
    pub is_negative: bool,
    pub left: usize,
    pub right: Option<usize>,
}

impl Operation<'_> {
    /// The name and the operands, which together say what is computed.
    pub fn parts(&self) -> (&str, &[usize]) {
        (self.name, &self.operands)
    }

    /// True if it is one of the inputs, or a number that is a float.
    fn has_value(&self, format: &Format) -> bool {
        if self.name == "input" {
            return (0..INPUTS as i64).contains(&self.value);
        }
        let size = BigInt::from(self.value.unsigned_abs());
        let most = BigInt::from(1) << format.parameters.digits;
        size <= most
    }

    /// True if there is such an operation, with so many operands.
    fn is_known(&self) -> bool {
        match self.parts() {
            ("abs" | "sqrt", operands) => operands.len() == 1,
            ("div", operands) => operands.len() == 2,
            (name, operands) => terms(name, operands).is_some(),
        }
    }
}

impl Term {
    /// The numbers that it multiplies.
    pub fn factors(&self) -> impl Iterator<Item = usize> + Clone {
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
pub fn read<'a>(format: &Format, reader: &mut Reader<'a>) -> Outcome<Vec<Operation<'a>>> {
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
fn parsed<'a>(words: &[&'a str], next: usize, format: &Format) -> Option<Operation<'a>> {
    let (&[place, name], operands) = words.split_first_chunk()?;
    if whole(place) != Some(next) {
        return None;
    }
    let mut operation = Operation {
        name,
        operands: vec![],
        value: 0,
    };
    if ["input", "number"].contains(&name) {
        let &[word] = operands else { return None };
        operation.value = whole(word)?;
        return operation.has_value(format).then_some(operation);
    }
    operation.operands = indices(operands, next)?;
    operation.is_known().then_some(operation)
}

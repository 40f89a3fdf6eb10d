//! The operations of a program, and how their lines are read.

use super::domain::INPUTS;
use super::format::Format;
use super::number::{power, whole};
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

impl Term {
    fn plus(left: usize, right: Option<usize>) -> Term {
        Term {
            is_negative: false,
            left,
            right,
        }
    }

    fn minus(left: usize, right: Option<usize>) -> Term {
        Term {
            is_negative: true,
            left,
            right,
        }
    }

    /// The numbers that it multiplies.
    pub fn factors(&self) -> impl Iterator<Item = usize> + Clone {
        [self.left].into_iter().chain(self.right)
    }
}

/// The terms that an operation adds up; none for operations that are not sums.
pub fn terms(name: &str, operands: &[usize]) -> Option<Vec<Term>> {
    let terms = match (name, operands) {
        ("neg", &[a]) => vec![Term::minus(a, None)],
        ("add", &[a, b]) => vec![Term::plus(a, None), Term::plus(b, None)],
        ("sub", &[a, b]) => vec![Term::plus(a, None), Term::minus(b, None)],
        ("mul", &[a, b]) => vec![Term::plus(a, Some(b))],
        ("fma", &[a, b, c]) => vec![Term::plus(a, Some(b)), Term::plus(c, None)],
        ("minor", &[a, b, c, d]) => vec![Term::plus(a, Some(b)), Term::minus(c, Some(d))],
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
    if ["input", "number"].contains(&name) {
        let &[word] = operands else { return None };
        let value = whole(word)?;
        return is_value(name, value, format).then_some(Operation {
            name,
            operands: vec![],
            value,
        });
    }
    let operands = indices(operands, next)?;
    let is_known = match (name, operands.len()) {
        ("abs" | "sqrt", 1) => true,
        ("div", 2) => true,
        _ => terms(name, &operands).is_some(),
    };
    is_known.then_some(Operation {
        name,
        operands,
        value: 0,
    })
}

/// True if it is one of the inputs, or a number that is a float.
fn is_value(name: &str, value: i64, format: &Format) -> bool {
    if name == "input" {
        return (0..INPUTS as i64).contains(&value);
    }
    let size = BigInt::from(value.unsigned_abs());
    let most = power(format.parameters.digits).to_integer();
    size <= most
}

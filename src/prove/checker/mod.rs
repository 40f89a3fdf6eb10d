//! An independent checker of certificates. docs/guide/proof.md has the theorem and the format.
//!
//! It shares no code with the prover, reads only the text, and computes with integers and rationals. A
//! number that a rule determines must be exactly that number: one unit more or less is refused.

mod corners;
mod formula;
mod number;
mod program;
mod reader;

pub use number::{Bound, Number};

use formula::Formula;
use num_traits::{One, Signed, Zero};
use number::{ERROR_DIGITS, F32, F64, Format, root_up, round_up};
use program::{DIRECTION_FLOOR, Domain, FLOOR, Operation, Program, QUOTIENT, indices};
use reader::{Outcome, Reader, ensure};
use std::fmt::{self, Display};

/// Longer texts are refused.
const MOST_BYTES: usize = 1 << 22;
/// Binary digits of a lemma's size.
const SIZE_DIGITS: i64 = 12;

/// A bound that a certificate proves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proved {
    /// Which program of the certificate, counted from 0.
    pub program: usize,
    /// The gate that compares the number.
    pub gate: String,
    /// The number's operation.
    pub place: usize,
    /// What holds for it.
    pub bound: Bound,
}

/// Why a certificate is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The line, counted from 1.
    pub line: usize,
    /// What was found there, and what was expected.
    pub message: String,
}

impl Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.message)
    }
}

/// Everything that a certificate proves, or why it is refused.
pub fn check(text: &str) -> Result<Vec<Proved>, Refusal> {
    let mut reader = Reader { lines: text.lines().peekable(), line: 0 };
    let checked = ensure(text.len() <= MOST_BYTES, format!("found more than {MOST_BYTES} bytes"));
    let checked = checked.and_then(|()| certificate(&mut reader));
    checked.map_err(|message| Refusal { line: reader.line, message })
}

fn certificate(reader: &mut Reader) -> Outcome<Vec<Proved>> {
    reader.read("hairline proof 1", |words| (words == ["proof", "1"]).then_some(()))?;
    let scalar = reader.read("kernel NAME SCALAR", |words| (words.len() == 2).then(|| words[1]))?;
    let format = reader.read("format DIGITS SMALLEST LARGEST, as of the scalar", |words| {
        let format: Option<Vec<i64>> = words.iter().map(|word| word.parse().ok()).collect();
        let format: [i64; 3] = format?.try_into().ok()?;
        let is_right = match (scalar, format) {
            ("f32", format) => format == F32,
            ("f64", format) => format == F64,
            ("float", [3..=60, -2048..=2048, -2048..=2048]) => true,
            _ => false,
        };
        is_right.then(|| Format::of(format))
    })?;
    let domain = reader.read("domain edge X reach X world X direction X …", Domain::parse)?;
    let (mut proved, mut work, mut number) = (Vec::new(), 0, 0);
    while reader.lines.peek().is_some() {
        let mut program = Program::read(format.clone(), domain.clone(), reader)?;
        while reader.is_next("lemma") {
            lemma(&mut program, &mut work, reader)?;
        }
        while reader.is_next("claim") {
            let (gate, place) = reader.read("claim GATE OPERATION", |words| match words {
                [gate, place] => Some((gate.to_string(), place.parse().ok()?)),
                _ => None,
            })?;
            let bound = program.bound(place)?.clone();
            proved.push(Proved { program: number, gate, place, bound });
        }
        reader.read("end", |words| words.is_empty().then_some(()))?;
        number += 1;
    }
    ensure(!proved.is_empty(), "found the end of the file, expected a program with a claim")?;
    Ok(proved)
}

/// Reads and checks a lemma.
fn lemma<'a>(program: &mut Program, work: &mut u64, reader: &mut Reader<'a>) -> Outcome<()> {
    let form = "lemma OPERATION sum, quotient, quotient-by-reciprocal or length X Y Z, \
                for an operation without a lemma that is no neg or abs";
    let (place, rule, vector) = reader.read(form, |words| {
        let (&[place, rule], words) = words.split_first_chunk()?;
        let place = indices(&[place], program.operations.len())?[0];
        let vector = indices(words, program.operations.len())?;
        let is_known = match rule {
            "length" => vector.len() == 3,
            "sum" | "quotient" | "quotient-by-reciprocal" => vector.is_empty(),
            _ => false,
        };
        let is_fit = !["neg", "abs"].contains(&program.operations[place].name);
        let is_new = !program.lemmas.contains_key(&place);
        (is_known && is_fit && is_new).then_some((place, rule, vector))
    })?;
    let bound = match rule {
        "sum" => {
            let formula = Formula::read(program, None, reader)?;
            let last = formula.steps[formula.steps.len() - 1].place;
            ensure(
                last == Some(place),
                format!("found another last step, expected operation {place}"),
            )?;
            let shown = formula.maximum(&program.format, work, reader)?;
            let size = round_up(&shown.size, SIZE_DIGITS);
            let error = round_up(&shown.error, ERROR_DIGITS);
            Bound { computed: shown.computed.min(&size + &error), size, error }
        }
        "length" => length(program, place, vector)?,
        _ => quotient(program, place, rule != "quotient", work, reader)?,
    };
    reader.demand("size", &bound.size)?;
    reader.demand("computed", &bound.computed)?;
    reader.demand("error", &bound.error)?;
    program.lemmas.insert(place, bound);
    Ok(())
}

/// The bound of a number that is rounded once more: its exact size, and its error and size before that.
fn rounded(format: &Format, size: Number, error: Number, before: &Number) -> Outcome<Bound> {
    let bound = format.rounded(size, before);
    format.finite(&bound.computed)?;
    Ok(Bound { error: round_up(&(error + bound.error), ERROR_DIGITS), ..bound })
}

/// The bound of n/d, or `by_reciprocal` of n*(1/d).
fn quotient(
    program: &Program,
    place: usize,
    by_reciprocal: bool,
    work: &mut u64,
    reader: &mut Reader,
) -> Outcome<Bound> {
    let format = &program.format;
    let operands = |place: usize, name: &str| {
        let Operation { name: found, operands, .. } = &program.operations[place];
        (*found == name).then(|| (operands[0], operands[1]))
    };
    let is_one = |place: usize| {
        let Operation { name, value, .. } = program.operations[place];
        (name, value) == ("number", 1)
    };
    let times = |n: usize, place: usize| {
        operands(place, "div").filter(|(one, _)| is_one(*one)).map(|(_, d)| (n, d))
    };
    let found = if by_reciprocal {
        operands(place, "mul").and_then(|(a, b)| times(a, b).or_else(|| times(b, a)))
    } else {
        operands(place, "div")
    };
    let (n, d) = found.ok_or("found a rule that does not fit its operation")?;
    let n = (by_reciprocal || !is_one(n)).then_some(n);
    let one = Bound::exactly(&Number::one());
    let (above, below) = (n.map_or(Ok(&one), |n| program.bound(n))?, program.bound(d)?);
    // Whether |n| <= |d|. A decision is about computed numbers, but inputs are exact.
    let ordered = |a: usize, b: usize| program.at_most.contains(&(a, b));
    let (numerator, divisor) = (n.and_then(|n| program.input(n)), program.input(d));
    let is_ordered = numerator.zip(divisor).is_some_and(|(n, d)| ordered(n, d));
    let is_largest = divisor
        .is_some_and(|d| (3..6).contains(&d) && (3..6).all(|axis| axis == d || ordered(axis, d)));
    let floor = &program.domain.0[if is_largest { DIRECTION_FLOOR } else { FLOOR }];
    let least = floor - &below.error;
    ensure(
        least.is_positive(),
        "found a divisor that may be rounded to zero, expected a larger floor",
    )?;
    if by_reciprocal {
        format.finite(&round_up(&least.recip(), ERROR_DIGITS))?;
    }
    let size = match n {
        Some(_) if is_ordered => Number::one(),
        Some(_) => (&above.size / floor).min(program.domain.0[QUOTIENT].clone()),
        None => floor.recip(),
    };
    let size = round_up(&size, SIZE_DIGITS);
    let formula = Formula::read(program, Some(&size), reader)?;
    ensure(
        formula.is_quotient_of(n, d),
        "found other last steps, expected numerator - quotient * divisor",
    )?;
    let mut error = formula.maximum(format, work, reader)?.error / least;
    let mut before = &size + &error;
    if by_reciprocal {
        let reciprocal = &format.unit * &before + &format.tiny * &above.computed;
        error += &reciprocal;
        before += reciprocal;
    } else if is_ordered {
        before = one.size;
    }
    rounded(format, size, error, &before)
}

/// The bound of the length of a vector: the root of the sum of three squares.
fn length(program: &Program, place: usize, vector: Vec<usize>) -> Outcome<Bound> {
    let (format, root) = (&program.format, &program.operations[place]);
    let (mut squares, mut open) = (Vec::new(), root.operands.clone());
    while let Some(place) = open.pop().filter(|_| squares.len() + open.len() < 3) {
        match (program.operations[place].name, &program.operations[place].operands[..]) {
            ("mul", &[a, b]) if a == b => squares.push(a),
            ("fma", &[a, b, c]) if a == b => {
                squares.push(a);
                open.push(c);
            }
            ("add", &[a, b]) => open.extend([a, b]),
            _ => break,
        }
    }
    squares.sort_unstable();
    let is_root = root.name == "sqrt" && squares == vector;
    ensure(is_root, "found another operation, expected the root of the sum of these squares")?;
    let (mut errors, mut sizes) = (Number::zero(), Number::zero());
    for place in vector {
        let bound = program.bound(place)?;
        errors += &bound.error * &bound.error;
        sizes += &bound.size * &bound.size;
    }
    let (shift, size) = (root_up(&errors, ERROR_DIGITS), root_up(&sizes, SIZE_DIGITS));
    let three = Number::from_integer(3.into());
    let least = &program.domain.0[FLOOR] - &shift;
    let is_safe = least.is_positive() && &three * &format.tiny <= &format.unit * &least * &least;
    ensure(is_safe, "found a length that may be rounded to zero, expected a larger floor")?;
    let largest = &size + &shift;
    let relative = three * &format.unit * &largest;
    let before = largest + &relative;
    format.finite(&(&before * &before))?;
    rounded(format, size, shift + relative, &before)
}

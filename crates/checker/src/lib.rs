//! An independent checker of certificates. docs/guide/proof.md, the guide, has the theorem and the format.
//!
//! It shares no code with the prover, reads only the text, and computes with integers and rationals. A
//! number that a rule determines must be exactly that number: one unit more or less is refused.

#![forbid(unsafe_code)]

mod corners;
mod domain;
mod format;
mod formula;
mod guarded;
mod lemma;
mod margins;
mod mirrors;
mod modular;
mod names;
mod number;
mod operations;
mod opposite;
mod points;
mod program;
mod promise;
mod quotient;
mod reader;
mod signs;
mod two_quotients;
mod unit;
mod variables;

pub use format::Bound;
pub use number::Number;
pub use program::Variant;

use domain::Domain;
use format::{F32, F64, Format, Parameters};
use number::whole;
use program::Program;
use reader::{Outcome, Reader, ensure};
use std::collections::HashMap;
use std::fmt::{self, Display};

/// Longer texts are refused.
const MOST_BYTES: usize = 1 << 22;

/// A bound that a certificate proves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proved {
    /// The line at which its program begins, counted from 1.
    pub line: usize,
    /// The bounds of its domain, in the order of their names.
    pub domain: [Number; 8],
    /// The limits of divisors and of quotients of its own; and how far below zero quotients may be.
    pub limits: [Vec<Number>; 3],
    /// The gate that compares the number.
    pub gate: String,
    /// The bound of the number.
    pub bound: Bound,
    /// True if it is an edge's value that is the exact negative of the neighbour's and, if it is not zero, has the
    /// sign of an exact determinant.
    pub has_signs: bool,
    /// The program, and those that are the same under other names of axes and vertices.
    pub programs: Vec<Variant>,
}

/// Why a certificate is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The line, counted from 1.
    pub line: usize,
    /// The text that was found there, and what was expected.
    pub message: String,
}

impl Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.message)
    }
}

/// Everything that a certificate proves, or why it is refused.
pub fn check(text: &str) -> Result<Vec<Proved>, Refusal> {
    checked(text, certificate)
}

/// How many margins make the hits and misses of a guarded kernel right, or why a certificate is refused.
pub fn check_guarded(text: &str) -> Result<usize, Refusal> {
    checked(text, |reader| {
        let format = heading(reader)?;
        guarded::check(format, reader)
    })
}

fn checked<'a, T>(
    text: &'a str,
    check: impl FnOnce(&mut Reader<'a>) -> Outcome<T>,
) -> Result<T, Refusal> {
    let mut reader = Reader {
        lines: text.lines().peekable(),
        line: 0,
        work: 0,
    };
    let outcome = if text.len() <= MOST_BYTES {
        check(&mut reader)
    } else {
        Err(format!("found more than {MOST_BYTES} bytes"))
    };
    outcome.map_err(|message| Refusal {
        line: reader.line,
        message,
    })
}

/// Reads the first lines: the version, the kernel and the format.
fn heading(reader: &mut Reader) -> Outcome<Format> {
    reader.read("hairline proof 3", |words| {
        (words == ["proof", "3"]).then_some(())
    })?;
    let scalar = reader.read("kernel NAME SCALAR", |words| {
        let &[_, scalar] = words else { return None };
        Some(scalar)
    })?;
    let form = "format DIGITS SMALLEST LARGEST, as of the scalar";
    let parameters = reader.read(form, |words| {
        let &[digits, smallest, largest] = words else {
            return None;
        };
        let parameters = Parameters {
            digits: whole(digits)?,
            smallest: whole(smallest)?,
            largest: whole(largest)?,
        };
        is_format(scalar, parameters).then_some(parameters)
    })?;
    Ok(Format::of(parameters))
}

/// True if a scalar may have these parameters.
fn is_format(scalar: &str, parameters: Parameters) -> bool {
    match scalar {
        "f32" => parameters == F32,
        "f64" => parameters == F64,
        "float" => {
            (3..=60).contains(&parameters.digits)
                && (-2048..=0).contains(&parameters.smallest)
                && (0..=2048).contains(&parameters.largest)
        }
        _ => false,
    }
}

/// Reads and checks a certificate: one program after the other, each in the domain that was stated last.
fn certificate(reader: &mut Reader) -> Outcome<Vec<Proved>> {
    let format = heading(reader)?;
    let form = "domain edge X reach X world X direction X …";
    let mut domain = reader.read(form, Domain::parse)?;
    let mut proved = Vec::new();
    while reader.lines.peek().is_some() {
        if reader.is_next("domain") {
            domain = reader.read(form, Domain::parse)?;
        }
        proved.push(claim(&format, &domain, reader)?);
    }
    ensure(
        !proved.is_empty(),
        "found the end of the file, expected a program with a claim",
    )?;
    Ok(proved)
}

/// Reads and checks a program with its lemmas, and the claim about its last operation.
fn claim(format: &Format, domain: &Domain, reader: &mut Reader) -> Outcome<Proved> {
    let line = reader.line + 1;
    let mut program = Program::read(format.clone(), domain.clone(), reader)?;
    while reader.is_next("lemma") {
        lemma::read(&mut program, reader)?;
    }
    let form = "claim GATE, and opposite or signs where it is so";
    let (gate, symmetry) = reader.read(form, |words| match *words {
        [gate] => Some((gate, None)),
        [gate, symmetry @ ("opposite" | "signs")] => Some((gate, Some(symmetry))),
        _ => None,
    })?;
    let last = program.last_of_used()?;
    let bound = program.bound(last)?.clone();
    if let Some(symmetry) = symmetry {
        opposite::check(&program, last, symmetry)?;
    }
    reader.read_word("end")?;
    let limits = &program.limits;
    Ok(Proved {
        line,
        domain: domain.0.clone(),
        limits: [&limits.at_least, &limits.at_most, &limits.down_to].map(values),
        gate: gate.to_owned(),
        bound,
        has_signs: symmetry == Some("signs"),
        programs: program.variants(),
    })
}

fn values(limits: &HashMap<usize, Number>) -> Vec<Number> {
    limits.values().cloned().collect()
}

#[cfg(test)]
mod tests;

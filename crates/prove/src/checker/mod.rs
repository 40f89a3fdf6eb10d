//! An independent checker of certificates. docs/guide/proof.md has the theorem and the format.
//!
//! It shares no code with the prover, reads only the text, and computes with integers and rationals. A
//! number that a rule determines must be exactly that number: one unit more or less is refused.

mod corners;
mod formula;
mod guarded;
mod number;
mod opposite;
mod points;
mod program;
mod reader;
mod signs;
mod variables;

pub use number::{Bound, Number};
pub use program::Variant;

use formula::Formula;
use num_traits::{One, Signed, Zero};
use number::{ERROR_DIGITS, F32, F64, Format, SIZE_DIGITS, root_up, round_up, shifted, whole};
use program::{Domain, Lemma, Program, indices};
use reader::{Outcome, Reader, ensure};
use std::fmt::{self, Display};
use variables::Quotient;

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
    checked(text, |reader| guarded::check(heading(reader)?, reader))
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
    let checked = ensure(
        text.len() <= MOST_BYTES,
        format!("found more than {MOST_BYTES} bytes"),
    );
    let checked = checked.and_then(|()| check(&mut reader));
    checked.map_err(|message| Refusal {
        line: reader.line,
        message,
    })
}

/// The first lines.
fn heading(reader: &mut Reader) -> Outcome<Format> {
    reader.read("hairline proof 3", |words| {
        (words == ["proof", "3"]).then_some(())
    })?;
    let scalar = reader.read("kernel NAME SCALAR", |words| {
        (words.len() == 2).then(|| words[1])
    })?;
    reader.read(
        "format DIGITS SMALLEST LARGEST, as of the scalar",
        |words| {
            let format: Option<Vec<i64>> = words.iter().map(|word| whole(word)).collect();
            let format: [i64; 3] = format?.try_into().ok()?;
            let is_right = match (scalar, format) {
                ("f32", format) => format == F32,
                ("f64", format) => format == F64,
                ("float", [3..=60, -2048..=0, 0..=2048]) => true,
                _ => false,
            };
            is_right.then(|| Format::of(format))
        },
    )
}

fn certificate(reader: &mut Reader) -> Outcome<Vec<Proved>> {
    let format = heading(reader)?;
    let form = "domain edge X reach X world X direction X …";
    let mut domain = reader.read(form, Domain::parse)?;
    let mut proved = Vec::new();
    while reader.lines.peek().is_some() {
        if reader.is_next("domain") {
            domain = reader.read(form, Domain::parse)?;
        }
        let line = reader.line + 1;
        let mut program = Program::read(format.clone(), domain.clone(), reader)?;
        while reader.is_next("lemma") {
            lemma(&mut program, reader)?;
        }
        let form = "claim GATE, and opposite or signs where it is so";
        let (gate, symmetry) = reader.read(form, |words| match *words {
            [gate] => Some((gate, "")),
            [gate, symmetry @ ("opposite" | "signs")] => Some((gate, symmetry)),
            _ => None,
        })?;
        let last = program.last_of_used()?;
        let bound = program.bound(last)?.clone();
        if !symmetry.is_empty() {
            opposite::check(&program, last, symmetry)?;
        }
        reader.read("end", |words| words.is_empty().then_some(()))?;
        proved.push(Proved {
            line,
            domain: domain.0.clone(),
            limits: program
                .limits
                .each_ref()
                .map(|limits| limits.values().cloned().collect()),
            gate: gate.to_owned(),
            bound,
            has_signs: symmetry == "signs",
            programs: program.variants(),
        });
    }
    ensure(
        !proved.is_empty(),
        "found the end of the file, expected a program with a claim",
    )?;
    Ok(proved)
}

/// Rules of quotients; -by-reciprocal may stand after them.
const OF_QUOTIENTS: [&str; 3] = ["quotient", "sum-of-quotients", "rest-of-quotients"];

/// Reads and checks a lemma.
fn lemma(program: &mut Program, reader: &mut Reader) -> Outcome<()> {
    let form = "lemma OPERATION sum, unit or quotient, sum-of-quotients or rest-of-quotients, \
                each of these perhaps with -by-reciprocal, for an operation without a lemma that is no neg or abs";
    let (place, rule) = reader.read(form, |words| {
        let &[place, rule] = words else { return None };
        let place = indices(&[place], program.operations.len())?[0];
        let of_quotients = rule.strip_suffix("-by-reciprocal").unwrap_or(rule);
        let is_known = ["sum", "unit"].contains(&rule) || OF_QUOTIENTS.contains(&of_quotients);
        let is_fit = !["neg", "abs"].contains(&program.operations[place].name);
        let is_new = !program.lemmas.contains_key(&place);
        (is_known && is_fit && is_new).then_some((place, rule))
    })?;
    let lemma = match rule {
        "sum" => sum(program, place, reader)?,
        "unit" => unit(program, place)?,
        _ => {
            let prove = if rule.starts_with("quotient") {
                quotient
            } else {
                two_quotients
            };
            let bound = prove(program, place, rule, reader)?;
            Lemma {
                before: bound.error.clone(),
                bound,
                unit: None,
            }
        }
    };
    reader.demand("size", &lemma.bound.size)?;
    reader.demand("computed", &lemma.bound.computed)?;
    reader.demand("error", &lemma.bound.error)?;
    program.lemmas.insert(place, lemma);
    Ok(())
}

/// A sum of products.
fn sum(program: &Program, place: usize, reader: &mut Reader) -> Outcome<Lemma> {
    let formula = Formula::read(program, None, reader)?;
    let last = formula.steps[formula.steps.len() - 1].place;
    ensure(
        last == Some(place),
        format!("found another last step, expected operation {place}"),
    )?;
    let shown = formula.maximum(&program.format, reader)?;
    let size = round_up(&shown.size, SIZE_DIGITS);
    let error = round_up(&shown.error, ERROR_DIGITS);
    let bound = Bound {
        computed: shown.computed.min(&size + &error),
        size,
        error,
    };
    Ok(Lemma {
        bound,
        before: shown.before,
        unit: None,
    })
}

/// The bound of a number that is rounded once more: its exact size, and its error and size before that.
fn rounded(format: &Format, size: Number, error: Number, before: &Number) -> Outcome<Bound> {
    let bound = format.rounded(size, before);
    format.finite(&bound.computed)?;
    Ok(Bound {
        error: round_up(&(error + bound.error), ERROR_DIGITS),
        ..bound
    })
}

/// The least size of a computed divisor.
fn least(program: &Program, d: usize) -> Outcome<Number> {
    let Format { tiny, .. } = &program.format;
    let least = program.floor(d) - &program.bound(d)?.error;
    let expected = "found a divisor that may be rounded to zero, expected a larger floor";
    ensure(least > tiny + tiny, expected)?;
    Ok(least)
}

/// The bound of u + v, or of (1 - u) - v where 1 - u has a lemma too, of two quotients by one divisor that have lemmas.
fn two_quotients(
    program: &Program,
    place: usize,
    rule: &str,
    reader: &mut Reader,
) -> Outcome<Bound> {
    let operands = |name: &str, place: usize| match program.operands(place) {
        &[a, b] if program.name(place) == name => Some((a, b)),
        _ => None,
    };
    let of_rest = |(rest, v): (usize, usize)| {
        let (_, u) = operands("sub", rest).filter(|(one, _)| program.is_one(*one))?;
        Some((u, v, Some(rest)))
    };
    let found = match rule.starts_with("sum") {
        true => operands("add", place).map(|(u, v)| (u, v, None)),
        false => operands("sub", place).and_then(of_rest),
    };
    let (u, v, rest) = found.ok_or(UNFIT)?;
    let both = &program.bound(u)?.size + &program.bound(v)?.size;
    let (most, down_to) = (program.most(place), program.down_to(place));
    let limited = |x: Number, most: Number| round_up(&x.min(most), SIZE_DIGITS);
    let (size, sum, lower) = if rest.is_none() {
        let size = limited(both, most.clone());
        (size.clone(), size, down_to.cloned())
    } else {
        // The sum of both is 1 less the number.
        let lower = down_to.map(|_| most - Number::one());
        let upper = Number::one() + down_to.unwrap_or(most);
        let upper = lower
            .clone()
            .map_or(upper.clone(), |lower| upper.max(lower));
        let size = limited(&both + Number::one(), most.clone());
        (size, limited(both, upper), lower)
    };
    let by_reciprocal = rule.ends_with("-by-reciprocal");
    let mut error = error_of_both(
        program,
        [u, v],
        (&sum, lower.as_ref()),
        by_reciprocal,
        reader,
    )?;
    if let Some(rest) = rest {
        let Bound {
            size, error: own, ..
        } = program.bound(rest)?;
        error += program.format.half_ulp(&(size + own));
    }
    let before = &size + &error;
    rounded(&program.format, size, error, &before)
}

const UNFIT: &str = "found a rule that does not fit its operation";

/// The errors of two quotients by one divisor, as one: n/d and m/d, or `by_reciprocal` n*(1/d) and m*(1/d). Given the
/// size of their sum, and how far below zero it may be.
fn error_of_both(
    program: &Program,
    parts: [usize; 2],
    (size, down_to): (&Number, Option<&Number>),
    by_reciprocal: bool,
    reader: &mut Reader,
) -> Outcome<Number> {
    let Format { unit, tiny, .. } = &program.format;
    let part = |part: &usize| {
        let is_fit = by_reciprocal == (program.name(*part) == "mul");
        program.fraction(*part).filter(|_| is_fit)
    };
    let fractions: Option<Vec<_>> = parts.iter().map(part).collect();
    let is_fit = |all: &Vec<(usize, usize)>| parts[0] != parts[1] && all[0].1 == all[1].1;
    let fractions = fractions.filter(is_fit).ok_or(UNFIT)?;
    let (d, numerators) = (fractions[0].1, [fractions[0].0, fractions[1].0]);
    let (floor, least) = (program.floor(d), least(program, d)?);
    let about = Quotient { size, down_to };
    let formula = Formula::read(program, Some(about), reader)?;
    ensure(
        formula.is_quotient_of(&numerators, d),
        "found other last steps, expected numerator + numerator - quotient * divisor",
    )?;
    // What a rounding that is left out, of the share u or the tiny number, adds to a quotient of size 1.
    let of_tiny = tiny / &least;
    let share = unit + &of_tiny;
    let share = &share / (Number::one() - &share);
    let mut error = formula.maximum(&program.format, reader)?.error;
    if formula.leaves_out(program, d) {
        error /= floor - &program.lemma(d)?.before;
        error = &error + &share * (size + &error) + &of_tiny;
    } else {
        error /= least;
    }
    for (part, n) in parts.into_iter().zip(numerators) {
        let Bound {
            size,
            error: of_part,
            ..
        } = program.bound(part)?;
        // Whatever its own lemma leaves out.
        let mut largest = (size + of_part + &of_tiny) * (Number::one() + &share + &share);
        if formula.leaves_out(program, n) {
            error += &share * &largest + &of_tiny;
        }
        if by_reciprocal {
            let reciprocal = unit * &largest + tiny * &program.bound(n)?.computed;
            error += &reciprocal;
            largest += reciprocal;
        }
        error += program.format.half_ulp(&largest);
    }
    Ok(error)
}

/// The bound of n/d, or by a reciprocal of n*(1/d).
fn quotient(program: &Program, place: usize, rule: &str, reader: &mut Reader) -> Outcome<Bound> {
    let format = &program.format;
    let by_reciprocal = rule.ends_with("-by-reciprocal");
    let is_fit = by_reciprocal == (program.operations[place].name == "mul");
    let found = program.fraction(place).filter(|_| is_fit);
    let (n, d) = found.ok_or(UNFIT)?;
    let n = (by_reciprocal || !program.is_one(n)).then_some(n);
    let one = Bound::exactly(&Number::one());
    let above = n.map_or(Ok(&one), |n| program.bound(n))?;
    let below_before = &program.lemma(d)?.before;
    let (numerator, divisor) = (n.and_then(|n| program.input(n)), program.input(d));
    let is_ordered = numerator
        .zip(divisor)
        .is_some_and(|order| program.orders.contains(&order));
    let (floor, least) = (program.floor(d), least(program, d)?);
    if by_reciprocal {
        format.finite(&round_up(&least.recip(), ERROR_DIGITS))?;
    }
    let size = match n {
        Some(_) if is_ordered => Number::one(),
        Some(_) => (&above.size / floor).min(program.most(place).clone()),
        None => floor.recip(),
    };
    let size = round_up(&size, SIZE_DIGITS);
    let about = Quotient {
        size: &size,
        down_to: program.down_to(place),
    };
    let formula = Formula::read(program, Some(about), reader)?;
    ensure(
        formula.is_quotient_of(n.as_slice(), d),
        "found other last steps, expected numerator - quotient * divisor",
    )?;
    let of_divisor = formula.leaves_out(program, d);
    let closest = if of_divisor {
        floor - below_before
    } else {
        least.clone()
    };
    let mut error = formula.maximum(format, reader)?.error / closest;
    let mut before = &size + &error;
    let left_out =
        u8::from(of_divisor) + u8::from(n.is_some_and(|n| formula.leaves_out(program, n)));
    if left_out > 0 {
        let tiny = &format.tiny / least;
        let share = &format.unit + &tiny;
        let share = &share / (Number::one() - &share) * Number::from_integer(left_out.into());
        error += share * &before + tiny;
        before = &size + &error;
    }
    if by_reciprocal {
        let reciprocal = &format.unit * &before + &format.tiny * &above.computed;
        error += &reciprocal;
        before += reciprocal;
    } else if is_ordered {
        before = one.size;
    }
    rounded(format, size, error, &before)
}

/// The bound of a coordinate of a vector that is divided by its length: the error is that of all of them.
fn unit(program: &Program, place: usize) -> Outcome<Lemma> {
    let found = program.fraction(place);
    let vector = found.and_then(|(n, length)| {
        let is_fit = |vector: &Vec<usize>| vector.len() == 3 && vector.contains(&n);
        squares(program, length)
            .filter(is_fit)
            .map(|vector| (vector, length))
    });
    let (vector, length) =
        vector.ok_or("found another operation, expected a part of a vector by its length")?;
    let (mut before, mut sizes) = (Number::zero(), Number::zero());
    for place in vector {
        let lemma = program.lemma(place)?;
        before += &lemma.before * &lemma.before;
        sizes += &lemma.bound.computed * &lemma.bound.computed;
    }
    let (before, size) = (
        root_up(&before, ERROR_DIGITS),
        root_up(&sizes, ERROR_DIGITS),
    );
    let Format { unit, tiny, .. } = &program.format;
    let (floor, one) = (program.floor(length), Number::one());
    let times = |n: i64, x: &Number| Number::from_integer(n.into()) * x;
    let shift = &before + unit * (&before + floor) + times(2, tiny);
    let least = floor - &shift;
    let is_safe = least.is_positive() && times(6, tiny) <= unit * unit * &least * &least;
    ensure(
        is_safe,
        "found a length that may be rounded to zero, expected a larger floor",
    )?;
    let (longest, third) = (&size * (&one + times(2, unit)), &one - times(3, unit));
    program
        .format
        .finite(&round_up(&(&longest * &longest), ERROR_DIGITS))?;
    program
        .format
        .finite(&round_up(&(least * &third).recip(), ERROR_DIGITS))?;
    let (turn, stretch) = (
        &shift / (floor - shifted(&shift, -1)),
        times(4, unit) / third,
    );
    let before = &stretch * &stretch + (&one + &stretch) * &turn * &turn;
    let before = root_up(&before, ERROR_DIGITS) + size * tiny;
    let rounded = &one + &before;
    let error = round_up(&(&before + unit * &rounded + times(2, tiny)), ERROR_DIGITS);
    let computed = program.format.float_up(&rounded);
    program.format.finite(&computed)?;
    let by_reciprocal = program.operations[place].name == "mul";
    let unit = found.map(|(n, length)| (n, (length, by_reciprocal)));
    Ok(Lemma {
        before: error.clone(),
        bound: Bound {
            size: one,
            computed,
            error,
        },
        unit,
    })
}

/// The numbers whose squares an operation adds up before it takes the root; more than three if they are too many.
fn squares(program: &Program, root: usize) -> Option<Vec<usize>> {
    let root = Some(&program.operations[root]).filter(|root| root.name == "sqrt")?;
    let (mut squares, mut open) = (Vec::new(), root.operands.clone());
    while let Some(place) = open.pop().filter(|_| squares.len() < 4) {
        match (
            program.operations[place].name,
            &program.operations[place].operands[..],
        ) {
            ("mul", &[a, b]) if a == b => squares.push(a),
            ("fma", &[a, b, c]) if a == b => {
                squares.push(a);
                open.push(c);
            }
            ("add", &[a, b]) => open.extend([a, b]),
            _ => return None,
        }
    }
    Some(squares)
}

#[cfg(test)]
mod tests;

//! Checks that an edge's value is, bit for bit, the negative of what the same program computes for the triangle on
//! the other side, and has the sign of an exact determinant: `opposite` and `signs` in the guide's "The certificate".

use super::operations::{Operation, terms};
use super::program::Program;
use super::reader::{Outcome, ensure};
use std::collections::HashMap;

/// A number's value: a sign, and the name of a form. Numbers of one form have one size, bit for bit.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Value {
    is_negative: bool,
    form: usize,
}

impl Value {
    fn negated(self) -> Value {
        Value {
            is_negative: !self.is_negative,
            form: self.form,
        }
    }
}

/// A summand of a form: a sign, and the forms of its factors, in order.
#[derive(PartialEq, Eq, Hash)]
struct Summand {
    is_negative: bool,
    factors: Vec<usize>,
}

impl Summand {
    fn plus(factors: Vec<usize>) -> Summand {
        Summand {
            is_negative: false,
            factors,
        }
    }
}

/// The normal form of an operation, of which the first summand is positive.
#[derive(PartialEq, Eq, Hash)]
struct Form {
    name: &'static str,
    summands: Vec<Summand>,
}

/// Two of the triangle's vertices, by their places among the points of a ray and a triangle.
#[derive(Clone, Copy)]
struct Edge {
    p: usize,
    q: usize,
}

impl Edge {
    /// The input in place of an input if the vertices are exchanged.
    fn exchanged(self, input: usize) -> usize {
        let axis = input % 3;
        match input / 3 {
            point if point == self.p => 3 * self.q + axis,
            point if point == self.q => 3 * self.p + axis,
            _ => input,
        }
    }
}

/// The forms that are known so far, each with its name.
struct Forms<'p> {
    program: &'p Program,
    names: HashMap<Form, usize>,
}

/// The values of a program's operations as they are, and with the vertices of an edge exchanged.
struct Sides {
    edge: Edge,
    here: Vec<Value>,
    there: Vec<Value>,
}

/// Checks that a number is made of two of the triangle's vertices, and has one form and opposite signs if they are
/// exchanged; and, for `signs`, that it is x(p)*y(q) - x(q)*y(p), with both products rounded or neither.
pub fn check(program: &Program, place: usize, claim: &str) -> Outcome<()> {
    let found = format!("found `{claim}` of operation {place}, expected");
    let &[p, q] = &vertices(program, place)[..] else {
        return Err(format!("{found} one that is made of two vertices"));
    };
    let edge = Edge { p, q };
    let mut forms = Forms {
        program,
        names: HashMap::new(),
    };
    let sides = Sides {
        edge,
        here: forms.values(None),
        there: forms.values(Some(edge)),
    };
    ensure(
        sides.here[place] == sides.there[place].negated(),
        format!("{found} its negative where the vertices are exchanged"),
    )?;
    if claim == "opposite" {
        return Ok(());
    }
    ensure(
        sides.has_determinant(program, place),
        format!("{found} x(p)*y(q) - x(q)*y(p) of two vertices"),
    )
}

/// The vertices of which a number is made: a, b and c as 2, 3 and 4.
fn vertices(program: &Program, place: usize) -> Vec<usize> {
    let mut vertices = vec![2, 3, 4];
    vertices.retain(|vertex| is_made_of(program, place, *vertex));
    vertices
}

/// True if a number depends on a point.
fn is_made_of(program: &Program, last: usize, point: usize) -> bool {
    let mut depends = Vec::new();
    for place in 0..=last {
        let mut operands = program.operands(place).iter();
        depends.push(match program.input(place) {
            Some(input) => input / 3 == point,
            None => operands.any(|operand| depends[*operand]),
        });
    }
    depends[last]
}

/// The factors of x*y - z*w.
struct Products {
    first: [usize; 2],
    second: [usize; 2],
}

/// The products whose difference a number is, both rounded or neither.
fn products(program: &Program, place: usize) -> Option<Products> {
    match program.operations[place].parts() {
        ("minor", &[x, y, z, w]) => Some(Products {
            first: [x, y],
            second: [z, w],
        }),
        ("sub", &[left, right]) => Some(Products {
            first: factors(program, left)?,
            second: factors(program, right)?,
        }),
        _ => None,
    }
}

fn factors(program: &Program, place: usize) -> Option<[usize; 2]> {
    if program.name(place) != "mul" {
        return None;
    }
    program.operands(place).try_into().ok()
}

impl Sides {
    /// True if a number is x(p)*y(q) - x(q)*y(p): the factors of one product are made of one vertex each, and with the
    /// vertices exchanged they are those of the other.
    ///
    /// Rounding is monotone. So where the rounded products differ, their difference has the sign of that of the exact
    /// ones, which is the determinant of the computed images.
    fn has_determinant(&self, program: &Program, place: usize) -> bool {
        let Some(Products { first, second }) = products(program, place) else {
            return false;
        };
        let mut images = first.map(|factor| vertices(program, factor));
        let mut there = first.map(|factor| self.there[factor]);
        let mut here = second.map(|factor| self.here[factor]);
        images.sort_unstable();
        there.sort_unstable();
        here.sort_unstable();
        let Edge { p, q } = self.edge;
        images == [[p], [q]] && there == here
    }
}

impl Forms<'_> {
    /// The values of all operations, with the vertices of an edge exchanged or as they are.
    ///
    /// Sums and products commute, and rounding to nearest is odd. So the order of summands and of factors does not count,
    /// and a sign of all summands is one of the result.
    fn values(&mut self, exchanged: Option<Edge>) -> Vec<Value> {
        let mut values: Vec<Value> = Vec::new();
        for operation in &self.program.operations {
            if let ("neg", &[a]) = operation.parts() {
                values.push(values[a].negated());
                continue;
            }
            let mut summands = summands(operation, &values, exchanged);
            summands.sort_by(|one, other| one.factors.cmp(&other.factors));
            let is_negative = summands[0].is_negative;
            for summand in &mut summands {
                summand.is_negative ^= is_negative;
            }
            let name = match operation.name {
                "sub" => "add",
                name => name,
            };
            let next = self.names.len();
            let form = Form { name, summands };
            let form = self.names.entry(form).or_insert(next);
            values.push(Value {
                is_negative,
                form: *form,
            });
        }
        values
    }
}

/// The summands of an operation, from the values of its operands.
fn summands(operation: &Operation, values: &[Value], exchanged: Option<Edge>) -> Vec<Summand> {
    let value = operation.value;
    let alone = match operation.parts() {
        ("input", _) => {
            let input = value as usize;
            let renamed = exchanged.map_or(input, |edge| edge.exchanged(input));
            Summand::plus(vec![renamed])
        }
        ("number", _) => Summand {
            is_negative: value < 0,
            factors: vec![value.unsigned_abs() as usize],
        },
        ("abs", &[a]) => Summand::plus(vec![values[a].form]),
        // A root has no sign of its own, and that of its operand counts.
        ("sqrt", &[a]) => {
            let sign = usize::from(values[a].is_negative);
            Summand::plus(vec![values[a].form, sign])
        }
        // The order of both counts.
        ("div", &[a, b]) => Summand {
            is_negative: values[a].is_negative ^ values[b].is_negative,
            factors: vec![values[a].form, values[b].form],
        },
        _ => return sum(operation, values),
    };
    vec![alone]
}

/// The summands of a sum of products.
fn sum(operation: &Operation, values: &[Value]) -> Vec<Summand> {
    let terms = terms(operation.name, &operation.operands);
    let mut summands = Vec::new();
    for term in terms.expect("the program was read") {
        let mut summand = Summand {
            is_negative: term.is_negative,
            factors: vec![],
        };
        for factor in term.factors() {
            let value = values[factor];
            summand.is_negative ^= value.is_negative;
            summand.factors.push(value.form);
        }
        summand.factors.sort_unstable();
        summands.push(summand);
    }
    summands
}

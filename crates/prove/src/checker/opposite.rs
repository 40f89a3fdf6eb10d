//! Checks that an edge's value is, bit for bit, the negative of what the same program computes for the triangle on
//! the other side, and has the sign of an exact determinant: `opposite` and `signs` in the guide's "The certificate".

use super::operations::terms;
use super::program::Program;
use super::reader::{Outcome, ensure};
use std::collections::HashMap;

/// A number's value: a sign, and the name of a form. Numbers of one form have one size, bit for bit.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Value {
    is_negative: bool,
    form: usize,
}

/// A summand of a form: a sign, and the forms of its factors, in order.
#[derive(Clone, PartialEq, Eq, Hash)]
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

/// Checks that a number is made of two of the triangle's vertices, and has one form and opposite signs if they are
/// exchanged; and, for `signs`, that it is x(p)*y(q) - x(q)*y(p), with both products rounded or neither.
pub fn check(program: &Program, place: usize, claim: &str) -> Outcome<()> {
    let found = format!("found `{claim}` of operation {place}, expected");
    let mut vertices = Vec::new();
    for vertex in 2..5 {
        if is_made_of(program, place, vertex) {
            vertices.push(vertex);
        }
    }
    let &[p, q] = &vertices[..] else {
        return Err(format!("{found} one that is made of two vertices"));
    };
    let edge = Edge { p, q };
    let mut forms = Forms {
        program,
        names: HashMap::new(),
    };
    let here = forms.value(place, None);
    let there = forms.value(place, Some(edge));
    ensure(
        here.form == there.form && here.is_negative != there.is_negative,
        format!("{found} its negative where the vertices are exchanged"),
    )?;
    if claim == "opposite" {
        return Ok(());
    }
    ensure(
        forms.is_determinant(place, edge),
        format!("{found} x(p)*y(q) - x(q)*y(p) of two vertices"),
    )
}

/// True if a number depends on a point.
fn is_made_of(program: &Program, last: usize, point: usize) -> bool {
    let mut depends = Vec::new();
    for place in 0..=last {
        let is_of_it = match program.input(place) {
            Some(input) => input / 3 == point,
            None => program.operands(place).iter().any(|i| depends[*i]),
        };
        depends.push(is_of_it);
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
    match (program.name(place), program.operands(place)) {
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

impl Forms<'_> {
    /// True if a number is x(p)*y(q) - x(q)*y(p): the factors of one product are made of one vertex each, and with the
    /// vertices exchanged they are those of the other.
    ///
    /// Rounding is monotone. So where the rounded products differ, their difference has the sign of that of the exact
    /// ones, which is the determinant of the computed images.
    fn is_determinant(&mut self, place: usize, edge: Edge) -> bool {
        let Some(Products { first, second }) = products(self.program, place) else {
            return false;
        };
        let [x, y] = first;
        let Edge { p, q } = edge;
        let are_apart = self.is_of_one(x, p, q) && self.is_of_one(y, q, p)
            || self.is_of_one(x, q, p) && self.is_of_one(y, p, q);
        let mut there = first.map(|factor| self.value(factor, Some(edge)));
        let mut here = second.map(|factor| self.value(factor, None));
        there.sort_unstable();
        here.sort_unstable();
        are_apart && there == here
    }

    /// True if a number depends on one vertex, and not on the other.
    fn is_of_one(&self, place: usize, vertex: usize, other: usize) -> bool {
        is_made_of(self.program, place, vertex) && !is_made_of(self.program, place, other)
    }

    /// The value of a number, with the vertices of an edge exchanged or as they are.
    ///
    /// Sums and products commute, and rounding to nearest is odd. So the order of summands and of factors does not count,
    /// and a sign of all summands is one of the result.
    fn value(&mut self, last: usize, exchanged: Option<Edge>) -> Value {
        let mut values: Vec<Value> = Vec::new();
        for place in 0..=last {
            if let ("neg", &[a]) = (self.program.name(place), self.program.operands(place)) {
                values.push(Value {
                    is_negative: !values[a].is_negative,
                    form: values[a].form,
                });
                continue;
            }
            let mut summands = self.summands(place, &values, exchanged);
            summands.sort_by(|one, other| one.factors.cmp(&other.factors));
            let is_negative = summands[0].is_negative;
            for summand in &mut summands {
                summand.is_negative ^= is_negative;
            }
            let name = match self.program.name(place) {
                "sub" => "add",
                name => name,
            };
            let next = self.names.len();
            let form = Form { name, summands };
            values.push(Value {
                is_negative,
                form: *self.names.entry(form).or_insert(next),
            });
        }
        values[last]
    }

    /// The summands of an operation, from the values of its operands.
    fn summands(&self, place: usize, values: &[Value], exchanged: Option<Edge>) -> Vec<Summand> {
        let name = self.program.name(place);
        let operands = self.program.operands(place);
        let value = self.program.operations[place].value;
        match (name, operands) {
            ("input", _) => {
                let input = value as usize;
                let renamed = exchanged.map_or(input, |edge| edge.exchanged(input));
                vec![Summand::plus(vec![renamed])]
            }
            ("number", _) => vec![Summand {
                is_negative: value < 0,
                factors: vec![value.unsigned_abs() as usize],
            }],
            ("abs", &[a]) => vec![Summand::plus(vec![values[a].form])],
            // A root has no sign of its own, and that of its operand counts.
            ("sqrt", &[a]) => {
                let sign = usize::from(values[a].is_negative);
                vec![Summand::plus(vec![values[a].form, sign])]
            }
            // The order of both counts.
            ("div", &[a, b]) => vec![Summand {
                is_negative: values[a].is_negative ^ values[b].is_negative,
                factors: vec![values[a].form, values[b].form],
            }],
            _ => sum(name, operands, values),
        }
    }
}

/// The summands of a sum of products.
fn sum(name: &str, operands: &[usize], values: &[Value]) -> Vec<Summand> {
    let mut summands = Vec::new();
    for term in terms(name, operands).expect("the program was read") {
        let mut is_negative = term.is_negative;
        let mut factors = Vec::new();
        for factor in term.factors() {
            is_negative ^= values[factor].is_negative;
            factors.push(values[factor].form);
        }
        factors.sort_unstable();
        summands.push(Summand {
            is_negative,
            factors,
        });
    }
    summands
}

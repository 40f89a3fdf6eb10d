//! Checks that an edge's value is, bit for bit, the negative of what the same program computes for the triangle on
//! the other side, and has the sign of an exact determinant.

use super::program::{Program, terms};
use super::reader::{Outcome, ensure};
use std::collections::HashMap;

/// The terms that an operation adds up: for each term, true if it has the other sign than the first, and its factors
/// by their forms. Sums and products commute, and rounding to nearest is odd.
type Form<'a> = (&'a str, Vec<(bool, Vec<usize>)>);

/// Checks that a number is made of two of the triangle's vertices, and has one form and opposite signs if they are
/// exchanged; and, for `signs`, that it is x(p)*y(q) - x(q)*y(p), with both products rounded or neither.
pub fn check(program: &Program, place: usize, claim: &str) -> Outcome<()> {
    let ensure = |holds: bool, expected: &str| {
        ensure(
            holds,
            format!("found `{claim}` of operation {place}, expected {expected}"),
        )
    };
    let vertices: Vec<usize> = (2..5)
        .filter(|vertex| is_made_of(program, place, *vertex))
        .collect();
    let &[p, q] = &vertices[..] else {
        return ensure(false, "one that is made of two vertices");
    };
    let mut forms = HashMap::new();
    let (sign, form) = form(program, place, &mut forms, &|i| i);
    let exchange = |i: usize| match i / 3 {
        point if point == p => 3 * q + i % 3,
        point if point == q => 3 * p + i % 3,
        _ => i,
    };
    let (other_sign, other) = self::form(program, place, &mut forms, &exchange);
    ensure(
        form == other && sign != other_sign,
        "its negative where the vertices are exchanged",
    )?;
    if claim == "opposite" {
        return Ok(());
    }
    // x(p)*y(q) - x(q)*y(p), both products rounded or neither.
    let product = |place: usize| (program.name(place) == "mul").then(|| program.operands(place));
    let factors = match (program.name(place), program.operands(place)) {
        ("minor", &[x, y, z, w]) => Some(([x, y], [z, w])),
        ("sub", &[a, b]) => match (product(a), product(b)) {
            (Some(&[x, y]), Some(&[z, w])) => Some(([x, y], [z, w])),
            _ => None,
        },
        _ => None,
    };
    let is_of = |place: usize, is: usize, is_not: usize| {
        is_made_of(program, place, is) && !is_made_of(program, place, is_not)
    };
    let is_picture = factors.is_some_and(|([x, y], second)| {
        let mut there = [x, y].map(|place| self::form(program, place, &mut forms, &exchange));
        let mut here = second.map(|place| self::form(program, place, &mut forms, &|i| i));
        there.sort_unstable();
        here.sort_unstable();
        let are_apart = is_of(x, p, q) && is_of(y, q, p) || is_of(x, q, p) && is_of(y, p, q);
        are_apart && there == here
    });
    ensure(is_picture, "x(p)*y(q) - x(q)*y(p) of two vertices")
}

/// True if a number depends on a point.
fn is_made_of(program: &Program, place: usize, point: usize) -> bool {
    let mut depends = Vec::new();
    for place in 0..=place {
        let of_input = program
            .input(place)
            .is_some_and(|i| i < 15 && i / 3 == point);
        depends.push(
            of_input
                || program
                    .operands(place)
                    .iter()
                    .any(|operand| depends[*operand]),
        );
    }
    depends[place]
}

/// The sign (true is minus) and the form of a number whose inputs are renamed.
fn form<'a>(
    program: &Program<'a>,
    last: usize,
    forms: &mut HashMap<Form<'a>, usize>,
    rename: &dyn Fn(usize) -> usize,
) -> (bool, usize) {
    let mut values: Vec<(bool, usize)> = Vec::new();
    for place in 0..=last {
        let (name, operands) = (program.name(place), program.operands(place));
        let value = program.operations[place].value;
        let (kind, mut all) = match (name, operands) {
            ("neg", &[a]) => {
                values.push((!values[a].0, values[a].1));
                continue;
            }
            ("abs", &[a]) => (name, vec![(false, vec![values[a].1])]),
            ("input", _) => (name, vec![(false, vec![rename(value as usize)])]),
            ("number", _) => (name, vec![(value < 0, vec![value.unsigned_abs() as usize])]),
            // The order of both counts.
            ("div", &[a, b]) => {
                let ((s, a), (t, b)) = (values[a], values[b]);
                (name, vec![(s ^ t, vec![a, b])])
            }
            // A root has no sign of its own, and that of its operand counts.
            ("sqrt", &[a]) => (
                name,
                vec![(false, vec![values[a].1, usize::from(values[a].0)])],
            ),
            _ => {
                let term = |(minus, a, b): (bool, usize, Option<usize>)| {
                    let factors = [Some(a), b].into_iter().flatten().map(|i| values[i]);
                    let minus = factors.clone().fold(minus, |minus, (sign, _)| minus ^ sign);
                    let mut forms: Vec<usize> = factors.map(|(_, form)| form).collect();
                    forms.sort_unstable();
                    (minus, forms)
                };
                let terms = terms(name, operands).expect("the program was read");
                let kind = if name == "sub" { "add" } else { name };
                (kind, terms.into_iter().map(term).collect())
            }
        };
        all.sort_by(|(_, one), (_, other)| one.cmp(other));
        let sign = all[0].0;
        all.iter_mut().for_each(|(minus, _)| *minus ^= sign);
        let next = forms.len();
        values.push((sign, *forms.entry((kind, all)).or_insert(next)));
    }
    values[last]
}

//! Quotients of edges' coordinates by one number, and what follows for the third edge.

use super::number::{Bound, Number};
use super::program::{Operation, Program, terms};
use super::reader::Outcome;
use num_traits::One;
use std::collections::HashMap;

/// A supposition about two edges of the triangle: along an axis they have the same sign, one of them perhaps
/// turned round.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct SameSign {
    divisor: usize,
    /// The vertex at which they meet.
    vertex: usize,
    axis: usize,
    /// The other axis of the plane in which the divisor is twice the triangle's area.
    other: usize,
}

impl SameSign {
    /// Along the other axis. They are of the same sign along one of both.
    pub fn or(self) -> SameSign {
        SameSign { axis: self.other, other: self.axis, ..self }
    }
}

/// A quotient of the third edge: the second quotient less the first one, or (`minus`) their sum.
pub struct Third {
    pub first: usize,
    pub second: usize,
    /// True if the first one's negative is a part of the second one.
    pub minus: bool,
    pub same_sign: SameSign,
    /// The bound of the second quotient.
    pub bound: Bound,
    /// The largest size of a quotient of the third edge.
    pub size: Number,
}

/// A sum of coordinates of vertices along one axis: how often each vertex is in it.
type Sum = [i64; 3];

/// Which quotient of the third edge follows from two others; none if none does.
pub fn third(program: &Program, first: usize, second: usize) -> Outcome<Option<Third>> {
    let Some((minus, same_sign)) = kind(program, first, second) else { return Ok(None) };
    let bound = program.bound(second)?.clone();
    let size = program.bound(first)?.size.clone().max(bound.size.clone());
    Ok(Some(Third { first, second, minus, same_sign, bound, size }))
}

fn kind(program: &Program, first: usize, second: usize) -> Option<(bool, SameSign)> {
    let quotient = |place: usize| {
        let Operation { name, operands, .. } = &program.operations[place];
        (*name == "div").then(|| Some((edge(program, operands[0])?, operands[1])))?
    };
    let (((u, axis), divisor), ((v, along), other_divisor)) = (quotient(first)?, quotient(second)?);
    let quotients = program.most(first).max(program.most(second));
    let most = program.domain.bound((6, Some(9))) * quotients;
    if divisor != other_divisor || axis != along || most >= Number::one() {
        return None;
    }
    let third = |minus: bool| [0, 1, 2].map(|k| if minus { v[k] + u[k] } else { v[k] - u[k] });
    let minus = [false, true].into_iter().find(|minus| {
        let mut sorted = third(*minus);
        sorted.sort_unstable();
        sorted == [-1, 0, 1]
    })?;
    let vertex = third(minus).iter().position(|k| *k == 0)?;
    let area = polynomial(program, divisor, 4)?;
    let is_area = |other: &usize| {
        let mut minor = HashMap::new();
        add_product(&mut minor, 1, (u, axis), (v, *other));
        add_product(&mut minor, -1, (v, axis), (u, *other));
        minor.retain(|_, count| *count != 0);
        let negative: HashMap<_, _> = minor.iter().map(|(key, count)| (*key, -count)).collect();
        *other != axis && (area == minor || area == negative)
    };
    let other = (0..3).find(is_area)?;
    Some((minus, SameSign { divisor, vertex, axis, other }))
}

/// The difference of two vertices along an axis that an operation is, and the axis.
fn edge(program: &Program, place: usize) -> Option<(Sum, usize)> {
    let Operation { name, operands, .. } = &program.operations[place];
    if *name == "neg" {
        let (sum, axis) = edge(program, operands[0])?;
        return Some((sum.map(|k| -k), axis));
    }
    let (i, j) = program.leaf(place)?;
    let (i, j) = (i.checked_sub(6)?, j?.checked_sub(6)?);
    let mut sum = [0; 3];
    sum[i / 3] += 1;
    sum[j / 3] -= 1;
    Some((sum, i % 3))
}

/// Products of two coordinates, each with how often it is in a sum. A coordinate is its vertex and its axis.
type Polynomial = HashMap<[(usize, usize); 2], i64>;

fn add_product(
    to: &mut Polynomial,
    factor: i64,
    (u, axis): (Sum, usize),
    (v, along): (Sum, usize),
) {
    for (i, k) in u.iter().enumerate() {
        for (j, l) in v.iter().enumerate() {
            let mut key = [(i, axis), (j, along)];
            key.sort_unstable();
            *to.entry(key).or_default() += factor * k * l;
        }
    }
}

/// An operation as a sum of products of edges, multiplied out.
fn polynomial(program: &Program, place: usize, depth: usize) -> Option<Polynomial> {
    let Operation { name, operands, .. } = &program.operations[place];
    let mut sum = Polynomial::new();
    for (minus, a, b) in terms(name, operands).filter(|_| 0 < depth)? {
        let factor = if minus { -1 } else { 1 };
        if let Some(b) = b {
            add_product(&mut sum, factor, edge(program, a)?, edge(program, b)?);
        } else {
            let inner = polynomial(program, a, depth - 1)?;
            inner
                .into_iter()
                .for_each(|(key, count)| *sum.entry(key).or_default() += factor * count);
        }
    }
    sum.retain(|_, count| *count != 0);
    Some(sum)
}

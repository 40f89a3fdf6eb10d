//! All corners of a box, in integers: the largest size of each step, and the largest sum of the effects of
//! all rounding errors.

use num_bigint::BigInt;
use num_traits::{One, Signed};

/// Longer numbers are refused.
const MOST_BITS: u64 = 1 << 12;

/// One step, with what it adds up: a constant, variables with factors, and earlier steps or products of two
/// with factors. And the variables in it, as bits.
#[derive(Clone)]
pub struct Row<T> {
    pub constant: T,
    pub variables: Vec<(T, usize)>,
    pub terms: Vec<(T, usize, Option<usize>)>,
    pub support: usize,
}

/// The weight of a step's error, and whether it is multiplied by the step.
pub type Weight<T> = (T, bool);

/// The largest sum, and the first corner that has it: bit v is set where variable v is negative.
pub struct Found<T> {
    pub sum: T,
    pub corner: usize,
    /// The largest size of each step.
    pub sizes: Vec<T>,
}

/// Every corner of the box. Without weights, only the sizes are searched for. None if numbers are too long.
pub fn search(
    rows: &[Row<BigInt>],
    weights: &[Weight<BigInt>],
    bounds: &[BigInt],
) -> Option<Found<BigInt>> {
    // With every sign plus and zeros as ones, the sum is longer than any number that the search meets,
    // for the last step depends on every step.
    let not_zero = |x: &BigInt| x.abs().max(BigInt::one());
    let plus = |row: &Row<BigInt>| Row {
        constant: if row.support == 0 { not_zero(&row.constant) } else { BigInt::ZERO },
        variables: row.variables.iter().map(|(c, v)| (c.abs(), *v)).collect(),
        terms: row.terms.iter().map(|(c, a, b)| (c.abs(), *a, *b)).collect(),
        support: row.support,
    };
    let plus: Vec<_> = rows.iter().map(plus).collect();
    let weight = |k: usize| (weights.get(k).map_or(BigInt::one(), |(w, _)| not_zero(w)), true);
    let all: Vec<_> = (0..rows.len()).map(weight).collect();
    let boxes: Vec<_> = bounds.iter().map(not_zero).collect();
    match search_in::<BigInt>(&plus, &all, &boxes, 1)?.sum.bits() {
        0..=62 => search_in::<i64>(rows, weights, bounds, 1 << bounds.len()),
        63..=126 => search_in::<i128>(rows, weights, bounds, 1 << bounds.len()),
        127..=MOST_BITS => search_in::<BigInt>(rows, weights, bounds, 1 << bounds.len()),
        _ => None,
    }
}

fn search_in<T>(
    rows: &[Row<BigInt>],
    weights: &[Weight<BigInt>],
    bounds: &[BigInt],
    corners: usize,
) -> Option<Found<BigInt>>
where
    T: Signed + Clone + PartialOrd + TryFrom<BigInt>,
    BigInt: From<T>,
{
    let of = |x: &BigInt| T::try_from(x.clone()).ok();
    let row = |row: &Row<BigInt>| {
        let variables = row.variables.iter().map(|(c, v)| Some((of(c)?, *v)));
        let terms = row.terms.iter().map(|(c, a, b)| Some((of(c)?, *a, *b)));
        let (variables, terms) = (variables.collect::<Option<_>>()?, terms.collect::<Option<_>>()?);
        Some(Row { constant: of(&row.constant)?, variables, terms, support: row.support })
    };
    let rows: Vec<Row<T>> = rows.iter().map(row).collect::<Option<_>>()?;
    let bounds: Vec<T> = bounds.iter().map(of).collect::<Option<_>>()?;
    let weights = weights.iter().map(|(weight, relative)| Some((of(weight)?, *relative)));
    let weights: Vec<Weight<T>> = weights.collect::<Option<_>>()?;
    let (mut values, mut slopes) = (vec![T::zero(); rows.len()], vec![T::zero(); rows.len()]);
    let (mut best, mut at, mut sizes) = (T::zero(), 0, values.clone());
    for corner in 0..corners {
        // A step stays as it was at the corner before if no changed variable is in it.
        let changed = corner ^ corner.wrapping_sub(1);
        let is_new = |row: &Row<T>| corner == 0 || row.support & changed != 0;
        for (k, row) in rows.iter().enumerate().filter(|(_, row)| is_new(row)) {
            let mut value = row.constant.clone();
            for (c, v) in &row.variables {
                let x = c.clone() * bounds[*v].clone();
                value = if corner >> v & 1 == 1 { value - x } else { value + x };
            }
            for (c, a, b) in &row.terms {
                let x = c.clone() * values[*a].clone();
                value = value + if let Some(b) = b { x * values[*b].clone() } else { x };
            }
            if sizes[k] < value.abs() {
                sizes[k] = value.abs();
            }
            values[k] = value;
        }
        if weights.is_empty() {
            continue;
        }
        // The derivatives of the last step by each step.
        slopes.fill(T::zero());
        slopes[rows.len() - 1] = T::one();
        let mut sum = T::zero();
        for (k, row) in rows.iter().enumerate().rev() {
            let slope = slopes[k].clone();
            let mut add = |to: usize, x: T| slopes[to] = slopes[to].clone() + x;
            for (c, a, b) in &row.terms {
                let x = slope.clone() * c.clone();
                if let Some(b) = b {
                    add(*a, x.clone() * values[*b].clone());
                    add(*b, x * values[*a].clone());
                } else {
                    add(*a, x);
                }
            }
            let effect = slope.abs() * weights[k].0.clone();
            sum = sum + if weights[k].1 { effect * values[k].abs() } else { effect };
        }
        if best < sum {
            (best, at) = (sum, corner);
        }
    }
    Some(Found {
        sum: best.into(),
        corner: at,
        sizes: sizes.into_iter().map(BigInt::from).collect(),
    })
}

#[cfg(test)]
mod tests;

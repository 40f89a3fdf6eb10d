//! The largest sum of the effects of all rounding errors, over all corners of a box, in integers.

use num_bigint::BigInt;
use num_traits::{One, Signed};

/// Longer numbers are refused.
pub const MOST_BITS: u64 = 1 << 12;

/// A signed product of two earlier steps, or a signed step, with a factor.
pub type Term<T> = (T, usize, Option<usize>);

/// One step: a constant, variables or terms that are added up; the weight of its error; whether its error
/// grows with it; and the variables in it, as bits.
pub struct Row<T> {
    pub constant: T,
    pub variables: Vec<(T, usize)>,
    pub terms: Vec<Term<T>>,
    pub weight: T,
    pub relative: bool,
    pub support: usize,
}

/// The largest sum, the first corner that has it (bit v is set where variable v is negative), and the
/// largest size of the last step. None if the numbers are too long.
pub fn search(rows: &[Row<BigInt>], sizes: &[BigInt]) -> Option<(BigInt, usize, BigInt)> {
    // With every sign plus and zeros as ones, the sum is longer than any number that the search meets,
    // for the last step depends on every step.
    let not_zero = |x: &BigInt| x.abs().max(BigInt::one());
    let plus = |row: &Row<BigInt>| Row {
        constant: if row.support == 0 { not_zero(&row.constant) } else { BigInt::ZERO },
        variables: row.variables.iter().map(|(c, v)| (c.abs(), *v)).collect(),
        terms: row.terms.iter().map(|(c, a, b)| (c.abs(), *a, *b)).collect(),
        weight: not_zero(&row.weight),
        relative: true,
        ..*row
    };
    let rows_plus: Vec<_> = rows.iter().map(plus).collect();
    let sizes_plus: Vec<_> = sizes.iter().map(not_zero).collect();
    let corners = 1 << sizes.len();
    match search_in::<BigInt>(&rows_plus, &sizes_plus, 1)?.0.bits() {
        0..=62 => search_in::<i64>(rows, sizes, corners),
        63..=126 => search_in::<i128>(rows, sizes, corners),
        127..=MOST_BITS => search_in::<BigInt>(rows, sizes, corners),
        _ => None,
    }
}

fn search_in<T>(
    rows: &[Row<BigInt>],
    sizes: &[BigInt],
    corners: usize,
) -> Option<(BigInt, usize, BigInt)>
where
    T: Signed + Clone + PartialOrd + TryFrom<BigInt>,
    BigInt: From<T>,
{
    let of = |x: &BigInt| T::try_from(x.clone()).ok();
    let rows = rows.iter().map(|row| {
        let variables = row.variables.iter().map(|(c, v)| Some((of(c)?, *v)));
        let terms = row.terms.iter().map(|(c, a, b)| Some((of(c)?, *a, *b)));
        Some(Row {
            constant: of(&row.constant)?,
            variables: variables.collect::<Option<_>>()?,
            terms: terms.collect::<Option<_>>()?,
            weight: of(&row.weight)?,
            relative: row.relative,
            support: row.support,
        })
    });
    let rows: Vec<Row<T>> = rows.collect::<Option<_>>()?;
    let sizes: Vec<T> = sizes.iter().map(of).collect::<Option<_>>()?;
    let mut values = vec![T::zero(); rows.len()];
    let (mut best, mut at, mut largest) = (T::zero(), 0, T::zero());
    for corner in 0..corners {
        // What no changed variable is in stays as it was at the corner before.
        let changed = corner ^ corner.wrapping_sub(1);
        for (k, row) in rows.iter().enumerate().filter(|(_, row)| corner == 0 || row.support & changed != 0) {
            let mut value = row.constant.clone();
            for (c, v) in &row.variables {
                let x = c.clone() * sizes[*v].clone();
                value = if corner >> v & 1 == 1 { value - x } else { value + x };
            }
            for (c, a, b) in &row.terms {
                let x = c.clone() * values[*a].clone();
                value = value + if let Some(b) = b { x * values[*b].clone() } else { x };
            }
            values[k] = value;
        }
        // The derivatives of the last step by each step.
        let mut slopes = vec![T::zero(); rows.len()];
        slopes[rows.len() - 1] = T::one();
        let mut sum = T::zero();
        for (k, row) in rows.iter().enumerate().rev() {
            let slope = slopes[k].clone();
            if slope.is_zero() {
                continue;
            }
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
            let effect = slope.abs() * row.weight.clone();
            sum = sum + if row.relative { effect * values[k].abs() } else { effect };
        }
        (best, at) = if best < sum { (sum, corner) } else { (best, at) };
        largest = if largest < values[values.len() - 1].abs() { values[values.len() - 1].abs() } else { largest };
    }
    Some((best.into(), at, largest.into()))
}

//! The largest sum of the effects of all rounding errors, over all corners of a box, in integers.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Longer numbers are refused.
const MOST_BITS: u64 = 1 << 12;

/// One step: a constant, variables and products of earlier steps, each with a factor, all added up; the
/// weight of its error; whether its error grows with it; and the variables in it, as bits.
pub struct Row<T> {
    pub constant: T,
    pub variables: Vec<(T, usize)>,
    pub terms: Vec<(T, usize, Option<usize>)>,
    pub weight: T,
    pub relative: bool,
    pub support: usize,
}

/// The largest sum, the first corner that has it (bit v is set where variable v is negative), and the
/// largest size of the last step. None if the numbers are too long.
pub fn search(rows: &[Row<BigInt>], sizes: &[BigInt]) -> Option<(BigInt, usize, BigInt)> {
    match bits(rows, sizes) {
        0..=62 => search_in::<i64>(rows, sizes),
        63..=126 => search_in::<i128>(rows, sizes),
        127..=MOST_BITS => search_in::<BigInt>(rows, sizes),
        _ => None,
    }
}

/// The digits of the longest number that a search can meet. Zeros count as ones, so that no factor is
/// longer than its product.
fn bits(rows: &[Row<BigInt>], sizes: &[BigInt]) -> u64 {
    let not_zero = |x: &BigInt| x.abs().max(BigInt::one());
    let mut values: Vec<BigInt> = Vec::new();
    for row in rows {
        let mut value = not_zero(&row.constant);
        value += row.variables.iter().map(|(c, v)| c.abs() * not_zero(&sizes[*v])).sum::<BigInt>();
        for (c, a, b) in &row.terms {
            value += c.abs() * &values[*a] * b.map_or(BigInt::one(), |b| values[b].clone());
        }
        if MOST_BITS < value.bits() {
            return value.bits();
        }
        values.push(value);
    }
    let mut slopes = vec![BigInt::one(); rows.len()];
    let mut total = BigInt::zero();
    for (k, row) in rows.iter().enumerate().rev() {
        for (c, a, b) in &row.terms {
            let slope = c.abs() * &slopes[k];
            match b {
                None => slopes[*a] += slope,
                Some(b) => {
                    slopes[*a] += &slope * &values[*b];
                    slopes[*b] += slope * &values[*a];
                }
            }
        }
        let effect = not_zero(&row.weight) * &slopes[k];
        total += if row.relative { effect * &values[k] } else { effect };
        if MOST_BITS < total.bits() {
            break;
        }
    }
    let longest = values.iter().chain(&slopes).map(BigInt::bits).max();
    longest.unwrap_or(0).max(total.bits())
}

fn search_in<T>(rows: &[Row<BigInt>], sizes: &[BigInt]) -> Option<(BigInt, usize, BigInt)>
where
    T: Signed + Clone + PartialOrd + TryFrom<BigInt>,
    BigInt: From<T>,
{
    let whole = |x: &BigInt| T::try_from(x.clone()).ok();
    let mut scaled = Vec::new();
    for row in rows {
        let variables: Option<_> =
            row.variables.iter().map(|(c, v)| Some((whole(c)?, *v))).collect();
        let terms: Option<_> =
            row.terms.iter().map(|(c, a, b)| Some((whole(c)?, *a, *b))).collect();
        let (constant, weight) = (whole(&row.constant)?, whole(&row.weight)?);
        let &Row { relative, support, .. } = row;
        scaled.push(Row {
            constant,
            variables: variables?,
            terms: terms?,
            weight,
            relative,
            support,
        });
    }
    let sizes: Vec<T> = sizes.iter().map(whole).collect::<Option<_>>()?;
    let (mut values, mut slopes) = (vec![T::zero(); rows.len()], vec![T::zero(); rows.len()]);
    let last = rows.len() - 1;
    let (mut best, mut at, mut largest) = (T::zero(), 0, T::zero());
    for corner in 0..1usize << sizes.len() {
        // What the step from the corner before does not change stays.
        let changed = if corner == 0 { usize::MAX } else { corner ^ (corner - 1) };
        for (k, row) in scaled.iter().enumerate() {
            if corner != 0 && row.support & changed == 0 {
                continue;
            }
            let mut value = row.constant.clone();
            for (c, v) in &row.variables {
                let x = c.clone() * sizes[*v].clone();
                value = if corner >> v & 1 == 1 { value - x } else { value + x };
            }
            for (c, a, b) in &row.terms {
                let x = c.clone() * values[*a].clone();
                value = value + b.map_or(T::one(), |b| values[b].clone()) * x;
            }
            values[k] = value;
        }
        slopes.fill(T::zero());
        slopes[last] = T::one();
        let mut total = T::zero();
        for (k, row) in scaled.iter().enumerate().rev() {
            let slope = slopes[k].clone();
            if slope.is_zero() {
                continue;
            }
            for (c, a, b) in &row.terms {
                let x = slope.clone() * c.clone();
                match b {
                    None => slopes[*a] = slopes[*a].clone() + x,
                    Some(b) => {
                        slopes[*a] = slopes[*a].clone() + x.clone() * values[*b].clone();
                        slopes[*b] = slopes[*b].clone() + x * values[*a].clone();
                    }
                }
            }
            let effect = slope.abs() * row.weight.clone();
            total = total + if row.relative { effect * values[k].abs() } else { effect };
        }
        if best < total {
            (best, at) = (total, corner);
        }
        if largest < values[last].abs() {
            largest = values[last].abs();
        }
    }
    Some((best.into(), at, largest.into()))
}

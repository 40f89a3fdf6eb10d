//! All corners of a box, in integers: the largest size of each step, and the largest sum of the effects of
//! all rounding errors. Where some variables are the coordinates of a unit vector, every axis instead of their
//! signs.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

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

/// The largest sum of effects, and the first corner that has it: bit v is set where variable v is negative.
pub struct Found {
    /// The sum of the effects that do not depend on a unit vector; all of them if there is none.
    pub sum: BigInt,
    /// The sum of the squares, axis by axis, of the sums of all others.
    pub squares: BigInt,
    pub corner: usize,
    /// The size of each step; of steps that depend on the unit vector, the sum of the squares.
    pub sizes: Vec<BigInt>,
}

/// The variables whose signs are tried, as bits. Of corners that differ by a mirror, a set of variables whose change of
/// sign keeps each step or changes its sign, the first is enough. What a step adds up must change alike: an equation,
/// modulo 2, of the set's bits. Each equation decides about its lowest variable, the others are free. A step that is
/// zero is computed as 0: it has no error, whatever its weight, and demands nothing. A fixed variable's ends are no
/// mirror images.
pub fn signs_to_try<T: Zero>(rows: &[Row<T>], unit: &[usize], fixed: usize) -> usize {
    let of_unit = unit.iter().fold(0, |bits, v| bits | 1 << v);
    // The variables on whose signs a step's sign depends; none of what is zero.
    let mut signs: Vec<Option<usize>> = Vec::new();
    let mut equations = [0; usize::BITS as usize];
    for row in rows {
        let constant = (!row.constant.is_zero()).then_some(0);
        let variables = row.variables.iter().map(|(_, v)| 1 << v & !fixed);
        let terms = row.terms.iter().filter_map(|(_, a, b)| {
            let by = b.map_or(Some(0), |b| signs[b])?;
            Some(signs[*a]? ^ by)
        });
        let mut all = constant.into_iter().chain(variables).chain(terms);
        let first = all.next();
        for mut equation in all.map(|sign| sign ^ first.unwrap_or(0)) {
            while equation != 0 {
                // The vector's coordinates have no signs to try.
                let with_sign = if equation & of_unit == 0 {
                    equation
                } else {
                    equation & of_unit
                };
                let known = &mut equations[with_sign.trailing_zeros() as usize];
                if *known == 0 {
                    *known = equation;
                    break;
                }
                equation ^= *known;
            }
        }
        signs.push(first);
    }
    let lowest = (0..equations.len()).filter(|v| equations[*v] != 0);
    lowest.fold(fixed, |bits, v| bits | 1 << v) & !of_unit
}

/// Every corner of the box, which has the `ends` of each variable, that differs in the `tried` variables, and every axis
/// of `unit`, the variables that are coordinates of a unit vector in which the last step is linear. Without weights, only
/// the sizes are searched for. None if numbers are too long.
pub fn search(
    rows: &[Row<BigInt>],
    weights: &[Weight<BigInt>],
    ends: &[[BigInt; 2]],
    unit: &[usize],
    tried: usize,
) -> Option<Found> {
    // With every sign plus and zeros as ones, the sum is longer than any number that the search meets,
    // for the last step depends on every step.
    let not_zero = |x: &BigInt| x.abs().max(BigInt::one());
    let plus = |row: &Row<BigInt>| Row {
        constant: if row.support == 0 {
            not_zero(&row.constant)
        } else {
            BigInt::ZERO
        },
        variables: row.variables.iter().map(|(c, v)| (c.abs(), *v)).collect(),
        terms: row
            .terms
            .iter()
            .map(|(c, a, b)| (c.abs(), *a, *b))
            .collect(),
        support: row.support,
    };
    let plus: Vec<_> = rows.iter().map(plus).collect();
    let weight = |k: usize| {
        (
            weights.get(k).map_or(BigInt::one(), |(w, _)| not_zero(w)),
            true,
        )
    };
    let all: Vec<_> = (0..rows.len()).map(weight).collect();
    let largest = |[a, b]: &[BigInt; 2]| [not_zero(a), not_zero(b)].into_iter().max();
    let boxes = ends
        .iter()
        .map(|ends| [(); 2].map(|()| largest(ends).expect("two")));
    let boxes: Vec<_> = boxes.collect();
    match search_in::<BigInt>(&plus, &all, &boxes, &[], 0)?.sum.bits() {
        0..=62 => search_in::<i64>(rows, weights, ends, unit, tried),
        63..=126 => search_in::<i128>(rows, weights, ends, unit, tried),
        127..=MOST_BITS => search_in::<BigInt>(rows, weights, ends, unit, tried),
        _ => None,
    }
}

fn search_in<T>(
    rows: &[Row<BigInt>],
    weights: &[Weight<BigInt>],
    ends: &[[BigInt; 2]],
    unit: &[usize],
    tried: usize,
) -> Option<Found>
where
    T: Signed + Clone + PartialOrd + TryFrom<BigInt>,
    BigInt: From<T>,
{
    let of = |x: &BigInt| T::try_from(x.clone()).ok();
    let row = |row: &Row<BigInt>| {
        let variables = row.variables.iter().map(|(c, v)| Some((of(c)?, *v)));
        let terms = row.terms.iter().map(|(c, a, b)| Some((of(c)?, *a, *b)));
        let (variables, terms) = (
            variables.collect::<Option<_>>()?,
            terms.collect::<Option<_>>()?,
        );
        Some(Row {
            constant: of(&row.constant)?,
            variables,
            terms,
            support: row.support,
        })
    };
    let rows: Vec<Row<T>> = rows.iter().map(row).collect::<Option<_>>()?;
    let ends = ends
        .iter()
        .map(|[upper, lower]| Some([of(upper)?, of(lower)?]));
    let ends: Vec<[T; 2]> = ends.collect::<Option<_>>()?;
    let weights = weights
        .iter()
        .map(|(weight, relative)| Some((of(weight)?, *relative)));
    let weights: Vec<Weight<T>> = weights.collect::<Option<_>>()?;
    let (mut values, mut slopes) = (vec![T::zero(); rows.len()], vec![T::zero(); rows.len()]);
    let square = |x: &T| BigInt::from(x.clone()).pow(2);
    let of_unit = unit.iter().fold(0, |bits, v| bits | 1 << v);
    let (mut best, mut squares, mut at, mut last) = (T::zero(), BigInt::ZERO, 0, usize::MAX);
    let (mut sizes, mut longest) = (values.clone(), vec![BigInt::ZERO; rows.len()]);
    let mut next = Some(0usize);
    while let Some(corner) = next {
        // The next larger one of the tried bits.
        next = Some(corner.wrapping_sub(tried) & tried).filter(|next| *next != 0);
        let (mut sum, mut of_axes) = (T::zero(), BigInt::ZERO);
        let mut lengths = vec![BigInt::ZERO; if unit.is_empty() { 0 } else { rows.len() }];
        for axis in 0..unit.len().max(1) {
            // A step stays as it was before if no changed variable is in it.
            let changed = (corner ^ last) | of_unit;
            let is_new = |row: &Row<T>| last == usize::MAX || row.support & changed != 0;
            for (k, row) in rows.iter().enumerate().filter(|(_, row)| is_new(row)) {
                let mut value = row.constant.clone();
                for (c, v) in &row.variables {
                    if of_unit >> v & 1 == 0 || unit[axis] == *v {
                        value = value + c.clone() * ends[*v][corner >> v & 1].clone();
                    }
                }
                for (c, a, b) in &row.terms {
                    let x = c.clone() * values[*a].clone();
                    value = value
                        + if let Some(b) = b {
                            x * values[*b].clone()
                        } else {
                            x
                        };
                }
                if row.support & of_unit != 0 {
                    lengths[k] += square(&value);
                } else if sizes[k] < value.abs() {
                    sizes[k] = value.abs();
                }
                values[k] = value;
            }
            last = corner;
            if weights.is_empty() {
                continue;
            }
            // The derivatives of the last step by each step.
            slopes.fill(T::zero());
            slopes[rows.len() - 1] = T::one();
            let mut of_axis = T::zero();
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
                let (weight, is_relative) = &weights[k];
                let effect = slope.abs() * weight.clone();
                let effect = if *is_relative {
                    effect * values[k].abs()
                } else {
                    effect
                };
                if !unit.is_empty() && (*is_relative || row.support & of_unit == 0) {
                    of_axis = of_axis + effect;
                } else if axis == 0 {
                    sum = sum + effect;
                }
            }
            of_axes += square(&of_axis);
        }
        for (longest, length) in longest.iter_mut().zip(lengths) {
            *longest = length.max(std::mem::take(longest));
        }
        if best < sum {
            best = sum;
            at = if unit.is_empty() { corner } else { at };
        }
        if squares < of_axes {
            (squares, at) = (of_axes, corner);
        }
    }
    let sizes = sizes.into_iter().map(BigInt::from).zip(longest);
    let sizes = sizes.map(|(size, longest)| size.max(longest)).collect();
    Some(Found {
        sum: best.into(),
        squares,
        corner: at,
        sizes,
    })
}

#[cfg(test)]
mod tests;

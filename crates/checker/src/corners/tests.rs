//! The search against its definition: every corner by itself, in integers of any length, and derivatives forwards.

use super::super::mirrors::signs_to_try;
use super::*;
use hairline_core::case::Draw;
use num_traits::Zero;

type Rows = Vec<Row<BigInt>>;

/// Each step at a corner, and its derivative by one of the steps.
fn at_corner(rows: &Rows, ends: &[[BigInt; 2]], corner: usize, by: usize) -> Vec<[BigInt; 2]> {
    let mut all: Vec<[BigInt; 2]> = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let (mut value, mut slope) = (row.constant.clone(), BigInt::ZERO);
        for multiple in &row.variables {
            let v = multiple.variable;
            value += &multiple.factor * &ends[v][usize::from(corner & (1 << v) != 0)];
        }
        for product in &row.products {
            let (c, b) = (&product.factor, product.right);
            let [x, dx] = &all[product.left];
            let [y, dy] = b.map_or([BigInt::one(), BigInt::ZERO], |b| all[b].clone());
            (value, slope) = (value + c * x * &y, slope + c * (dx * &y + x * dy));
        }
        all.push([value, if k == by { BigInt::one() } else { slope }]);
    }
    all
}

/// The largest sum, its first corner, the sizes of the steps, and the squares that a unit vector has instead.
type All = (BigInt, usize, Vec<BigInt>, BigInt);

/// At every corner, and at every axis there.
fn expected(rows: &Rows, weights: &[Weight<BigInt>], ends: &[[BigInt; 2]], unit: &[usize]) -> All {
    let (mut sum, mut first, mut sizes) = (BigInt::ZERO, 0, vec![BigInt::ZERO; rows.len()]);
    let mut squares = BigInt::ZERO;
    let is_positive = |corner: &usize| unit.iter().all(|v| corner & (1 << v) == 0);
    let is_linear = |k: usize| unit.iter().any(|v| rows[k].support & (1 << v) != 0);
    for corner in (0..1 << ends.len()).filter(is_positive) {
        let mut alone = BigInt::ZERO;
        let mut effects = vec![BigInt::ZERO; unit.len().max(1)];
        let mut lengths = vec![BigInt::ZERO; rows.len()];
        for (axis, effects) in effects.iter_mut().enumerate() {
            let mut ends = ends.to_vec();
            unit.iter()
                .filter(|v| **v != unit[axis])
                .for_each(|v| ends[*v] = Default::default());
            alone = BigInt::ZERO;
            for k in 0..rows.len() {
                let all = at_corner(rows, &ends, corner, k);
                let size = all[k][0].abs();
                lengths[k] += &size * &size;
                if !is_linear(k) {
                    sizes[k] = size.clone().max(sizes[k].clone());
                }
                if let Some(Weight {
                    size: weight,
                    is_relative,
                }) = weights.get(k)
                {
                    let slope = all[rows.len() - 1][1].abs();
                    let effect = slope * weight * if *is_relative { size } else { BigInt::one() };
                    let depends = !unit.is_empty() && (*is_relative || !is_linear(k));
                    *if depends { &mut *effects } else { &mut alone } += effect;
                }
            }
        }
        for k in (0..rows.len()).filter(|k| is_linear(*k)) {
            sizes[k] = lengths[k].clone().max(sizes[k].clone());
        }
        let here: BigInt = effects.iter().map(|effect| effect * effect).sum();
        if if unit.is_empty() {
            sum < alone
        } else {
            squares < here
        } {
            first = corner;
        }
        (sum, squares) = (sum.max(alone), squares.max(here));
    }
    (sum, first, sizes, squares)
}

fn found(
    rows: &Rows,
    weights: &[Weight<BigInt>],
    ends: &[[BigInt; 2]],
    unit: &[usize],
) -> Option<All> {
    let fixed = ends
        .iter()
        .enumerate()
        .filter(|(_, [upper, lower])| -lower != *upper);
    let fixed = fixed.fold(0, |bits, (v, _)| bits | 1 << v);
    let found = search(&Problem {
        rows: rows.clone(),
        weights: weights.to_vec(),
        ends: ends.to_vec(),
        unit: unit.to_vec(),
        tried: signs_to_try(rows, unit, fixed),
    })?;
    Some((found.sum, found.corner, found.sizes, found.squares))
}

/// A number of at most so many bits, which may be 0.
fn number(draw: &mut Draw, bits: usize) -> BigInt {
    BigInt::from(draw.below(1 << 10)) << draw.below(bits) >> 10
}

/// The ends of variables; of one in four they are no mirror images.
fn random_ends(draw: &mut Draw, variables: usize, bits: usize) -> Vec<[BigInt; 2]> {
    let ends = |_| {
        let upper = number(draw, bits);
        let lower = if draw.below(4) == 0 {
            number(draw, bits)
        } else {
            upper.clone()
        };
        [upper, -lower]
    };
    (0..variables).map(ends).collect()
}

fn sign(draw: &mut Draw) -> BigInt {
    BigInt::from(if draw.coin() { 1 } else { -1 })
}

/// Weights of the steps' errors. A step that is zero has none.
fn random_weights(draw: &mut Draw, rows: &Rows, bits: usize) -> Vec<Weight<BigInt>> {
    let mut zeros: Vec<bool> = Vec::new();
    for row in rows {
        let is_zero =
            |term: &Product<BigInt>| zeros[term.left] || term.right.is_some_and(|b| zeros[b]);
        let has_none = row.constant.is_zero() && row.variables.is_empty();
        zeros.push(has_none && row.products.iter().all(is_zero));
    }
    let weight = |is_zero| {
        if is_zero {
            BigInt::ZERO
        } else {
            number(draw, bits)
        }
    };
    let weights: Vec<BigInt> = zeros.into_iter().map(weight).collect();
    weights
        .into_iter()
        .map(|size| Weight {
            size,
            is_relative: draw.coin(),
        })
        .collect()
}

/// A factor, as it brings terms to one scale.
fn factor(draw: &mut Draw) -> BigInt {
    sign(draw) << draw.below(3)
}

/// Random steps; the last one depends on all.
fn random_rows(draw: &mut Draw, variables: usize, bits: usize) -> Rows {
    let mut rows: Rows = Vec::new();
    for _ in 0..1 + draw.below(5) {
        let mut row = Row {
            constant: BigInt::ZERO,
            variables: vec![],
            products: vec![],
            support: 0,
        };
        match draw.below(4) {
            0 => row.constant = number(draw, bits) * sign(draw),
            1 if !rows.is_empty() => {
                for _ in 0..1 + draw.below(2) {
                    let other = draw.coin().then(|| draw.below(rows.len()));
                    row.products.push(Product {
                        factor: factor(draw),
                        left: draw.below(rows.len()),
                        right: other,
                    });
                }
            }
            _ => (0..variables)
                .filter(|_| draw.coin())
                .collect::<Vec<_>>()
                .into_iter()
                .for_each(|variable| {
                    row.variables.push(Multiple {
                        factor: factor(draw),
                        variable,
                    })
                }),
        }
        rows.push(row);
    }
    let term = |left| Product {
        factor: sign(draw),
        left,
        right: None,
    };
    let products = (0..rows.len()).map(term).collect();
    rows.push(Row {
        constant: BigInt::ZERO,
        variables: vec![],
        products,
        support: 0,
    });
    for k in 0..rows.len() {
        let of_variables = rows[k]
            .variables
            .iter()
            .fold(0, |bits, multiple| bits | 1 << multiple.variable);
        let operands = rows[k]
            .products
            .iter()
            .flat_map(|term| [term.left, term.right.unwrap_or(term.left)]);
        rows[k].support = operands.fold(of_variables, |bits, a| bits | rows[a].support);
    }
    rows
}

#[test]
fn the_largest_sum_is_that_of_every_corner_by_itself_in_integers_of_any_width() {
    let mut draw = Draw::new("corners", 1, 0);
    // Up to 62 bits, up to 126, and more.
    let mut widths = [0; 3];
    for _ in 0..3000 {
        let (variables, bits) = (1 + draw.below(4), 1 + draw.below(60));
        let rows = random_rows(&mut draw, variables, bits);
        let ends = random_ends(&mut draw, variables, bits);
        let weights = random_weights(&mut draw, &rows, bits);
        let sum = expected(&rows, &weights, &ends, &[]);
        widths[match sum.0.bits() {
            0..=62 => 0,
            63..=126 => 1,
            _ => 2,
        }] += 1;
        assert_eq!(found(&rows, &weights, &ends, &[]), Some(sum));
        // Without weights only sizes are wanted.
        assert_eq!(
            found(&rows, &[], &ends, &[]),
            Some(expected(&rows, &[], &ends, &[]))
        );
    }
    assert!(widths.into_iter().all(|n| 20 < n), "{widths:?}");
}

/// Steps that are linear in three more variables: random numbers times them, added up, and multiplied again.
fn linear_rows(draw: &mut Draw, variables: usize, bits: usize) -> Rows {
    let mut rows = random_rows(draw, variables, bits);
    let count = rows.len();
    let push = |rows: &mut Rows, variables, products: Vec<Product<BigInt>>, support| {
        let operands = products
            .iter()
            .flat_map(|term| [term.left, term.right.unwrap_or(term.left)]);
        let support = operands.fold(support, |bits, a| bits | rows[a].support);
        rows.push(Row {
            constant: BigInt::ZERO,
            variables,
            products,
            support,
        });
        rows.len() - 1
    };
    let mut sum = Vec::new();
    for v in variables..variables + 3 {
        let part = push(
            &mut rows,
            vec![Multiple {
                factor: BigInt::one(),
                variable: v,
            }],
            vec![],
            1 << v,
        );
        // The last of the random steps depends on all of them.
        let by = if sum.is_empty() {
            count - 1
        } else {
            draw.below(count)
        };
        let term = Product {
            factor: factor(draw),
            left: by,
            right: Some(part),
        };
        let product = push(&mut rows, vec![], vec![term], 0);
        sum.push(Product {
            factor: sign(draw),
            left: product,
            right: None,
        });
    }
    let last = push(&mut rows, vec![], sum, 0);
    let term = Product {
        factor: sign(draw),
        left: last,
        right: draw.coin().then(|| draw.below(count)),
    };
    push(&mut rows, vec![], vec![term], 0);
    rows
}

#[test]
fn a_unit_vector_is_every_axis_in_turn_in_integers_of_any_width() {
    let mut draw = Draw::new("units", 1, 0);
    let mut widths = [0; 3];
    for _ in 0..1000 {
        let (variables, bits) = (1 + draw.below(3), 1 + draw.below(60));
        let rows = linear_rows(&mut draw, variables, bits);
        let mut ends = random_ends(&mut draw, variables, bits);
        let of_unit = [(); 3].map(|()| BigInt::from(1 + draw.below(2)));
        ends.extend(of_unit.map(|size| [size.clone(), -size]));
        let weights = random_weights(&mut draw, &rows, bits);
        let unit = [variables, variables + 1, variables + 2];
        let all = expected(&rows, &weights, &ends, &unit);
        widths[match all.3.bits() {
            0..=124 => 0,
            125..=252 => 1,
            _ => 2,
        }] += 1;
        assert_eq!(found(&rows, &weights, &ends, &unit), Some(all));
        let sizes = expected(&rows, &[], &ends, &unit);
        assert_eq!(found(&rows, &[], &ends, &unit), Some(sizes));
    }
    assert!(widths.into_iter().all(|n| 20 < n), "{widths:?}");
}

#[test]
fn numbers_that_are_too_long_are_refused() {
    let rows = vec![Row {
        constant: BigInt::ZERO,
        variables: vec![Multiple {
            factor: BigInt::one(),
            variable: 0,
        }],
        products: vec![],
        support: 1,
    }];
    let weights = [Weight {
        size: BigInt::one(),
        is_relative: true,
    }];
    let longest: BigInt = (BigInt::one() << MOST_BITS) - 1;
    let all = |bound: &BigInt| found(&rows, &weights, &[[bound.clone(), -bound.clone()]], &[]);
    assert_eq!(
        all(&longest),
        Some((longest.clone(), 0, vec![longest.clone()], BigInt::ZERO))
    );
    assert_eq!(all(&(longest + 1)), None);
}

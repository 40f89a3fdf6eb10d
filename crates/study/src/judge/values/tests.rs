use super::*;
use crate::case::Parameters;
use crate::family::FAMILIES;
use crate::judge::ValueLimits;
use crate::kernel::Scalar;
use crate::oracle;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use std::array;

fn number(x: f64) -> BigRational {
    BigRational::from_float(x).expect("finite")
}

/// Solves t·d - u·ab - v·ac = a - o by elimination.
fn solve(vectors: &[[BigRational; 3]; 5]) -> [BigRational; 3] {
    let [o, d, a, b, c] = vectors;
    let mut rows: Vec<[BigRational; 4]> = (0..3)
        .map(|j| [d[j].clone(), &a[j] - &b[j], &a[j] - &c[j], &a[j] - &o[j]])
        .collect();
    for column in 0..3 {
        let pivot = (column..3)
            .find(|&i| !rows[i][column].is_zero())
            .expect("it crosses");
        rows.swap(column, pivot);
        let top = rows[column].clone().map(|x| x / &rows[column][column]);
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column].clone();
            if i != column {
                row.iter_mut()
                    .zip(&top)
                    .for_each(|(x, y)| *x -= &factor * y);
            }
        }
        rows[column] = top;
    }
    array::from_fn(|i| rows[i][3].clone())
}

/// t, u, v and what each may be off, by elimination: a move of the origin by 1 along an axis shows what an error of
/// that size does, because each value is an affine function of the origin.
fn defined<F: Float>(case: &Case<F>) -> ([BigRational; 3], [BigRational; 3]) {
    let vectors = case.vectors().map(|v| v.map(|x| number(x.to_f64())));
    let exact = solve(&vectors);
    let [t, u, v] = &exact;
    let w = number(1.0) - u - v;
    let [o, d, a, b, c] = &vectors;
    let size = |j: usize| {
        let terms = [&w * &a[j], u * &b[j], v * &c[j], o[j].clone(), t * &d[j]];
        terms
            .iter()
            .map(BigRational::abs)
            .fold(BigRational::zero(), |sum, x| sum + x)
    };
    let size = (0..3).map(size).max().expect("three axes");
    let mut moves: [BigRational; 3] = array::from_fn(|_| BigRational::zero());
    for j in 0..3 {
        let mut moved = vectors.clone();
        moved[0][j] += number(1.0);
        let values = solve(&moved);
        for i in 0..3 {
            moves[i] += (&values[i] - &exact[i]).abs();
        }
    }
    let roundoff = number(F::EPSILON.to_f64() / 2.0);
    let allowed = array::from_fn(|i| {
        let kappa = &moves[i] * &size;
        let kappa = if i == 0 {
            kappa
        } else {
            kappa.max(number(1.0))
        };
        (kappa * &roundoff * number(16.0)).max(number(F::from_place(1).to_f64()))
    });
    (exact, allowed)
}

const ALL: Gives = Gives {
    t: true,
    uv: true,
    facing: false,
};

fn hit<F: Float>(values: [F; 3]) -> Verdict<F> {
    let [t, u, v] = values;
    Verdict {
        hit: true,
        t,
        u,
        v,
        ..Verdict::miss(None)
    }
}

fn cases_with_values<F: Scalar>(count: u64) -> Vec<(Case<F>, Truth)> {
    let made = FAMILIES.iter().flat_map(|family| {
        (0..count).map(|index| family.make::<F>(&Parameters::default(), 5, index))
    });
    let cases = made.flat_map(|made| made.cases().to_vec());
    let with_truth = cases.map(|case| (case, oracle::truth(&case)));
    with_truth.filter(|(_, truth)| has_values(truth)).collect()
}

fn values_are_judged_as_defined<F: Scalar>() {
    let mut sure = 0;
    let cases = cases_with_values::<F>(12);
    for (case, truth) in &cases {
        let (exact, allowed) = defined(case);
        let limits = ValueLimits::of(case, truth);
        sure += usize::from(limits.low[0].is_finite());
        let float = |x: &BigRational| F::from_f64(Exact::from_rational(x).approximate());
        let nearest = exact.each_ref().map(float);
        for which in 0..3 {
            // Around both ends, and the ends of what is surely right.
            let ends = [
                &exact[which] - &allowed[which],
                &exact[which] + &allowed[which],
            ];
            let around = ends
                .iter()
                .flat_map(|end| (-2..=2).map(move |ulps| float(end).offset_ulps(ulps)));
            let sure = [limits.low[which], limits.high[which]];
            for value in around.chain(sure).filter(|x| x.is_finite()) {
                let mut values = nearest;
                values[which] = value;
                if values.iter().any(|x| !x.is_finite()) {
                    continue;
                }
                let is_near =
                    |i: usize| (number(values[i].to_f64()) - &exact[i]).abs() <= allowed[i];
                let expected = (0..3).all(is_near);
                assert_eq!(
                    are_near(case, ALL, &hit(values), 0.0),
                    expected,
                    "{} {which}",
                    case.hex()
                );
                let is_sure =
                    (0..3).all(|i| limits.low[i] <= values[i] && values[i] <= limits.high[i]);
                assert!(!is_sure || expected, "{} {which} {value}", case.hex());
            }
        }
    }
    assert!(
        cases.len() > 200 && sure * 10 > cases.len() * 9,
        "{sure} of {}",
        cases.len()
    );
}

#[test]
fn values_are_judged_as_elimination_in_rational_numbers_says() {
    values_are_judged_as_defined::<f32>();
    values_are_judged_as_defined::<f64>();
}

#[test]
fn errors_are_those_of_rational_numbers() {
    for (case, truth) in cases_with_values::<f64>(6) {
        let (exact, allowed) = defined(&case);
        let float = |x: &BigRational| Exact::from_rational(x).approximate();
        let values = exact.each_ref().map(|x| float(x) * 1.5 + 0.125);
        if values.iter().any(|x| !x.is_finite()) {
            continue;
        }
        let errors = ValueErrors::of(&case, &truth, ALL, &hit(values));
        for i in 0..3 {
            let close = |found: f64, right: f64| (found - right).abs() <= 1e-5 * right.abs();
            assert!(close(errors.exact[i], float(&exact[i])), "{}", case.hex());
            let off = (number(values[i]) - &exact[i]).abs();
            let times = float(&(off / &allowed[i])) * ALLOWANCE;
            let found = errors.times[i].expect("given");
            // Where the least number is all that is allowed, there is no unit to count in.
            let counts = allowed[i] > number(f64::MIN_POSITIVE) && times.is_finite();
            assert!(
                !counts || close(found, times),
                "{} {found} {times}",
                case.hex()
            );
        }
    }
}

#[test]
fn a_rounded_value_is_near_and_a_thousandth_of_an_edge_is_not() {
    let unit = Case::<f32>::new(
        [0.25, 0.25, 2.0],
        [0.1, 0.2, -1.0],
        [[0.0, 0.0, 0.1], [1.0, 0.0, 0.0], [0.0, 1.0, 0.2]],
    );
    let truth = oracle::truth(&unit);
    let exact = ValueErrors::of(&unit, &truth, ALL, &hit([0.0; 3]))
        .exact
        .map(|x| x as f32);
    assert!(are_near(&unit, ALL, &hit(exact), 0.0));
    for which in 0..3 {
        for off in [-1e-3, 1e-3, 1e-5] {
            let mut values = exact;
            values[which] += off;
            assert!(!are_near(&unit, ALL, &hit(values), 0.0), "{which} {off}");
            let only_t = Gives { uv: false, ..ALL };
            assert_eq!(are_near(&unit, only_t, &hit(values), 0.0), which != 0);
        }
    }
}

/// The tolerance of a contract is a distance: by t along the ray, in longest edges; by u and v a weight.
fn tolerances_are_judged_as_defined<F: Scalar>() {
    let (mut within, mut beyond) = (0, 0);
    for (case, _) in &cases_with_values::<F>(4) {
        let (exact, allowed) = defined(case);
        let [_, d, a, b, c] = case.vectors().map(|v| v.map(|x| number(x.to_f64())));
        let square = |p: &[BigRational; 3], q: &[BigRational; 3]| -> BigRational {
            (0..3).map(|i| (&p[i] - &q[i]) * (&p[i] - &q[i])).sum()
        };
        let edge = square(&a, &b).max(square(&b, &c)).max(square(&c, &a));
        let zero = [number(0.0), number(0.0), number(0.0)];
        let direction = square(&d, &zero);
        let float = |x: &BigRational| F::from_f64(Exact::from_rational(x).approximate());
        for (tolerance, factor) in [(1e-3, 0.999), (1e-3, 1.001), (0.25, 0.5), (1e-9, 2.0)] {
            for which in 0..3 {
                // About so far off: where it stands is computed from the rounded value.
                let length = float(&(&edge / &direction)).to_f64().sqrt();
                let off = tolerance * factor * if which == 0 { length } else { 1.0 };
                let mut values = exact.each_ref().map(float);
                values[which] = F::from_f64(values[which].to_f64() + off);
                if values.iter().any(|x| !x.is_finite()) {
                    continue;
                }
                let is_near = |i: usize| {
                    let off = number(values[i].to_f64()) - &exact[i];
                    let most = number(tolerance);
                    let is_tolerated = match i {
                        0 => &off * &off * &direction <= &most * &most * &edge,
                        _ => -most.clone() <= off && off <= most,
                    };
                    is_tolerated || off <= allowed[i] && -off <= allowed[i]
                };
                let expected = (0..3).all(is_near);
                let about = format!("{} {which} {tolerance} {factor}", case.hex());
                assert_eq!(
                    are_near(case, ALL, &hit(values), tolerance),
                    expected,
                    "{about}"
                );
                assert!(are_near(case, ALL, &hit(values), f64::INFINITY), "{about}");
                *(if expected { &mut within } else { &mut beyond }) += 1;
            }
        }
    }
    assert!(150 < within && 150 < beyond, "{within} {beyond}");
}

#[test]
fn values_within_the_tolerance_of_a_contract_are_near() {
    tolerances_are_judged_as_defined::<f32>();
    tolerances_are_judged_as_defined::<f64>();
}

#[test]
fn the_worst_value_is_counted_in_units_of_rounding() {
    for (case, truth) in cases_with_values::<f64>(2) {
        let (exact, _) = defined(&case);
        let float = |x: &BigRational| Exact::from_rational(x).approximate();
        let values = exact.each_ref().map(|x| float(x) * 1.25 + 0.5);
        let times = ValueErrors::of(&case, &truth, ALL, &hit(values))
            .times
            .map(Option::unwrap);
        let worst = times.into_iter().fold(0.0, f64::max);
        let found = exact_times(&case, ALL, &hit(values));
        if worst.is_finite() && found.is_finite() {
            let found = found.approximate();
            assert!(
                (found - worst).abs() <= 1e-5 * worst,
                "{} {found} {worst}",
                case.hex()
            );
        }
    }
}

/// A value is wrong where it is farther off than rounding explains and than the contract tolerates.
#[test]
fn a_tolerated_value_is_not_wrong() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let case = Case::<f64>::new([0.25, 0.25, 1.0], [0.0, 0.0, -1.0], corners);
    let truth = oracle::truth(&case);
    let errors = |values: [f64; 3]| ValueErrors::of(&case, &truth, ALL, &hit(values));
    let right = errors([1.0, 0.25, 0.25]);
    let off = errors([1.0 + 0.125, 0.25 + 0.125, 0.25 - 0.125]);
    for which in 0..3 {
        assert!(!right.is_wrong(which, 0.0), "{which}");
        assert!(off.is_wrong(which, 0.0), "{which}");
        // The longest edge is the root of 2.
        let share = if which == 0 {
            0.125 / 2.0f64.sqrt()
        } else {
            0.125
        };
        assert!(off.is_wrong(which, share * 0.999), "{which}");
        assert!(!off.is_wrong(which, share * 1.001), "{which}");
    }
}

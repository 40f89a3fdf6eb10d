//! The bounds of the filter, against their proof in integers, and what lies exactly on a bound.

use super::*;
use crate::arith::decompose;
use crate::case::{Case, Draw};
use crate::oracle::signs::{ALL, rows};
use crate::oracle::{Layer, Layers, define, truth_counted};
use num_bigint::BigInt;
use num_traits::Signed;

/// A float as a multiple of 2^-1074.
fn whole(x: f64) -> BigInt {
    let (digits, exponent) = decompose(x);
    BigInt::from(digits) << (if digits == 0 { 0 } else { exponent + 1074 })
}

/// A determinant and its permanent as multiples of 2^-3222, and |first|₁ as one of 2^-1074.
fn exact(determinant: Determinant, case: &Case<f64>) -> [BigInt; 3] {
    let [first, p, q, base] = rows(determinant, case.vectors());
    let minus_base = |v: [f64; 3]| [0, 1, 2].map(|i| whole(v[i]) - whole(base[i]));
    let (p, q) = (minus_base(p), minus_base(q));
    let first = if determinant == Determinant::T {
        minus_base(first)
    } else {
        first.map(whole)
    };
    let [mut value, mut permanent, mut length] = [0; 3].map(BigInt::from);
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let (x, y) = (&p[j] * &q[k], &p[k] * &q[j]);
        value += &first[i] * (&x - &y);
        permanent += first[i].abs() * (x.abs() + y.abs());
        length += first[i].abs();
    }
    [value, permanent, length]
}

/// The exact permanent of a determinant. The filter's permanent of D is the sum of the weights' permanents.
fn permanent(determinant: Determinant, case: &Case<f64>) -> BigInt {
    match determinant {
        Determinant::D => (0..3)
            .map(|k| permanent(Determinant::Weight(k), case))
            .sum(),
        _ => exact(determinant, case)[1].clone(),
    }
}

/// Vectors of sizes from all over the range, also such that products underflow or overflow in part.
fn any_size(index: u64) -> Case<f64> {
    let mut draw = Draw::new("filter", 1, index);
    let sizes = draw.pick(&[
        [0, 0, 0],
        [-600, 0, 300],
        [-520, -480, -400],
        [-360, -340, -330],
    ]);
    let spread = draw.pick(&[2, 40]);
    let [o, d, a, b, c] = std::array::from_fn(|i| {
        // Every second origin is zero, so that differences are as small as points.
        let middle = draw.pick(&sizes);
        let zero = i == 0 && draw.coin();
        std::array::from_fn(|_| {
            let exponent = draw.integer(middle - spread, middle + spread) as i32;
            if zero {
                0.0
            } else {
                draw.with_exponent::<f64>(exponent)
            }
        })
    });
    Case::new(o, d, [a, b, c])
}

#[test]
fn errors_are_below_the_bounds_and_the_bounds_are_those_of_the_proof() {
    let (mut compared, mut at_underflow) = (0, 0);
    for index in 0..3000 {
        let case = any_size(index);
        let computed = compute(case.vectors());
        for determinant in ALL {
            let (value, error, factor, allowances) = match determinant {
                Determinant::Weight(k) => (-computed.weights[k], computed.weight_errors[k], 3, 0),
                Determinant::D => (computed.d, computed.d_error, 4, 2),
                Determinant::T => (computed.t, computed.t_error, 4, 0),
            };
            if !error.is_finite() {
                continue;
            }
            let [exact, _, length] = exact(determinant, &case);
            let (value, error) = (whole(value) << 2148, whole(error) << 2148);
            let off: BigInt = value - exact;
            assert!(off.abs() <= error, "{determinant:?} {}", case.hex());
            // 8u or 16u of the permanent, and once or four times 2^-1000 of 1 + the length.
            let relative = permanent(determinant, &case) << factor >> 53;
            let underflow = (length + (BigInt::from(1) << 1074)) << (2148 - 1000 + allowances);
            at_underflow += u32::from(underflow > relative);
            let bound = relative + underflow;
            let off: BigInt = &error - &bound;
            assert!(off.abs() << 45 < bound, "{determinant:?} {}", case.hex());
            compared += 1;
        }
    }
    assert!(
        compared > 10_000 && at_underflow > 1000,
        "{compared} {at_underflow}"
    );
}

fn layer_of(case: &Case<f64>) -> Layer {
    let mut layers = Layers::default();
    let truth = truth_counted(case, &mut layers);
    assert_eq!(truth, define(case).truth, "{}", case.hex());
    [Layer::Filter, Layer::Grid, Layer::ScaledFilter]
        .into_iter()
        .find(|layer| layers.of(*layer) > 0)
        .unwrap_or(Layer::BigInteger)
}

#[test]
fn a_value_at_its_bound_is_handed_on_and_one_above_it_is_not() {
    let (far, third) = ([-0.3, 0.7, 1.0], [5.1, -3.3, 7.7]);
    // x·(far × z) = 2e, and its permanent is 2.
    let near = |e: f64| ([1.0, 1.0, 0.0], [1.0 + e, 1.0 - e, 0.0]);
    let weight = |k: usize, e: f64| {
        let (x, z) = near(e);
        let mut vertices = [third, far, z];
        vertices.rotate_right(k);
        Case::new([0.0; 3], x, vertices)
    };
    let t = |e: f64| {
        let (x, z) = near(e);
        Case::new([0.0; 3], third, [x, far, z.map(|x| -x)])
    };
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // Weights of 0.5 + e, -(1 - e) and 0.5: their sum is 2e, and their permanents' sum 2.
    let d = |e: f64| Case::new([0.0; 3], [0.5 + e, e - 1.0, 0.5], unit);
    // 8u·2 = 2e, or 16u·2 = 2e.
    let (weights, others) = (2f64.powi(-50), 2f64.powi(-49));
    type Make<'a> = &'a dyn Fn(f64) -> Case<f64>;
    let cases: [(Determinant, f64, Make); 5] = [
        (Determinant::Weight(0), weights, &|e| weight(0, e)),
        (Determinant::Weight(1), weights, &|e| weight(1, e)),
        (Determinant::Weight(2), weights, &|e| weight(2, e)),
        (Determinant::T, others, &t),
        (Determinant::D, others, &d),
    ];
    for (determinant, e, make) in cases {
        for (e, certain) in [(e, false), (e + 2f64.powi(-52), true)] {
            let case = make(e);
            let sign = compute(case.vectors()).sign(determinant);
            assert_eq!(sign.is_some(), certain, "{determinant:?} {e:e}");
            assert_eq!(
                layer_of(&case) == Layer::Filter,
                certain,
                "{determinant:?} {e:e}"
            );
        }
    }
}

#[test]
fn weights_of_one_sign_tell_the_sign_of_d_whatever_its_bound() {
    // Weights of 1.01·2^-1000, each above its allowance of 2^-1000; their sum is below four times that.
    let x = 1.01 * UNDERFLOW;
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let case = Case::<f64>::new([0.0; 3], [x; 3], unit);
    let computed = compute(case.vectors());
    assert_eq!(computed.sign(Determinant::D), None);
    assert_eq!(layer_of(&case), Layer::Filter);
    // One of the other sign leaves the sign of D open.
    assert_ne!(
        layer_of(&Case::new([0.0; 3], [x, x, -x], unit)),
        Layer::Filter
    );
}

#[test]
fn an_end_is_compared_up_to_the_errors_of_t_and_d() {
    // T = t ± 0.5 and D = ±(1 ± 0.25): at the end 2, T - 2 D is uncertain by 1.
    for sign in [1.0, -1.0] {
        let past = |t: f64, end: f64| is_past(end, (t, 0.5), (sign, 0.25));
        for (t, is_positive) in [(3.0, true), (1.0, false)] {
            assert_eq!(past(sign * t, 2.0), None);
            let farther = sign
                * (t + if is_positive {
                    2f64.powi(-50)
                } else {
                    -2f64.powi(-50)
                });
            assert_eq!(past(farther, 2.0), Some(is_positive));
            assert_eq!(
                is_past(-2.0, (-farther, 0.5), (sign, 0.25)),
                Some(!is_positive)
            );
        }
        assert_eq!(past(9.0, f64::INFINITY), Some(false));
        assert_eq!(past(9.0, f64::NEG_INFINITY), Some(true));
    }
    // The sign of D must be certain too.
    assert_eq!(is_past(0.5, (9.0, 0.5), (0.25, 0.25)), None);
    assert_eq!(is_past(0.5, (9.0, 0.5), (0.2501, 0.25)), Some(true));
}

#[test]
fn an_overflow_of_the_end_times_d_decides_nothing() {
    // T may be as large as end·D, which overflows by a little.
    let (t, error) = (f64::MAX, f64::MAX * U);
    assert_eq!(
        is_past(2f64.powi(1000), (t, error), (2f64.powi(24), 0.0)),
        None
    );
    assert_eq!(
        is_past(2f64.powi(1000), (t, error), (2f64.powi(23), 0.0)),
        Some(true)
    );
}

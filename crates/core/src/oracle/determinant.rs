//! The sign of one determinant where the filter is in doubt: double-double arithmetic with a bound,
//! then `robust`'s adaptive predicate where its conditions hold, then the determinant multiplied out.

use super::signs::{Determinant, FloatPoint, rows};
use super::{Layer, monomials};
use crate::case::Case;
use robust::{Coord3D, orient3d};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

/// The sign of a determinant of a case, and the layer that found it. `near_one` is the same case with
/// its axes scaled where that can help, for the double-doubles.
pub(super) fn sign(
    determinant: Determinant,
    case: &Case<f64>,
    near_one: &Case<f64>,
) -> (Ordering, Layer) {
    if let Some(sign) = double_double(determinant, near_one) {
        return (sign, Layer::DoubleDouble);
    }
    if let Some(sign) = by_robust(determinant, case) {
        return (sign, Layer::Robust);
    }
    (monomials::sign(determinant, case), Layer::Monomials)
}

/// An unevaluated sum of two floats, the second at most half an ulp of the first.
#[derive(Clone, Copy)]
struct Double {
    high: f64,
    low: f64,
}

/// Exact (Knuth).
#[inline(always)]
fn two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    let part = high - a;
    Double {
        high,
        low: (a - (high - part)) + (b - part),
    }
}

/// Exact where |a| ≥ |b| (Dekker).
#[inline(always)]
fn fast_two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    Double {
        high,
        low: b - (high - a),
    }
}

/// Exact without overflow and underflow (Veltkamp's splitting, Dekker's product).
#[inline(always)]
fn two_product(a: f64, b: f64) -> Double {
    let split = |x: f64| {
        let scaled = 134_217_729.0 * x;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let high = a * b;
    let low = a_low * b_low - (((high - a_high * b_high) - a_low * b_high) - a_high * b_low);
    Double { high, low }
}

impl Add for Double {
    type Output = Double;
    /// Off by at most 4u²·(|x| + |y|): the low parts' sum and its addition round once each.
    #[inline(always)]
    fn add(self, other: Double) -> Double {
        let sum = two_sum(self.high, other.high);
        fast_two_sum(sum.high, sum.low + (self.low + other.low))
    }
}

impl Sub for Double {
    type Output = Double;
    #[inline(always)]
    fn sub(self, other: Double) -> Double {
        self + Double {
            high: -other.high,
            low: -other.low,
        }
    }
}

impl Mul for Double {
    type Output = Double;
    /// Off by at most 8u²·|xy|: the product of the low parts is left out (u²), and the products of
    /// high and low parts (at most u each) and their sums round.
    #[inline(always)]
    fn mul(self, other: Double) -> Double {
        let product = two_product(self.high, other.high);
        let mixed = self.high * other.low + self.low * other.high;
        fast_two_sum(product.high, product.low + mixed)
    }
}

/// The largest coordinate for which nothing overflows and underflow stays below [`UNDERFLOW`].
const LARGEST: f64 = f64::from_bits((1023 + 300) << 52);
/// A low part that underflows is off by 2^-1074, and is multiplied by at most 2^301 afterwards.
const UNDERFLOW: f64 = f64::from_bits((1023 - 700) << 52);

/// The sign, if double-doubles are certain of it.
///
/// Differences are exact. With P the permanent, six products cost 8u²P, three differences 4u²P, three
/// products 8u²P and two sums 8u²P: below 28u²P. The bound 64u²·P = 2^-100·P also covers P's own
/// rounding.
fn double_double(determinant: Determinant, case: &Case<f64>) -> Option<Ordering> {
    let rows = rows(determinant, case.vectors());
    let largest = rows
        .as_flattened()
        .iter()
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest > LARGEST {
        return None;
    }
    let [first, p, q, base] = rows;
    let difference = |x: FloatPoint| {
        [
            two_sum(x[0], -base[0]),
            two_sum(x[1], -base[1]),
            two_sum(x[2], -base[2]),
        ]
    };
    let (p, q) = (difference(p), difference(q));
    let first = match determinant {
        Determinant::T => difference(first),
        _ => first.map(|high| Double { high, low: 0.0 }),
    };
    let mut value = Double {
        high: 0.0,
        low: 0.0,
    };
    let mut permanent = 0.0;
    for (factor, (j, k)) in first.into_iter().zip([(1, 2), (2, 0), (0, 1)]) {
        let (x, y) = (p[j] * q[k], p[k] * q[j]);
        value = value + factor * (x - y);
        permanent += factor.high.abs() * (x.high.abs() + y.high.abs());
    }
    let error = permanent * (-100f64).exp2() + UNDERFLOW;
    (value.high.abs() > error).then(|| value.high.total_cmp(&0.0))
}

/// The exponents between which `robust` is used.
const ROBUST_RANGE: u64 = 250;

/// `robust` computes with Shewchuk's expansions, which are exact as long as no product of three
/// coordinates underflows or overflows, and with a filter whose bound is relative. With every
/// coordinate zero or within 2^±250 in absolute value, lowest bits are at least 2^-302, differences
/// that are not zero too, and products of three of them at least 2^-906: the filter's bound, 2^-50
/// times such a product, is far above what underflow can add. Products of three sums stay below
/// 2^760. Without the condition wrong signs begin at 2^-338 for points of full size, and earlier for points
/// close together, because the extent counts.
fn robust_holds(points: &[FloatPoint]) -> bool {
    const LOW: f64 = f64::from_bits((1023 - ROBUST_RANGE) << 52);
    const HIGH: f64 = f64::from_bits((1023 + ROBUST_RANGE) << 52);
    points
        .as_flattened()
        .iter()
        .all(|x| *x == 0.0 || (LOW..=HIGH).contains(&x.abs()))
}

/// The sign by `robust::orient3d`, where it is exact. It takes points; for d·(P×Q) the differences P
/// and Q must be exact, which their rounding errors tell.
fn by_robust(determinant: Determinant, case: &Case<f64>) -> Option<Ordering> {
    let rows = rows(determinant, case.vectors());
    let points = if determinant == Determinant::T {
        rows
    } else {
        let [first, p, q, base] = rows;
        let exact = |x: FloatPoint| -> Option<FloatPoint> {
            let differences = [0, 1, 2].map(|i| two_sum(x[i], -base[i]));
            differences
                .iter()
                .all(|x| x.low == 0.0)
                .then(|| differences.map(|x| x.high))
        };
        [first, exact(p)?, exact(q)?, [0.0; 3]]
    };
    if !robust_holds(&points) {
        return None;
    }
    let [a, b, c, d] = points.map(|[x, y, z]| Coord3D { x, y, z });
    orient3d(a, b, c, d).partial_cmp(&0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{Float, decompose, scale_by_power_of_two};
    use crate::case::Draw;
    use crate::oracle::scaled::Scaled;
    use crate::oracle::signs::ALL;
    use num_bigint::BigInt;

    /// Cases with exact zeros and near ones among their determinants.
    fn case(index: u64, scale: i32) -> Case<f64> {
        let mut draw = Draw::new("determinant", 1, index);
        let by = |v: [f64; 3]| v.map(|x| scale_by_power_of_two(x, scale));
        let lattice = draw.coin();
        let mut point = || -> [f64; 3] {
            if lattice {
                draw.lattice_point(2).map(|x| x as f64)
            } else {
                draw.point::<f64>()
            }
        };
        let [o, d, a, b, c] = std::array::from_fn(|_| point());
        let s = draw.unit();
        let d = if draw.coin() {
            std::array::from_fn(|i| a[i] + s * (b[i] - a[i]) - o[i])
        } else {
            d
        };
        Case::new(by(o), by(d), [by(a), by(b), by(c)])
    }

    #[test]
    fn each_layer_agrees_with_big_integers_or_hands_on() {
        for scale in [-400, -253, -249, -100, 0, 100, 249, 253, 299, 303] {
            let (mut doubles, mut robusts) = (0, 0);
            for index in 0..400 {
                let case = case(index, scale);
                let exact = Scaled::new(&case);
                for determinant in ALL {
                    let expected = exact.sign(determinant);
                    if let Some(sign) = double_double(determinant, &case) {
                        doubles += 1;
                        assert_eq!(
                            sign, expected,
                            "double-double {determinant:?} 2^{scale} {case:?}"
                        );
                    }
                    if let Some(sign) = by_robust(determinant, &case) {
                        robusts += 1;
                        assert_eq!(sign, expected, "robust {determinant:?} 2^{scale} {case:?}");
                    }
                }
            }
            // Both are open inside their ranges and shut outside.
            assert_eq!(robusts > 0, scale.abs() < 250, "2^{scale}");
            assert_eq!(doubles > 0, (-230..300).contains(&scale), "2^{scale}");
        }
    }

    #[test]
    fn differences_that_cancel_far_down_are_handed_on_or_right() {
        // Points some ulps apart near the guard's lower end: differences are 2^-50 of coordinates.
        for scale in [-300, -251, -249, -240] {
            for index in 0..500 {
                let mut draw = Draw::new("far", 1, index);
                let base = draw.point::<f64>();
                let mut near = || [0, 1, 2].map(|i| base[i].offset_ulps(draw.integer(-9, 9)));
                let points = [near(), near(), near(), near()];
                let [o, a, b, c] = points.map(|p| p.map(|x| scale_by_power_of_two(x, scale)));
                let case = Case::<f64>::new(o, [1.0, 0.0, 0.0], [a, b, c]);
                if let Some(sign) = by_robust(Determinant::T, &case) {
                    assert_eq!(
                        sign,
                        Scaled::new(&case).sign(Determinant::T),
                        "2^{scale} {index}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_guard_shuts_where_robust_is_wrong() {
        let h = scale_by_power_of_two(1.0, -359);
        let points = [[h, 0.0, 0.0], [0.0, h, 0.0], [0.0, 0.0, h], [0.0; 3]];
        assert!(!robust_holds(&points));
        let [a, b, c, d] = points.map(|[x, y, z]| Coord3D { x, y, z });
        assert_eq!(
            orient3d(a, b, c, d),
            0.0,
            "which is wrong: the determinant is positive"
        );
        let case = Case::<f64>::new([0.0; 3], [1.0, 0.0, 0.0], [points[0], points[1], points[2]]);
        assert_eq!(
            sign(Determinant::T, &case, &case),
            (Ordering::Greater, Layer::Monomials)
        );
    }

    #[test]
    fn double_doubles_decide_above_their_bound_and_not_at_it() {
        // Weight 0 is d·(c×b): here d·x of c = (0, p, r) and b = (0, s, q), that is d (pq - rs).
        let decides = |d: f64, [p, q, r, s]: [f64; 4]| {
            let case = Case::new(
                [0.0; 3],
                [d, 0.0, 0.0],
                [[0.0; 3], [0.0, s, q], [0.0, p, r]],
            );
            double_double(Determinant::Weight(0), &case)
        };
        let unit = [1.0, 1.0, 0.0, 0.0];
        // The allowance for underflow, 2^-700.
        let least = scale_by_power_of_two(1.0, -700);
        assert_eq!(decides(least, unit), None);
        assert_eq!(decides(least.next_up(), unit), Some(Ordering::Greater));
        // The largest coordinate, 2^300.
        let most = scale_by_power_of_two(1.0, 300);
        assert_eq!(decides(most, unit), Some(Ordering::Greater));
        assert_eq!(decides(most.next_up(), unit), None);
        // (1 + k·2^-52)(1 - k·2^-52) - 1 = -k²·2^-104 against 2^-100 of a permanent of 2.
        let near_zero = |k: f64| {
            decides(
                1.0,
                [1.0 + k * f64::EPSILON, 1.0 - k * f64::EPSILON, 1.0, 1.0],
            )
        };
        assert_eq!(near_zero(5.0), None);
        assert_eq!(near_zero(6.0), Some(Ordering::Less));
    }

    #[test]
    fn robust_takes_zeros_and_needs_exact_differences_of_all_but_t() {
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let case = Case::<f64>::new([0.0; 3], [1.0, 2.0, 4.0], unit);
        let exact = Scaled::new(&case);
        for determinant in ALL {
            assert_eq!(
                by_robust(determinant, &case),
                Some(exact.sign(determinant)),
                "{determinant:?}"
            );
        }
        // 1 - 2^-60 is no float.
        let far = Case::<f64>::new([scale_by_power_of_two(1.0, -60); 3], [1.0, 2.0, 4.0], unit);
        for determinant in ALL {
            let is_exact = matches!(determinant, Determinant::T | Determinant::D);
            assert_eq!(
                by_robust(determinant, &far).is_some(),
                is_exact,
                "{determinant:?}"
            );
        }
    }

    #[test]
    fn a_product_and_a_sum_are_the_sums_of_their_parts() {
        // As multiples of 2^-200.
        let whole = |x: f64| {
            let (digits, exponent) = decompose(x);
            BigInt::from(digits) << (if digits == 0 { 0 } else { exponent + 200 })
        };
        for index in 0..1000 {
            let mut draw = Draw::new("parts", 1, index);
            let exponent = draw.integer(-20, 20) as i32;
            let (a, b) = (
                draw.with_exponent::<f64>(exponent),
                draw.with_exponent::<f64>(0),
            );
            let parts = |double: Double| whole(double.high) + whole(double.low);
            assert_eq!(parts(two_sum(a, b)), whole(a) + whole(b), "{a:e} {b:e}");
            assert_eq!(
                parts(two_product(a, b)) << 200,
                whole(a) * whole(b),
                "{a:e} {b:e}"
            );
        }
    }
}

//! Tests of exact numbers.

use super::*;
use num_bigint::BigInt;
use num_traits::Signed;

fn number(value: f64) -> Exact {
    Exact::from_f64(value)
}

#[test]
fn special_values_follow_ieee_754() {
    let inf = Exact::infinity();
    assert!((inf.clone() - inf.clone()).is_nan());
    assert!((inf.clone() * Exact::zero()).is_nan());
    assert!((Exact::zero() / Exact::zero()).is_nan());
    assert!((number(-3.0) / Exact::zero()).is_less(&number(-1e300)));
    assert!((inf.clone() / number(-2.0)).is_less(&number(-1e300)));
    assert!((number(5.0) / inf).is_zero());
    assert!(!Nan.is_less(&Nan) && !Nan.is_at_most(&number(0.0)));
    assert!(number(-1.0).sqrt().is_nan());
}

#[test]
fn roots_compare_exactly_where_floats_cannot() {
    // √2 against its nearest float: the float is the larger of the two.
    let root = number(2.0).sqrt();
    assert!(root.is_less(&number(2f64.sqrt())));
    assert!(number(2f64.sqrt().next_down()).is_less(&root));
    // (√2)² is 2, 1/√2 is √2/2, and √4 - 2 is zero although 4's root is kept as a root.
    assert!((root.clone() * &root - number(2.0)).is_zero());
    assert!((Exact::one() / &root - root.clone() / number(2.0)).is_zero());
    let two = number(4.0).sqrt();
    assert!((two.clone() - number(2.0)).is_zero());
    assert!((Exact::one() / (two + number(2.0)) - number(0.25)).is_zero());
}

/// `value` within a few ulps of `exact`, or, out of the floats' range, on the right side of it.
fn assert_near(value: f64, exact: &BigRational) {
    let rational = |x: f64| BigRational::from_float(x).unwrap();
    let error = (rational(value.clamp(f64::MIN, f64::MAX)) - exact).abs();
    let ulps = exact.abs() * rational(8.0 * f64::EPSILON) + rational(f64::from_bits(2));
    let beyond = value.is_infinite() && rational(f64::MAX) * rational(0.999) < exact.abs();
    let signs = value == 0.0 || (value > 0.0) == exact.is_positive();
    assert!(signs && (beyond || error <= ulps), "{value:e} {exact}");
}

#[test]
fn an_approximation_is_right_whatever_its_parts_are() {
    let power = |k: i64| Exact::from_rational(&num_traits::Pow::pow(two(), k as i32));
    for (digits, s) in [(1i64, 3i64), (-5, 7), (12_345_678_987_654_321, 999_999_999)] {
        for (i, j, k) in [
            (0, 0, 0),
            (1100, -1100, 0),
            (-3000, 1500, 1500),
            (2000, -5000, 2990),
            (-900, -900, 800),
            (3000, 3000, -5990),
            (1060, 0, -20),
        ] {
            // p + q√(s²·2^2k), whose root is no float's business: exactly p + q·s·2^k.
            let whole = |n: i64| Exact::from_rational(&BigRational::from_integer(n.into()));
            let p = whole(digits) * power(i);
            let root = whole(s) * whole(s) * power(2 * k);
            for q in [1i64, -1, 3, -7].map(|q| whole(q) * power(j)) {
                let value = p.clone() + q.clone() * root.sqrt();
                let exact = p.to_rational().unwrap()
                    + q.to_rational().unwrap() * (whole(s) * power(k)).to_rational().unwrap();
                assert_near(value.approximate(), &exact);
                assert_near((-value).approximate(), &-exact);
            }
        }
    }
}

#[test]
fn an_approximation_is_right_where_the_parts_cancel() {
    // √n - ⌊√n⌋, where ⌊√n⌋ has more digits than a float: bounds by integers.
    for n in [2u64, 3, 10, 1_000_003] {
        for shift in [0u32, 60, 300, 1100] {
            let radicand = BigInt::from(n) << (2 * shift);
            let floor = radicand.sqrt();
            let number = |n: &BigInt| Exact::from_rational(&BigRational::from_integer(n.clone()));
            let rest = number(&radicand).sqrt() - number(&floor);
            // 200 more bits of the root.
            let finer: BigInt = (&radicand << 400u32).sqrt() - (&floor << 200u32);
            let exact = BigRational::new(finer, BigInt::from(1) << 200u32);
            assert_near(rest.approximate(), &exact);
            assert_near((-rest).approximate(), &-exact);
        }
    }
    // √4 is kept as a root: nothing is left of √4 - 2.
    assert_eq!((number(4.0).sqrt() - number(2.0)).approximate(), 0.0);
}

fn two() -> BigRational {
    BigRational::from_integer(2.into())
}

#[test]
fn arithmetic_agrees_with_num_rational() {
    let values = [0.1, -3.5, 1e-300, 7e200, 5e-324];
    for a in values {
        for b in values {
            let [ra, rb] = [a, b].map(|v| BigRational::from_float(v).unwrap());
            let exact = (number(a) + number(b)) * number(a) / number(b);
            assert_eq!(exact.to_rational().unwrap(), (&ra + &rb) * &ra / &rb);
        }
    }
}

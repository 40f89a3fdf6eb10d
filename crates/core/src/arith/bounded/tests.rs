//! Tests of the bounds against exact numbers.

use super::*;
use crate::arith::Exact;
use crate::case::Draw;

/// Random formulas in both arithmetics: what is claimed must hold.
#[test]
fn the_exact_value_lies_within_the_bound_and_decided_comparisons_agree() {
    let (mut decisions, mut doubts, mut zeros) = (0, 0, 0);
    for index in 0..4_000 {
        let mut draw = Draw::new("bounded", 1, index);
        let mut numbers: Vec<(Bounded, Exact)> = (0..5)
            .map(|_| {
                let exponent = draw.pick(&[0, 0, -3, 40, -300, 300, 880, -1000]);
                let value = match draw.below(3) {
                    0 => draw.integer(-4, 4) as f64,
                    1 => draw.symmetric(),
                    _ => draw.with_exponent(exponent),
                };
                (Bounded::new(value), Exact::from_f64(value))
            })
            .collect();
        for _ in 0..7 {
            let (i, j) = (draw.below(numbers.len()), draw.below(numbers.len()));
            let ((x, p), (y, q)) = (numbers[i].clone(), numbers[j].clone());
            let made = match draw.below(7) {
                0 => (x + y, p + q),
                1 => (x - y, p - q),
                2 => (x * y, p * q),
                3 => (x / y, p / q),
                4 => (x.smaller(y), p.smaller(q)),
                5 => (x.larger(y), p.larger(q)),
                _ if matches!(p, Exact::Rational(_)) => {
                    // Squares have roots that are rational.
                    ((x * x).sqrt(), p.abs())
                }
                _ => continue,
            };
            numbers.push(made);
        }
        for (x, p) in &numbers {
            if !x.is_known() {
                continue;
            }
            if x.is_special() {
                assert_eq!(p.is_nan(), x.high.is_nan(), "{x:?} {p:?}");
                assert_eq!(p.is_finite(), x.high.is_finite(), "{x:?} {p:?}");
                continue;
            }
            let middle = Exact::from_f64(x.high) + Exact::from_f64(x.low);
            let off = (p.clone() - middle).abs();
            assert!(off.is_at_most(&Exact::from_f64(x.error)), "{x:?} {p:?}");
            for (y, q) in &numbers {
                let found = bounded(|| (x.is_less(y), x.is_at_most(y), x.is_zero()));
                let expected = (p.is_less(q), p.is_at_most(q), p.is_zero());
                match found {
                    Some(found) => assert_eq!(found, expected, "{x:?} {y:?}"),
                    None => doubts += 1,
                }
                decisions += usize::from(found.is_some());
                zeros += usize::from(found.is_some() && expected.2);
            }
        }
    }
    assert!(
        decisions > 100_000 && zeros > 1_000 && doubts > 1_000,
        "{decisions} {doubts}"
    );
}

#[test]
fn what_floats_cannot_tell_apart_bounds_do() {
    let third = Bounded::one() / Bounded::new(3.0);
    let near = Bounded::new(1.0 / 3.0);
    assert_eq!(bounded(|| near.is_less(&third)), Some(true));
    assert_eq!(
        bounded(|| (third * Bounded::new(3.0)).is_less(&Bounded::one())),
        None
    );
    assert_eq!(
        bounded(|| (Bounded::new(6.0) / Bounded::new(3.0)).is_less(&third)),
        Some(false)
    );
    assert_eq!(third.approximate(), Some(1.0 / 3.0));
}

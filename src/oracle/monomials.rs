//! The sign of one determinant multiplied out: a sum of products of three given coordinates, in
//! floats whose exponent cannot overflow or underflow.
//!
//! With coordinates from all over the range, differences cancel: b-o and c-o are both -o rounded
//! where o is much the largest, and what tells the sign is hundreds of binary places below. Multiplied
//! out, o×o is gone, what is left are 18 products (24 in T) whose exponents mostly lie far apart, and
//! the largest decides.

use super::determinants::{Determinant, Point, rows};
use crate::case::Case;
use std::cmp::Ordering;

/// A float: digits in ±[1, 2) times 2^exponent, or zero with [`NO_EXPONENT`].
#[derive(Clone, Copy)]
struct Extended {
    digits: f64,
    exponent: i32,
}

/// Below the exponent of every product of three numbers, however large the other two.
const NO_EXPONENT: i32 = -100_000;

impl Extended {
    #[inline(always)]
    fn of(x: f64) -> Extended {
        if x == 0.0 {
            return Extended { digits: 0.0, exponent: NO_EXPONENT };
        }
        let (normal, bias) = if x.abs() < f64::MIN_POSITIVE {
            (x * (1u64 << 60) as f64, 1023 + 60)
        } else {
            (x, 1023)
        };
        let field = normal.to_bits() >> 52 & 0x7ff;
        let digits = f64::from_bits(normal.to_bits() & !(0x7ff << 52) | 1023 << 52);
        Extended { digits, exponent: field as i32 - bias }
    }
}

/// Products that lie this many binary places below the largest are left out.
const REACH: i32 = 200;
/// What leaving out and rounding add, relative to the sum of absolute values: 2^-48.
const ERROR: f64 = f64::from_bits((1023 - 48) << 52);

/// The sign of a determinant, if the sum of its products is certain.
///
/// Error bound (u = 2^-53): a product's digits round twice, and at most 23 additions follow, so each
/// product carries a factor within (1+u)^±25; scaling by a power of two is exact. The sum P of the
/// absolute values, computed alike, is at least (1-u)^25 of its exact value, so the computed sum is
/// off by at most ((1+u)^25 - 1)/(1-u)^25·P < 26u·P. Products left out add less than
/// 24·8·2^-200, and P ≥ 1. The bound 32u·P = 2^-48·P covers all, its own rounding too.
pub(super) fn sign(determinant: Determinant, case: &Case<f64>) -> Option<Ordering> {
    let (first, p, q, base) = rows(determinant, case);
    let [first, p, q, base] = [first, p, q, base].map(|v: Point| v.map(Extended::of));
    let mut products = [Extended { digits: 0.0, exponent: NO_EXPONENT }; 24];
    // (p-base)×(q-base) = p×q + q×base + base×p. Where base is subtracted from the first vector too,
    // base·(p×q) is subtracted: the other two are orthogonal to base.
    let mut fill = |k: usize, x: &[Extended; 3], y: &[Extended; 3], z: &[Extended; 3]| {
        for (n, (i, j, k)) in (6 * k..).step_by(2).zip([(0, 1, 2), (1, 2, 0), (2, 0, 1)]) {
            products[n] = product(x[i], y[j], z[k]);
            products[n + 1] = product(x[i], z[j], y[k]);
            products[n + 1].digits = -products[n + 1].digits;
        }
    };
    fill(0, &first, &p, &q);
    fill(1, &first, &q, &base);
    fill(2, &first, &base, &p);
    if determinant == Determinant::T {
        fill(3, &base, &q, &p);
    }
    let largest = products.iter().fold(i32::MIN, |largest, x| largest.max(x.exponent));
    if largest < NO_EXPONENT / 2 {
        return Some(Ordering::Equal);
    }
    let (mut sum, mut permanent) = (0.0, 0.0);
    for Extended { digits, exponent } in products {
        let below = largest - exponent;
        let scale = if below > REACH { 0.0 } else { f64::from_bits(((1023 - below) as u64) << 52) };
        sum += digits * scale;
        permanent += (digits * scale).abs();
    }
    (sum.abs() > permanent * ERROR).then(|| sum.total_cmp(&0.0))
}

#[inline(always)]
fn product(x: Extended, y: Extended, z: Extended) -> Extended {
    Extended {
        digits: x.digits * y.digits * z.digits,
        exponent: x.exponent + y.exponent + z.exponent,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use crate::oracle::scaled::Scaled;

    #[test]
    fn monomials_agree_with_big_integers_or_hand_on() {
        let (mut decided, mut handed_on) = (0, 0);
        for index in 0..20_000 {
            let mut draw = Draw::new("monomials", 1, index);
            // From all exponents alike to the whole range, and few numbers: exact cancellation.
            let spread = draw.pick(&[0, 3, 30, 400, 1000]);
            let middle = draw.integer(-1074 + spread, 1023 - spread);
            let palette = [0; 6].map(|_| {
                let exponent = draw.integer(middle - spread, middle + spread) as i32;
                draw.with_exponent::<f64>(exponent)
            });
            let few = draw.coin();
            let mut number = || {
                if few {
                    return draw.pick(&palette) * draw.pick(&[0.0, 1.0, 1.0, -1.0]);
                }
                let exponent = draw.integer(middle - spread, middle + spread) as i32;
                draw.with_exponent::<f64>(exponent)
            };
            let [o, d, a, b, c] = std::array::from_fn(|_| std::array::from_fn(|_| number()));
            let case = Case::new(o, d, [a, b, c]);
            let exact = Scaled::new(&case);
            for determinant in crate::oracle::determinants::ALL {
                match sign(determinant, &case) {
                    Some(sign) => {
                        decided += 1;
                        assert_eq!(sign, exact.sign(determinant), "{determinant:?} {case:?}");
                    }
                    None => handed_on += 1,
                }
            }
        }
        assert!(decided > 60_000 && handed_on > 1000, "{decided} {handed_on}");
    }

    #[test]
    fn a_sum_at_the_bound_is_handed_on_and_no_products_at_all_are_zero() {
        // Weight 0 is d·(c×b), here (1 + e) - (1 - e): 2e against 2^-48 of 2.
        let sign_of = |e: f64| {
            let vertices = [[0.0; 3], [0.0, 1.0 - e, 1.0], [0.0, 1.0 + e, 1.0]];
            sign(Determinant::Weight(0), &Case::new([0.0; 3], [1.0, 0.0, 0.0], vertices))
        };
        assert_eq!(sign_of(2f64.powi(-48)), None);
        assert_eq!(sign_of(2f64.powi(-48) + f64::EPSILON), Some(Ordering::Greater));
        // Every product has a factor of zero, however large the other two.
        let zero =
            Case::<f64>::new([0.0; 3], [1.0; 3], [[0.0; 3], [1e300; 3], [-1e300, 1e300, 1e300]]);
        assert_eq!(sign(Determinant::T, &zero), Some(Ordering::Equal));
    }
}

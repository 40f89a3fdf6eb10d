//! The sign of one determinant multiplied out: a sum of products of three coordinates, whose exponents
//! cannot overflow or underflow. First in floats, then exactly. And in the same way, on which side of an end of the
//! interval t lies.
//!
//! With coordinates from all over the range, differences cancel: b-o and c-o are both -o rounded
//! where o is much the largest, and what tells the sign is hundreds of binary places below. Multiplied
//! out, o×o is gone, what is left are 18 products (24 in T) whose exponents mostly lie far apart, and
//! the largest decides.

use super::signs::{Determinant, rows};
use super::sum::{ExactProduct, sign_of_sum};
use crate::case::Case;
use std::cmp::Ordering;

/// The sign of a determinant.
pub(super) fn sign(determinant: Determinant, case: &Case<f64>) -> Ordering {
    sign_of::<24>(&[(determinant, 1.0)], case)
}

/// The sign of T - end·D, which is that of t - end times that of D. The end is finite and not zero.
pub(super) fn compare_with_end(end: f64, case: &Case<f64>) -> Ordering {
    sign_of::<42>(&[(Determinant::T, 1.0), (Determinant::D, -end)], case)
}

/// The sign of a sum of determinants, each times a number. Multiplied out it has at most N products.
fn sign_of<const N: usize>(sum: &[(Determinant, f64)], case: &Case<f64>) -> Ordering {
    let (floats, count) = in_extended::<N>(sum, case);
    in_floats(&floats[..count]).unwrap_or_else(|| exactly::<N>(sum, case))
}

/// The products of a sum in floats, and how many they are.
#[inline(always)]
fn in_extended<const N: usize>(
    sum: &[(Determinant, f64)],
    case: &Case<f64>,
) -> ([Extended; N], usize) {
    multiplied_out(
        sum,
        case,
        Extended::of(0.0),
        Extended::of,
        Extended::product,
    )
}

/// The same sign, exactly, whatever cancels.
#[inline(never)]
fn exactly<const N: usize>(sum: &[(Determinant, f64)], case: &Case<f64>) -> Ordering {
    let (products, count) = multiplied_out::<_, _, N>(
        sum,
        case,
        ExactProduct::ZERO,
        WholeNumber::of,
        WholeNumber::product,
    );
    sign_of_sum(&products[..count])
}

/// The products of a sum, and how many they are. `of` makes a factor of a number. Arrays of arrays do not go through `map`
/// without calls, so they are written out.
#[inline(always)]
fn multiplied_out<X: Copy, P: Copy, const N: usize>(
    sum: &[(Determinant, f64)],
    case: &Case<f64>,
    zero: P,
    of: impl Fn(f64) -> X,
    product: impl Fn([X; 4]) -> P,
) -> ([P; N], usize) {
    let (mut products, mut count) = ([zero; N], 0);
    let vector = |[x, y, z]: [f64; 3]| [of(x), of(y), of(z)];
    for (determinant, by) in sum {
        let [first, p, q, base] = rows(*determinant, case.vectors());
        let [first, p, q, base] = [vector(first), vector(p), vector(q), vector(base)];
        let (by, minus) = (of(*by), of(-by));
        // (p-base)×(q-base) = p×q + q×base + base×p. Where base is subtracted from the first vector too,
        // base·(p×q) is subtracted: the other two are orthogonal to base.
        let triples = [
            (first, p, q),
            (first, q, base),
            (first, base, p),
            (base, q, p),
        ];
        let triples = if *determinant == Determinant::T {
            &triples[..]
        } else {
            &triples[..3]
        };
        for (x, y, z) in triples {
            for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                products[count] = product([x[i], y[j], z[k], by]);
                products[count + 1] = product([x[i], z[j], y[k], minus]);
                count += 2;
            }
        }
    }
    (products, count)
}

/// A float as a whole number of 53 bits, the digits of its [`Extended`] times 2^52. So a product of four is 2^208 times too
/// large, all alike: the sign of a sum stays.
#[derive(Clone, Copy)]
struct WholeNumber {
    digits: i64,
    exponent: i32,
}

impl WholeNumber {
    #[inline(always)]
    fn of(x: f64) -> WholeNumber {
        let Extended { digits, exponent } = Extended::of(x);
        WholeNumber {
            digits: (digits * (1u64 << 52) as f64) as i64,
            exponent,
        }
    }

    #[inline(always)]
    fn product([x, y, z, w]: [WholeNumber; 4]) -> ExactProduct {
        ExactProduct {
            factors: [x.digits, y.digits, z.digits, w.digits],
            exponent: x.exponent + y.exponent + z.exponent + w.exponent,
        }
    }
}

/// A float: digits in ±[1, 2) times 2^exponent, or zero with [`NO_EXPONENT`]. A product's digits are in ±[1, 16].
#[derive(Clone, Copy)]
struct Extended {
    digits: f64,
    exponent: i32,
}

/// The exponent of zero. A product of four factors with a zero among them lies far below any without: at most at
/// -96931, against at least -4296.
const NO_EXPONENT: i32 = -100_000;

/// The binary exponent of a number that is not zero.
pub(super) fn exponent_of(x: f64) -> i32 {
    Extended::of(x).exponent
}

impl Extended {
    #[inline(always)]
    fn of(x: f64) -> Extended {
        if x == 0.0 {
            return Extended {
                digits: 0.0,
                exponent: NO_EXPONENT,
            };
        }
        let (normal, bias) = if x.abs() < f64::MIN_POSITIVE {
            (x * (1u64 << 60) as f64, 1023 + 60)
        } else {
            (x, 1023)
        };
        let field = normal.to_bits() >> 52 & 0x7ff;
        let digits = f64::from_bits(normal.to_bits() & !(0x7ff << 52) | 1023 << 52);
        Extended {
            digits,
            exponent: field as i32 - bias,
        }
    }

    #[inline(always)]
    fn product([x, y, z, w]: [Extended; 4]) -> Extended {
        Extended {
            digits: x.digits * y.digits * z.digits * w.digits,
            exponent: x.exponent + y.exponent + z.exponent + w.exponent,
        }
    }
}

/// Products that lie more than this many binary places below the largest are left out.
const REACH: i32 = 200;
/// The error that leaving out and rounding add, relative to the sum of absolute values: 2^-47.
const ERROR: f64 = f64::from_bits((1023 - 47) << 52);

/// The sign of a sum of up to 42 products, if floats are certain of it.
///
/// Error bound (u = 2^-53): a product's digits round up to three times, and at most 41 additions follow, so each
/// product carries a factor within (1+u)^±44; scaling by a power of two is exact. The sum P of the
/// absolute values, computed alike, is at least (1-u)^44 of its exact value, so the computed sum is
/// off by at most ((1+u)^44 - 1)/(1-u)^44·P < 45u·P. Products left out add less than
/// 42·16·2^-200, and P ≥ 1. The bound 64u·P = 2^-47·P covers all, its own rounding too.
fn in_floats(products: &[Extended]) -> Option<Ordering> {
    let largest = products
        .iter()
        .fold(i32::MIN, |largest, x| largest.max(x.exponent));
    if largest < NO_EXPONENT / 2 {
        return Some(Ordering::Equal);
    }
    let (mut sum, mut permanent) = (0.0, 0.0);
    for &Extended { digits, exponent } in products {
        let below = largest - exponent;
        let scale = if below > REACH {
            0.0
        } else {
            f64::from_bits(((1023 - below) as u64) << 52)
        };
        sum += digits * scale;
        permanent += (digits * scale).abs();
    }
    (sum.abs() > permanent * ERROR).then(|| sum.total_cmp(&0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{Float, scale_by_power_of_two};
    use crate::case::Draw;
    use crate::oracle::scaled::Scaled;
    use crate::oracle::signs::ALL;
    use num_rational::BigRational;
    use num_traits::ToPrimitive;

    fn floats<const N: usize>(sum: &[(Determinant, f64)], case: &Case<f64>) -> Option<Ordering> {
        let (products, count) = in_extended::<N>(sum, case);
        in_floats(&products[..count])
    }

    /// From all exponents alike to the whole range; or few numbers, which cancel exactly.
    fn case(draw: &mut Draw) -> Case<f64> {
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
        Case::new(o, d, [a, b, c])
    }

    /// Small integers, each axis times a power of two: t is often a float.
    fn small_integers(draw: &mut Draw) -> Case<f64> {
        let powers = [0; 3].map(|_| draw.integer(-1000, 900) as i32);
        let [o, d, a, b, c] = std::array::from_fn(|_| {
            let vector = draw.lattice_point(4);
            [0, 1, 2].map(|i| scale_by_power_of_two(vector[i] as f64, powers[i]))
        });
        Case::new(o, d, [a, b, c])
    }

    #[test]
    fn determinants_have_the_signs_of_integers_of_any_size() {
        let (mut decided, mut handed_on) = (0, 0);
        for index in 0..20_000 {
            let case = case(&mut Draw::new("monomials", 1, index));
            let expected = Scaled::new(&case);
            for determinant in ALL {
                let expected = expected.sign(determinant);
                let sum = [(determinant, 1.0)];
                assert_eq!(
                    exactly::<24>(&sum, &case),
                    expected,
                    "{determinant:?} {case:?}"
                );
                match floats::<24>(&sum, &case) {
                    Some(sign) => {
                        decided += 1;
                        assert_eq!(sign, expected, "{determinant:?} {case:?}");
                    }
                    None => handed_on += 1,
                }
            }
        }
        assert!(
            decided > 60_000 && handed_on > 1000,
            "{decided} {handed_on}"
        );
    }

    #[test]
    fn an_end_at_t_and_beside_it_is_where_fractions_say() {
        let (mut signs, mut decided, mut handed_on) = ([0; 3], 0, 0);
        for index in 0..20_000 {
            let mut draw = Draw::new("ends", 1, index);
            let case = if draw.coin() {
                case(&mut draw)
            } else {
                small_integers(&mut draw)
            };
            let capital_d = Scaled::new(&case).sign(Determinant::D);
            if capital_d == Ordering::Equal {
                continue;
            }
            let [t, ..] = Scaled::new(&case).crossing();
            let near = t.to_f64().expect("a fraction");
            let end = if draw.below(8) == 0 {
                draw.symmetric()
            } else {
                near
            };
            let end = end.offset_ulps(draw.pick(&[0, 0, 0, 1, -1]));
            if !end.is_finite() || end == 0.0 {
                continue;
            }
            let exact = t.cmp(&BigRational::from_float(end).expect("finite"));
            let expected = if capital_d == Ordering::Less {
                exact.reverse()
            } else {
                exact
            };
            let sum = [(Determinant::T, 1.0), (Determinant::D, -end)];
            assert_eq!(compare_with_end(end, &case), expected, "{end:e} {case:?}");
            assert_eq!(exactly::<42>(&sum, &case), expected, "{end:e} {case:?}");
            match floats::<42>(&sum, &case) {
                Some(_) => decided += 1,
                None => handed_on += 1,
            }
            signs[(exact as i8 + 1) as usize] += 1;
        }
        assert!(signs.iter().all(|count| *count > 500), "{signs:?}");
        assert!(decided.min(handed_on) > 1000, "{decided} {handed_on}");
    }

    #[test]
    fn products_of_full_size_that_cancel_keep_their_sign() {
        let triangle = [[-1.5, -1.5, 1.5], [-1.5, 1.5, -1.5], [1.5, -1.5, -1.5]];
        let origin = [0.0, 0.0, scale_by_power_of_two(1.0, 100)];
        let case = Case::<f64>::new(origin, [1.75, 1.5, 1.75], triangle);
        // t rounded, and the float below: numbers with one more bit than a product may have would decide wrongly.
        let t = -scale_by_power_of_two(1.6, 97);
        for end in [t, t.next_down()] {
            assert_eq!(compare_with_end(end, &case), Ordering::Less, "{end:e}");
        }
    }

    #[test]
    fn a_sum_at_the_bound_is_handed_on_and_no_products_at_all_are_zero() {
        // Weight 0 is d·(c×b), here (1 + e) - (1 - e): 2e against 2^-47 of 2.
        let sign_of = |e: f64| {
            let vertices = [[0.0; 3], [0.0, 1.0 - e, 1.0], [0.0, 1.0 + e, 1.0]];
            let case = Case::new([0.0; 3], [1.0, 0.0, 0.0], vertices);
            floats::<24>(&[(Determinant::Weight(0), 1.0)], &case)
        };
        assert_eq!(sign_of(2f64.powi(-47)), None);
        assert_eq!(
            sign_of(2f64.powi(-47) + f64::EPSILON),
            Some(Ordering::Greater)
        );
        // Every product has a factor of zero, however large the other two.
        let zero = Case::<f64>::new(
            [0.0; 3],
            [1.0; 3],
            [[0.0; 3], [1e300; 3], [-1e300, 1e300, 1e300]],
        );
        assert_eq!(
            floats::<24>(&[(Determinant::T, 1.0)], &zero),
            Some(Ordering::Equal)
        );
    }
}

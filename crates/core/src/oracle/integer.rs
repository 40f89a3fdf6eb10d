//! Integer vectors and intervals, which the integer layers share.

use super::fixed::{I192, I256};
use crate::arith::decompose;
use crate::case::Case;
use num_bigint::BigInt;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// An exact integer of some width.
pub trait ExactInteger: Clone + Default + Ord {
    /// The same number as an integer of any size.
    fn big(&self) -> BigInt;

    /// The same number in 256 bits; none unless its size is sure to be at most 2^191.
    fn fixed(&self) -> Option<I256>;

    /// The order of the number and zero, which is the default of every integer.
    #[inline(always)]
    fn sign(&self) -> Ordering {
        self.cmp(&Self::default())
    }

    /// True if it is zero.
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }
}

impl ExactInteger for i64 {
    fn big(&self) -> BigInt {
        BigInt::from(*self)
    }
    #[inline(always)]
    fn fixed(&self) -> Option<I256> {
        Some(I256::from(i128::from(*self)))
    }
}

impl ExactInteger for i128 {
    fn big(&self) -> BigInt {
        BigInt::from(*self)
    }
    #[inline(always)]
    fn fixed(&self) -> Option<I256> {
        Some(I256::from(*self))
    }
}

impl ExactInteger for I192 {
    fn big(&self) -> BigInt {
        BigInt::from(*self)
    }
    #[inline(always)]
    fn fixed(&self) -> Option<I256> {
        Some(I256::from(*self))
    }
}

impl ExactInteger for BigInt {
    fn big(&self) -> BigInt {
        self.clone()
    }
    fn fixed(&self) -> Option<I256> {
        None
    }
}

/// An [`ExactInteger`] that computes: `i128` or `BigInt`.
pub trait Integer:
    ExactInteger
    + Neg<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
{
    /// The order of `a*b` and `c*d`.
    fn compare_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Ordering;

    /// `a*b - c*d`.
    fn minor(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        let subtracted = c.clone() * d;
        a.clone() * b - &subtracted
    }
}

impl Integer for i128 {
    fn compare_products(a: &i128, b: &i128, c: &i128, d: &i128) -> Ordering {
        let [left, right] = [a.checked_mul(*b), c.checked_mul(*d)];
        if let (Some(left), Some(right)) = (left, right) {
            return left.cmp(&right);
        }
        let sizes = [a, b, c, d].map(|factor| factor.unsigned_abs());
        if sizes.iter().all(|size| *size < I256::MOST_OF_A_FACTOR) {
            return I256::product(*a, *b).cmp(&I256::product(*c, *d));
        }
        BigInt::compare_products(&a.big(), &b.big(), &c.big(), &d.big())
    }
}

impl Integer for BigInt {
    fn compare_products(a: &BigInt, b: &BigInt, c: &BigInt, d: &BigInt) -> Ordering {
        (a * b).cmp(&(c * d))
    }
}

/// An integer vector.
pub type IntegerVector<I> = [I; 3];

/// The interval of a case whose t = numerator / denominator carries a power of two.
pub struct RayInterval {
    t_min: f64,
    t_max: f64,
    exponent: i64,
}

impl RayInterval {
    /// The interval of a case, with t = numerator / denominator * 2^exponent.
    pub fn new(case: &Case<f64>, exponent: i64) -> RayInterval {
        RayInterval::between(case.ray.t_min, case.ray.t_max, exponent)
    }

    /// The interval from t_min to t_max, with t = numerator / denominator * 2^exponent.
    pub fn between(t_min: f64, t_max: f64, exponent: i64) -> RayInterval {
        RayInterval {
            t_min,
            t_max,
            exponent,
        }
    }

    /// True if the interval is `[0, +inf]`.
    pub fn is_default(&self) -> bool {
        self.t_min == 0.0 && self.t_max == f64::INFINITY
    }

    /// True if the interval is one point.
    pub fn is_point(&self) -> bool {
        self.t_min == self.t_max
    }

    /// The sign of t - t_min; the denominator is not zero.
    pub fn compare_start<I: ExactInteger>(&self, numerator: &I, denominator: &I) -> Ordering {
        self.compare(numerator, denominator, self.t_min)
    }

    /// The sign of t - t_max; the denominator is not zero.
    pub fn compare_end<I: ExactInteger>(&self, numerator: &I, denominator: &I) -> Ordering {
        self.compare(numerator, denominator, self.t_max)
    }

    /// The sign of t - end.
    #[inline]
    fn compare<I: ExactInteger>(&self, numerator: &I, denominator: &I, end: f64) -> Ordering {
        if end.is_infinite() {
            return if end > 0.0 {
                Ordering::Less
            } else {
                Ordering::Greater
            };
        }
        let sign = numerator.sign() as i8 * denominator.sign() as i8;
        let end_sign = i8::from(end > 0.0) - i8::from(end < 0.0);
        if sign != end_sign || end_sign == 0 {
            return sign.cmp(&end_sign);
        }
        // Of one sign: the sizes decide, the other way round below zero.
        let (digits, exponent) = decompose(end);
        let digits = digits.unsigned_abs();
        let places = self.exponent - exponent;
        let by_size = match (numerator.fixed(), denominator.fixed()) {
            (Some(numerator), Some(denominator)) => {
                let scaled = denominator.size().times(digits);
                numerator.size().compare_scaled(places, scaled)
            }
            _ => compare_big([numerator.big(), denominator.big() * digits], places),
        };
        (by_size as i8 * sign).cmp(&0)
    }
}

/// The order of the sizes of two numbers, the first of them times 2^places.
fn compare_big(numbers: [BigInt; 2], places: i64) -> Ordering {
    let [mut left, mut right] = numbers.map(|number| number.into_parts().1);
    if places >= 0 {
        left <<= places
    } else {
        right <<= -places
    }
    left.cmp(&right)
}

/// Points as integers on a common grid, and the grid's exponent.
pub fn align<const N: usize>(points: [[f64; 3]; N]) -> ([IntegerVector<BigInt>; N], i64) {
    let parts = points.map(|point| point.map(decompose));
    let nonzero = parts.iter().flatten().filter(|(digits, _)| *digits != 0);
    let grid = nonzero.map(|(_, exponent)| *exponent).min().unwrap_or(0);
    let on_grid = |(digits, exponent): (i64, i64)| {
        // Its exponent, 0, may be below the grid's.
        if digits == 0 {
            return BigInt::ZERO;
        }
        BigInt::from(digits) << (exponent - grid)
    };
    let integers = parts.map(|point| point.map(on_grid));
    (integers, grid)
}

pub fn minus<I: Integer>(a: &IntegerVector<I>, b: &IntegerVector<I>) -> IntegerVector<I> {
    std::array::from_fn(|i| a[i].clone() - &b[i])
}

pub fn dot<I: Integer>(a: &IntegerVector<I>, b: &IntegerVector<I>) -> I {
    let x = a[0].clone() * &b[0];
    let y = a[1].clone() * &b[1];
    let z = a[2].clone() * &b[2];
    x + &y + &z
}

pub fn cross<I: Integer>(a: &IntegerVector<I>, b: &IntegerVector<I>) -> IntegerVector<I> {
    [
        I::minor(&a[1], &b[2], &a[2], &b[1]),
        I::minor(&a[2], &b[0], &a[0], &b[2]),
        I::minor(&a[0], &b[1], &a[1], &b[0]),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::fixed::number_of_bits;
    use super::*;
    use crate::arith::Float;
    use crate::case::Draw;
    use num_rational::BigRational;

    /// The order of t and an end by rationals.
    fn by_definition(
        numerator: &BigInt,
        denominator: &BigInt,
        exponent: i64,
        end: f64,
    ) -> Ordering {
        let two = BigRational::from_integer(2.into());
        let t = BigRational::new(numerator.clone(), denominator.clone()) * two.pow(exponent as i32);
        t.cmp(&BigRational::from_float(end).expect("a finite end"))
    }

    fn order<I: ExactInteger>(
        [numerator, denominator]: [&I; 2],
        exponent: i64,
        end: f64,
    ) -> Ordering {
        RayInterval::between(end, end, exponent).compare_start(numerator, denominator)
    }

    #[test]
    fn integers_of_every_width_are_compared_with_ends_as_rationals_are() {
        let mut equal = 0;
        for index in 0..20_000 {
            let mut draw = Draw::new("ends", 1, index);
            let bits = draw.pick(&[3, 60, 96, 127]);
            let mut number = |bits: i64| {
                let x = i128::try_from(number_of_bits(&mut draw, bits)).expect("127 bits");
                if x == 0 { i128::MIN } else { x }
            };
            let (top, bottom, multiple) = (number(bits), number(bits), number(20));
            let exponent = draw.integer(-1000, 900);
            // Often t is the end, or the float beside it.
            let [top, bottom, end] = match draw.below(4) {
                0 => [top, bottom, 0],
                _ => [multiple, 1, multiple],
            };
            let end = match end {
                0 => draw.pick(&[0.0, -0.0, 5e-324, -5e-324, 1e308, power_of_two(exponent)]),
                end => end as f64 * power_of_two(exponent),
            };
            let end = end.offset_ulps(draw.pick(&[0, 0, 1, -1]));
            let top = if draw.below(16) == 0 { 0 } else { top };
            let big = [top, bottom].map(BigInt::from);
            let expected = by_definition(&big[0], &big[1], exponent, end);
            assert_eq!(
                order([&top, &bottom], exponent, end),
                expected,
                "{top} {bottom} {exponent} {end:e}"
            );
            assert_eq!(
                order([&big[0], &big[1]], exponent, end),
                expected,
                "{top} {bottom} {exponent} {end:e}"
            );
            // Sixty bits more.
            let by = draw.integer(1, i64::MAX);
            if top.unsigned_abs().max(bottom.unsigned_abs()) < 1 << 126 {
                let wide = [top, bottom].map(|x| I192::product(by, x));
                assert_eq!(
                    order([&wide[0], &wide[1]], exponent, end),
                    expected,
                    "{top} {bottom} {exponent} {end:e}"
                );
            }
            equal += usize::from(expected == Ordering::Equal);
        }
        assert!(3000 < equal, "{equal}");
    }

    fn power_of_two(exponent: i64) -> f64 {
        2f64.powi(exponent as i32)
    }

    #[test]
    fn products_of_any_size_are_compared() {
        for index in 0..20_000 {
            let mut draw = Draw::new("products", 1, index);
            let [a, b, mut c, mut d] = [(); 4].map(|()| {
                let bits = draw.pick(&[3, 63, 107, 108, 127]);
                i128::try_from(number_of_bits(&mut draw, bits)).expect("127 bits")
            });
            if draw.coin() {
                (c, d) = (b, a.saturating_add(i128::from(draw.integer(-1, 1))));
            }
            let expected = (BigInt::from(a) * b).cmp(&(BigInt::from(c) * d));
            assert_eq!(
                i128::compare_products(&a, &b, &c, &d),
                expected,
                "{a} {b} {c} {d}"
            );
        }
    }

    #[test]
    fn a_fraction_is_compared_with_the_ends_of_an_interval() {
        let case = Case::<f64>::new([0.0; 3], [1.0; 3], [[0.0; 3]; 3]);
        // 3·2^exponent / -6 on [-4, -2].
        let order = |exponent: i64| {
            let interval = RayInterval::new(&case.on(-4.0, -2.0), exponent);
            (
                interval.compare_start(&3i128, &-6),
                interval.compare_end(&3i128, &-6),
            )
        };
        assert_eq!(order(1), (Ordering::Greater, Ordering::Greater));
        assert_eq!(order(2), (Ordering::Greater, Ordering::Equal));
        assert_eq!(order(3), (Ordering::Equal, Ordering::Less));
        assert_eq!(order(4), (Ordering::Less, Ordering::Less));
        // Also of a t beyond every float.
        for exponent in [0, 2000] {
            let all = RayInterval::new(&case.on(f64::NEG_INFINITY, f64::INFINITY), exponent);
            for denominator in [1, -1] {
                assert_eq!(all.compare_start(&1i128, &denominator), Ordering::Greater);
                assert_eq!(all.compare_end(&1i128, &denominator), Ordering::Less);
            }
        }
        let kinds = |low: f64, high: f64| {
            let interval = RayInterval::new(&case.on(low, high), 0);
            (interval.is_default(), interval.is_point())
        };
        assert_eq!(kinds(0.0, f64::INFINITY), (true, false));
        assert_eq!(kinds(0.0, 1.0), (false, false));
        assert_eq!(kinds(1.0, f64::INFINITY), (false, false));
        assert_eq!(kinds(1.0, 1.0), (false, true));
    }
}

//! The exact layers: the predicates in integers, of 128 bits where they fit, of any size where not.
//!
//! Positions are multiples of 2^p and the direction of 2^q for the smallest exponents p, q of their
//! lowest bits, so that all coordinates become integers. U, V, W and D are then multiples of
//! 2^(2p+q), T of 2^(3p), and t = T/D carries 2^(p-q).

use super::contact;
use super::signs::Signs;
use crate::case::Case;
use crate::truth::Truth;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// An exact integer: `i128` or `BigInt`.
pub(super) trait Integer:
    Clone
    + Ord
    + Zero
    + Neg<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
{
    /// `digits * 2^shift`.
    fn shifted(digits: i64, shift: u32) -> Self;
    /// In any size.
    fn big(&self) -> BigInt;

    /// Less, equal or greater than zero.
    fn sign(&self) -> Ordering {
        self.cmp(&Self::zero())
    }

    /// `a*b - c*d`.
    fn minor(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        a.clone() * b - &(c.clone() * d)
    }
}

impl Integer for i128 {
    fn shifted(digits: i64, shift: u32) -> i128 {
        i128::from(digits) << shift
    }
    fn big(&self) -> BigInt {
        BigInt::from(*self)
    }
}

impl Integer for BigInt {
    fn shifted(digits: i64, shift: u32) -> BigInt {
        BigInt::from(digits) << shift
    }
    fn big(&self) -> BigInt {
        self.clone()
    }
}

/// An integer vector.
pub(super) type Triple<I> = [I; 3];

/// A case's numbers as integers times a power of two.
pub(super) struct Scaled {
    /// Origin, a, b, c: digits and left shift.
    positions: [[(i64, u32); 3]; 4],
    direction: [(i64, u32); 3],
    /// Bits of the largest position and of the largest direction coordinate.
    position_bits: u32,
    direction_bits: u32,
    /// p - q.
    t_exponent: i64,
    t_min: f64,
    t_max: f64,
}

impl Scaled {
    /// Of a valid case.
    pub fn new(case: &Case<f64>) -> Scaled {
        let [o, d, a, b, c] = case.vectors();
        let (positions, position_bits, p) = align([o, a, b, c]);
        let ([direction], direction_bits, q) = align([d]);
        let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
        Scaled {
            positions,
            direction,
            position_bits,
            direction_bits,
            t_exponent: p - q,
            t_min,
            t_max,
        }
    }

    /// In 128 bits, where every intermediate fits.
    pub fn decide_small(&self) -> Option<Truth> {
        // Differences gain a bit; T sums six products of three of them; contact compares fractions
        // of degree 2+1 by 1+2 in positions and directions, with two bits for its sums.
        let (p, q) = (self.position_bits + 1, self.direction_bits);
        let transversal = (3 * p + 3).max(2 * p + q + 4) <= 126;
        let contact = 3 * (p + 1) + 3 * q + 8 <= 126;
        if !transversal {
            return None;
        }
        self.decide::<i128>(contact)
    }

    /// In integers of any size.
    pub fn decide_big(&self) -> Truth {
        self.decide::<BigInt>(true).expect("integers of any size decide everything")
    }

    /// None if the contact would be needed and does not fit.
    fn decide<I: Integer>(&self, contact_fits: bool) -> Option<Truth> {
        let integer = |(digits, shift): (i64, u32)| I::shifted(digits, shift);
        let [o, a, b, c] = self.positions.map(|point| point.map(integer));
        let d = self.direction.map(integer);
        let n = cross(&minus(&b, &a), &minus(&c, &a));
        let [a, b, c] = [minus(&a, &o), minus(&b, &o), minus(&c, &o)];
        let capital_d = dot(&d, &n);
        if capital_d.is_zero() {
            let degenerate = n.iter().all(Zero::is_zero);
            if !degenerate && !dot(&n, &a).is_zero() {
                return Some(Truth::Parallel);
            }
            if !contact_fits {
                return None;
            }
            let contact = contact::decide(self, &d, [&a, &b, &c], &n);
            return Some(if degenerate {
                Truth::Degenerate(contact)
            } else {
                Truth::Coplanar(contact)
            });
        }
        let capital_t = dot(&n, &a);
        let weights = [(&c, &b), (&a, &c), (&b, &a)].map(|(x, y)| dot(&d, &cross(x, y)).sign());
        let compare = |end: f64| self.compare_t(&capital_t, &capital_d, end);
        let signs = Signs {
            d: capital_d.sign(),
            weights,
            t: capital_t.sign(),
            from_min: compare(self.t_min),
            from_max: compare(self.t_max),
        };
        Some(signs.truth())
    }

    /// The sign of `numerator / denominator * 2^(p-q) - end`; the denominator is not zero.
    pub fn compare_t<I: Integer>(&self, numerator: &I, denominator: &I, end: f64) -> Ordering {
        let relative = |sign: Ordering| {
            if denominator.sign() == Ordering::Less { sign.reverse() } else { sign }
        };
        if end.is_infinite() {
            return if end > 0.0 { Ordering::Less } else { Ordering::Greater };
        }
        if end == 0.0 {
            return relative(numerator.sign());
        }
        let (digits, exponent) = decompose(end);
        let (mut left, mut right) = (numerator.big(), denominator.big() * digits);
        let shift = self.t_exponent - exponent;
        if shift >= 0 {
            left <<= shift
        } else {
            right <<= -shift
        }
        relative((left - right).signum().sign_ordering())
    }

    /// The interval.
    pub fn interval(&self) -> (f64, f64) {
        (self.t_min, self.t_max)
    }
}

trait SignOrdering {
    fn sign_ordering(&self) -> Ordering;
}

impl SignOrdering for BigInt {
    fn sign_ordering(&self) -> Ordering {
        self.cmp(&BigInt::zero())
    }
}

/// A finite float as an odd integer (or zero) times a power of two.
fn decompose(value: f64) -> (i64, i64) {
    let bits = value.to_bits();
    let field = (bits >> 52 & 0x7ff) as i64;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (digits, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    if digits == 0 {
        return (0, 0);
    }
    let zeros = digits.trailing_zeros();
    let odd = digits >> zeros;
    (if value < 0.0 { -odd } else { odd }, exponent + i64::from(zeros))
}

/// Points on a common grid: digits and shifts, the bits of the largest, and the grid's exponent.
fn align<const N: usize>(points: [[f64; 3]; N]) -> ([[(i64, u32); 3]; N], u32, i64) {
    let parts = points.map(|point| point.map(decompose));
    let nonzero = || parts.iter().flatten().filter(|(digits, _)| *digits != 0);
    let grid = nonzero().map(|(_, exponent)| *exponent).min().unwrap_or(0);
    let shift = |exponent: i64| (exponent - grid) as u32;
    let bits = nonzero()
        .map(|(digits, exponent)| 64 - digits.unsigned_abs().leading_zeros() + shift(*exponent))
        .max()
        .unwrap_or(0);
    let aligned = parts.map(|point| {
        point.map(|(digits, exponent)| if digits == 0 { (0, 0) } else { (digits, shift(exponent)) })
    });
    (aligned, bits, grid)
}

pub(super) fn minus<I: Integer>(a: &Triple<I>, b: &Triple<I>) -> Triple<I> {
    std::array::from_fn(|i| a[i].clone() - &b[i])
}

pub(super) fn dot<I: Integer>(a: &Triple<I>, b: &Triple<I>) -> I {
    a[0].clone() * &b[0] + &(a[1].clone() * &b[1]) + &(a[2].clone() * &b[2])
}

pub(super) fn cross<I: Integer>(a: &Triple<I>, b: &Triple<I>) -> Triple<I> {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        I::minor(&a[j], &b[k], &a[k], &b[j])
    })
}

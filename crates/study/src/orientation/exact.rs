//! The exact determinant: once by its definition in rationals, once quickly in scaled integers.

use super::Points;
use crate::arith::{Float, decompose};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;
use std::fmt;

/// The definition: the determinant of the rows (point, 1), expanded along its last column, in
/// rationals. No difference of points is formed, so that it shares nothing with the integers below.
///
/// None where a coordinate is not finite.
pub fn defined_determinant<F: Float>(points: &Points<F>) -> Option<BigRational> {
    let rows: Option<Vec<Vec<BigRational>>> = points
        .iter()
        .map(|point| {
            let mut row = point
                .iter()
                .map(|x| BigRational::from_float(x.to_f64()))
                .collect::<Option<Vec<_>>>()?;
            row.push(BigRational::one());
            Some(row)
        })
        .collect();
    let rows = rows?;
    Some(expand(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>()))
}

/// Laplace's expansion along the last column.
fn expand(rows: &[&[BigRational]]) -> BigRational {
    let n = rows.len();
    if n == 1 {
        return rows[0][0].clone();
    }
    let mut sum = BigRational::zero();
    for (i, row) in rows.iter().enumerate() {
        let others: Vec<&[BigRational]> =
            (0..n).filter(|&k| k != i).map(|k| &rows[k][..n - 1]).collect();
        let term = &row[n - 1] * expand(&others);
        // The sign of the cofactor at row i, column n-1.
        if (i + n - 1).is_multiple_of(2) { sum += term } else { sum -= term }
    }
    sum
}

/// `digits * 2^exponent`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BigDyadic {
    /// Odd, or 0.
    digits: BigInt,
    /// 0 beside 0.
    exponent: i64,
}

impl BigDyadic {
    fn new(digits: BigInt, exponent: i64) -> BigDyadic {
        match digits.trailing_zeros() {
            None => BigDyadic { digits, exponent: 0 },
            Some(zeros) => BigDyadic { digits: digits >> zeros, exponent: exponent + zeros as i64 },
        }
    }

    /// Less, equal or greater than 0.
    pub fn sign(&self) -> Ordering {
        self.digits.cmp(&BigInt::zero())
    }

    /// As a reduced rational.
    pub fn to_rational(&self) -> BigRational {
        let power = BigInt::one() << self.exponent.unsigned_abs();
        if self.exponent < 0 {
            BigRational::new(self.digits.clone(), power)
        } else {
            BigRational::from_integer(&self.digits * power)
        }
    }
}

impl fmt::Display for BigDyadic {
    /// A fraction in lowest terms, its power of two unexpanded: `3/2^1077`, `5*2^900`, `-7`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.exponent {
            0 => write!(f, "{}", self.digits),
            1.. => write!(f, "{}*2^{}", self.digits, self.exponent),
            _ => write!(f, "{}/2^{}", self.digits, self.exponent.unsigned_abs()),
        }
    }
}

/// Finite points as integers times one power of two.
#[derive(Clone, Debug)]
pub struct ScaledPoints {
    points: Vec<Vec<BigInt>>,
    /// The coordinates are multiples of 2 to this power.
    grid: i64,
}

impl ScaledPoints {
    /// None where a coordinate is not finite.
    pub fn new<F: Float>(points: &Points<F>) -> Option<ScaledPoints> {
        if !points.is_finite() {
            return None;
        }
        let parts: Vec<Vec<(i64, i64)>> = points
            .iter()
            .map(|point| point.iter().map(|&x| decompose(x.to_f64())).collect())
            .collect();
        let nonzero = parts.iter().flatten().filter(|(digits, _)| *digits != 0);
        let grid = nonzero.map(|(_, exponent)| *exponent).min().unwrap_or(0);
        let integer = |&(digits, exponent): &(i64, i64)| {
            if digits == 0 { BigInt::zero() } else { BigInt::from(digits) << (exponent - grid) }
        };
        let points = parts.iter().map(|point| point.iter().map(integer).collect()).collect();
        Some(ScaledPoints { points, grid })
    }

    /// The determinant, by differences from the last point.
    pub fn determinant(&self) -> BigDyadic {
        let (last, others) = self.points.split_last().expect("there are three points or four");
        let rows: Vec<Vec<BigInt>> = others
            .iter()
            .map(|point| point.iter().zip(last).map(|(x, y)| x - y).collect())
            .collect();
        let minor = |a: &[BigInt], b: &[BigInt], j: usize, k: usize| &a[j] * &b[k] - &a[k] * &b[j];
        let digits = match rows.as_slice() {
            [a, b] => minor(a, b, 0, 1),
            [a, b, c] => {
                &a[0] * minor(b, c, 1, 2) + &a[1] * minor(b, c, 2, 0) + &a[2] * minor(b, c, 0, 1)
            }
            _ => unreachable!("there are three points or four"),
        };
        BigDyadic::new(digits, self.grid * rows.len() as i64)
    }

    /// The largest `abs(coordinate)`, in units of the grid.
    fn largest(&self) -> BigUint {
        let coordinates = self.points.iter().flatten();
        coordinates.map(BigInt::magnitude).max().cloned().unwrap_or_default()
    }

    /// The exponent k of the largest `abs(coordinate)`, which is in `[2^k, 2^(k+1))`; none if all
    /// are 0.
    pub(super) fn largest_exponent(&self) -> Option<i64> {
        let bits = self.largest().bits() as i64;
        (bits > 0).then(|| bits - 1 + self.grid)
    }

    /// True if `abs(determinant) <= 2^power * m^n`, where m is the largest `abs(coordinate)` and n the number of
    /// dimensions.
    pub(super) fn is_within(&self, determinant: &BigDyadic, power: i64) -> bool {
        let n = self.points[0].len();
        let bound =
            BigDyadic::new(self.largest().pow(n as u32).into(), self.grid * n as i64 + power);
        let grid = bound.exponent.min(determinant.exponent);
        let align = |number: &BigDyadic| number.digits.abs() << (number.exponent - grid);
        align(determinant) <= align(&bound)
    }

    /// True if on some axis the points' extent is at most 2^-`bits` of their distance from 0.
    pub(super) fn is_far(&self, bits: u64) -> bool {
        (0..self.points[0].len()).any(|axis| {
            let values = || self.points.iter().map(|point| &point[axis]);
            let (low, high) = (values().min(), values().max());
            let nearest = values().map(BigInt::magnitude).min();
            match (low, high, nearest) {
                (Some(low), Some(high), Some(nearest)) => {
                    !nearest.is_zero() && ((high - low) << bits) <= BigInt::from(nearest.clone())
                }
                _ => false,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn determinants_print_as_fractions() {
        let shown = |digits: i64, exponent| BigDyadic::new(digits.into(), exponent).to_string();
        assert_eq!(shown(12, -4), "3/2^2");
        assert_eq!(shown(-5, 900), "-5*2^900");
        assert_eq!(shown(-14, -1), "-7");
        assert_eq!(shown(0, -1074), "0");
    }

    #[test]
    fn points_that_are_not_finite_have_no_determinant() {
        for bad in [f64::NAN, f64::INFINITY] {
            let points = Points::two([[0.0, 1.0], [bad, 0.0], [1.0, 1.0]]);
            assert!(ScaledPoints::new(&points).is_none());
            assert!(defined_determinant(&points).is_none());
        }
    }

    #[test]
    fn unit_corners_are_positive_by_both_ways() {
        let two = Points::two([[1.0f32, 0.0], [0.0, 1.0], [0.0, 0.0]]);
        let three = Points::three([[1.0f64, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]);
        let one = BigRational::one();
        assert_eq!(ScaledPoints::new(&two).unwrap().determinant().to_rational(), one);
        assert_eq!(ScaledPoints::new(&three).unwrap().determinant().to_rational(), one);
        assert_eq!(defined_determinant(&two).unwrap(), one);
        assert_eq!(defined_determinant(&three).unwrap(), one);
    }
}

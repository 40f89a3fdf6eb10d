//! Distances where floats and double-doubles do not decide: all that can cancel in integers of any
//! size, and the rest, products and quotients, in floats with exponents of any size.
//!
//! With A = a - o and so on, the offset of the line from a is A×d / |d|, and that from b is B×d / |d|.
//! The edge between them, B×d - A×d = slope, is met beside its ends where offset and slope are at an
//! obtuse angle at a and at an acute one at b; the distance is then |(A×d)×(B×d)| / (|slope| |d|), and
//! (A×d)×(B×d) = (A·(B×d)) d. So three cross products and three determinants are all there is to
//! round; signs of products with the slope err only where both readings agree to some 2^-50.

use super::Distances;
use crate::arith::{decompose, scale_by_power_of_two};
use crate::case::Case;
use crate::oracle::integer::{IntegerVector, align, cross, dot, minus};
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::cmp::Ordering;

/// A number that is not negative: a power of two times a float, which is zero, infinite, or from 1 to 2.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct WideFloat {
    exponent: i64,
    float: f64,
}

impl WideFloat {
    /// In the order of numbers.
    const ZERO: WideFloat = WideFloat {
        exponent: i64::MIN / 4,
        float: 0.0,
    };

    fn new(float: f64, exponent: i64) -> WideFloat {
        if float == 0.0 {
            return WideFloat::ZERO;
        }
        let (digits, power) = decompose(float);
        let bits = i64::from(63 - digits.leading_zeros());
        let near_one = scale_by_power_of_two(digits as f64, -bits as i32);
        WideFloat {
            float: near_one,
            exponent: exponent + power + bits,
        }
    }

    /// The magnitude of an integer times a power of two, its first 64 bits.
    fn of(integer: &BigInt, exponent: i64) -> WideFloat {
        let shift = integer.bits().saturating_sub(64);
        let leading = (integer.magnitude() >> shift).to_u64().expect("64 bits");
        WideFloat::new(leading as f64, exponent + shift as i64)
    }

    fn times(self, other: WideFloat) -> WideFloat {
        WideFloat::new(self.float * other.float, self.exponent + other.exponent)
    }

    /// By a number that is not zero.
    fn over(self, other: WideFloat) -> WideFloat {
        WideFloat::new(self.float / other.float, self.exponent - other.exponent)
    }

    fn compare(&self, other: &WideFloat) -> Ordering {
        self.partial_cmp(other).expect("no NaN")
    }

    fn to_f64(self) -> f64 {
        let [least, most] = [i32::MIN, i32::MAX].map(i64::from);
        scale_by_power_of_two(self.float, self.exponent.clamp(least, most) as i32)
    }
}

/// A vector in floats below 1, times a power of two.
struct WideVector {
    floats: [f64; 3],
    exponent: i64,
}

impl WideVector {
    fn of(vector: &IntegerVector<BigInt>, exponent: i64) -> WideVector {
        let bits = vector
            .iter()
            .map(BigInt::bits)
            .max()
            .expect("three components");
        let shift = bits.saturating_sub(64);
        let float = |x: &BigInt| {
            let leading = (x >> shift).to_i128().expect("65 bits");
            scale_by_power_of_two(leading as f64, -64)
        };
        WideVector {
            floats: vector.each_ref().map(float),
            exponent: exponent + shift as i64 + 64,
        }
    }

    fn length(&self) -> WideFloat {
        let square = self.floats.iter().map(|x| x * x).sum::<f64>();
        WideFloat::new(square.sqrt(), self.exponent)
    }

    /// The dot product but for a power of two: its sign is what counts.
    fn dot(&self, other: &WideVector) -> f64 {
        self.floats
            .iter()
            .zip(other.floats)
            .map(|(x, y)| x * y)
            .sum()
    }
}

/// The distances of a valid case; `crosses` says whether the line crosses the plane. A zero distance comes out as zero.
pub(super) fn distances(case: &Case<f64>, ulp: f64, crosses: bool) -> Distances {
    let [o, d, a, b, c] = case.vectors();
    let ([o, a, b, c], grid) = align([o, a, b, c]);
    let ([d], direction_grid) = align([d]);
    let squared = grid + direction_grid;
    let length = WideVector::of(&d, direction_grid).length();
    let points = [&a, &b, &c].map(|point| minus(point, &o));
    let offsets = points.each_ref().map(|point| cross(point, &d));

    let edges = [(0, 1), (1, 2), (2, 0)];
    let sides = edges.map(|(p, q)| WideVector::of(&minus(&points[q], &points[p]), grid).length());
    let longest = sides
        .into_iter()
        .max_by(WideFloat::compare)
        .expect("three edges");
    let unit = if longest == WideFloat::ZERO {
        WideFloat::new(1.0, 0)
    } else {
        longest
    };
    let to_edges = edges.map(|(p, q)| {
        let slope = WideVector::of(&minus(&offsets[q], &offsets[p]), squared);
        let [at_p, at_q] = [p, q].map(|end| WideVector::of(&offsets[end], squared));
        if at_p.dot(&slope) < 0.0 && 0.0 < at_q.dot(&slope) {
            let determinant = dot(&points[p], &offsets[q]);
            WideFloat::of(&determinant, grid + squared).over(slope.length())
        } else {
            [at_p.length(), at_q.length()]
                .into_iter()
                .min_by(WideFloat::compare)
                .expect("two")
                .over(length)
        }
    });
    let in_space = to_edges
        .into_iter()
        .min_by(WideFloat::compare)
        .expect("three edges");

    let [from_a, ..] = &points;
    let n = cross(&minus(&b, &a), &minus(&c, &a));
    let (capital_t, capital_d) = (dot(&n, from_a), dot(&n, &d));
    let to_end = |end: f64| {
        if end.is_infinite() {
            return f64::INFINITY;
        }
        let gap = gap((&capital_t, 3 * grid), (&capital_d, grid + squared), end);
        gap.over(WideFloat::of(&capital_d, grid + squared))
            .times(length)
            .over(unit)
            .to_f64()
    };
    let along = if crosses {
        [0.0, case.ray.t_min, case.ray.t_max].map(to_end)
    } else {
        [f64::NAN; 3]
    };
    Distances {
        in_space: in_space.over(unit).to_f64(),
        along,
        edge_in_ulps: unit.over(WideFloat::new(ulp, 0)).to_f64(),
    }
}

/// |T - end·D|; T and D as integers times powers of two.
fn gap((t, t_exponent): (&BigInt, i64), (d, d_exponent): (&BigInt, i64), end: f64) -> WideFloat {
    let (digits, exponent) = decompose(end);
    let d_exponent = d_exponent + exponent;
    let common = t_exponent.min(d_exponent);
    let gap = (t << (t_exponent - common)) - ((d * digits) << (d_exponent - common));
    WideFloat::of(&gap, common)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{Exact, Real};
    use crate::case::Parameters;
    use crate::family::FAMILIES;
    use crate::judge::Squares;
    use crate::oracle;
    use crate::truth::Truth;

    /// In exact squares, without a float until the end.
    fn by_squares(case: &Case<f64>, truth: &Truth) -> (f64, [f64; 3]) {
        let (ray, triangle) = case.exact();
        let squares = Squares::<Exact>::of(&ray, &triangle, truth.crossing().is_some());
        let unit = if squares.longest.is_zero() {
            Exact::one()
        } else {
            squares.longest
        };
        let relative = |square: Exact| (square / &unit).approximate_root();
        let along = squares
            .along
            .map(|square| square.map_or(f64::NAN, relative));
        (relative(squares.in_space), along)
    }

    #[test]
    fn distances_in_integers_are_those_of_exact_squares() {
        let near = |found: f64, exact: f64| {
            found == exact || (found - exact).abs() <= 1e-12 * exact || exact.is_infinite()
        };
        let mut compared = 0;
        for family in FAMILIES {
            for index in 0..60 {
                let made = family.make::<f64>(&Parameters::default(), 5, index);
                for case in made.cases() {
                    let truth = oracle::truth(case);
                    if truth == Truth::Invalid {
                        continue;
                    }
                    let found = distances(case, 1.0, truth.crossing().is_some());
                    let (in_space, along) = by_squares(case, &truth);
                    assert!(
                        near(found.in_space, in_space),
                        "{} {in_space:e}",
                        case.hex()
                    );
                    for (found, exact) in found.along.into_iter().zip(along) {
                        let agree = exact.is_nan() || near(found, exact);
                        assert!(agree, "{} {found:e} {exact:e}", case.hex());
                    }
                    compared += 1;
                }
            }
        }
        assert!(compared > 1500, "{compared}");
    }
}

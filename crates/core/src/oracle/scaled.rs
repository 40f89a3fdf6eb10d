//! The last layer: all truths in integers of any size, and the exact t, u and v of a crossing.
//!
//! Positions are multiples of 2^p and the direction of 2^q for the smallest exponents p, q of their
//! lowest bits, so that all coordinates become integers. U, V, W and D are then multiples of
//! 2^(2p+q), T of 2^(3p), and t = T/D carries 2^(p-q).

use super::contact;
use super::integer::{ExactInteger, IntegerVector, RayInterval, align, cross, dot, minus};
use super::signs::{DecidingSigns, Determinant, rows};
use crate::case::{Case, Matrix};
use crate::truth::Truth;
use num_bigint::BigInt;
use num_rational::BigRational;
use std::cmp::Ordering;

/// A case's numbers as integers of any size.
pub(super) struct Scaled {
    origin: IntegerVector<BigInt>,
    direction: IntegerVector<BigInt>,
    vertices: [IntegerVector<BigInt>; 3],
    /// The exponent that t = T/D carries.
    t_exponent: i64,
}

impl Scaled {
    /// The numbers of a valid case.
    pub fn new(case: &Case<f64>) -> Scaled {
        let [o, d, a, b, c] = case.vectors();
        let ([origin, vertices @ ..], p) = align([o, a, b, c]);
        let ([direction], q) = align([d]);
        Scaled {
            origin,
            direction,
            vertices,
            t_exponent: p - q,
        }
    }

    /// The numbers of a ray of the world and the triangle that an instance puts there, as the object sees them, times
    /// the determinant of the matrix, so that no division is left. None if the determinant is 0.
    ///
    /// With M the matrix and m its translation, adj M·(o - m), adj M·d and det M·(a, b, c) are the case by the exact
    /// inverse, times det M. Where det M is negative all signs are changed, so that no side is turned.
    pub fn of_instance(case: &Case<f64>, matrix: Matrix<f64>) -> Option<Scaled> {
        let [o, d, a, b, c] = case.vectors();
        let columns = [0, 1, 2].map(|column| matrix.map(|row| row[column]));
        let translation = matrix.map(|row| row[3]);
        let ([x, y, z], r) = align(columns);
        let ([origin, translation], p) = align([o, translation]);
        let ([direction], q) = align([d]);
        let (vertices, s) = align([a, b, c]);
        let adjugate = [cross(&y, &z), cross(&z, &x), cross(&x, &y)];
        let determinant = dot(&z, &adjugate[2]);
        let (rows, size) = match ExactInteger::sign(&determinant) {
            Ordering::Equal => return None,
            Ordering::Greater => (adjugate, determinant),
            Ordering::Less => (adjugate.map(|row| row.map(|entry| -entry)), -determinant),
        };
        let from_translation = minus(&origin, &translation);
        // The rows carry 2^(2r) and the determinant 2^(3r). So the origin carries 2^(2r+p) and the vertices 2^(3r+s):
        // without the 2^(2r) that the direction has too, 2^p and 2^(r+s). Both become multiples of the lesser.
        let common = p.min(r + s);
        let to_origin = p - common;
        let to_vertices = r + s - common;
        Some(Scaled {
            origin: products(&rows, &from_translation).map(|x| x << to_origin),
            direction: products(&rows, &direction),
            vertices: vertices.map(|vertex| vertex.map(|x| (x * &size) << to_vertices)),
            t_exponent: common - q,
        })
    }

    /// The truth, all of it in integers; of the case only the interval counts.
    pub fn truth(&self, case: &Case<f64>) -> Truth {
        let d = self.value(Determinant::D);
        let t = self.value(Determinant::T);
        if ExactInteger::is_zero(&d) {
            return if ExactInteger::is_zero(&t) {
                self.touching(case)
            } else {
                Truth::Parallel
            };
        }
        let weight = |vertex| self.value(Determinant::Weight(vertex));
        let interval = RayInterval::new(case, self.t_exponent);
        let signs = DecidingSigns {
            d: ExactInteger::sign(&d),
            weights: [0, 1, 2].map(|vertex| ExactInteger::sign(&weight(vertex))),
            t: ExactInteger::sign(&t),
            from_min: interval.compare_start(&t, &d),
            from_max: interval.compare_end(&t, &d),
        };
        signs.truth()
    }

    /// The sign of one determinant, with which the tests compare that of earlier layers.
    #[cfg(test)]
    pub fn sign(&self, determinant: Determinant) -> std::cmp::Ordering {
        ExactInteger::sign(&self.value(determinant))
    }

    fn value(&self, determinant: Determinant) -> BigInt {
        let [a, b, c] = &self.vertices;
        let [first, p, q, base] = rows(determinant, [&self.origin, &self.direction, a, b, c]);
        let normal = cross(&minus(p, base), &minus(q, base));
        match determinant {
            Determinant::T => dot(&minus(first, base), &normal),
            _ => dot(first, &normal),
        }
    }

    /// t, u and v of a crossing, where D is not zero.
    pub fn crossing(&self) -> [BigRational; 3] {
        let d = self.value(Determinant::D);
        let mut numerator = self.value(Determinant::T);
        let mut denominator = d.clone();
        if self.t_exponent >= 0 {
            numerator <<= self.t_exponent
        } else {
            denominator <<= -self.t_exponent
        }
        let t = BigRational::new(numerator, denominator);
        let weight = |vertex| BigRational::new(-self.value(Determinant::Weight(vertex)), d.clone());
        [t, weight(1), weight(2)]
    }

    /// The truth where D and T are zero: the triangle has no area, or the line lies in its plane.
    pub fn touching(&self, case: &Case<f64>) -> Truth {
        let [a, b, c] = &self.vertices;
        let normal = cross(&minus(b, a), &minus(c, a));
        let from_origin = self.vertices.each_ref().map(|v| minus(v, &self.origin));
        let interval = RayInterval::new(case, self.t_exponent);
        let contact = contact::decide(&interval, &self.direction, from_origin.each_ref(), &normal);
        if normal.iter().all(ExactInteger::is_zero) {
            Truth::Degenerate(contact)
        } else {
            Truth::Coplanar(contact)
        }
    }
}

/// The product of each row with a vector.
fn products(
    rows: &[IntegerVector<BigInt>; 3],
    vector: &IntegerVector<BigInt>,
) -> IntegerVector<BigInt> {
    rows.each_ref().map(|row| dot(row, vector))
}

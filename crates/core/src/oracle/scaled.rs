//! The last layer: contacts in integers of any size. And the exact t, u and v of a crossing.
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
        let ([origin, a, b, c], p) = align([o, a, b, c]);
        let ([direction], q) = align([d]);
        Scaled {
            origin,
            direction,
            vertices: [a, b, c],
            t_exponent: p - q,
        }
    }

    /// The numbers of a ray of the world and the triangle that an instance puts there, as the object sees them and as
    /// many times as large as the determinant of the matrix, so that no division is left; none where that is 0.
    ///
    /// With M the matrix and m its translation, adj M·(o - m), adj M·d and det M·(a, b, c) are what the exact inverse
    /// makes of the case, times det M. A negative one is left positive, so that no side is turned.
    pub fn of_instance(case: &Case<f64>, matrix: Matrix<f64>) -> Option<Scaled> {
        let [o, d, a, b, c] = case.vectors();
        let columns = [0, 1, 2].map(|column| matrix.map(|row| row[column]));
        let ([x, y, z], r) = align(columns);
        let ([mut origin, moved], p) = align([o, matrix.map(|row| row[3])]);
        let ([direction], q) = align([d]);
        let (mut vertices, s) = align([a, b, c]);
        let mut rows = [cross(&y, &z), cross(&z, &x), cross(&x, &y)];
        let mut determinant = dot(&z, &rows[2]);
        match ExactInteger::sign(&determinant) {
            Ordering::Equal => return None,
            Ordering::Less => {
                determinant = -determinant;
                rows = rows.map(|row| row.map(|entry| -entry));
            }
            Ordering::Greater => {}
        }
        origin = minus(&origin, &moved);
        // The determinant carries 2^(3r) and the rows 2^(2r): the origin 2^(2r+p), the vertices 2^(3r+s).
        let (of_origin, of_vertices) = (p, r + s);
        let common = of_origin.min(of_vertices);
        let times =
            |row: &IntegerVector<BigInt>, by: &IntegerVector<BigInt>, shift| dot(row, by) << shift;
        vertices =
            vertices.map(|vertex| vertex.map(|x| (x * &determinant) << (of_vertices - common)));
        Some(Scaled {
            origin: rows
                .each_ref()
                .map(|row| times(row, &origin, of_origin - common)),
            direction: rows.each_ref().map(|row| times(row, &direction, 0)),
            vertices,
            t_exponent: common - q,
        })
    }

    /// The truth, all of it in integers; of the case only the interval counts.
    pub fn truth(&self, case: &Case<f64>) -> Truth {
        let (d, t) = (self.value(Determinant::D), self.value(Determinant::T));
        match (ExactInteger::sign(&d), ExactInteger::sign(&t)) {
            (Ordering::Equal, Ordering::Equal) => self.touching(case),
            (Ordering::Equal, _) => Truth::Parallel,
            (of_d, of_t) => {
                let weight = |k| ExactInteger::sign(&self.value(Determinant::Weight(k)));
                let interval = RayInterval::new(case, self.t_exponent);
                let signs = DecidingSigns {
                    d: of_d,
                    weights: [0, 1, 2].map(weight),
                    t: of_t,
                    from_min: interval.compare_start(&t, &d),
                    from_max: interval.compare_end(&t, &d),
                };
                signs.truth()
            }
        }
    }

    /// The sign of one determinant: what the layers before are compared with.
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
        let (mut t, mut over) = (self.value(Determinant::T), d.clone());
        if self.t_exponent >= 0 {
            t <<= self.t_exponent
        } else {
            over <<= -self.t_exponent
        }
        let weight = |i| BigRational::new(-self.value(Determinant::Weight(i)), d.clone());
        [BigRational::new(t, over), weight(1), weight(2)]
    }

    /// The truth where D and T are zero: the triangle has no area, or the line lies in its plane.
    pub fn touching(&self, case: &Case<f64>) -> Truth {
        let [a, b, c] = &self.vertices;
        let n = cross(&minus(b, a), &minus(c, a));
        let degenerate = n.iter().all(ExactInteger::is_zero);
        let [a, b, c] = self.vertices.each_ref().map(|v| minus(v, &self.origin));
        let interval = RayInterval::new(case, self.t_exponent);
        let contact = contact::decide(&interval, &self.direction, [&a, &b, &c], &n);
        if degenerate {
            Truth::Degenerate(contact)
        } else {
            Truth::Coplanar(contact)
        }
    }
}

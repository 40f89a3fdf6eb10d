//! Three numbers of any arithmetic, in glam's order of operations.

use super::{Exact, Real, Vector};

/// Three numbers. What glam's scalar vectors compute, this computes in the same order, so that a
/// kernel rounds alike on both.
#[derive(Clone, Debug)]
pub struct Triple<R>([R; 3]);

/// Three exact numbers.
pub type ExactVector = Triple<Exact>;

impl<R> From<[R; 3]> for Triple<R> {
    fn from(coordinates: [R; 3]) -> Self {
        Triple(coordinates)
    }
}

impl<R: Real> Vector for Triple<R> {
    type Real = R;
    fn new(x: R, y: R, z: R) -> Self {
        Triple([x, y, z])
    }
    fn at(&self, axis: usize) -> R {
        self.0[axis].clone()
    }
    fn minus(&self, other: &Self) -> Self {
        let ([x, y, z], [a, b, c]) = (&self.0, &other.0);
        Triple([x.clone() - a, y.clone() - b, z.clone() - c])
    }
    fn plus(&self, other: &Self) -> Self {
        let ([x, y, z], [a, b, c]) = (&self.0, &other.0);
        Triple([x.clone() + a, y.clone() + b, z.clone() + c])
    }
    fn times(&self, factor: &R) -> Self {
        let [x, y, z] = &self.0;
        Triple([x.clone() * factor, y.clone() * factor, z.clone() * factor])
    }
    fn plus_scaled(self, vector: &Self, factor: &R) -> Self {
        let ([x, y, z], [a, b, c]) = (self.0, &vector.0);
        let product = |a: &R| a.clone() * factor;
        Triple([x + product(a), y + product(b), z + product(c)])
    }
    fn dot(&self, other: &Self) -> R {
        let ([x, y, z], [a, b, c]) = (&self.0, &other.0);
        x.clone() * a + y.clone() * b + z.clone() * c
    }
    fn cross(&self, other: &Self) -> Self {
        let ([x, y, z], [a, b, c]) = (&self.0, &other.0);
        let minor = |p: &R, q: &R, r: &R, s: &R| p.clone() * q - r.clone() * s;
        Triple([minor(y, c, b, z), minor(z, a, c, x), minor(x, b, a, y)])
    }
}

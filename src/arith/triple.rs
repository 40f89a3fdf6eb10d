//! Three numbers of any arithmetic, in glam's order of operations.

use super::{Exact, Real, Vector};

/// Three numbers. What glam's scalar vectors compute, this computes in the same order, so that a
/// kernel rounds alike on both.
#[derive(Clone, Debug)]
pub struct Triple<R>([R; 3]);

/// Three exact numbers.
pub type ExactVector = Triple<Exact>;

impl<R: Real> Vector for Triple<R> {
    type Real = R;
    fn new(x: R, y: R, z: R) -> Self {
        Triple([x, y, z])
    }
    fn at(&self, axis: usize) -> R {
        self.0[axis].clone()
    }
    fn minus(&self, other: &Self) -> Self {
        Triple(std::array::from_fn(|i| self.0[i].clone() - &other.0[i]))
    }
    fn plus(&self, other: &Self) -> Self {
        Triple(std::array::from_fn(|i| self.0[i].clone() + &other.0[i]))
    }
    fn times(&self, factor: &R) -> Self {
        Triple(std::array::from_fn(|i| self.0[i].clone() * factor))
    }
    fn plus_scaled(self, vector: &Self, factor: &R) -> Self {
        let mut axes = 0..3;
        Triple(self.0.map(|x| {
            let i = axes.next().expect("three axes");
            x + vector.0[i].clone() * factor
        }))
    }
    fn dot(&self, other: &Self) -> R {
        let [x, y, z] = std::array::from_fn(|i| self.0[i].clone() * &other.0[i]);
        x + y + z
    }
    fn cross(&self, other: &Self) -> Self {
        Triple(std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            self.0[j].clone() * &other.0[k] - other.0[j].clone() * &self.0[k]
        }))
    }
}

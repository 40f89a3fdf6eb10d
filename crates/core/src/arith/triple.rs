//! Three numbers of any arithmetic, in glam's order of operations.

use super::{Exact, Real, Vector};

/// Three numbers. What glam's scalar vectors compute, this computes in the same order, so that a
/// kernel rounds alike on both.
#[derive(Clone, Debug)]
pub struct Triple<R> {
    x: R,
    y: R,
    z: R,
}

/// Three exact numbers.
pub type ExactVector = Triple<Exact>;

impl<R> From<[R; 3]> for Triple<R> {
    fn from([x, y, z]: [R; 3]) -> Self {
        Triple { x, y, z }
    }
}

impl<R: Real> Vector for Triple<R> {
    type Real = R;
    fn new(x: R, y: R, z: R) -> Self {
        Triple { x, y, z }
    }
    fn at(&self, axis: usize) -> R {
        let coordinates = [&self.x, &self.y, &self.z];
        coordinates[axis].clone()
    }
    fn minus(&self, other: &Self) -> Self {
        Triple {
            x: self.x.clone() - &other.x,
            y: self.y.clone() - &other.y,
            z: self.z.clone() - &other.z,
        }
    }
    fn plus(&self, other: &Self) -> Self {
        Triple {
            x: self.x.clone() + &other.x,
            y: self.y.clone() + &other.y,
            z: self.z.clone() + &other.z,
        }
    }
    fn times(&self, factor: &R) -> Self {
        Triple {
            x: self.x.clone() * factor,
            y: self.y.clone() * factor,
            z: self.z.clone() * factor,
        }
    }
    fn plus_scaled(self, vector: &Self, factor: &R) -> Self {
        let scaled = |coordinate: &R| coordinate.clone() * factor;
        Triple {
            // The product is added while it is unborrowed, so that an arithmetic may fuse it.
            x: self.x + scaled(&vector.x),
            y: self.y + scaled(&vector.y),
            z: self.z + scaled(&vector.z),
        }
    }
    fn dot(&self, other: &Self) -> R {
        self.x.clone() * &other.x + self.y.clone() * &other.y + self.z.clone() * &other.z
    }
    fn cross(&self, other: &Self) -> Self {
        Triple {
            x: minor(&self.y, &other.z, &other.y, &self.z),
            y: minor(&self.z, &other.x, &other.z, &self.x),
            z: minor(&self.x, &other.y, &other.x, &self.y),
        }
    }
}

/// `p*q - r*s`, with both products unborrowed, so that an arithmetic may fuse one of them.
fn minor<R: Real>(p: &R, q: &R, r: &R, s: &R) -> R {
    p.clone() * q - r.clone() * s
}

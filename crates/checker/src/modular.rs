//! Numbers modulo a prime, and vectors of them.

use std::array::from_fn;

pub const PRIME: u64 = (1 << 61) - 1;

pub fn times(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    (product % u128::from(PRIME)) as u64
}

pub fn minus(a: u64, b: u64) -> u64 {
    (a + (PRIME - b)) % PRIME
}

pub fn plus(a: u64, b: u64) -> u64 {
    (a + b) % PRIME
}

pub fn negative(x: u64) -> u64 {
    minus(0, x)
}

/// A whole number.
pub fn number(value: i64) -> u64 {
    let size = value.unsigned_abs() % PRIME;
    if value < 0 { negative(size) } else { size }
}

/// The power of a number, for small exponents.
pub fn raised(x: u64, exponent: u64) -> u64 {
    let mut product = 1;
    for _ in 0..exponent {
        product = times(product, x);
    }
    product
}

/// The inverse, by Fermat: x to the power of two less than the prime.
pub fn inverse(x: u64) -> u64 {
    let mut exponent = PRIME - 2;
    let mut square = x;
    let mut found = 1;
    while exponent > 0 {
        if exponent % 2 == 1 {
            found = times(found, square);
        }
        square = times(square, square);
        exponent /= 2;
    }
    found
}

pub type Vector = [u64; 3];

pub fn difference(p: Vector, q: Vector) -> Vector {
    from_fn(|axis| minus(p[axis], q[axis]))
}

pub fn cross(p: Vector, q: Vector) -> Vector {
    from_fn(|axis| {
        let j = (axis + 1) % 3;
        let k = (axis + 2) % 3;
        let ahead = times(p[j], q[k]);
        let back = times(p[k], q[j]);
        minus(ahead, back)
    })
}

pub fn dot(p: Vector, q: Vector) -> u64 {
    let mut sum = 0;
    for axis in 0..3 {
        sum = plus(sum, times(p[axis], q[axis]));
    }
    sum
}

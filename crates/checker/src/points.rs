//! Inputs modulo a prime, and the numbers there that a guarded kernel may be made from.

use super::domain::INPUTS;
use super::modular::{
    PRIME, Vector, cross, difference, dot, inverse, minus, negative, number, plus, raised, times,
};
use super::operations::Operation;
use super::program::Program;
use std::array::from_fn;
use std::collections::HashMap;

/// The numbers that have a sign of their own.
pub const U: usize = 0;
pub const V: usize = 1;
pub const W: usize = 2;
pub const UV: usize = 3;
pub const VW: usize = 4;
pub const WU: usize = 5;
pub const SUM: usize = 6;
pub const T: usize = 7;
pub const NEAR: usize = 8;
pub const FAR: usize = 9;
pub const N: usize = 10;
pub const D: usize = 13;
pub const COUNT: usize = 16;
/// N·N, which is positive.
pub const SQUARE: usize = 16;

/// A sign for each number that has one of its own.
pub type KnownSigns = [i8; COUNT];

pub const POINTS: usize = 5;

/// Inputs, and the known numbers there.
pub struct Point {
    inputs: [u64; INPUTS],
    known: [u64; COUNT + 1],
}

impl Point {
    pub fn new(seed: u64) -> Point {
        let mut state = seed;
        let mut point = Point {
            inputs: from_fn(|_| next_random(&mut state) % PRIME),
            known: [0; COUNT + 1],
        };
        point.compute_known();
        point
    }

    /// Three inputs from this one on.
    fn vector(&self, first: usize) -> Vector {
        from_fn(|axis| self.inputs[first + axis])
    }

    /// Computes the known numbers by their definitions.
    fn compute_known(&mut self) {
        let origin = self.vector(0);
        let direction = self.vector(3);
        let a = self.vector(6);
        let b = self.vector(9);
        let c = self.vector(12);
        let to_a = difference(a, origin);
        let to_b = difference(b, origin);
        let to_c = difference(c, origin);
        let normal = cross(difference(b, a), difference(c, a));
        let u = dot(direction, cross(to_c, to_b));
        let v = dot(direction, cross(to_a, to_c));
        let w = dot(direction, cross(to_b, to_a));
        let t = dot(normal, to_a);
        let sum = plus(plus(u, v), w);
        let determinant = negative(sum);
        let to_near = times(self.inputs[15], determinant);
        let to_far = times(self.inputs[16], determinant);
        let known = &mut self.known;
        known[U] = u;
        known[V] = v;
        known[W] = w;
        known[UV] = plus(u, v);
        known[VW] = plus(v, w);
        known[WU] = plus(w, u);
        known[SUM] = sum;
        known[T] = t;
        known[NEAR] = minus(t, to_near);
        known[FAR] = minus(to_far, t);
        known[N..N + 3].copy_from_slice(&normal);
        known[D..D + 3].copy_from_slice(&direction);
        known[SQUARE] = dot(normal, normal);
    }
}

/// The next number of SplitMix64.
fn next_random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut x = *state;
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A seed of points that depends on every operation, so that no program can be chosen for its points.
pub fn seed(program: &Program) -> u64 {
    let mut state = 0;
    for operation in &program.operations {
        for byte in operation.name.bytes() {
            state = mixed(state, byte.into());
        }
        for place in &operation.operands {
            state = mixed(state, *place as u64);
        }
        state = mixed(state, operation.value as u64);
    }
    state
}

fn mixed(state: u64, word: u64) -> u64 {
    let mut x = state ^ word;
    x = x.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 29)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x.rotate_left(31)
}

/// The most that a number's degree may be, and the sum of its coefficients' sizes: two such polynomials that differ also
/// differ modulo the prime, and agree at a point with a chance below 2^-54.
const MOST_DEGREE: u64 = 64;
const MOST_COEFFICIENTS: u64 = 1 << 50;

/// Bounds of a polynomial.
#[derive(Clone, Copy)]
struct Polynomial {
    degree: u64,
    /// The sum of the coefficients' sizes.
    coefficients: u64,
}

impl Polynomial {
    const INPUT: Polynomial = Polynomial {
        degree: 1,
        coefficients: 1,
    };

    fn constant(size: u64) -> Polynomial {
        Polynomial {
            degree: 0,
            coefficients: size,
        }
    }

    /// The bounds of a sum of two; none if they are too large for this machine's integers.
    fn plus(self, other: Polynomial) -> Option<Polynomial> {
        let coefficients = self.coefficients.checked_add(other.coefficients)?;
        Some(Polynomial {
            degree: self.degree.max(other.degree),
            coefficients,
        })
    }

    fn times(self, other: Polynomial) -> Option<Polynomial> {
        let coefficients = self.coefficients.checked_mul(other.coefficients)?;
        Some(Polynomial {
            degree: self.degree + other.degree,
            coefficients,
        })
    }

    fn is_small(&self) -> bool {
        self.degree <= MOST_DEGREE && self.coefficients <= MOST_COEFFICIENTS
    }
}

/// True if a number is a polynomial within these bounds.
pub fn is_small(program: &Program, last: usize) -> bool {
    let mut all = Vec::new();
    for operation in &program.operations[..=last] {
        let found = polynomial(operation, &all);
        all.push(found.filter(Polynomial::is_small));
    }
    all[last].is_some()
}

fn polynomial(operation: &Operation, above: &[Option<Polynomial>]) -> Option<Polynomial> {
    match operation.parts() {
        ("input", _) => Some(Polynomial::INPUT),
        ("number", _) => Some(Polynomial::constant(operation.value.unsigned_abs())),
        ("add" | "sub", &[a, b]) => above[a]?.plus(above[b]?),
        ("mul", &[a, b]) => above[a]?.times(above[b]?),
        ("neg" | "abs", &[a]) => above[a],
        // No number with a margin is made from it.
        _ => Some(Polynomial::constant(0)),
    }
}

/// A power of a known number.
#[derive(Clone, Copy)]
pub struct Power {
    pub known: usize,
    pub exponent: u64,
}

/// Powers of known numbers.
pub type Factors = Vec<Power>;

/// The value of a product at a point.
pub fn product(factors: &[Power], point: &Point) -> u64 {
    let mut product = 1;
    for factor in factors {
        let power = raised(point.known[factor.known], factor.exponent);
        product = times(product, power);
    }
    product
}

/// The products that a number may be, each by the ratio of its values at the first two points.
pub fn products(points: &[Point]) -> HashMap<u64, Vec<Factors>> {
    let mut all: HashMap<u64, Vec<Factors>> = HashMap::new();
    for factors in every_product() {
        let first = product(&factors, &points[0]);
        let second = product(&factors, &points[1]);
        let ratio = times(second, inverse(first));
        all.entry(ratio).or_default().push(factors);
    }
    all
}

/// At most one of the weights, their pairs, T and the ends, times powers of D, of N·N, and of one coordinate of N and d.
fn every_product() -> Vec<Factors> {
    let choices = [
        powers((U..SUM).chain(T..N), 1),
        powers([SUM], 3),
        powers([SQUARE], 2),
        powers(N..D, 2),
        powers(D..COUNT, 4),
    ];
    let mut all = vec![Factors::new()];
    for choice in choices {
        let mut longer = Vec::new();
        for factors in &all {
            for power in &choice {
                let mut product = factors.clone();
                product.extend(power);
                longer.push(product);
            }
        }
        all = longer;
    }
    all
}

/// None of these numbers, or one of them to a power.
fn powers(numbers: impl IntoIterator<Item = usize>, most: u64) -> Vec<Option<Power>> {
    let mut all = vec![None];
    for known in numbers {
        for exponent in 1..=most {
            all.push(Some(Power { known, exponent }));
        }
    }
    all
}

/// The sign that is assumed of a number inside an absolute value.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Assumed {
    pub place: usize,
    pub is_negative: bool,
}

/// The signs inside absolute values, and the names of the axes.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Case {
    pub inner: Vec<Assumed>,
    pub axes: [usize; 3],
}

impl Case {
    /// A number's value at a point.
    pub fn value(&self, program: &Program, last: usize, point: &Point) -> u64 {
        let mut values = Vec::new();
        for operation in &program.operations[..=last] {
            values.push(self.result(operation, &values, point));
        }
        values[last]
    }

    fn result(&self, operation: &Operation, above: &[u64], point: &Point) -> u64 {
        match operation.parts() {
            ("input", _) => point.inputs[self.input(operation.value as usize)],
            ("number", _) => number(operation.value),
            ("add", &[a, b]) => plus(above[a], above[b]),
            ("sub", &[a, b]) => minus(above[a], above[b]),
            ("mul", &[a, b]) => times(above[a], above[b]),
            ("neg", &[a]) => negative(above[a]),
            ("abs", &[a]) if self.is_negative(a) => negative(above[a]),
            ("abs", &[a]) => above[a],
            // No number with a margin is made from it.
            _ => 0,
        }
    }

    /// The input in place of an input, under these names of the axes.
    fn input(&self, input: usize) -> usize {
        match input {
            0..15 => input / 3 * 3 + self.axes[input % 3],
            _ => input,
        }
    }

    /// True if a number is assumed to be negative.
    fn is_negative(&self, place: usize) -> bool {
        let negative = Assumed {
            place,
            is_negative: true,
        };
        self.inner.contains(&negative)
    }
}

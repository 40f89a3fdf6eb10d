//! Inputs modulo a prime, and the numbers there that a guarded kernel may be made from.

use super::program::{Operation, Program};
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

pub const PRIME: u64 = (1 << 61) - 1;
pub const POINTS: usize = 5;

pub fn times(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(PRIME)) as u64
}

pub fn minus(a: u64, b: u64) -> u64 {
    (a + (PRIME - b)) % PRIME
}

pub fn plus(a: u64, b: u64) -> u64 {
    (a + b) % PRIME
}

fn raised(x: u64, power: u64) -> u64 {
    (0..power).fold(1, |product, _| times(product, x))
}

/// The inverse, by Fermat.
pub fn inverse(mut x: u64) -> u64 {
    let (mut power, mut found) = (PRIME - 2, 1);
    while power > 0 {
        if power % 2 == 1 {
            found = times(found, x);
        }
        x = times(x, x);
        power /= 2;
    }
    found
}

type Vector = [u64; 3];

fn difference(p: Vector, q: Vector) -> Vector {
    from_fn(|i| minus(p[i], q[i]))
}

fn cross(p: Vector, q: Vector) -> Vector {
    from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        minus(times(p[j], q[k]), times(p[k], q[j]))
    })
}

fn dot(p: Vector, q: Vector) -> u64 {
    (0..3).fold(0, |sum, i| plus(sum, times(p[i], q[i])))
}

/// Inputs, and the known numbers there.
pub struct Point {
    inputs: [u64; 17],
    known: [u64; COUNT + 1],
}

impl Point {
    pub fn new(seed: u64) -> Point {
        let mut state = seed;
        let inputs: [u64; 17] = from_fn(|_| {
            // SplitMix64.
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let x = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            (x ^ (x >> 31)) % PRIME
        });
        let at = |i: usize| -> Vector { from_fn(|axis| inputs[i + axis]) };
        let [o, d, a, b, c] = [0, 3, 6, 9, 12].map(at);
        let [pa, pb, pc] = [a, b, c].map(|p| difference(p, o));
        let triple = |p, q| dot(d, cross(p, q));
        let (u, v, w) = (triple(pc, pb), triple(pa, pc), triple(pb, pa));
        let normal = cross(difference(b, a), difference(c, a));
        let (sum, t) = (plus(plus(u, v), w), dot(normal, pa));
        let determinant = minus(0, sum);
        let near = minus(t, times(inputs[15], determinant));
        let far = minus(times(inputs[16], determinant), t);
        let pairs = [plus(u, v), plus(v, w), plus(w, u)];
        let square = dot(normal, normal);
        let known = [
            &[u, v, w][..],
            &pairs,
            &[sum, t, near, far],
            &normal,
            &d,
            &[square],
        ]
        .concat();
        Point {
            inputs,
            known: known.try_into().expect("seventeen"),
        }
    }
}

/// A seed of points that depends on every operation, so that no program can be chosen for its points.
pub fn seed(program: &Program) -> u64 {
    let mix = |state: u64, word: u64| {
        let x = (state ^ word).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (x ^ (x >> 29))
            .wrapping_mul(0x94d0_49bb_1331_11eb)
            .rotate_left(31)
    };
    program.operations.iter().fold(
        0,
        |state,
         Operation {
             name,
             operands,
             value,
         }| {
            let name = name.bytes().map(u64::from);
            let operands = operands.iter().map(|place| *place as u64);
            name.chain(operands).chain([*value as u64]).fold(state, mix)
        },
    )
}

/// The most that a number's degree and the sum of its coefficients' sizes may be: two such polynomials that differ also differ modulo
/// the prime, and agree at a point with a chance below 2^-54.
const MOST_DEGREE: u64 = 64;
const MOST_COEFFICIENTS: u64 = 1 << 50;

/// True if a number is a polynomial within these bounds.
pub fn is_small(program: &Program, last: usize) -> bool {
    let mut all: Vec<Option<(u64, u64)>> = Vec::with_capacity(last + 1);
    for Operation {
        name,
        operands,
        value,
    } in &program.operations[..=last]
    {
        let of = |i: usize| -> Option<(u64, u64)> { all[operands[i]] };
        let both = || Some((of(0)?, of(1)?));
        let found = match *name {
            "input" => Some((1, 1)),
            "number" => Some((0, value.unsigned_abs())),
            "add" | "sub" => {
                both().and_then(|((p, a), (q, b))| Some((p.max(q), a.checked_add(b)?)))
            }
            "mul" => both().and_then(|((p, a), (q, b))| Some((p + q, a.checked_mul(b)?))),
            "neg" | "abs" => of(0),
            // No number with a margin is made from it.
            _ => Some((0, 0)),
        };
        all.push(found.filter(|(degree, sum)| *degree <= MOST_DEGREE && *sum <= MOST_COEFFICIENTS));
    }
    all[last].is_some()
}

/// Known numbers and their powers.
pub type Factors = [(usize, u64); 5];

pub fn product(factors: &Factors, point: &Point) -> u64 {
    let power = |(known, power): &(usize, u64)| raised(point.known[*known], *power);
    factors.iter().map(power).fold(1, times)
}

/// The products that a number may be, each by the ratio of its values at the first two points.
pub fn products(points: &[Point]) -> HashMap<u64, Vec<Factors>> {
    let mut all: HashMap<u64, Vec<Factors>> = HashMap::new();
    let mains = [(U, 0)]
        .into_iter()
        .chain((0..SUM).chain(T..N).map(|main| (main, 1)));
    for main in mains {
        for of_sum in 0..4 {
            for of_square in 0..3 {
                for normal in powers(N, 2) {
                    for along in powers(D, 4) {
                        let factors = [main, (SUM, of_sum), (SQUARE, of_square), normal, along];
                        let [first, second] = [0, 1].map(|i| product(&factors, &points[i]));
                        all.entry(times(second, inverse(first)))
                            .or_default()
                            .push(factors);
                    }
                }
            }
        }
    }
    all
}

/// One of three coordinates to a power, or none.
fn powers(first: usize, most: u64) -> impl Iterator<Item = (usize, u64)> {
    let all = (first..first + 3).flat_map(move |known| (1..=most).map(move |power| (known, power)));
    [(first, 0)].into_iter().chain(all)
}

/// A number's value at a point under other names of the axes.
pub fn value(
    program: &Program,
    last: usize,
    point: &Point,
    inner: &[(usize, bool)],
    axes: &[usize; 3],
) -> u64 {
    let mut values = Vec::with_capacity(last + 1);
    for Operation {
        name,
        operands,
        value,
    } in &program.operations[..=last]
    {
        let of = |i: usize| -> u64 { values[operands[i]] };
        values.push(match *name {
            "input" => match *value as usize {
                i @ 0..15 => point.inputs[i / 3 * 3 + axes[i % 3]],
                i => point.inputs[i],
            },
            "number" if *value < 0 => minus(0, value.unsigned_abs() % PRIME),
            "number" => value.unsigned_abs() % PRIME,
            "add" => plus(of(0), of(1)),
            "sub" => minus(of(0), of(1)),
            "mul" => times(of(0), of(1)),
            "neg" => minus(0, of(0)),
            "abs" => match inner.contains(&(operands[0], true)) {
                true => minus(0, of(0)),
                false => of(0),
            },
            // No number with a margin is made from it.
            _ => 0,
        });
    }
    values[last]
}

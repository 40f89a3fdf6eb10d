//! Cases at the thresholds of the oracle's layers: determinants no larger than the rounding errors of
//! the arithmetic that they meet, products that underflow beside factors that make up for it, products that
//! overflow though others outweigh them, and numbers at the last bit of a grid. A bound that is too small gives a
//! wrong sign on some of them.

use crate::arith::scale_by_power_of_two;
use crate::case::{Case, Draw};

type Doubles = [f64; 3];

/// Case `index` of a set.
pub(super) fn case(seed: u64, index: u64) -> Case<f64> {
    let mut draw = Draw::new("thresholds", seed, index);
    let case = match index % 16 {
        3 => overflowing(&mut draw),
        n if n % 4 == 0 => underflowing(&mut draw),
        n if n % 4 == 1 => last_bits(&mut draw),
        _ => {
            let (case, bits) = cancelling(&mut draw);
            scaled(&mut draw, &case, bits)
        }
    };
    let case = match draw.below(8) {
        0 => case.on(1.0, 4.0),
        1 => case.on(-1.0, 1.0),
        2 => case.on(0.0, 1.0),
        _ => case,
    };
    assert!(
        case.vectors().as_flattened().iter().all(|x| x.is_finite()),
        "{}",
        case.hex()
    );
    case
}

fn number(draw: &mut Draw, exponent: i64) -> f64 {
    draw.with_exponent(exponent as i32)
}

/// A case of whose determinants one has these rows (a point stands for its difference from a base), the
/// rest being random: one of the weights, T or D.
fn with_rows(
    draw: &mut Draw,
    [x, y, z]: [Doubles; 3],
    base: Doubles,
    other: [Doubles; 2],
) -> Case<f64> {
    let at = |v: Doubles| -> Doubles { [0, 1, 2].map(|i| base[i] + v[i]) };
    match draw.below(5) {
        0 => Case::new(base, x, [other[0], at(y), at(z)]),
        1 => Case::new(base, x, [at(z), other[0], at(y)]),
        2 => Case::new(base, x, [at(y), at(z), other[0]]),
        3 => Case::new(other[0], x, [base, at(y), at(z)]),
        _ => Case::new(base, other[1], [at(x), at(y), at(z)]),
    }
}

/// Three vectors on a grid of up to 53 bits, nearly in a plane (their determinant is about 2^-53), and
/// half the time two of them also nearly parallel (2^-106): then double-doubles cannot tell it either. And the bits.
fn cancelling(draw: &mut Draw) -> (Case<f64>, i32) {
    let bits = draw.pick(&[20, 29, 40, 50, 53]);
    let one = (1i64 << bits) as f64;
    let grid = |draw: &mut Draw| -> Doubles {
        draw.lattice_point((1i64 << bits) - 1)
            .map(|x| x as f64 / one)
    };
    let beside = |draw: &mut Draw, v: Doubles, units: i64| -> Doubles {
        let by = draw.lattice_point(units);
        [0, 1, 2].map(|i| ((v[i] * one).round() + by[i] as f64) / one)
    };
    let x = grid(draw);
    let y = match draw.coin() {
        true => {
            let multiple = draw.pick(&[1.0, -1.0, 0.5, -0.75]);
            beside(draw, x.map(|x| x * multiple), 4)
        }
        false => grid(draw),
    };
    let factor = |draw: &mut Draw| match draw.coin() {
        true => draw.pick(&[0.0, 0.5, -0.5, 1.0, -1.0]),
        false => draw.symmetric::<f64>() * 0.5,
    };
    let (s, t) = (factor(draw), factor(draw));
    let units = draw.pick(&[0, 1, 1, 3]);
    let z = beside(draw, [0, 1, 2].map(|i| s * x[i] + t * y[i]), units);
    let mut rows = [x, y, z];
    rows.rotate_left(draw.below(3));
    let base = if draw.coin() { [0.0; 3] } else { grid(draw) };
    let other = [grid(draw), grid(draw)];
    (with_rows(draw, rows, base, other), bits)
}

/// A case whose axes, and then its direction, are multiplied by powers of two, which keeps all signs:
/// to the ends of what the predicate of `robust` is used for, to where products of three coordinates
/// overflow or underflow, and each axis by itself, also such that the last of its bits is the smallest float,
/// with or without a point that lies far off along it. As it was if a number leaves the range.
fn scaled(draw: &mut Draw, case: &Case<f64>, bits: i32) -> Case<f64> {
    let uniform = |draw: &mut Draw, low, high| [draw.integer(low, high) as i32; 3];
    let mut by = match draw.below(6) {
        0 => [0; 3],
        1 => [0; 3].map(|_| draw.integer(-60, 60) as i32),
        2 => uniform(draw, -345, -190),
        3 => uniform(draw, 240, 342),
        4 => [0; 3].map(|_| draw.integer(-330, 330) as i32),
        _ => [0; 3].map(|_| draw.integer(-1000, 900) as i32),
    };
    let direction = draw.integer(-300, 300) as i32;
    let direction = draw.pick(&[0, 0, direction]);
    let smallest = (draw.below(12) == 0).then(|| draw.below(3));
    if let Some(axis) = smallest {
        by = by.map(|power| power.clamp(-330, 330));
        by[axis] = bits - 1074;
    }
    let [o, d, vertices @ ..] = case.vectors();
    let position = |v: Doubles| [0, 1, 2].map(|i| scale_by_power_of_two(v[i], by[i]));
    let d = position(d).map(|x| scale_by_power_of_two(x, direction));
    let mut points = [o, vertices[0], vertices[1], vertices[2]].map(position);
    if let Some(axis) = smallest.filter(|_| draw.coin()) {
        points[draw.below(4)][axis] = 1.0;
    }
    let [o, a, b, c] = points;
    let scaled = Case::new(o, d, [a, b, c]);
    let is_finite = scaled
        .vectors()
        .as_flattened()
        .iter()
        .all(|x| x.is_finite());
    if is_finite { scaled } else { *case }
}

/// A determinant f·(p×q) of which one component of p×q is lost to underflow while f is so large in it
/// that it decides the sign, against another component that is left.
fn underflowing(draw: &mut Draw) -> Case<f64> {
    let i = draw.below(3);
    let (j, k) = if draw.coin() {
        ((i + 1) % 3, (i + 2) % 3)
    } else {
        ((i + 2) % 3, (i + 1) % 3)
    };
    // Both products of the lost component lie about the smallest float.
    let lost = |draw: &mut Draw| -1076 + draw.integer(-2, 2);
    let (mut p, mut q, mut f) = ([0i64; 3], [0i64; 3], [0i64; 3]);
    (p[j], p[k]) = (draw.integer(-650, -430), draw.integer(-650, -430));
    (q[k], q[j]) = (lost(draw) - p[j], lost(draw) - p[k]);
    let left = draw.integer(-985, -860);
    (p[i], q[i]) = (left - q[k], left - p[k]);
    f[i] = draw.integer(0, 330);
    // The other components: anything from nothing to as much as the lost one.
    f[j] = f[i] - 1075 - left - draw.integer(-2, 90);
    f[k] = f[j] - draw.integer(0, 100);
    let none = draw.pick(&[None, Some(j), Some(k)]);
    let mut vector = |exponents: [i64; 3]| exponents.map(|e| number(draw, e.clamp(-1070, 1000)));
    let [p, q, mut f] = [p, q, f].map(&mut vector);
    if let Some(axis) = none {
        f[axis] = 0.0;
    }
    let other = [draw.point(), draw.point()];
    with_rows(draw, [f, p, q], [0.0; 3], other)
}

/// A determinant f·(p×q) of which one product of f and p×q is beyond the largest float, while the other two together
/// outweigh it: computed it is infinite and has the wrong sign.
fn overflowing(draw: &mut Draw) -> Case<f64> {
    let [p, q] = [0; 2].map(|_| [0; 3].map(|_| number(draw, 300)));
    let beyond = draw.below(3);
    let half = scale_by_power_of_two(draw.pick(&[1.0, -1.0]), 1023);
    let f = [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let share = if i == beyond {
            1.01 + 0.1 * draw.unit()
        } else {
            -0.6 - 0.3 * draw.unit()
        };
        half / (p[j] * q[k] - p[k] * q[j]) * (2.0 * share)
    });
    let other = [draw.point(), draw.point()];
    with_rows(draw, [f, p, q], [0.0; 3], other)
}

/// Integers about the largest that a small or a wide grid holds, times powers of two up to the ends of what
/// it takes, with one number now and then half a unit or one ulp off.
fn last_bits(draw: &mut Draw) -> Case<f64> {
    let bits = draw.pick(&[29, 30, 31, 60, 61, 62]);
    // One above the largest float of so many bits.
    let largest = (1i64 << bits) - (1i64 << bits >> f64::MANTISSA_DIGITS).max(1) + 1;
    let [position, direction] = [0; 2].map(|_| match draw.below(4) {
        0 => draw.integer(-1074, -960),
        1 => 1023 - bits - draw.integer(0, 37),
        2 => draw.integer(-30, 30),
        _ => 0,
    });
    let kind = draw.below(3);
    let coordinate = |draw: &mut Draw| match kind {
        0 => draw.pick(&[largest - 1, 1 - largest]),
        1 => draw.pick(&[largest - 1, 1 - largest, largest, largest - 2, 0, 1]),
        _ => draw.integer(1 - largest, largest - 1),
    };
    let mut vectors: [[i64; 3]; 5] = [[0; 3]; 5].map(|v| v.map(|_| coordinate(draw)));
    match draw.below(4) {
        // In the plane, and on it.
        0 => vectors[1] = [0, 1, 2].map(|i| (vectors[2][i] - vectors[3][i]) / 2),
        1 => vectors[4] = [0, 1, 2].map(|i| vectors[2][i] / 2 + vectors[3][i] / 2),
        // The origin and two vertices on a line, whose direction has the last bit beside the first.
        2 => {
            let half = 1i64 << (bits - 1);
            let mut step = [0; 3].map(|_| draw.pick(&[half, -half]));
            step[draw.below(3)] = draw.pick(&[1, -1]);
            let mut on_line = || {
                let steps = draw.integer(0, 3);
                step.map(|x| steps * x - (x + x / 2))
            };
            vectors[0] = on_line();
            (vectors[2], vectors[3]) = (on_line(), on_line());
            vectors[1] = step;
            vectors[2..].rotate_left(draw.below(3));
        }
        _ => {}
    }
    let off = draw.below(30);
    let mut at = 0;
    let mut float = |v: [i64; 3], exponent: i64| {
        v.map(|x| {
            at += 1;
            let x = if at == off { x as f64 + 0.5 } else { x as f64 };
            scale_by_power_of_two(x, exponent as i32)
        })
    };
    let exponents = [position, direction, position, position, position];
    let [o, d, a, b, c] = std::array::from_fn(|i| float(vectors[i], exponents[i]));
    Case::new(o, d, [a, b, c])
}

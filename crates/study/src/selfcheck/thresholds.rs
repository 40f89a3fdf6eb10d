//! Cases at the thresholds of the oracle's layers: determinants no larger than the rounding errors of
//! the arithmetic that they meet, products that underflow beside factors that make up for it, products that
//! overflow though others outweigh them, and numbers at the last bit of a grid. A bound that is too small gives a
//! wrong sign on some of them.

use crate::arith::scale_by_power_of_two;
use crate::case::{Case, Draw};
use glam::I64Vec3;

type Doubles = [f64; 3];

/// Case `index` of a set.
pub(super) fn case(seed: u64, index: u64) -> Case<f64> {
    let mut draw = Draw::new("thresholds", seed, index);
    let unlimited = match index % 16 {
        0 | 4 | 8 | 12 => underflowing(&mut draw),
        1 | 5 | 9 | 13 => last_bits(&mut draw),
        3 => overflowing(&mut draw),
        _ => {
            let bits = draw.pick(&[20, 29, 40, 50, 53]);
            let case = cancelling(&mut draw, bits);
            scaled(&mut draw, &case, bits)
        }
    };
    let case = match draw.below(8) {
        0 => unlimited.on(1.0, 4.0),
        1 => unlimited.on(-1.0, 1.0),
        2 => unlimited.on(0.0, 1.0),
        _ => unlimited,
    };
    assert!(is_finite(&case), "{}", case.hex());
    case
}

fn is_finite(case: &Case<f64>) -> bool {
    let vectors = case.vectors();
    vectors.as_flattened().iter().all(|x| x.is_finite())
}

/// The axes after one, in turn.
fn next_axes(axis: usize) -> [usize; 2] {
    [(axis + 1) % 3, (axis + 2) % 3]
}

/// A case with these rows in one of its determinants: one of the weights, T or D. A row is a direction, or the difference of
/// a point from a base; the other vectors are the numbers of the case that are not in that determinant.
fn with_rows(
    draw: &mut Draw,
    rows: [Doubles; 3],
    base: Doubles,
    [other, other_direction]: [Doubles; 2],
) -> Case<f64> {
    let [x, ..] = rows;
    let [at_x, at_y, at_z] = rows.map(|row| [0, 1, 2].map(|axis| base[axis] + row[axis]));
    match draw.below(5) {
        0 => Case::new(base, x, [other, at_y, at_z]),
        1 => Case::new(base, x, [at_z, other, at_y]),
        2 => Case::new(base, x, [at_y, at_z, other]),
        3 => Case::new(other, x, [base, at_y, at_z]),
        _ => Case::new(base, other_direction, [at_x, at_y, at_z]),
    }
}

/// The numbers of a grid: the multiples of 2 to a power below 1.
struct Grid {
    /// How many there are from 0 to 1.
    steps: i64,
}

impl Grid {
    fn point(&self, draw: &mut Draw) -> Doubles {
        let counts = draw.lattice_point(self.steps - 1);
        counts.map(|count| count as f64 / self.steps as f64)
    }

    /// A point of the grid some units beside another point in each axis.
    fn beside(&self, draw: &mut Draw, point: Doubles, units: i64) -> Doubles {
        let steps = self.steps as f64;
        let offset = draw.lattice_point(units);
        [0, 1, 2].map(|axis| {
            let nearest = (point[axis] * steps).round();
            (nearest + offset[axis] as f64) / steps
        })
    }
}

/// Three vectors on a grid of up to 53 bits, nearly in a plane (their determinant is about 2^-53), and
/// half the time two of them also nearly parallel (2^-106): then double-doubles cannot tell it either.
fn cancelling(draw: &mut Draw, bits: i32) -> Case<f64> {
    let grid = Grid { steps: 1 << bits };
    let x = grid.point(draw);
    let y = if draw.coin() {
        let factor = draw.pick(&[1.0, -1.0, 0.5, -0.75]);
        let parallel = x.map(|x| x * factor);
        grid.beside(draw, parallel, 4)
    } else {
        grid.point(draw)
    };
    let s = share(draw);
    let t = share(draw);
    let units = draw.pick(&[0, 1, 1, 3]);
    let in_plane = [0, 1, 2].map(|axis| s * x[axis] + t * y[axis]);
    let z = grid.beside(draw, in_plane, units);
    let mut rows = [x, y, z];
    rows.rotate_left(draw.below(3));
    let base = if draw.coin() {
        [0.0; 3]
    } else {
        grid.point(draw)
    };
    let others = [grid.point(draw), grid.point(draw)];
    with_rows(draw, rows, base, others)
}

/// How much of a vector a sum has.
fn share(draw: &mut Draw) -> f64 {
    if draw.coin() {
        draw.pick(&[0.0, 0.5, -0.5, 1.0, -1.0])
    } else {
        draw.symmetric::<f64>() * 0.5
    }
}

/// A case whose axes, and then its direction, are multiplied by powers of two, which keeps all signs:
/// to the ends of what the predicate of `robust` is used for, to where products of three coordinates
/// overflow or underflow, and each axis by itself, also such that the last of its bits is the smallest float,
/// with or without a point that lies far off along it. If a number leaves the range, the case stays as it is.
fn scaled(draw: &mut Draw, case: &Case<f64>, bits: i32) -> Case<f64> {
    let drawn_powers = axis_powers(draw);
    let drawn_power = draw.integer(-300, 300) as i32;
    let direction_power = draw.pick(&[0, 0, drawn_power]);
    let has_smallest = draw.below(12) == 0;
    let smallest = has_smallest.then(|| draw.below(3));
    let powers = match smallest {
        Some(axis) => with_last_bit_at_the_smallest(drawn_powers, axis, bits),
        None => drawn_powers,
    };
    let mut vectors = case.vectors();
    for vector in &mut vectors {
        for (x, power) in vector.iter_mut().zip(powers) {
            *x = scale_by_power_of_two(*x, power);
        }
    }
    if let Some(axis) = smallest
        && draw.coin()
    {
        let far_off = draw.pick(&[0, 2, 3, 4]);
        vectors[far_off][axis] = 1.0;
    }
    let [origin, direction, a, b, c] = vectors;
    let direction = direction.map(|x| scale_by_power_of_two(x, direction_power));
    let scaled = Case::new(origin, direction, [a, b, c]);
    if is_finite(&scaled) { scaled } else { *case }
}

/// Powers of two for the axes: none, or all of one size, or each by itself.
fn axis_powers(draw: &mut Draw) -> [i32; 3] {
    match draw.below(6) {
        0 => [0; 3],
        1 => each_from(draw, -60, 60),
        2 => [draw.integer(-345, -190) as i32; 3],
        3 => [draw.integer(240, 342) as i32; 3],
        4 => each_from(draw, -330, 330),
        _ => each_from(draw, -1000, 900),
    }
}

fn each_from(draw: &mut Draw, low: i64, high: i64) -> [i32; 3] {
    [(); 3].map(|()| draw.integer(low, high) as i32)
}

/// Powers that make the last of some bits the smallest float in one axis, with moderate ones in the others.
fn with_last_bit_at_the_smallest(powers: [i32; 3], axis: usize, bits: i32) -> [i32; 3] {
    let mut moderate = powers.map(|power| power.clamp(-330, 330));
    moderate[axis] = bits - 1074;
    moderate
}

/// A determinant f·(p×q) of which one component of p×q is lost to underflow while f is so large in it
/// that it decides the sign, against another component that is left.
fn underflowing(draw: &mut Draw) -> Case<f64> {
    let i = draw.below(3);
    let [mut j, mut k] = next_axes(i);
    if !draw.coin() {
        (j, k) = (k, j);
    }
    let mut p = [0; 3];
    let mut q = [0; 3];
    let mut f = [0; 3];
    p[j] = draw.integer(-650, -430);
    p[k] = draw.integer(-650, -430);
    // Both products of the lost component lie about the smallest float.
    q[k] = about_the_smallest(draw) - p[j];
    q[j] = about_the_smallest(draw) - p[k];
    let left = draw.integer(-985, -860);
    p[i] = left - q[k];
    q[i] = left - p[k];
    f[i] = draw.integer(0, 330);
    // The other components: anything from nothing to as much as the lost one.
    f[j] = f[i] - 1075 - left - draw.integer(-2, 90);
    f[k] = f[j] - draw.integer(0, 100);
    let nothing = draw.pick(&[None, Some(j), Some(k)]);
    let [p, q, mut f] = [p, q, f].map(|exponents| with_exponents(draw, exponents));
    if let Some(axis) = nothing {
        f[axis] = 0.0;
    }
    let others = [draw.point(), draw.point()];
    with_rows(draw, [f, p, q], [0.0; 3], others)
}

/// The exponent of a product that underflows, or just does not.
fn about_the_smallest(draw: &mut Draw) -> i64 {
    -1076 + draw.integer(-2, 2)
}

fn with_exponents(draw: &mut Draw, exponents: [i64; 3]) -> Doubles {
    exponents.map(|exponent| draw.with_exponent(exponent.clamp(-1070, 1000) as i32))
}

/// A determinant f·(p×q) of which one product of f and p×q is beyond the largest float, while the other two together
/// outweigh it: computed it is infinite and has the wrong sign.
fn overflowing(draw: &mut Draw) -> Case<f64> {
    let p = with_exponents(draw, [300; 3]);
    let q = with_exponents(draw, [300; 3]);
    let beyond = draw.below(3);
    let half = scale_by_power_of_two(draw.pick(&[1.0, -1.0]), 1023);
    let mut f = [0.0; 3];
    for (i, x) in f.iter_mut().enumerate() {
        let [j, k] = next_axes(i);
        let component = p[j] * q[k] - p[k] * q[j];
        // The product as a share of the largest float.
        let share = if i == beyond {
            1.01 + 0.1 * draw.unit()
        } else {
            -0.6 - 0.3 * draw.unit()
        };
        *x = half / component * (2.0 * share);
    }
    let others = [draw.point(), draw.point()];
    with_rows(draw, [f, p, q], [0.0; 3], others)
}

/// Integers about the largest that a small or a wide grid holds, times powers of two up to the ends of what
/// it takes, with one number now and then half a unit or one ulp off.
fn last_bits(draw: &mut Draw) -> Case<f64> {
    let bits = draw.pick(&[29, 30, 31, 60, 61, 62]);
    let largest = above_the_largest(bits);
    let position_exponent = grid_exponent(draw, bits);
    let direction_exponent = grid_exponent(draw, bits);
    let kind = draw.below(3);
    let [mut o, mut d, mut a, mut b, mut c] = [(); 5].map(|()| {
        let point = [(); 3].map(|()| near_the_largest(draw, largest, kind));
        I64Vec3::from(point)
    });
    match draw.below(4) {
        // A direction in the plane, and a triangle without area.
        0 => d = (a - b) / 2,
        1 => c = a / 2 + b / 2,
        2 => {
            // The direction has the last bit next to the first.
            d = first_and_last_bit(draw, bits);
            [o, a, b] = [(); 3].map(|()| on_a_line(draw, d));
            let mut vertices = [a, b, c];
            vertices.rotate_left(draw.below(3));
            [a, b, c] = vertices;
        }
        _ => {}
    }
    // The number that is half a unit off, counted from 1; beyond 15 none is.
    let off = draw.below(30);
    let mut floats = [[0.0; 3]; 5];
    for (i, vector) in [o, d, a, b, c].into_iter().enumerate() {
        let exponent = match i {
            1 => direction_exponent,
            _ => position_exponent,
        };
        for axis in 0..3 {
            let mut units = vector[axis] as f64;
            if 3 * i + axis + 1 == off {
                units += 0.5;
            }
            floats[i][axis] = scale_by_power_of_two(units, exponent);
        }
    }
    let [o, d, a, b, c] = floats;
    Case::new(o, d, [a, b, c])
}

/// An integer below the largest, of one of three kinds: at an end, about an end or zero, anywhere.
fn near_the_largest(draw: &mut Draw, largest: i64, kind: usize) -> i64 {
    let last = largest - 1;
    match kind {
        0 => draw.pick(&[last, -last]),
        1 => draw.pick(&[last, -last, largest, largest - 2, 0, 1]),
        _ => draw.integer(-last, last),
    }
}

/// One above the largest float of so many bits.
fn above_the_largest(bits: i64) -> i64 {
    let power = 1i64 << bits;
    let last_place = (power >> f64::MANTISSA_DIGITS).max(1);
    power - last_place + 1
}

/// The exponent of a grid of so many bits, often at an end of what floats take.
fn grid_exponent(draw: &mut Draw, bits: i64) -> i32 {
    let exponent = match draw.below(4) {
        0 => draw.integer(-1074, -960),
        1 => 1023 - bits - draw.integer(0, 37),
        2 => draw.integer(-30, 30),
        _ => 0,
    };
    exponent as i32
}

/// A vector of which two coordinates have the first of some bits, and one has the last.
fn first_and_last_bit(draw: &mut Draw, bits: i64) -> I64Vec3 {
    let half = 1i64 << (bits - 1);
    let mut vector = I64Vec3::from([(); 3].map(|()| draw.pick(&[half, -half])));
    vector[draw.below(3)] = draw.pick(&[1, -1]);
    vector
}

/// A point on a line of integers about zero.
fn on_a_line(draw: &mut Draw, step: I64Vec3) -> I64Vec3 {
    let steps = draw.integer(0, 3);
    step * steps - (step + step / 2)
}

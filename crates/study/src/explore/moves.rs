//! Random moves on cases: mutations that stay near the places where kernels break, each from its own
//! stream of numbers.
//!
//! A move changes a number by a few ulps or a power of two, makes coordinates coincide, or puts the
//! ray and the triangle into a special position: through a vertex, along an edge, in the plane. A move
//! may round, because its result is a case in its own right.

use crate::arith::{Float, Vector, scale_by_power_of_two};
use crate::case::{Case, Draw};

/// The vectors of a case by index: origin, direction, a, b, c.
const ORIGIN: usize = 0;
const DIRECTION: usize = 1;
const POINTS: [usize; 4] = [0, 2, 3, 4];
const VERTICES: [usize; 3] = [2, 3, 4];

/// A case taken apart.
struct CaseParts<F> {
    vectors: [[F; 3]; 5],
    interval: [F; 2],
}

type Move<F> = fn(&mut CaseParts<F>, &mut Draw);

/// A case some moves away: mostly one, rarely more than three. The same draw gives the same case.
pub fn mutate<F: Float>(case: &Case<F>, draw: &mut Draw) -> Case<F> {
    let moves: [Move<F>; 16] = [
        nudge,
        nudge,
        change_exponent,
        flip_bit,
        to_lattice,
        copy_coordinate,
        zero_or_negate,
        slide_origin,
        aim,
        put_origin_on_the_triangle,
        |parts, draw| scale(parts, draw, &POINTS),
        |parts, draw| scale(parts, draw, &[DIRECTION]),
        shift_points,
        swap_vertices,
        flatten,
        change_interval,
    ];
    let mut parts = CaseParts {
        vectors: case.vectors(),
        interval: [case.ray.t_min, case.ray.t_max],
    };
    for _ in 0..=draw.bits().trailing_zeros().min(3) {
        draw.pick(&moves)(&mut parts, draw);
    }
    let [origin, direction, a, b, c] = parts.vectors;
    let [t_min, t_max] = parts.interval;
    Case::new(origin, direction, [a, b, c]).on(t_min, t_max)
}

impl<F: Float> CaseParts<F> {
    /// One of the fifteen coordinates.
    fn any(&mut self, draw: &mut Draw) -> &mut F {
        &mut self.vectors[draw.below(5)][draw.below(3)]
    }

    fn point(&self, i: usize) -> F::Vector {
        self.vectors[i].into()
    }

    /// A vertex, a point of an edge, or a point of the plane of the triangle, as it rounds.
    fn point_of_triangle(&self, draw: &mut Draw) -> F::Vector {
        let [p, q, r] = VERTICES.map(|i| self.point(i));
        let share = |draw: &mut Draw| {
            // Small denominators come out exact where the coordinates are short.
            let exact = F::from_f64(draw.integer(-2, 10) as f64 / 8.0);
            if draw.coin() {
                exact
            } else {
                F::from_f64(draw.unit())
            }
        };
        let [p, q, r] = draw.pick(&[[p, q, r], [q, r, p], [r, p, q]]);
        match draw.below(3) {
            0 => p,
            1 => p.plus(&q.minus(&p).times(&share(draw))),
            _ => {
                let along = p.plus(&q.minus(&p).times(&share(draw)));
                along.plus(&r.minus(&p).times(&share(draw)))
            }
        }
    }
}

/// 2 to a power, as a number of the scalar.
fn power<F: Float>(exponent: i64) -> F {
    F::from_f64(scale_by_power_of_two(1.0, exponent as i32))
}

/// One coordinate by a few ulps.
fn nudge<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let most = draw.pick(&[1, 1, 4, 16, 1000]);
    let ulps = draw.integer(1, most) * if draw.coin() { 1 } else { -1 };
    let x = parts.any(draw);
    *x = x.offset_ulps(ulps);
}

/// One coordinate by a power of two, mostly a small one.
fn change_exponent<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let most = draw.pick(&[1, 2, 8, 40]);
    let factor = power::<F>(draw.integer(-most, most));
    let x = parts.any(draw);
    *x = *x * factor;
}

/// One bit of a significand.
fn flip_bit<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let bit = draw.below(F::DIGITS as usize - 1);
    let x = parts.any(draw);
    *x = F::from_bits(x.to_bits() ^ 1 << bit);
}

/// One coordinate, or all, to fewer bits: rounded to a multiple of a power of two near their size.
fn to_lattice<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    // Places count in bits: clearing the low ones of a place rounds the significand.
    let step = 1i64 << (i64::from(F::DIGITS) - 1 - draw.integer(0, 6));
    let rounded = |x: F| {
        // The places of some NaNs have no sum with half a step.
        if !x.is_finite() {
            return x;
        }
        let place = x.place();
        let magnitude = (place.abs() + step / 2) / step * step;
        F::from_place(magnitude * place.signum())
    };
    if draw.below(4) == 0 {
        parts.vectors = parts.vectors.map(|vector| vector.map(rounded));
    } else {
        let x = parts.any(draw);
        *x = rounded(*x);
    }
}

/// A coordinate of one point becomes that of another, or one of its neighbours.
fn copy_coordinate<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let (from, to, axis) = (draw.pick(&POINTS), draw.pick(&POINTS), draw.below(3));
    let ulps = draw.pick(&[0, 0, 1, -1]);
    parts.vectors[to][axis] = parts.vectors[from][axis].offset_ulps(ulps);
}

fn zero_or_negate<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let zero = draw.coin();
    let x = parts.any(draw);
    *x = if zero { F::zero() } else { -*x };
}

/// The origin along the ray.
fn slide_origin<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let by: F = draw.symmetric::<F>() * power::<F>(draw.integer(-8, 12));
    let direction = parts.point(DIRECTION);
    parts.vectors[ORIGIN] = parts.point(ORIGIN).plus(&direction.times(&by)).into();
}

/// The direction from the origin to a point of the triangle's plane.
fn aim<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let target = parts.point_of_triangle(draw);
    let factor = power::<F>(draw.pick(&[0, 0, 1, -1, 6, -6]));
    parts.vectors[DIRECTION] = target.minus(&parts.point(ORIGIN)).times(&factor).into();
}

fn put_origin_on_the_triangle<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    parts.vectors[ORIGIN] = parts.point_of_triangle(draw).into();
}

/// Some vectors by one power of two.
fn scale<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw, vectors: &[usize]) {
    let most = draw.pick(&[1, 4, 30]);
    let factor = power::<F>(draw.integer(-most, most));
    for i in vectors {
        parts.vectors[*i] = parts.vectors[*i].map(|x| x * factor);
    }
}

/// All points by one offset, which is a coordinate of one of them or any number of their size.
fn shift_points<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let axis = draw.below(3);
    let size = parts.vectors[draw.pick(&POINTS)][axis];
    let by = if draw.coin() {
        -size
    } else {
        size * draw.symmetric::<F>() * power::<F>(draw.integer(0, 6))
    };
    for i in POINTS {
        parts.vectors[i][axis] = parts.vectors[i][axis] + by;
    }
}

fn swap_vertices<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let (i, j) = (draw.pick(&VERTICES), draw.pick(&VERTICES));
    parts.vectors.swap(i, j);
}

/// A vertex towards the others: near another vertex, or near their line.
fn flatten<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let (moved, target) = (draw.pick(&VERTICES), parts.point_of_triangle(draw));
    let keep = power::<F>(-draw.integer(1, 12));
    let offset = parts.point(moved).minus(&target);
    parts.vectors[moved] = target.plus(&offset.times(&keep)).into();
}

/// An end of the interval: the default one, near where the line crosses the plane, or any.
fn change_interval<F: Float>(parts: &mut CaseParts<F>, draw: &mut Draw) {
    let [a, b, c] = VERTICES.map(|i| parts.point(i));
    let normal = b.minus(&a).cross(&c.minus(&a));
    let t = normal.dot(&a.minus(&parts.point(ORIGIN))) / normal.dot(&parts.point(DIRECTION));
    let end = draw.below(2);
    parts.interval[end] = match draw.below(4) {
        0 => [F::zero(), F::infinity()][end],
        1 => draw.symmetric(),
        _ if t.to_f64().is_finite() => t.offset_ulps(draw.integer(-3, 3)),
        _ => parts.interval[end],
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    fn mutants<F: Float>(seed: u64) -> Vec<[u64; 17]> {
        let [zero, one, three] = [0.0, 1.0, 3.0].map(F::from_f64);
        let case = Case::new(
            [one, one, three],
            [zero, zero, -one],
            [[zero, zero, one], [three, zero, one], [zero, three, one]],
        );
        (0..2000)
            .map(|i| mutate(&case, &mut Draw::new("moves", seed, i)).bits())
            .collect()
    }

    #[test]
    fn the_same_seed_gives_the_same_cases_and_another_gives_others() {
        assert_eq!(mutants::<f32>(1), mutants::<f32>(1));
        assert_ne!(mutants::<f64>(1), mutants::<f64>(2));
    }

    #[test]
    fn any_numbers_can_be_moved() {
        fn mutants<F: Float>() {
            let mut draw = Draw::new("any-numbers", 1, 0);
            let odd = [u64::MAX, u64::MAX >> 1, 1, 0, F::infinity().to_bits()].map(F::from_bits);
            for _ in 0..5000 {
                let mut vector = || [(); 3].map(|()| draw.pick(&odd));
                let case = Case::new(vector(), vector(), [vector(), vector(), vector()]);
                mutate(&case, &mut draw);
            }
        }
        mutants::<f32>();
        mutants::<f64>();
    }

    #[test]
    fn every_number_of_a_case_can_change() {
        for all in [mutants::<f32>(1), mutants::<f64>(1)] {
            for number in 0..17 {
                let distinct: HashSet<u64> = all.iter().map(|bits| bits[number]).collect();
                assert!(
                    distinct.len() > 20,
                    "number {number} takes {} values",
                    distinct.len()
                );
            }
        }
    }
}

//! Random moves on cases: mutations that stay near the places where kernels break, each from its own
//! stream of numbers.
//!
//! A move changes a number by a few ulps or a power of two, makes coordinates coincide, or puts the
//! ray and the triangle into a special position: through a vertex, along an edge, in the plane. A move
//! may round, because its result is a case in its own right.

use crate::arith::{Float, Vector, scale_by_power_of_two};
use crate::case::{Case, Draw};
use crate::family::integer::turned;

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
        CaseParts::nudge,
        CaseParts::nudge,
        CaseParts::change_exponent,
        CaseParts::flip_bit,
        CaseParts::round_to_lattice,
        CaseParts::copy_coordinate,
        CaseParts::zero_or_negate,
        CaseParts::slide_origin,
        CaseParts::aim,
        CaseParts::put_origin_on_the_triangle,
        CaseParts::scale_points,
        CaseParts::scale_direction,
        CaseParts::shift_points,
        CaseParts::swap_vertices,
        CaseParts::flatten,
        CaseParts::change_interval,
    ];
    let mut parts = CaseParts {
        vectors: case.vectors(),
        interval: [case.ray.t_min, case.ray.t_max],
    };
    let more_moves = draw.bits().trailing_zeros().min(3);
    for _ in 0..=more_moves {
        let make_move = draw.pick(&moves);
        make_move(&mut parts, draw);
    }
    let [origin, direction, a, b, c] = parts.vectors;
    let [t_min, t_max] = parts.interval;
    Case::new(origin, direction, [a, b, c]).on(t_min, t_max)
}

/// The points and numbers that moves begin with.
impl<F: Float> CaseParts<F> {
    /// One of the fifteen coordinates.
    fn any(&mut self, draw: &mut Draw) -> &mut F {
        let vector = draw.below(5);
        let axis = draw.below(3);
        &mut self.vectors[vector][axis]
    }

    fn point(&self, i: usize) -> F::Vector {
        self.vectors[i].into()
    }

    /// A vertex, a point of an edge, or a point of the plane of the triangle, as it rounds.
    fn point_of_triangle(&self, draw: &mut Draw) -> F::Vector {
        let [a, b, c] = VERTICES.map(|i| self.point(i));
        let [p, q, r] = turned(draw, [a, b, c]);
        let dimension = draw.below(3);
        if dimension == 0 {
            return p;
        }
        let to_q = q.minus(&p);
        let on_edge = p.plus(&to_q.times(&share(draw)));
        if dimension == 1 {
            return on_edge;
        }
        let to_r = r.minus(&p);
        on_edge.plus(&to_r.times(&share(draw)))
    }
}

/// How far along an edge a point lies, mostly between its ends.
fn share<F: Float>(draw: &mut Draw) -> F {
    // Small denominators come out exact where the coordinates are short.
    let eighths = draw.integer(-2, 10);
    let share = if draw.coin() {
        eighths as f64 / 8.0
    } else {
        draw.unit()
    };
    F::from_f64(share)
}

/// 2 to a power, as a number of the scalar.
fn power<F: Float>(exponent: i64) -> F {
    F::from_f64(scale_by_power_of_two(1.0, exponent as i32))
}

/// A number with all but some leading bits rounded away: to a multiple of `step` in places.
fn rounded<F: Float>(x: F, step: i64) -> F {
    // The places of some NaNs have no sum with half a step.
    if !x.is_finite() {
        return x;
    }
    let place = x.place();
    let steps = (place.abs() + step / 2) / step;
    F::from_place(steps * step * place.signum())
}

/// The moves.
impl<F: Float> CaseParts<F> {
    /// One coordinate by a few ulps.
    fn nudge(&mut self, draw: &mut Draw) {
        let most = draw.pick(&[1, 1, 4, 16, 1000]);
        let ulps = draw.integer(1, most);
        let is_up = draw.coin();
        let x = self.any(draw);
        *x = x.offset_ulps(if is_up { ulps } else { -ulps });
    }

    /// One coordinate by a power of two, mostly a small one.
    fn change_exponent(&mut self, draw: &mut Draw) {
        let most = draw.pick(&[1, 2, 8, 40]);
        let factor = power::<F>(draw.integer(-most, most));
        let x = self.any(draw);
        *x = *x * factor;
    }

    /// One bit of a significand.
    fn flip_bit(&mut self, draw: &mut Draw) {
        let bit = draw.below(F::DIGITS as usize - 1);
        let x = self.any(draw);
        *x = F::from_bits(x.to_bits() ^ 1 << bit);
    }

    /// One coordinate, or all, to fewer bits: rounded to a multiple of a power of two near their size.
    fn round_to_lattice(&mut self, draw: &mut Draw) {
        // Places count in bits: clearing the low ones of a place rounds the significand.
        let kept_bits = draw.integer(0, 6);
        let step = 1i64 << (i64::from(F::DIGITS) - 1 - kept_bits);
        let rounds_all = draw.below(4) == 0;
        if rounds_all {
            for x in self.vectors.as_flattened_mut() {
                *x = rounded(*x, step);
            }
        } else {
            let x = self.any(draw);
            *x = rounded(*x, step);
        }
    }

    /// A coordinate of one point becomes that of another, or one of its neighbours.
    fn copy_coordinate(&mut self, draw: &mut Draw) {
        let from = draw.pick(&POINTS);
        let to = draw.pick(&POINTS);
        let axis = draw.below(3);
        let ulps = draw.pick(&[0, 0, 1, -1]);
        let copied = self.vectors[from][axis];
        self.vectors[to][axis] = copied.offset_ulps(ulps);
    }

    fn zero_or_negate(&mut self, draw: &mut Draw) {
        let becomes_zero = draw.coin();
        let x = self.any(draw);
        *x = if becomes_zero { F::zero() } else { -*x };
    }

    /// The origin along the ray.
    fn slide_origin(&mut self, draw: &mut Draw) {
        let share: F = draw.symmetric();
        let by = share * power::<F>(draw.integer(-8, 12));
        let way = self.point(DIRECTION).times(&by);
        let origin = self.point(ORIGIN);
        self.vectors[ORIGIN] = origin.plus(&way).into();
    }

    /// The direction from the origin to a point of the triangle's plane.
    fn aim(&mut self, draw: &mut Draw) {
        let target = self.point_of_triangle(draw);
        let factor = power::<F>(draw.pick(&[0, 0, 1, -1, 6, -6]));
        let way = target.minus(&self.point(ORIGIN));
        self.vectors[DIRECTION] = way.times(&factor).into();
    }

    fn put_origin_on_the_triangle(&mut self, draw: &mut Draw) {
        self.vectors[ORIGIN] = self.point_of_triangle(draw).into();
    }

    fn scale_points(&mut self, draw: &mut Draw) {
        self.scale(draw, &POINTS);
    }

    fn scale_direction(&mut self, draw: &mut Draw) {
        self.scale(draw, &[DIRECTION]);
    }

    /// Some vectors by one power of two.
    fn scale(&mut self, draw: &mut Draw, vectors: &[usize]) {
        let most = draw.pick(&[1, 4, 30]);
        let factor = power::<F>(draw.integer(-most, most));
        for i in vectors {
            for x in &mut self.vectors[*i] {
                *x = *x * factor;
            }
        }
    }

    /// All points by one offset, which is a coordinate of one of them or any number of their size.
    fn shift_points(&mut self, draw: &mut Draw) {
        let axis = draw.below(3);
        let size = self.vectors[draw.pick(&POINTS)][axis];
        let offset = if draw.coin() {
            -size
        } else {
            let share: F = draw.symmetric();
            size * share * power::<F>(draw.integer(0, 6))
        };
        for i in POINTS {
            let x = &mut self.vectors[i][axis];
            *x = *x + offset;
        }
    }

    fn swap_vertices(&mut self, draw: &mut Draw) {
        let one = draw.pick(&VERTICES);
        let other = draw.pick(&VERTICES);
        self.vectors.swap(one, other);
    }

    /// A vertex towards the others: near another vertex, or near their line.
    fn flatten(&mut self, draw: &mut Draw) {
        let moved = draw.pick(&VERTICES);
        let target = self.point_of_triangle(draw);
        let kept_share = power::<F>(-draw.integer(1, 12));
        let offset = self.point(moved).minus(&target);
        let kept = offset.times(&kept_share);
        self.vectors[moved] = target.plus(&kept).into();
    }

    /// An end of the interval: the default one, near where the line crosses the plane, or any.
    fn change_interval(&mut self, draw: &mut Draw) {
        let defaults = [F::zero(), F::infinity()];
        let end = draw.below(2);
        let kind = draw.below(4);
        self.interval[end] = match kind {
            0 => defaults[end],
            1 => draw.symmetric(),
            _ => {
                let t = self.t_at_plane();
                if !t.to_f64().is_finite() {
                    return;
                }
                t.offset_ulps(draw.integer(-3, 3))
            }
        };
    }

    /// The parameter at which the line of the ray crosses the plane, as it rounds.
    fn t_at_plane(&self) -> F {
        let [a, b, c] = VERTICES.map(|i| self.point(i));
        let normal = b.minus(&a).cross(&c.minus(&a));
        let from_origin = a.minus(&self.point(ORIGIN));
        let along_direction = normal.dot(&self.point(DIRECTION));
        normal.dot(&from_origin) / along_direction
    }
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

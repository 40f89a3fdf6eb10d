//! A third reference for the truth, which shares no formula with the other two: it tries every t that could be an end of
//! what the line and the box have in common, in integers; and cases that are hard to decide.

use hairline_boxes::{BoxCase, Class, FAMILIES, FamilyScalar, Meeting, Origin, Overlap, Truth};
use hairline_core::arith::decompose;
use hairline_core::case::Draw;
use num_bigint::BigInt;
use std::cmp::Ordering;

/// `above / below`, with `below` positive.
#[derive(Clone, Debug)]
struct Time {
    above: BigInt,
    below: BigInt,
}

impl Time {
    fn of(above: BigInt, below: BigInt) -> Time {
        if below < BigInt::ZERO {
            return Time {
                above: -above,
                below: -below,
            };
        }
        Time { above, below }
    }

    fn cmp(&self, other: &Time) -> Ordering {
        (&self.above * &other.below).cmp(&(&other.above * &self.below))
    }
}

struct Space {
    /// Origin, direction, min and max.
    vectors: [[BigInt; 3]; 4],
}

impl Space {
    /// For each axis, where the line is relative to the planes at min and at max.
    fn sides(&self, t: &Time) -> [[Ordering; 2]; 3] {
        let [origin, direction, min, max] = &self.vectors;
        [0, 1, 2].map(|i| {
            let x = &origin[i] * &t.below + &direction[i] * &t.above;
            [x.cmp(&(&min[i] * &t.below)), x.cmp(&(&max[i] * &t.below))]
        })
    }

    fn has(&self, t: &Time) -> bool {
        let is_between = |[low, high]: [Ordering; 2]| low.is_ge() && high.is_le();
        self.sides(t).into_iter().all(is_between)
    }

    /// How many axes have the line on one of their planes.
    fn planes(&self, t: &Time) -> usize {
        let is_on = |sides: &[Ordering; 2]| sides.contains(&Ordering::Equal);
        self.sides(t).iter().filter(|sides| is_on(sides)).count()
    }
}

/// Numbers as integers, and the exponent that they all carry.
fn integers(numbers: &[f64]) -> (Vec<BigInt>, i64) {
    let parts: Vec<(i64, i64)> = numbers.iter().map(|x| decompose(*x)).collect();
    let nonzero = parts.iter().filter(|(digits, _)| *digits != 0);
    let least = nonzero.map(|(_, exponent)| *exponent).min().unwrap_or(0);
    let shifted = |&(digits, exponent): &(i64, i64)| match digits {
        0 => BigInt::ZERO,
        _ => BigInt::from(digits) << (exponent - least),
    };
    (parts.iter().map(shifted).collect(), least)
}

fn triple(numbers: &[BigInt]) -> [BigInt; 3] {
    [0, 1, 2].map(|i| numbers[i].clone())
}

pub fn truth(case: &BoxCase<f64>) -> Truth {
    let [t_min, t_max] = [case.ray.t_min, case.ray.t_max];
    let [origin, direction, min, max] = case.vectors();
    let numbers = case.vectors();
    let is_finite = numbers.as_flattened().iter().all(|x| x.is_finite());
    if !is_finite || direction == [0.0; 3] || t_min.is_nan() || t_max.is_nan() || t_max < t_min {
        return Truth::Invalid;
    }
    if (0..3).any(|i| min[i] > max[i]) {
        return Truth::Empty;
    }
    let (positions, p) = integers([origin, min, max].as_flattened());
    let (directions, q) = integers(&direction);
    let [origin, min, max] = [0, 3, 6].map(|i| triple(&positions[i..]));
    let space = Space {
        vectors: [origin, triple(&directions), min, max],
    };

    let [origin, direction, min, max] = &space.vectors;
    let mut times = Vec::new();
    for i in (0..3).filter(|i| direction[*i] != BigInt::ZERO) {
        for plane in [&min[i], &max[i]] {
            times.push(Time::of(plane - &origin[i], direction[i].clone()));
        }
    }
    times.retain(|t| space.has(t));
    times.sort_by(Time::cmp);
    let [Some(enter), Some(exit)] = [times.first(), times.last()] else {
        return Truth::Outside;
    };
    let zero = Time::of(BigInt::ZERO, BigInt::from(1));
    let origin = match (space.has(&zero), space.planes(&zero)) {
        (false, _) => Origin::Outside,
        (true, 0) => Origin::Inside,
        (true, _) => Origin::On,
    };
    let class = if enter.cmp(exit).is_lt() {
        let above = &enter.above * &exit.below + &exit.above * &enter.below;
        let middle = Time::of(above, &enter.below * &exit.below * 2);
        if space.planes(&middle) == 0 {
            Class::Interior
        } else {
            Class::Along
        }
    } else {
        [Class::Face, Class::Edge, Class::Corner][space.planes(enter) - 1]
    };
    let end = |t: f64| -> Option<Time> {
        if t.is_infinite() {
            return None;
        }
        let (digits, exponent) = decompose(t);
        let shift = exponent - (p - q);
        let digits = BigInt::from(digits);
        let one = BigInt::from(1);
        Some(if shift >= 0 {
            Time::of(digits << shift, one)
        } else {
            Time::of(digits, one << -shift)
        })
    };
    let overlap = |low: f64, high: f64| -> Overlap {
        if low == f64::INFINITY || high == f64::NEG_INFINITY {
            return Overlap::None;
        }
        let (low, high) = (end(low), end(high));
        let mut common: Vec<&Time> = vec![enter, exit];
        common.extend(low.iter());
        common.extend(high.iter());
        common.retain(|t| {
            let is_after = low.as_ref().is_none_or(|low| t.cmp(low).is_ge());
            let is_before = high.as_ref().is_none_or(|high| t.cmp(high).is_le());
            space.has(t) && is_after && is_before
        });
        let Some(first) = common.first() else {
            return Overlap::None;
        };
        let ends = [&low, &high];
        let is_end = |t: &Time| {
            ends.iter()
                .any(|end| end.as_ref().is_some_and(|e| e.cmp(t).is_eq()))
        };
        let is_one_point = common.iter().all(|t| t.cmp(first).is_eq());
        if is_one_point && is_end(first) {
            Overlap::AtAnEnd
        } else {
            Overlap::Within
        }
    };
    Truth::Meets(Meeting {
        class,
        origin,
        ray: overlap(0.0, f64::INFINITY),
        interval: overlap(t_min, t_max),
    })
}

/// A case on a small grid, a family's case with a nudged number, or numbers of any exponent; some of them invalid.
pub fn hard_case<F: FamilyScalar>(seed: u64, index: u64) -> BoxCase<F> {
    let mut draw = Draw::new("hard boxes", seed, index);
    let case = match index % 4 {
        0 => on_a_grid(&mut draw),
        1 => nudged(&mut draw, seed, index),
        2 => FAMILIES[draw.below(FAMILIES.len())].case(seed, index),
        _ => any_exponents(&mut draw),
    };
    let number = |x: f64| F::from_f64(x);
    let drawn = number(draw.integer(-6, 6) as f64 * 0.5);
    let [low, high] = draw.pick(&[
        [0.0, f64::INFINITY],
        [0.0, f64::INFINITY],
        [f64::NEG_INFINITY, f64::INFINITY],
        [0.0, 1.0],
        [1.0, 1.0],
        [f64::INFINITY, f64::INFINITY],
        [1.0, 0.0],
    ]);
    match draw.below(4) {
        0 => case,
        1 => case.on(drawn, F::infinity()),
        2 => case.on(F::zero(), drawn),
        _ => case.on(number(low), number(high)),
    }
}

fn on_a_grid<F: FamilyScalar>(draw: &mut Draw) -> BoxCase<F> {
    let number = |x: i64| F::from_f64(x as f64);
    let min = draw.lattice_point(2);
    let max = min.map(|x| x + draw.integer(-1, 3).max(i64::from(draw.below(20) > 0) - 1));
    let origin = draw.lattice_point(5).map(number);
    let direction = draw.lattice_point(2).map(number);
    BoxCase::new(origin, direction, [min.map(number), max.map(number)])
}

fn nudged<F: FamilyScalar>(draw: &mut Draw, seed: u64, index: u64) -> BoxCase<F> {
    let family = &FAMILIES[draw.below(FAMILIES.len())];
    let case = family.case::<F>(seed, index);
    let mut vectors = case.vectors();
    let ulps = draw.integer(-2, 2);
    let place = draw.below(12);
    let number = &mut vectors.as_flattened_mut()[place];
    *number = number.offset_ulps(ulps);
    let [origin, direction, min, max] = vectors;
    BoxCase::new(origin, direction, [min, max]).on(case.ray.t_min, case.ray.t_max)
}

fn any_exponents<F: FamilyScalar>(draw: &mut Draw) -> BoxCase<F> {
    let mut point = || -> [F; 3] {
        [(); 3].map(|()| match draw.below(8) {
            0 => F::zero(),
            _ => {
                let exponent = draw.integer(F::MIN_EXPONENT.into(), F::MAX_EXPONENT.into());
                draw.with_exponent(exponent as i32)
            }
        })
    };
    let [origin, direction, a, b] = [point(), point(), point(), point()];
    let min = [0, 1, 2].map(|i| if b[i] < a[i] { b[i] } else { a[i] });
    let max = [0, 1, 2].map(|i| if b[i] < a[i] { a[i] } else { b[i] });
    BoxCase::new(origin, direction, [min, max])
}

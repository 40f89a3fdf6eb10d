//! The last layer of the truth: products of integers, of 128 bits where the coordinates allow it and of any size otherwise.
//!
//! Positions are multiples of 2^p and the direction of 2^q for the smallest exponents p, q of their lowest bits. So all
//! coordinates become integers, and t carries 2^(p-q).

use crate::case::{BoxCase, each_axis};
use crate::truth::{Class, Meeting, Origin, Overlap, Truth};
use hairline_core::oracle::integer::{Integer, IntegerVector, RayInterval, align};
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::cmp::Ordering;

/// Differences of such integers, turned round, are far from the ends of `i128`.
const MOST_BITS: u64 = 120;

/// A fraction whose denominator is positive.
struct Fraction<I> {
    above: I,
    below: I,
}

impl<I: Integer> Fraction<I> {
    fn order(&self, other: &Fraction<I>) -> Ordering {
        I::compare_products(&self.above, &other.below, &other.above, &self.below)
    }
}

/// One axis in integers.
struct Axis<I> {
    /// Where the line enters and leaves the slab; none if it is parallel to it.
    crossing: Option<[Fraction<I>; 2]>,
    /// The place of the origin between the planes.
    origin: Origin,
}

/// The truth of a valid case whose box is not empty.
pub(crate) fn decide(case: &BoxCase<f64>) -> Truth {
    let [origin, direction, min, max] = case.vectors();
    let ([origin, min, max], p) = align([origin, min, max]);
    let ([direction], q) = align([direction]);
    let ends = RayInterval::between(case.ray.t_min, case.ray.t_max, p - q);
    let vectors = [origin, direction, min, max];
    match narrow(&vectors) {
        Some(narrow) => decide_in(narrow, &ends),
        None => decide_in(vectors, &ends),
    }
}

/// The numbers in 128 bits, if they fit.
fn narrow(vectors: &[IntegerVector<BigInt>; 4]) -> Option<[IntegerVector<i128>; 4]> {
    let mut narrow = [[0; 3]; 4];
    for (to, from) in narrow
        .as_flattened_mut()
        .iter_mut()
        .zip(vectors.as_flattened())
    {
        if from.bits() > MOST_BITS {
            return None;
        }
        *to = from.to_i128()?;
    }
    Some(narrow)
}

fn decide_in<I: Integer>(vectors: [IntegerVector<I>; 4], ends: &RayInterval) -> Truth {
    let [origin, direction, min, max] = &vectors;
    let axes = each_axis(|i| axis(&origin[i], &direction[i], [&min[i], &max[i]]));
    let is_beside = |axis: &Axis<I>| axis.crossing.is_none() && axis.origin == Origin::Outside;
    if axes.iter().any(is_beside) {
        return Truth::Outside;
    }
    let crossings = || axes.iter().filter_map(|axis| axis.crossing.as_ref());
    let enter = crossings()
        .map(|[enter, _]| enter)
        .max_by(|a, b| a.order(b));
    let exit = crossings().map(|[_, exit]| exit).min_by(|a, b| a.order(b));
    let (Some(enter), Some(exit)) = (enter, exit) else {
        return Truth::Invalid;
    };
    if enter.order(exit) == Ordering::Greater {
        return Truth::Outside;
    }
    let start_of_ray = exit.above.sign();
    Truth::Meets(Meeting {
        class: class(&axes, enter, exit),
        origin: place(&axes),
        ray: overlap(start_of_ray, Ordering::Less, false),
        interval: overlap(
            ends.compare_start(&exit.above, &exit.below),
            ends.compare_end(&enter.above, &enter.below),
            ends.is_point(),
        ),
    })
}

fn axis<I: Integer>(origin: &I, direction: &I, [min, max]: [&I; 2]) -> Axis<I> {
    let from_min = min.clone() - origin;
    let from_max = max.clone() - origin;
    let place = match (from_min.sign(), from_max.sign()) {
        (Ordering::Less, Ordering::Greater) => Origin::Inside,
        (Ordering::Greater, _) | (_, Ordering::Less) => Origin::Outside,
        _ => Origin::On,
    };
    let turned = |near: I, far: I, below: I| {
        let enter = Fraction {
            above: near,
            below: below.clone(),
        };
        Some([enter, Fraction { above: far, below }])
    };
    let crossing = match direction.sign() {
        Ordering::Equal => None,
        Ordering::Greater => turned(from_min, from_max, direction.clone()),
        Ordering::Less => turned(-from_max, -from_min, -direction.clone()),
    };
    Axis {
        crossing,
        origin: place,
    }
}

fn class<I: Integer>(axes: &[Axis<I>; 3], enter: &Fraction<I>, exit: &Fraction<I>) -> Class {
    let runs_in_a_plane = |axis: &Axis<I>| axis.crossing.is_none() && axis.origin == Origin::On;
    if enter.order(exit) == Ordering::Less {
        let is_along = axes.iter().any(runs_in_a_plane);
        return if is_along {
            Class::Along
        } else {
            Class::Interior
        };
    }
    let is_on_plane = |axis: &&Axis<I>| match &axis.crossing {
        None => axis.origin == Origin::On,
        Some(crossing) => crossing.iter().any(|t| t.order(enter) == Ordering::Equal),
    };
    match axes.iter().filter(is_on_plane).count() {
        3 => Class::Corner,
        2 => Class::Edge,
        _ => Class::Face,
    }
}

fn place<I>(axes: &[Axis<I>; 3]) -> Origin {
    let has = |place| axes.iter().any(|axis| axis.origin == place);
    if has(Origin::Outside) {
        return Origin::Outside;
    }
    if has(Origin::On) {
        Origin::On
    } else {
        Origin::Inside
    }
}

/// From the order of the exit and the lower end, and of the entry and the upper end.
fn overlap(exit_and_low: Ordering, enter_and_high: Ordering, is_point: bool) -> Overlap {
    if exit_and_low == Ordering::Less || enter_and_high == Ordering::Greater {
        return Overlap::None;
    }
    let touches = exit_and_low == Ordering::Equal || enter_and_high == Ordering::Equal;
    if touches || is_point {
        Overlap::AtAnEnd
    } else {
        Overlap::Within
    }
}

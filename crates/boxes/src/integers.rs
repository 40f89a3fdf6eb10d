//! The last layer of the truth: products of integers, of 128 bits where the coordinates allow it and of any size otherwise.
//!
//! Positions are multiples of 2^p and the direction of 2^q for the smallest exponents p, q of their lowest bits. So all
//! coordinates become integers, and t carries 2^(p-q).

use crate::case::{BoxCase, each_axis};
use crate::slab::Slab;
use crate::truth::{Class, Meeting, Origin, Overlap, Truth};
use hairline_core::oracle::integer::{Integer, IntegerVector, RayInterval, align};
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::cmp::Ordering;

/// Differences of such integers, turned round, are far from the ends of `i128`.
const MOST_BITS: u64 = 120;

/// A t of a slab, whose denominator is positive.
struct Time<'a, I> {
    above: &'a I,
    below: &'a I,
}

impl<I: Integer> Time<'_, I> {
    fn order(&self, other: &Time<I>) -> Ordering {
        I::compare_products(self.above, other.below, other.above, self.below)
    }
}

impl<I> Slab<I> {
    fn enter(&self) -> Time<'_, I> {
        Time {
            above: &self.near,
            below: &self.size,
        }
    }

    fn exit(&self) -> Time<'_, I> {
        Time {
            above: &self.far,
            below: &self.size,
        }
    }
}

/// One axis in integers.
struct Axis<I> {
    /// None if the line is parallel to the slab.
    slab: Option<Slab<I>>,
    /// The place of the origin between the planes.
    origin: Origin,
}

/// Origin, direction, min and max.
type Vectors<I> = [IntegerVector<I>; 4];

/// The truth of a valid case whose box is not empty.
pub fn decide(case: &BoxCase<f64>) -> Truth {
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
fn narrow(vectors: &Vectors<BigInt>) -> Option<Vectors<i128>> {
    let mut narrow = [[0; 3]; 4];
    let places = narrow.as_flattened_mut();
    for (place, number) in places.iter_mut().zip(vectors.as_flattened()) {
        if number.bits() > MOST_BITS {
            return None;
        }
        *place = number.to_i128()?;
    }
    Some(narrow)
}

fn decide_in<I: Integer>(vectors: Vectors<I>, ends: &RayInterval) -> Truth {
    let axes = each_axis(|i| {
        let numbers = vectors.each_ref().map(|vector| &vector[i]);
        axis(numbers)
    });
    if axes.iter().any(Axis::is_beside) {
        return Truth::Outside;
    }
    let slabs = || axes.iter().filter_map(|axis| axis.slab.as_ref());
    let enter = slabs().map(Slab::enter).max_by(Time::order);
    let exit = slabs().map(Slab::exit).min_by(Time::order);
    let (Some(enter), Some(exit)) = (enter, exit) else {
        return Truth::Invalid;
    };
    if enter.order(&exit) == Ordering::Greater {
        return Truth::Outside;
    }
    let start_of_ray = exit.above.sign();
    let start = ends.compare_start(exit.above, exit.below);
    let end = ends.compare_end(enter.above, enter.below);
    Truth::Meets(Meeting {
        class: class(&axes, &enter, &exit),
        origin: place(&axes),
        ray: overlap(start_of_ray, Ordering::Less, false),
        interval: overlap(start, end, ends.is_point()),
    })
}

fn axis<I: Integer>([origin, direction, min, max]: [&I; 4]) -> Axis<I> {
    let from_min = min.clone() - origin;
    let from_max = max.clone() - origin;
    let origin = match (from_min.sign(), from_max.sign()) {
        (Ordering::Less, Ordering::Greater) => Origin::Inside,
        (Ordering::Greater, _) | (_, Ordering::Less) => Origin::Outside,
        _ => Origin::On,
    };
    let size = direction.clone();
    let slab = match direction.sign() {
        Ordering::Equal => None,
        Ordering::Greater => Some(Slab::forward(from_min, from_max, size)),
        Ordering::Less => Some(Slab::backward(from_min, from_max, size)),
    };
    Axis { slab, origin }
}

impl<I: Integer> Axis<I> {
    /// True if the line is parallel to the slab, and outside it.
    fn is_beside(&self) -> bool {
        self.slab.is_none() && self.origin == Origin::Outside
    }

    /// True if the line runs in one of the planes.
    fn is_along(&self) -> bool {
        self.slab.is_none() && self.origin == Origin::On
    }

    /// True if the line is on one of the planes at a time.
    fn is_on_plane(&self, t: &Time<I>) -> bool {
        let Some(slab) = &self.slab else {
            return self.is_along();
        };
        let is_now = |end: Time<I>| end.order(t) == Ordering::Equal;
        is_now(slab.enter()) || is_now(slab.exit())
    }
}

fn class<I: Integer>(axes: &[Axis<I>; 3], enter: &Time<I>, exit: &Time<I>) -> Class {
    if enter.order(exit) == Ordering::Less {
        if axes.iter().any(Axis::is_along) {
            return Class::Along;
        }
        return Class::Interior;
    }
    let on_planes = axes.iter().filter(|axis| axis.is_on_plane(enter));
    match on_planes.count() {
        3 => Class::Corner,
        2 => Class::Edge,
        _ => Class::Face,
    }
}

fn place<I>(axes: &[Axis<I>; 3]) -> Origin {
    let places = axes.each_ref().map(|axis| axis.origin);
    if places.contains(&Origin::Outside) {
        return Origin::Outside;
    }
    if places.contains(&Origin::On) {
        return Origin::On;
    }
    Origin::Inside
}

/// From the order of the exit and the lower end, and of the entry and the upper end.
fn overlap(exit_and_low: Ordering, enter_and_high: Ordering, is_point: bool) -> Overlap {
    if exit_and_low == Ordering::Less {
        return Overlap::None;
    }
    if enter_and_high == Ordering::Greater {
        return Overlap::None;
    }
    let orders = [exit_and_low, enter_and_high];
    if orders.contains(&Ordering::Equal) || is_point {
        return Overlap::AtAnEnd;
    }
    Overlap::Within
}

//! The first layer of the truth: comparisons of products in `f64`, each with a bound on its error.
//!
//! Turn each axis so that the direction is positive there: the line enters the slab at near/size and leaves it at
//! far/size, where near and far are differences of two given numbers and size is |d|. It enters slab i before it leaves
//! slab j if near_i·size_j < far_j·size_i. Each product carries two roundings, below 3u of its computed value
//! (u = 2^-53), and an underflow of less than 2^-1075. So the computed order is right if the products differ by more
//! than 8u·(|left| + |right|) + 2^-1000. An overflow makes the bound infinite, and nothing is certain.
//!
//! Signs of differences, and so the place of the origin, need no bound: IEEE subtraction never gets them wrong.

use crate::case::{BoxCase, any_axis};
use crate::slab::Slab;
use crate::truth::{Class, Meeting, Origin, Overlap, Truth};
use std::cmp::Ordering;

const U: f64 = f64::EPSILON / 2.0;
/// More than underflow can add: 2^-1000.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);

/// The truth, if floats are sure of it.
pub fn decide(case: &BoxCase<f64>) -> Option<Truth> {
    if !is_valid(case) {
        return Some(Truth::Invalid);
    }
    let [origin, direction, min, max] = case.vectors();
    if any_axis(|i| max[i] < min[i]) {
        return Some(Truth::Empty);
    }
    let mut slabs = Vec::with_capacity(3);
    let mut touches_a_plane = false;
    for i in 0..3 {
        if direction[i] == 0.0 {
            if origin[i] < min[i] || max[i] < origin[i] {
                return Some(Truth::Outside);
            }
            touches_a_plane |= origin[i] == min[i] || origin[i] == max[i];
            continue;
        }
        touches_a_plane |= min[i] == max[i];
        let from_min = min[i] - origin[i];
        let from_max = max[i] - origin[i];
        slabs.push(if direction[i] > 0.0 {
            Slab::forward(from_min, from_max, direction[i])
        } else {
            Slab::backward(from_min, from_max, direction[i])
        });
    }
    if enters_before_it_leaves(&slabs)? == Ordering::Greater {
        return Some(Truth::Outside);
    }
    if touches_a_plane {
        return None;
    }
    let ray = on_ray(&slabs);
    Some(Truth::Meets(Meeting {
        class: Class::Interior,
        origin: place(case.vectors()),
        ray,
        interval: in_interval(case, &slabs, ray)?,
    }))
}

/// Finite coordinates, a direction that is not zero, and an interval whose ends are in order.
pub fn is_valid(case: &BoxCase<f64>) -> bool {
    let vectors = case.vectors();
    let mut numbers = vectors.as_flattened().iter();
    let are_finite = numbers.all(|x| x.is_finite());
    let has_direction = vectors[1] != [0.0; 3];
    are_finite && has_direction && case.ray.t_min <= case.ray.t_max
}

/// The order of where the line enters the last slab and where it leaves the first, never called equal.
fn enters_before_it_leaves(slabs: &[Slab<f64>]) -> Option<Ordering> {
    let mut is_certain = true;
    for (i, enters) in slabs.iter().enumerate() {
        for (j, leaves) in slabs.iter().enumerate() {
            if i == j {
                continue;
            }
            match order(enters.near * leaves.size, leaves.far * enters.size) {
                Some(Ordering::Greater) => return Some(Ordering::Greater),
                Some(_) => {}
                None => is_certain = false,
            }
        }
    }
    is_certain.then_some(Ordering::Less)
}

/// The order of two products, if it is certain; it is never equal.
fn order(left: f64, right: f64) -> Option<Ordering> {
    let bound = 8.0 * U * (left.abs() + right.abs()) + UNDERFLOW;
    let difference = left - right;
    if difference.abs() > bound {
        return difference.partial_cmp(&0.0);
    }
    None
}

/// The place of the origin. All that is on the boundary has been handed on, unless the origin is on a plane that the
/// line crosses.
fn place([origin, _, min, max]: [[f64; 3]; 4]) -> Origin {
    let is_below = any_axis(|i| origin[i] < min[i]);
    let is_above = any_axis(|i| max[i] < origin[i]);
    if is_below || is_above {
        return Origin::Outside;
    }
    let is_at_min = any_axis(|i| origin[i] == min[i]);
    let is_at_max = any_axis(|i| origin[i] == max[i]);
    if is_at_min || is_at_max {
        return Origin::On;
    }
    Origin::Inside
}

/// The part at t >= 0 of a line through the interior.
fn on_ray(slabs: &[Slab<f64>]) -> Overlap {
    if slabs.iter().any(|slab| slab.far < 0.0) {
        return Overlap::None;
    }
    if slabs.iter().any(|slab| slab.far == 0.0) {
        return Overlap::AtAnEnd;
    }
    Overlap::Within
}

/// The part in the interval of a line through the interior; `ray` is its part at t >= 0.
fn in_interval(case: &BoxCase<f64>, slabs: &[Slab<f64>], ray: Overlap) -> Option<Overlap> {
    let t_min = case.ray.t_min;
    let t_max = case.ray.t_max;
    if t_min == 0.0 && t_max == f64::INFINITY {
        return Some(ray);
    }
    let mut is_certain = t_min < t_max;
    for slab in slabs {
        let end = order_with_end(slab.far, slab.size, t_min);
        let start = order_with_end(slab.near, slab.size, t_max);
        if end == Some(Ordering::Less) || start == Some(Ordering::Greater) {
            return Some(Overlap::None);
        }
        is_certain &= end.is_some() && start.is_some();
    }
    is_certain.then_some(Overlap::Within)
}

/// The order of distance/size and an end of the interval.
fn order_with_end(distance: f64, size: f64, end: f64) -> Option<Ordering> {
    if end.is_infinite() {
        return 0.0.partial_cmp(&end);
    }
    order(distance, end * size)
}

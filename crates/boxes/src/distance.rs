//! The least padding with which a box is met: how far a line, a ray or an interval passes outside, exactly.

use crate::case::BoxCase;
use crate::filter::is_valid;
use crate::slab::Slab;
use num_rational::BigRational as Rational;
use num_traits::{Num, ToPrimitive, Zero};
use std::ops::Neg;

/// The number by which a box must grow on all sides so that it is just met; below zero if it is met already.
#[derive(Clone, Debug, PartialEq)]
pub struct Padding {
    /// As a length.
    pub length: Rational,
    /// As a share of the largest coordinate of the case, rounded.
    pub share: f64,
}

/// The padding of a case; none of an invalid one.
pub fn padding(case: &BoxCase<f64>) -> Option<Padding> {
    let length = least(case, Rational::from_float)?;
    let share = share(&length, largest_coordinate(case));
    Some(Padding { length, share })
}

/// About the share of [`padding`], in doubles and without rationals; those where doubles overflow. It is off by some 1e-15 at
/// most, a few roundings of numbers that are at most a few times the largest coordinate.
pub fn about(case: &BoxCase<f64>) -> Option<f64> {
    let finite = |x: f64| x.is_finite().then_some(x);
    let length = least(case, finite)?;
    let share = length / largest_coordinate(case);
    if share.is_finite() {
        return Some(share);
    }
    padding(case).map(|padding| padding.share)
}

/// The padding as a length, from numbers of a kind; `number` has none for an infinity, which bounds nothing.
///
/// Padded by p, the line enters slab i before it leaves slab j if (near_i - p)/size_i <= (far_j + p)/size_j, so if
/// p >= (near_i·size_j - far_j·size_i) / (size_i + size_j). The largest of these bounds is the padding.
fn least<N>(case: &BoxCase<f64>, number: impl Fn(f64) -> Option<N>) -> Option<N>
where
    N: Num + Neg<Output = N> + Clone + PartialOrd,
{
    if !is_valid(case) {
        return None;
    }
    let vectors = case.vectors();
    let mut bounds = Vec::with_capacity(18);
    let mut slabs = Vec::with_capacity(3);
    for i in 0..3 {
        let [origin, direction, min, max] = vectors.map(|vector| vector[i]);
        let origin = number(origin)?;
        let from_min = number(min)? - origin.clone();
        let from_max = number(max)? - origin;
        let size = number(direction)?;
        if direction == 0.0 {
            bounds.push(from_min);
            bounds.push(-from_max);
        } else if direction > 0.0 {
            slabs.push(Slab::forward(from_min, from_max, size));
        } else {
            slabs.push(Slab::backward(from_min, from_max, size));
        }
    }
    let t_min = number(case.ray.t_min);
    let t_max = number(case.ray.t_max);
    for Slab { near, far, size } in &slabs {
        if let Some(t_max) = t_max.clone() {
            bounds.push(near.clone() - t_max * size.clone());
        }
        if let Some(t_min) = t_min.clone() {
            bounds.push(t_min * size.clone() - far.clone());
        }
        for other in &slabs {
            let enters = near.clone() * other.size.clone();
            let leaves = other.far.clone() * size.clone();
            let sizes = size.clone() + other.size.clone();
            bounds.push((enters - leaves) / sizes);
        }
    }
    let larger = |one: N, other: N| if one < other { other } else { one };
    bounds.into_iter().reduce(larger)
}

fn largest_coordinate(case: &BoxCase<f64>) -> f64 {
    let [origin, _, min, max] = case.vectors();
    let coordinates = [origin, min, max];
    let sizes = coordinates.as_flattened().iter().map(|x| x.abs());
    sizes.fold(0.0, f64::max)
}

/// A length by the largest coordinate; infinite if all coordinates are 0.
fn share(length: &Rational, largest: f64) -> f64 {
    let largest = Rational::from_float(largest).unwrap_or_else(Rational::zero);
    if largest.is_zero() {
        return if length.is_zero() { 0.0 } else { f64::INFINITY };
    }
    (length / largest).to_f64().unwrap_or(f64::INFINITY)
}

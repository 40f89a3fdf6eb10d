//! The least padding with which a box is met: how far a line, a ray or an interval passes outside, exactly.

use crate::case::BoxCase;
use crate::filter::is_valid;
use crate::slab::Slab;
use num_rational::BigRational as Rational;
use num_traits::{ToPrimitive, Zero};

/// The number by which a box must grow on all sides so that it is just met; below zero if it is met already.
#[derive(Clone, Debug, PartialEq)]
pub struct Padding {
    /// As a length.
    pub length: Rational,
    /// As a share of the largest coordinate of the case, rounded.
    pub share: f64,
}

/// The padding of a case; none of an invalid one.
///
/// Padded by p, the line enters slab i before it leaves slab j if (near_i - p)/size_i <= (far_j + p)/size_j, so if
/// p >= (near_i·size_j - far_j·size_i) / (size_i + size_j). The largest of these bounds is the padding.
pub fn padding(case: &BoxCase<f64>) -> Option<Padding> {
    if !is_valid(case) {
        return None;
    }
    let vectors = case.vectors();
    let mut bounds = Vec::new();
    let mut slabs = Vec::new();
    for i in 0..3 {
        let [origin, direction, min, max] = vectors.map(|vector| vector[i]);
        let origin = Rational::from_float(origin)?;
        let size = Rational::from_float(direction)?;
        let from_min = Rational::from_float(min)? - &origin;
        let from_max = Rational::from_float(max)? - &origin;
        if direction == 0.0 {
            bounds.push(from_min);
            bounds.push(-from_max);
        } else if direction > 0.0 {
            slabs.push(Slab::forward(from_min, from_max, size));
        } else {
            slabs.push(Slab::backward(from_min, from_max, size));
        }
    }
    // An infinite end is no bound.
    let t_min = Rational::from_float(case.ray.t_min);
    let t_max = Rational::from_float(case.ray.t_max);
    for slab in &slabs {
        if let Some(t_max) = &t_max {
            bounds.push(&slab.near - t_max * &slab.size);
        }
        if let Some(t_min) = &t_min {
            bounds.push(t_min * &slab.size - &slab.far);
        }
        for other in &slabs {
            let enters = &slab.near * &other.size;
            let leaves = &other.far * &slab.size;
            let sizes = &slab.size + &other.size;
            bounds.push((enters - leaves) / sizes);
        }
    }
    let length = bounds.into_iter().max()?;
    let share = share(&length, largest_coordinate(case));
    Some(Padding { length, share })
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

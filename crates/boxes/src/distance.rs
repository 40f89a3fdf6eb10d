//! The least padding with which a box is met: how far a line, a ray or an interval passes outside, exactly.

use crate::case::BoxCase;
use crate::filter::is_valid;
use num_rational::BigRational as Rational;
use num_traits::{Signed, ToPrimitive, Zero};

/// The number by which a box must grow on all sides so that it is just met; below zero if it is met already.
#[derive(Clone, Debug, PartialEq)]
pub struct Padding {
    /// As a length.
    pub length: Rational,
    /// As a share of the largest coordinate of the case, rounded.
    pub share: f64,
}

/// An axis on which the direction is not zero, turned so that it is positive.
struct Slab {
    near: Rational,
    far: Rational,
    size: Rational,
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
    let [origin, direction, min, max] = vectors.map(|v| v.map(Rational::from_float));
    let mut bounds = Vec::new();
    let mut slabs = Vec::new();
    for i in 0..3 {
        let (origin, direction) = (origin[i].as_ref()?, direction[i].as_ref()?);
        let from_min = min[i].as_ref()? - origin;
        let from_max = max[i].as_ref()? - origin;
        if direction.is_zero() {
            bounds.extend([from_min, -from_max]);
            continue;
        }
        let size = direction.abs();
        slabs.push(if direction.is_positive() {
            Slab {
                near: from_min,
                far: from_max,
                size,
            }
        } else {
            Slab {
                near: -from_max,
                far: -from_min,
                size,
            }
        });
    }
    // No bound of an infinite end.
    let [t_min, t_max] = [case.ray.t_min, case.ray.t_max].map(Rational::from_float);
    for slab in &slabs {
        bounds.extend(t_max.as_ref().map(|t_max| &slab.near - t_max * &slab.size));
        bounds.extend(t_min.as_ref().map(|t_min| t_min * &slab.size - &slab.far));
        for other in &slabs {
            let apart = &slab.near * &other.size - &other.far * &slab.size;
            bounds.push(apart / (&slab.size + &other.size));
        }
    }
    let length = bounds.into_iter().max()?;
    let [origin, _, min, max] = vectors;
    let coordinates = [origin, min, max];
    let largest = coordinates
        .as_flattened()
        .iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    let share = share(&length, largest);
    Some(Padding { length, share })
}

/// A length by the largest coordinate; infinite if all coordinates are 0.
fn share(length: &Rational, largest: f64) -> f64 {
    let largest = Rational::from_float(largest).unwrap_or_else(Rational::zero);
    if largest.is_zero() {
        return if length.is_zero() { 0.0 } else { f64::INFINITY };
    }
    (length / largest).to_f64().unwrap_or(f64::INFINITY)
}

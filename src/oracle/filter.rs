//! The first layer: all signs at once in `f64`, each with an error bound from its permanent.
//!
//! With A = a-o, B = b-o, C = c-o the three cross products are shared: U = d·(C×B), V = d·(A×C),
//! W = d·(B×A), D = -(U+V+W) and T = A·(B×C).
//!
//! Error bounds (u = 2^-53 is the unit roundoff). A term of U is a product d_i·(x·y) of one given
//! and two subtracted numbers. Its computed value passes through 2 subtractions, 1 product, 1
//! difference, 1 product and 2 sums: 7 roundings, so it carries a factor within (1+u)^±7. The
//! permanent P (the same sum over absolute values) is computed with as many roundings and is at
//! least (1-u)^7 times its exact value. Hence
//! |U_computed - U| ≤ ((1+u)^7 - 1)/(1-u)^7 · P_computed < 8u·P_computed, and the product 8u·P is
//! exact. T has a third subtracted factor: 8 roundings, below 16u·P. D by U+V+W has 2 further sums
//! over the sum of the three permanents: 9 roundings, below 16u·(P_U+P_V+P_W).
//!
//! Underflow and overflow: coordinates are at most 2^150 in absolute value, so nothing overflows
//! (three factors below 2^152, nine terms). A product that underflows is off by at most 2^-1075;
//! multiplied by the other factors (below 2^151 each) and added up (fewer than 2^6 of them), the
//! sum is off by less than 2^-900, which is added to each bound; the same holds for the permanents.

use super::signs::Signs;
use crate::case::Case;
use crate::truth::Truth;
use std::cmp::Ordering;

const U: f64 = f64::EPSILON / 2.0;
/// The largest coordinate for which nothing overflows: 2^150.
const LARGEST: f64 = f64::from_bits((1023 + 150) << 52);
/// What underflow can add to an error: 2^-900.
const UNDERFLOW: f64 = f64::from_bits((1023 - 900) << 52);

/// The truth, if every sign that it depends on is certain.
#[inline]
pub(super) fn decide(case: &Case<f64>) -> Option<Truth> {
    let [o, d, a, b, c] = case.vectors();
    let largest = [o, d, a, b, c].iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest > LARGEST {
        return None;
    }
    let [a, b, c] = [a, b, c].map(|p| [p[0] - o[0], p[1] - o[1], p[2] - o[2]]);
    let (bc, bc_permanent) = cross(&b, &c);
    let (ca, ca_permanent) = cross(&c, &a);
    let (ab, ab_permanent) = cross(&a, &b);
    let abs_d = d.map(f64::abs);
    let weights = [-dot(&d, &bc), -dot(&d, &ca), -dot(&d, &ab)];
    let permanents =
        [dot(&abs_d, &bc_permanent), dot(&abs_d, &ca_permanent), dot(&abs_d, &ab_permanent)];
    let capital_t = dot(&a, &bc);
    let t_permanent = dot(&a.map(f64::abs), &bc_permanent);

    let u = certain(weights[0], 8.0 * U * permanents[0])?;
    let v = certain(weights[1], 8.0 * U * permanents[1])?;
    let w = certain(weights[2], 8.0 * U * permanents[2])?;
    let sum = weights[0] + weights[1] + weights[2];
    let d_permanent = permanents[0] + permanents[1] + permanents[2];
    let d_sign =
        if u == v && v == w { u.reverse() } else { certain(-sum, 16.0 * U * d_permanent)? };
    let t_error = 16.0 * U * t_permanent;
    let t = certain(capital_t, t_error)?;

    let compare = |end: f64| {
        compare_with_end(end, d_sign, t, (capital_t, t_error), (-sum, 16.0 * U * d_permanent))
    };
    let (from_min, from_max) = (compare(case.ray.t_min)?, compare(case.ray.t_max)?);
    Some(Signs { d: d_sign, weights: [u, v, w], t, from_min, from_max }.truth())
}

/// The sign of T/D - end.
#[inline]
fn compare_with_end(
    end: f64,
    d_sign: Ordering,
    t_sign: Ordering,
    (t, t_error): (f64, f64),
    (d, d_error): (f64, f64),
) -> Option<Ordering> {
    let relative = |sign: Ordering| if d_sign == Ordering::Less { sign.reverse() } else { sign };
    if end == 0.0 {
        return Some(relative(t_sign));
    }
    if end.is_infinite() {
        return Some(if end > 0.0 { Ordering::Less } else { Ordering::Greater });
    }
    if end.abs() > LARGEST {
        return None;
    }
    // T - end·D: the product and the difference round once more each, on at most |T| + |end·D|.
    let product = end * d;
    let error = t_error + end.abs() * d_error + 4.0 * U * (t.abs() + product.abs());
    // The sum of the bounds rounds too: twice covers it. What underflow adds to D is multiplied.
    certain(t - product, 2.0 * error + end.abs() * UNDERFLOW).map(relative)
}

/// The sign of a value known within an error, underflow included; none if it is in doubt.
#[inline(always)]
fn certain(value: f64, error: f64) -> Option<Ordering> {
    let error = error + UNDERFLOW;
    if value > error {
        Some(Ordering::Greater)
    } else if value < -error {
        Some(Ordering::Less)
    } else {
        None
    }
}

#[inline(always)]
fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product and its permanents.
#[inline(always)]
fn cross(a: &[f64; 3], b: &[f64; 3]) -> ([f64; 3], [f64; 3]) {
    let pairs = [(1, 2), (2, 0), (0, 1)].map(|(j, k)| (a[j] * b[k], a[k] * b[j]));
    (pairs.map(|(p, q)| p - q), pairs.map(|(p, q)| p.abs() + q.abs()))
}

//! The second layer: small integers. Where all positions are multiples of one power of two below
//! 2^30 times it, and so are the direction's coordinates of another, every predicate is computed
//! exactly in machine integers, and zero is zero.
//!
//! Widths: coordinates below 2^30, differences below 2^31, minors below 2^63 (64 bits hold them), the
//! determinants below 2^96 (128 bits).

use super::contact;
use super::integer::{Interval, dot};
use super::signs::Signs;
use crate::case::Case;
use crate::truth::Truth;

/// Bits of a coordinate.
const BITS: i32 = 30;
/// Adding and subtracting it rounds a number below 2^51 to an integer; the sum's low bits are it.
const TO_INTEGER: f64 = 1.5 * (1u64 << 52) as f64;

/// The truth, if the coordinates lie on such a grid.
pub(super) fn decide(case: &Case<f64>) -> Option<Truth> {
    let [o, d, a, b, c] = case.vectors();
    let mut flat_positions = [0.0; 12];
    flat_positions.copy_from_slice([o, a, b, c].as_flattened());
    let (positions, p) = on_grid(flat_positions)?;
    let (d, q) = on_grid(d)?;
    let at = |k: usize| [positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]];
    let [a, b, c] = [minus(at(1), at(0)), minus(at(2), at(0)), minus(at(3), at(0))];
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    // The negated weights, whose sum is D.
    let weights = [wide_dot(d, bc), wide_dot(d, ca), wide_dot(d, ab)];
    let capital_d = weights[0] + weights[1] + weights[2];
    let capital_t = wide_dot(a, bc);
    let interval = Interval::new(case, p - q);
    if capital_d == 0 {
        return Some(flat(&interval, d, [a, b, c], capital_t));
    }
    let sign = |x: i128| x.cmp(&0);
    let signs = Signs {
        d: sign(capital_d),
        weights: weights.map(|x| 0.cmp(&x)),
        t: sign(capital_t),
        from_min: interval.compare_start(&capital_t, &capital_d),
        from_max: interval.compare_end(&capital_t, &capital_d),
    };
    Some(signs.truth())
}

/// Lines parallel to the plane, and triangles without area.
#[inline(never)]
fn flat(interval: &Interval, d: [i64; 3], vertices: [[i64; 3]; 3], capital_t: i128) -> Truth {
    let [a, b, c] = vertices.map(|v| v.map(i128::from));
    let n = super::integer::cross(&super::integer::minus(&b, &a), &super::integer::minus(&c, &a));
    let degenerate = n == [0; 3];
    if !degenerate && capital_t != 0 {
        debug_assert_ne!(dot(&n, &a), 0);
        return Truth::Parallel;
    }
    let contact = contact::decide(interval, &d.map(i128::from), [&a, &b, &c], &n);
    if degenerate { Truth::Degenerate(contact) } else { Truth::Coplanar(contact) }
}

/// Numbers as integers below 2^30 times a power of two, and its exponent.
#[inline(always)]
fn on_grid<const N: usize>(values: [f64; N]) -> Option<([i64; N], i64)> {
    let mut largest = 0.0;
    for x in values {
        largest = if x.abs() > largest { x.abs() } else { largest };
    }
    if largest == 0.0 {
        return Some(([0; N], 0));
    }
    let exponent = (largest.to_bits() >> 52) as i32 - 1023;
    let shift = BITS - 1 - exponent;
    // The scale must be a normal number; subnormal coordinates are for the layers behind.
    if !(-1000..=1000).contains(&shift) {
        return None;
    }
    let scale = f64::from_bits(((1023 + shift) as u64) << 52);
    let mut integers = [0; N];
    let mut fits = true;
    for i in 0..N {
        let scaled = values[i] * scale;
        let shifted = scaled + TO_INTEGER;
        // A number that underflows to zero is no multiple either.
        fits &= (shifted - TO_INTEGER == scaled) & ((scaled != 0.0) | (values[i] == 0.0));
        integers[i] = shifted.to_bits().wrapping_sub(TO_INTEGER.to_bits()) as i64;
    }
    fits.then_some((integers, -i64::from(shift)))
}

#[inline(always)]
fn minus(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn wide_dot(a: [i64; 3], b: [i64; 3]) -> i128 {
    let product = |i: usize| i128::from(a[i]) * i128::from(b[i]);
    product(0) + product(1) + product(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::define;

    #[test]
    fn the_grid_holds_thirty_bits_and_no_more() {
        let most = ((1u64 << 30) - 1) as f64;
        assert!(on_grid([most, 1.0]).is_some());
        assert!(on_grid([most + 1.0, 1.0]).is_none(), "31 bits");
        assert!(on_grid([most, 0.5]).is_none());
        assert_eq!(on_grid([0.75, -0.5]), Some(([3 << 28, -2 << 28], -30)));
        assert!(on_grid([1e300, 5e-324]).is_none(), "underflow is noticed");
        assert_eq!(on_grid([0.0, -0.0]), Some(([0, 0], 0)));
    }

    #[test]
    fn the_largest_coordinates_do_not_overflow() {
        let m = ((1u64 << 30) - 1) as f64;
        for signs in 0u32..1 << 15 {
            if signs % 37 != 0 {
                continue;
            }
            let at = |k: usize| if signs >> k & 1 == 0 { m } else { -m };
            let vector = |k: usize| [at(3 * k), at(3 * k + 1), at(3 * k + 2)];
            let case = Case::<f64>::new(vector(0), vector(1), [vector(2), vector(3), vector(4)]);
            let found = decide(&case).expect("on the grid");
            assert_eq!(found, define(&case).truth, "{signs:b}");
        }
    }
}

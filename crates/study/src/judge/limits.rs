//! Ranges in which the values of a hit are surely right, so that most verdicts need no more than comparisons.

use super::values::{ALLOWANCE, Allowed, has_values, roundoff};
use crate::arith::{Bounded, Float};
use crate::case::Case;
use crate::truth::Truth;
use glam::{DVec3, Vec3Swizzles};

/// Ranges in which t, u and v of a hit are surely right. Beyond these numbers `are_near` decides.
#[derive(Clone, Copy, Debug)]
pub struct ValueLimits<F> {
    /// The least t, u and v.
    pub low: [F; 3],
    /// The largest t, u and v.
    pub high: [F; 3],
}

impl<F: Float> ValueLimits<F> {
    fn all_between(low: F, high: F) -> Self {
        ValueLimits {
            low: [low; 3],
            high: [high; 3],
        }
    }

    /// Every finite number.
    fn any() -> Self {
        let largest = F::infinity().offset_ulps(-1);
        ValueLimits::all_between(-largest, largest)
    }

    /// No number.
    fn none() -> Self {
        ValueLimits::all_between(F::infinity(), -F::infinity())
    }

    /// The ranges for a case with its truth.
    pub fn of(case: &Case<F>, truth: &Truth) -> Self {
        if !has_values(truth) {
            return ValueLimits::any();
        }
        let known = by_floats(&case.widen(), roundoff::<F>()).or_else(|| by_bounds(case));
        let Some(known) = known else {
            return ValueLimits::none();
        };
        let mut limits = ValueLimits::any();
        for (which, value) in known.into_iter().enumerate() {
            let Some([low, high]) = value.numbers_within() else {
                return ValueLimits::none();
            };
            limits.low[which] = low;
            limits.high[which] = high;
        }
        limits
    }
}

/// A value, and how far from it a kernel's value surely may be.
#[derive(Clone, Copy, Default)]
struct KnownValue {
    value: f64,
    off: f64,
}

impl KnownValue {
    /// The least and the largest number of a scalar that are not too far off; none where one is not finite.
    fn numbers_within<F: Float>(self) -> Option<[F; 2]> {
        // Each end is rounded once or twice, by less than what is taken off here.
        let off = self.off - (self.value.abs() + self.off) * (4.0 * f64::EPSILON);
        let least = self.value - off;
        let most = self.value + off;
        let mut low = F::from_f64(least);
        if low.is_finite() && low.to_f64() < least {
            low = low.offset_ulps(1);
        }
        let mut high = F::from_f64(most);
        if high.is_finite() && high.to_f64() > most {
            high = high.offset_ulps(-1);
        }
        let are_finite = low.is_finite() && high.is_finite();
        are_finite.then_some([low, high])
    }
}

/// The values as numbers with bounds find them; none where they are not known well.
fn by_bounds<F: Float>(case: &Case<F>) -> Option<[KnownValue; 3]> {
    let Allowed { exact, unit, .. } = Allowed::<Bounded>::of(case);
    let mut known = [KnownValue::default(); 3];
    for (which, known) in known.iter_mut().enumerate() {
        // Each is known to a millionth of itself at least; what that leaves open is taken off.
        let off = ALLOWANCE * unit[which].approximate()? * (1.0 - 1e-5);
        known.value = exact[which].known_to(off * 1e-5)?;
        known.off = off * (1.0 - 1e-5);
    }
    Some(known)
}

/// A cross product, and its permanent: the same with all signs dropped.
struct Row {
    vector: DVec3,
    permanent: DVec3,
}

impl Row {
    fn cross(p: DVec3, q: DVec3) -> Row {
        let left = p.yzx() * q.zxy();
        let right = p.zxy() * q.yzx();
        Row {
            vector: left - right,
            permanent: left.abs() + right.abs(),
        }
    }
}

/// Differences, products and sums: at most eight roundings of half an epsilon on the way to each term.
const ERROR: f64 = 4.0 * f64::EPSILON;

/// The values as floats find them; none where they are not known well.
fn by_floats(case: &Case<f64>, roundoff: f64) -> Option<[KnownValue; 3]> {
    let vectors = case.vectors();
    if !vectors.as_flattened().iter().all(|x| is_moderate(*x)) {
        return None;
    }
    let [o, d, a, b, c] = vectors.map(DVec3::from);
    let ab = b - a;
    let ac = c - a;
    let start = a - o;
    let rows = [Row::cross(ab, ac), Row::cross(d, ac), Row::cross(ab, d)];
    let normal = &rows[0];
    let signed_determinant = d.dot(normal.vector);
    let determinant = signed_determinant.abs();
    let sign = if signed_determinant < 0.0 { -1.0 } else { 1.0 };
    let determinant_error = ERROR * d.abs().dot(normal.permanent);
    let least_determinant = determinant - determinant_error;
    // False of NaN too.
    let is_known = determinant / 2.0 < least_determinant;
    if !is_known {
        return None;
    }
    let mut values = [0.0; 3];
    let mut errors = [0.0; 3];
    for (which, row) in rows.iter().enumerate() {
        let value = sign * row.vector.dot(start) / determinant;
        let numerator_error = ERROR * row.permanent.dot(start.abs());
        let of_quotient = numerator_error + value.abs() * determinant_error;
        values[which] = value;
        errors[which] = of_quotient / least_determinant + ERROR * value.abs();
    }
    let [t, u, v] = values;
    let w = 1.0 - u - v;
    let terms = (w * a).abs() + (u * b).abs() + (v * c).abs() + o.abs() + (t * d).abs();
    // The weights' errors move each term by no more than this.
    let [t_error, u_error, v_error] = errors;
    let moved =
        (u_error + v_error + ERROR) * (largest(a) + largest(b) + largest(c)) + t_error * largest(d);
    let size = (largest(terms) * (1.0 - ERROR) - moved).max(0.0);
    let mut known = [KnownValue::default(); 3];
    for (which, row) in rows.iter().enumerate() {
        let length = row.vector.abs().element_sum() - ERROR * row.permanent.element_sum();
        let moved = roundoff * size * length.max(0.0) / (determinant + determinant_error);
        let unit = if which == 0 {
            moved
        } else {
            moved.max(roundoff)
        };
        let off = ALLOWANCE * unit * (1.0 - 1e-9) - errors[which];
        // Most values of kernels are off by less than twice this unit. A limit of 0 is one.
        let is_known = 2.0 * unit <= off;
        if !is_known {
            return None;
        }
        known[which] = KnownValue {
            value: values[which],
            off,
        };
    }
    Some(known)
}

/// True if products of four numbers of this size neither overflow nor underflow.
fn is_moderate(x: f64) -> bool {
    /// 2^200.
    const LARGEST: f64 = f64::from_bits((1023 + 200) << 52);
    x == 0.0 || (1.0 / LARGEST..=LARGEST).contains(&x.abs())
}

fn largest(v: DVec3) -> f64 {
    v.abs().max_element()
}

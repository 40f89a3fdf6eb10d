//! Rays that pass exactly through the middle of a segment, or through a point, of any coordinates.

use crate::arith::Float;

/// A ray through the middle of a segment (or through a point given twice), from about as far away as
/// a vector leads. Where floats allow it the middle lies on its line exactly, though it need be no float itself:
/// the direction is (p - o) + (q - o).
pub(crate) fn exact_ray<F: Float>(ends: [[F; 3]; 2], away: [f64; 3]) -> ([F; 3], [F; 3]) {
    let [p, q] = ends;
    let axes = [0, 1, 2].map(|i| exact_axis(p[i], q[i], away[i]));
    let origin = axes.map(|axis| axis.origin);
    let direction = axes.map(|axis| axis.direction);
    (origin, direction)
}

/// A ray along one axis.
#[derive(Clone, Copy)]
struct AxisRay<F> {
    origin: F,
    direction: F,
    /// True if d is the sum without rounding.
    is_exact: bool,
}

/// The ray along one axis with d = (p - o) + (q - o). The sum is exact if o is on the coarser grid of p and q, and near
/// enough for d to keep the finer one's digits: so if the wanted distance does not do, a shorter one is taken.
fn exact_axis<F: Float>(p: F, q: F, away: f64) -> AxisRay<F> {
    let wide_p = p.to_f64();
    let wide_q = q.to_f64();
    let middle = wide_p * 0.5 + wide_q * 0.5;
    // Zero is on every grid.
    let coarse = ulp_or(p, 0.0).max(ulp_or(q, 0.0));
    let fine = ulp_or(p, f64::INFINITY).min(ulp_or(q, f64::INFINITY));
    let kept_digits = F::DIGITS - 3;
    let reach = fine * (1u64 << kept_digits) as f64;
    let wanted = AxisRay::from_start(rounded_to(middle - away, coarse), wide_p, wide_q);
    if wanted.is_exact {
        return wanted;
    }
    let within_reach = away.min(reach).max(-reach);
    AxisRay::from_start(rounded_to(middle - within_reach, coarse), wide_p, wide_q)
}

impl<F: Float> AxisRay<F> {
    /// The ray from a rounded start.
    fn from_start(start: f64, p: f64, q: f64) -> AxisRay<F> {
        let origin = F::from_f64(start);
        let (sum, is_exact_sum) = sum_of_differences(p, q, origin.to_f64());
        let direction = F::from_f64(sum);
        AxisRay {
            origin,
            direction,
            is_exact: is_exact_sum && direction.to_f64() == sum,
        }
    }
}

/// The distance from a number to its neighbours; another number for zero.
fn ulp_or<F: Float>(x: F, of_zero: f64) -> f64 {
    if x.is_zero() {
        of_zero
    } else {
        x.ulp().to_f64()
    }
}

/// The nearest multiple of a step; the number itself where that is not finite.
fn rounded_to(x: f64, step: f64) -> f64 {
    let rounded = (x / step).round() * step;
    if rounded.is_finite() { rounded } else { x }
}

/// (p - o) + (q - o), and whether no step rounded.
fn sum_of_differences(p: f64, q: f64, o: f64) -> (f64, bool) {
    let (from_p, error_p) = two_sum(p, -o);
    let (from_q, error_q) = two_sum(q, -o);
    let (sum, error) = two_sum(from_p, from_q);
    let is_exact = error_p == 0.0 && error_q == 0.0 && error == 0.0;
    (sum, is_exact)
}

/// The rounded sum and its error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_as_added = sum - a;
    let a_as_added = sum - b_as_added;
    let error = (a - a_as_added) + (b - b_as_added);
    (sum, error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use num_rational::BigRational;

    fn exact<F: Float>(x: F) -> BigRational {
        BigRational::from_float(x.to_f64()).expect("finite")
    }

    /// How many of the axes of random segments have the middle on the line exactly.
    fn exact_axes<F: Float>(segment: impl Fn(&mut Draw) -> (F, F, f64)) -> usize {
        let mut draw = Draw::new("exact-axes", 1, 0);
        let is_exact = |_: &u32| {
            let (p, q, away) = segment(&mut draw);
            let found = exact_axis(p, q, away);
            let origin = exact(found.origin);
            exact(p) + exact(q) - &origin - &origin == exact(found.direction)
        };
        (0..1000).filter(is_exact).count()
    }

    #[test]
    fn the_middle_of_nearly_every_segment_is_on_a_ray_exactly() {
        fn near<F: Float>(draw: &mut Draw) -> (F, F, f64) {
            let p = 1.0 + draw.unit();
            let q = p + (draw.unit() - 0.5) / 16.0;
            (F::from_f64(p), F::from_f64(q), draw.unit() * 4.0 - 2.0)
        }
        assert!(exact_axes::<f32>(near) > 990);
        assert!(exact_axes::<f64>(near) > 990);
        // Of very different sizes, one of them zero, and a vertex.
        let apart = |draw: &mut Draw| {
            (
                draw.symmetric::<f32>(),
                F32_SMALL * draw.symmetric::<f32>(),
                draw.unit(),
            )
        };
        assert!(exact_axes::<f32>(apart) > 500);
        assert_eq!(
            exact_axes::<f32>(|draw| (draw.symmetric(), 0.0, draw.unit())),
            1000
        );
        let vertex = |draw: &mut Draw| {
            let p = draw.symmetric::<f64>();
            (p, p, 2.0 * draw.unit())
        };
        assert_eq!(exact_axes::<f64>(vertex), 1000);
    }

    const F32_SMALL: f32 = 1.0 / 1024.0;

    #[test]
    fn nothing_panics_at_the_ends_of_the_range() {
        for p in [0.0f64, -0.0, 5e-324, f64::MAX, f64::MIN_POSITIVE, 1.0] {
            for q in [0.0, f64::MAX, -f64::MAX, 5e-324] {
                for away in [0.0, 1e308, f64::INFINITY, f64::NAN, -1.0] {
                    exact_axis(p, q, away);
                    exact_axis(p as f32, q as f32, away);
                }
            }
        }
    }
}

//! Epsilons that follow the size of each case.

use crate::arith::Float;
use crate::case::Case;
use crate::kernel::Dimension;

/// The unit of a gate's margin on each case: L^p·|d|^q for a dimension (p, q). L is the triangle's
/// longest edge; for t, whose error follows the distance from zero, it is the largest coordinate.
///
/// Computed in `f64` and rounded to the scalar; 1 where that is zero or infinite.
pub(super) struct Scales<F> {
    by_case: Vec<F>,
}

impl<F: Float> Scales<F> {
    pub fn new(cases: &[Case<F>], dimension: Dimension) -> Scales<F> {
        Scales { by_case: cases.iter().map(|case| scale(case, dimension)).collect() }
    }

    /// The largest e for which `e * unit <= margin`, in the scalar's arithmetic.
    pub fn relative(&self, case: usize, margin: F) -> F {
        let unit = self.by_case[case];
        if !margin.is_finite() {
            return margin;
        }
        F::largest_accepted(|e| *e * unit <= margin, || margin / unit)
    }
}

fn scale<F: Float>(case: &Case<F>, dimension: Dimension) -> F {
    let [o, d, a, b, c] = case.vectors().map(|v| glam::DVec3::from(v.map(F::to_f64)));
    let length = if dimension == Dimension::new(1, -1) {
        [o, a, b, c].iter().fold(0.0f64, |most, v| most.max(v.abs().max_element()))
    } else {
        [(a, b), (b, c), (c, a)].iter().fold(0.0f64, |most, (p, q)| most.max(p.distance(*q)))
    };
    let unit = length.powi(dimension.length.into()) * d.length().powi(dimension.direction.into());
    let unit = F::from_f64(unit);
    if unit.is_finite() && F::zero() < unit { unit } else { F::from_f64(1.0) }
}

/// The comparison that means the same at every scale, for a gate of this dimension.
pub fn scale_free_form(dimension: Dimension) -> Option<String> {
    let power = |base: &str, exponent: i8| match exponent {
        0 => None,
        1 => Some(format!(" * {base}")),
        n => Some(format!(" * {base}^{n}")),
    };
    let Dimension { length, direction } = dimension;
    if (length, direction) == (0, 0) {
        return None;
    }
    let base = if dimension == Dimension::new(1, -1) { "M" } else { "L" };
    let mut text = "e".to_owned();
    text.extend(power(base, length));
    match direction {
        -1 => text.push_str(" / |d|"),
        n => text.extend(power("|d|", n)),
    }
    Some(text)
}

/// What L or M stands for in [`scale_free_form`]; empty if neither is in it.
pub fn unit_of_length(dimension: Dimension) -> &'static str {
    if dimension == Dimension::new(1, -1) {
        "M = the largest coordinate of the ray's origin and the triangle"
    } else if dimension.length != 0 {
        "L = the triangle's longest edge"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;

    #[test]
    fn the_relative_margin_is_the_last_epsilon_whose_product_is_accepted() {
        let mut draw = Draw::new("relative", 1, 0);
        for _ in 0..20_000 {
            let unit: f32 =
                draw.symmetric::<f32>().abs() * 2f32.powi(draw.integer(-100, 100) as i32);
            let margin: f32 = draw.symmetric::<f32>() * 2f32.powi(draw.integer(-120, 100) as i32);
            let scales = Scales { by_case: vec![if unit > 0.0 { unit } else { 1.0 }] };
            let unit = scales.by_case[0];
            let e = scales.relative(0, margin);
            if e.is_finite() {
                assert!(e * unit <= margin, "{e:e} {unit:e} {margin:e}");
                assert!(e.next_up() * unit > margin, "{e:e} {unit:e} {margin:e}");
            } else if e > 0.0 {
                assert!(f32::MAX * unit <= margin, "{unit:e} {margin:e}");
            } else {
                assert!(f32::MIN * unit > margin, "{unit:e} {margin:e}");
            }
        }
    }
}

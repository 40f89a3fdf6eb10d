//! Numbers in few digits that are on the safe side of others.

use super::Float;

/// A number of three digits at or above another, or at or below it.
pub fn three_digits<F: Float>(x: F, above: bool) -> F {
    in_digits(x, 3, above)
}

/// A number of two digits at or above another, or at or below it: as many as a sample's quantile deserves.
pub fn two_digits<F: Float>(x: F, above: bool) -> F {
    in_digits(x, 2, above)
}

fn in_digits<F: Float>(x: F, count: usize, above: bool) -> F {
    let is_right = |y: &F| y.is_finite() && if above { x <= *y } else { *y <= x };
    let text = format!("{:.*e}", count - 1, x.to_f64());
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let unit = 10f64.powi(count as i32 - 1);
    let digits = (digits.parse::<f64>().unwrap_or(0.0) * unit).round() as i64;
    let moved = |by: i64| F::parse(&format!("{}e{exponent}", (digits + by) as f64 / unit));
    let tries = [0, if above { 1 } else { -1 }];
    tries
        .into_iter()
        .filter_map(moved)
        .find(is_right)
        .unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;

    #[test]
    fn short_numbers_are_on_the_side_that_is_named() {
        assert_eq!(
            (
                three_digits(1.2344f64, true),
                three_digits(1.2344f64, false)
            ),
            (1.24, 1.23)
        );
        assert_eq!(
            (
                three_digits(-1.2344f64, true),
                three_digits(-1.2344f64, false)
            ),
            (-1.23, -1.24)
        );
        assert_eq!(
            (three_digits(9.999f32, true), three_digits(9.999f32, false)),
            (10.0, 9.9)
        );
        assert_eq!(three_digits(0.0f32, true), 0.0);
        assert_eq!(
            (two_digits(1.2344f64, true), two_digits(-1.2344f64, true)),
            (1.3, -1.2)
        );
        let mut draw = Draw::new("short", 1, 0);
        for _ in 0..20_000 {
            let x = f32::from_bits(draw.bits() as u32);
            if x.is_finite() {
                assert!(
                    three_digits(x, false) <= x && x <= three_digits(x, true),
                    "{x:e}"
                );
                assert!(
                    two_digits(x, false) <= x && x <= two_digits(x, true),
                    "{x:e}"
                );
            }
        }
    }
}

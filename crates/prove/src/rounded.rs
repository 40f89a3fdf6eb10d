//! Numbers in a few digits, rounded up or down so that what is said of them stays true.

/// A positive number in three digits, not below it.
pub fn above(x: f64) -> String {
    short(x, true)
}

/// A positive number in three digits, not above it.
pub fn below(x: f64) -> String {
    short(x, false)
}

/// A number of either sign in three digits, not below it, or not above it.
pub fn signed(x: f64, up: bool) -> String {
    if x < 0.0 {
        format!("-{}", short(-x, !up))
    } else {
        short(x, up)
    }
}

/// The least whole number of units of 10^exponent that is not below a positive number, or the largest that is not above it. A
/// decimal that is read back as this very float counts as equal to it.
fn whole(nearest: f64, exponent: i32, x: f64, up: bool) -> f64 {
    let decimal = format!("{nearest}e{exponent}").parse();
    let decimal: f64 = decimal.expect("a number as it is printed");
    if up && decimal < x {
        nearest + 1.0
    } else if !up && x < decimal {
        nearest - 1.0
    } else {
        nearest
    }
}

fn short(x: f64, up: bool) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !x.is_finite() {
        return x.to_string();
    }
    // Three digits that are rounded to nearest, whatever the exponent.
    let nearest = format!("{x:.2e}");
    let (digits, exponent) = nearest.split_once('e').expect("an exponent");
    let digits: f64 = digits.parse().expect("digits");
    let exponent: i32 = exponent.parse().expect("a whole exponent");
    let digits = whole((digits * 100.0).round(), exponent - 2, x, up);
    let (digits, exponent) = if digits >= 1000.0 {
        (100.0, exponent + 1)
    } else if digits < 100.0 {
        (999.0, exponent - 1)
    } else {
        (digits, exponent)
    };
    if (-2..4).contains(&exponent) {
        let decimals = (2 - exponent).max(0) as usize;
        let text = format!("{:.decimals$}", digits / 10f64.powi(2 - exponent));
        let text = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        text.to_owned()
    } else {
        format!("{:.2}e{exponent}", digits / 100.0)
    }
}

/// A number of units in two decimals, not below it, or not above it.
pub fn units(x: f64, up: bool) -> String {
    if (0.01..1e4).contains(&x) {
        let hundreds = whole((x * 100.0).round(), -2, x, up);
        format!("{:.2}", hundreds / 100.0)
    } else {
        short(x, up)
    }
}

/// An angle in degrees, not below it.
pub fn degrees(angle: f64) -> String {
    let text = above(angle);
    let unit = if text == "1" { "degree" } else { "degrees" };
    format!("{text} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use hairline_core::case::Draw;
    use num_rational::BigRational;

    /// The exact value of a decimal.
    fn exact(text: &str) -> BigRational {
        let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let (whole, decimals) = digits.split_once('.').unwrap_or((digits, ""));
        let exponent = exponent.parse::<i32>().unwrap() - decimals.len() as i32;
        let ten = BigRational::from_integer(10.into());
        let digits = format!("{whole}{decimals}").parse().unwrap();
        BigRational::from_integer(digits) * ten.pow(exponent)
    }

    #[test]
    fn numbers_are_on_the_side_that_is_said_of_them() {
        for index in 0..20_000 {
            let mut draw = Draw::new("rounded", 1, index);
            let exponent = draw.integer(-1074, 1023) as i32;
            let near = draw.pick(&[0.01, 0.0101, 1.0, 9.99, 999.0, 9995.0, 0.5, 1e-6, 1e-300]);
            let any = draw.with_exponent::<f64>(exponent).abs();
            let beside = draw.pick(&[0, 1, -1]);
            let x = draw
                .pick(&[any, near])
                .to_bits()
                .wrapping_add_signed(beside);
            let x = f64::from_bits(x);
            if x == 0.0 {
                continue;
            }
            let value = BigRational::from_float(x).unwrap();
            for text in [above(x), units(x, true)] {
                // The decimal of a float is the float.
                let is_itself = text.parse() == Ok(x);
                assert!(value <= exact(&text) || is_itself, "{x:e} {text}");
            }
            for text in [below(x), units(x, false)] {
                let is_itself = text.parse() == Ok(x);
                assert!(exact(&text) <= value || is_itself, "{x:e} {text}");
            }
            // Of three digits one unit of the last is at most a hundredth.
            let apart = exact(&above(x)) - exact(&below(x));
            let hundred = BigRational::from_integer(100.into());
            assert!(apart * hundred <= value, "{x:e}");
        }
        assert_eq!([above(5e-324), below(5e-324)], ["4.94e-324"; 2]);
    }
}

//! An epsilon as people write it.

use crate::arith::Float;
use serde::{Deserialize, Serialize};
use std::fmt;

/// An epsilon before it is rounded to a scalar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum EpsilonText {
    /// Decimal text, rounded to the nearest number of the scalar.
    Decimal(String),
    /// This many times the scalar's distance from 1 to the next number.
    MachineEpsilon(f64),
}

impl EpsilonText {
    /// In a scalar; none if the text is no finite number of it.
    pub fn value<F: Float>(&self) -> Option<F> {
        let value = match self {
            EpsilonText::Decimal(text) => F::parse(text)?,
            EpsilonText::MachineEpsilon(factor) => {
                let rounded = F::from_f64(*factor);
                // A factor beyond the range may have a product within it.
                match rounded.is_finite() {
                    true => F::EPSILON * rounded,
                    false => F::from_f64(F::EPSILON.to_f64() * factor),
                }
            }
        };
        value.is_finite().then_some(value)
    }

    /// In a scalar; none if it is too large there, or so small that it is 0.
    pub fn fitting<F: Float>(&self) -> Option<F> {
        let value: F = self.value()?;
        let is_lost = value.is_zero() && !self.is_zero();
        (!is_lost).then_some(value)
    }

    /// True if it is written as zero.
    fn is_zero(&self) -> bool {
        match self {
            EpsilonText::Decimal(text) => is_written_as_zero(text),
            EpsilonText::MachineEpsilon(factor) => *factor == 0.0,
        }
    }

    /// `EPSILON`, `-EPSILON` or `k*EPSILON`; decimal text otherwise, not checked. None if k is no number.
    pub fn of(text: &str) -> Option<EpsilonText> {
        let Some(before) = text.strip_suffix("EPSILON") else {
            return Some(EpsilonText::Decimal(text.to_owned()));
        };
        let factor = match before {
            "" => 1.0,
            "-" => -1.0,
            _ => before.strip_suffix('*').and_then(factor)?,
        };
        Some(EpsilonText::MachineEpsilon(factor))
    }
}

/// The factor of a text; none if it is no number, or so small that it would be 0.
fn factor(text: &str) -> Option<f64> {
    let factor: f64 = text.parse().ok()?;
    let is_lost = factor == 0.0 && !is_written_as_zero(text);
    (!is_lost).then_some(factor)
}

/// True if no digit before the exponent is above 0.
fn is_written_as_zero(text: &str) -> bool {
    let mut significand = text.chars().take_while(|c| !matches!(c, 'e' | 'E'));
    significand.all(|c| !matches!(c, '1'..='9'))
}

impl fmt::Display for EpsilonText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EpsilonText::Decimal(text) => f.write_str(text),
            EpsilonText::MachineEpsilon(factor) if *factor == 1.0 => f.write_str("EPSILON"),
            EpsilonText::MachineEpsilon(factor) if (1e-3..1e6).contains(&factor.abs()) => {
                write!(f, "{factor}*EPSILON")
            }
            EpsilonText::MachineEpsilon(factor) => write!(f, "{factor:e}*EPSILON"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_is_neither_lost_nor_too_large_where_its_product_fits() {
        let value = |text: &str| EpsilonText::of(text)?.value::<f32>();
        assert_eq!(
            value("1e40*EPSILON"),
            Some((1e40 * f64::from(f32::EPSILON)) as f32)
        );
        assert_eq!(value("-2*EPSILON"), Some(-2.0 * f32::EPSILON));
        assert_eq!(value("0*EPSILON"), Some(0.0));
        assert_eq!(value("-EPSILON"), Some(-f32::EPSILON));
        for text in [
            "1e-400*EPSILON",
            "2EPSILON",
            "*EPSILON",
            "-*EPSILON",
            "1e60*EPSILON",
        ] {
            assert_eq!(value(text), None, "{text}");
        }
    }
}

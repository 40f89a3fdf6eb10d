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
            EpsilonText::MachineEpsilon(factor) => F::EPSILON * F::from_f64(*factor),
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
            EpsilonText::Decimal(text) => {
                let mut significand = text.chars().take_while(|c| !matches!(c, 'e' | 'E'));
                significand.all(|c| !matches!(c, '1'..='9'))
            }
            EpsilonText::MachineEpsilon(factor) => *factor == 0.0,
        }
    }

    /// `EPSILON`, `-EPSILON` or `k*EPSILON`; decimal text otherwise, not checked. None if k is no number.
    pub fn of(text: &str) -> Option<EpsilonText> {
        let Some(before) = text.strip_suffix("EPSILON") else {
            return Some(EpsilonText::Decimal(text.to_owned()));
        };
        let factor = match before.strip_suffix('*').unwrap_or(before) {
            "" => 1.0,
            "-" => -1.0,
            number => number.parse().ok()?,
        };
        Some(EpsilonText::MachineEpsilon(factor))
    }
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

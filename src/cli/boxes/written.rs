//! A box and a ray as JSON.

use hairline_boxes::BoxCase;
use hairline_core::{Float, ScalarName};
use serde::Deserialize;

/// A case of either scalar.
pub enum AnyBoxCase {
    F32(BoxCase<f32>),
    F64(BoxCase<f64>),
}

/// A case in JSON. Numbers are the nearest doubles; those of `f32` are rounded once more, which leaves a float alone.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WrittenCase {
    scalar: ScalarName,
    origin: WrittenVector,
    direction: WrittenVector,
    min: WrittenVector,
    max: WrittenVector,
    #[serde(default)]
    t_min: f64,
    /// Infinite if it is not said.
    #[serde(default)]
    t_max: Option<f64>,
}

/// JSON has no NaN: it is `null`.
type WrittenVector = [Option<f64>; 3];

impl WrittenCase {
    /// The case in its scalar.
    pub fn read(&self) -> AnyBoxCase {
        match self.scalar {
            ScalarName::F32 => AnyBoxCase::F32(self.numbers()),
            ScalarName::F64 => AnyBoxCase::F64(self.numbers()),
        }
    }

    fn numbers<F: Float>(&self) -> BoxCase<F> {
        let number = |x: Option<f64>| F::from_f64(x.unwrap_or(f64::NAN));
        let vector = |numbers: WrittenVector| numbers.map(number);
        let corners = [vector(self.min), vector(self.max)];
        let case = BoxCase::new(vector(self.origin), vector(self.direction), corners);
        let t_max = self.t_max.unwrap_or(f64::INFINITY);
        case.on(F::from_f64(self.t_min), F::from_f64(t_max))
    }
}

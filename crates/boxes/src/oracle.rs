//! The truth in two layers, and its comparison with the definition.

use crate::case::BoxCase;
use crate::define::define;
use crate::truth::Truth;
use crate::{filter, integers};
use hairline_core::Float;

/// How often each layer decided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layers {
    /// Comparisons in `f64` with bounds on their errors.
    pub filter: u64,
    /// Integers.
    pub integers: u64,
}

/// The truth of a case.
///
/// ```
/// use hairline_boxes::{BoxCase, Class, Truth, truth};
///
/// // Straight at a corner of the unit cube, and past the rest of it.
/// let case = BoxCase::<f32>::new([2.0, 0.0, 1.0], [-1.0, 1.0, 0.0], [[0.0; 3], [1.0; 3]]);
/// let Truth::Meets(meeting) = truth(&case) else { panic!() };
/// assert_eq!(meeting.class, Class::Corner);
/// ```
pub fn truth<F: Float>(case: &BoxCase<F>) -> Truth {
    truth_counted(case, &mut Layers::default())
}

/// The truth of a case, and a count for the layer that decided it.
pub fn truth_counted<F: Float>(case: &BoxCase<F>, layers: &mut Layers) -> Truth {
    let wide = case.widen();
    if let Some(truth) = filter::decide(&wide) {
        layers.filter += 1;
        return truth;
    }
    layers.integers += 1;
    integers::decide(&wide)
}

/// The truth that the integers give without the filter.
pub fn truth_in_integers<F: Float>(case: &BoxCase<F>) -> Truth {
    let wide = case.widen();
    match filter::decide(&wide) {
        Some(truth @ (Truth::Invalid | Truth::Empty)) => truth,
        _ => integers::decide(&wide),
    }
}

/// Compares both layers with the definition; an error shows the case on which they differ.
pub fn check<F: Float>(case: &BoxCase<F>) -> Result<Truth, String> {
    let defined = define(case).truth;
    for (layer, found) in [
        ("layers", truth(case)),
        ("integers", truth_in_integers(case)),
    ] {
        if found != defined {
            let case = case.hex();
            return Err(format!(
                "{layer}: {found:?}, by definition {defined:?}: {case}"
            ));
        }
    }
    Ok(defined)
}

//! Numbers as people write them: epsilons, shares, costs, errors, and limits with their ends.

use super::record::*;
use crate::arith::{Float, ScalarName, smallest_normal};
use crate::page::Cell;
use hairline_record::{Rate, group_digits};

/// A shortest decimal as people write it.
pub(super) fn human(epsilon: &str) -> String {
    match epsilon.parse::<f64>() {
        Ok(value) if (1e-4..1e7).contains(&value.abs()) => format!("{value}"),
        _ => epsilon.to_owned(),
    }
}

/// `3e-6`.
pub(super) fn short_error(error: Option<f64>) -> String {
    match error {
        None => "inf".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(error) => format!("{error:.0e}"),
    }
}

/// A cost, as weighted wrong answers in a hundred rays of each kind: `0.52`, `14.1`, `315`.
pub(super) fn cost_text(cost: f64) -> String {
    let per_hundred = 100.0 * cost;
    match per_hundred {
        0.0 => "0".to_owned(),
        ..9.995 => format!("{per_hundred:.2}"),
        ..99.95 => format!("{per_hundred:.1}"),
        _ => format!("{per_hundred:.0}"),
    }
}

/// A rate in a table, as [`share`] writes it.
pub(super) fn share_cell(rate: &Rate) -> Cell {
    Cell::rate(rate, share(rate))
}

/// `0 of 40,000`, `1 in 1,200`, `2.9%`.
pub(super) fn share(rate: &Rate) -> String {
    match rate.rate {
        None => "-".to_owned(),
        Some(0.0) => format!("0 of {}", group_digits(rate.of)),
        Some(share) if share < 0.01 => {
            let one_in = 1.0 / share;
            let unit = 10f64.powi((one_in.log10().floor() as i32 - 1).max(0));
            format!(
                "1 in {}",
                group_digits(((one_in / unit).round() * unit) as u64)
            )
        }
        Some(share) => format!("{:.1}%", share * 100.0),
    }
}

/// `>= 1.2e-6`, or that no value keeps the limit.
pub(super) fn bound(value: Option<&str>, is_lower: bool, unit: &str) -> String {
    match value {
        Some(value) => format!(
            "{} {}{unit}",
            if is_lower { ">=" } else { "<=" },
            human(value)
        ),
        None => "no value".to_owned(),
    }
}

/// A limit from its safe end to its far one, or that it is unsure.
pub(super) fn interval(limit: &KnobLimitPart, unit: &str) -> String {
    let safe = bound(limit.value.as_deref(), limit.is_lower, "");
    let Some(value) = &limit.value else {
        return safe;
    };
    match (&limit.far, limit.is_unsure) {
        (Some(far), false) if far == value => format!("{safe}{unit}"),
        (Some(far), false) => format!("{safe} ({}){unit}", human(far)),
        (Some(far), true) => {
            let mut ends = [value, far];
            ends.sort_by(|a, b| {
                number(Some(a))
                    .partial_cmp(&number(Some(b)))
                    .expect("numbers")
            });
            format!("unsure: {} to {}{unit}", human(ends[0]), human(ends[1]))
        }
        (None, _) => format!("unsure: from {}{unit} on", human(value)),
    }
}

/// The number of a text.
pub(super) fn number(text: Option<&String>) -> Option<f64> {
    text?.parse().ok()
}

/// The shortest decimal of an epsilon.
pub fn shortest<F: Float>(epsilon: F) -> String {
    if epsilon.is_zero() {
        "0".to_owned()
    } else {
        format!("{epsilon:e}")
    }
}

/// The smallest normal number of the scalar of a name.
pub(super) fn least_normal(scalar: ScalarName) -> f64 {
    if scalar == ScalarName::F32 {
        smallest_normal::<f32>()
    } else {
        smallest_normal::<f64>()
    }
}

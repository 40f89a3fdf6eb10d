//! Numbers as records and people read them.

pub use crate::plot::{group_digits, number_of};
use serde::{Deserialize, Deserializer};

/// Reads a number that is written as null where it is infinite, as JSON has no word for that.
pub fn or_infinite<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

//! Floor 2: cases on disk. Takes readers and writers; opens no file itself.

#![forbid(unsafe_code)]

pub mod case_json;
mod found_by;
pub mod lines;
mod plain_json;
mod stored_case;
mod stored_truth;
pub mod truth_json;

pub use found_by::FoundBy;

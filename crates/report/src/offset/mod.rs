//! Where new rays start: the record of `offset`, and its page.

mod choice;
mod compared;
mod page;
mod record;

pub use choice::{least_without_failure, made_for};
pub use record::*;

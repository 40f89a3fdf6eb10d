//! Where new rays start: the record of `offset`, and its page.

mod choice;
mod compared;
mod page;
mod record;

pub use choice::made_for;
pub use record::*;

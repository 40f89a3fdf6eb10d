//! Where new rays start: the record of `offset`, and its page.

mod choice;
mod compared;
mod page;
mod record;
mod table;
mod terms;

pub use choice::made_for;
pub use record::*;

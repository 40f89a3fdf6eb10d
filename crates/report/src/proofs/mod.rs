//! Statements that hold for every float of a domain: the record of `prove`, and its page.

mod page;
mod record;
mod verdicts;

pub use record::*;
pub use verdicts::*;

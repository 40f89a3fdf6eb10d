//! The worst case of each kernel and gate, found by climbing, and the table of the worst known.

mod climb;
mod table;

pub use climb::family_case;
pub use climb::{Found, Goal, LANES, exact_score, search};
pub use table::{Entry, Table, Update, find_worst, replay};

//! The worst case of each kernel and gate, found by climbing, and the table of the worst known.

mod climb;
mod table;

pub use climb::{FoundWorst, LANES, WorstGoal, exact_score, family_case, search};
pub use table::{Update, WorstEntry, WorstTable, find_worst, replay};

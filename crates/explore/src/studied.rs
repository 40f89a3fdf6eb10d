//! The search for the worst case, compiled in this crate for both scalars, as `hairline_study::studied` has its studies.

use crate::worst::{self, WorstEntry, WorstGoal};

hairline_study::studied! {
    Searched;
    worst::find_worst::<Self>: fn find_worst(
        goals: &[WorstGoal],
        evaluations: u64,
        seed: u64,
    ) -> Vec<Option<WorstEntry>>;
}

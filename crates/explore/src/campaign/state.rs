//! The state that a campaign saves now and then: counters and population. It reads the known kinds from its finds.

use crate::arith::ScalarName;
use serde::{Deserialize, Serialize};

/// Counters and population between two rounds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CampaignState {
    /// Rounds until now.
    pub rounds: u64,
    /// Evaluations until now.
    pub evaluations: u64,
    /// Seconds until now, as counted by the caller, who has a clock.
    pub seconds: f64,
    /// Sessions until now: how often the campaign was begun or resumed.
    pub sessions: u64,
    /// All individuals.
    pub population: Vec<SavedIndividual>,
}

/// A case with epsilons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedIndividual {
    /// The kernel.
    pub kernel: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// The epsilons, as `--epsilon` takes them.
    pub epsilons: Option<String>,
    /// The contract, as `--contract` takes it.
    #[serde(default = "own")]
    pub contract: String,
    /// The case's bits, as [`Case::bits`](crate::case::Case::bits) has them.
    pub bits: Vec<u64>,
}

fn own() -> String {
    "own".to_owned()
}

//! Floor 4: which epsilons for a scene, or on families and stored cases: all of a kernel's together, weighed by what
//! wrong answers cost.
//!
//! A *knob* is a number that can be chosen: a gate's epsilon, or the least t that counts. Each ray of a
//! stratum, or of a family, is a trial, and its margins say at which values of the knobs it is a hit. One pass counts
//! trials on a grid of all knobs; the cheapest point is the recommendation. Further passes find how far
//! each knob may move, and try everything on rays of another seed.

#![forbid(unsafe_code)]

mod candidates;
mod confidence;
mod crossings;
mod curves;
mod errors;
mod fresh;
mod joint;
mod knob;
mod limits;
mod margins;
mod measure;
mod picture;
mod prepared;
mod proved;
mod queue;
mod race;
mod rays;
mod relative;
mod shared;
mod study;
#[cfg(test)]
mod tests;
mod trials;

/// Rays of each stratum, if nothing says how many: enough to show one in 10,000.
pub const COUNT: u64 = 40_000;

pub use confidence::{CONFIDENCE, ranks};
pub use curves::Curve;
pub use errors::{ERRORS_ONE_IN, ErrorSums, HitErrors, MaxError, Value, hit_errors};
pub use fresh::{OnFresh, Tried};
pub use joint::Costs;
pub use knob::{Knob, LEAST_T, MOST_KNOBS, contract_with};
pub use limits::{KnobLimit, limits};
pub use measure::{Attempt, count_at};
pub use prepared::Store;
pub use proved::{ProvedValue, proved};
pub use race::{Contender, CostSeen, surely_dearer};
pub use rays::{RayCount, Rays, WrongKind, counts, counts_of};
pub use relative::scale_free_form;
pub use shared::SharedCases;
pub use study::{
    Chosen, Elsewhere, SCALE_FREE, SceneStudy, cheapest, choose, own_epsilons, study_scene,
    try_elsewhere, try_on_fresh,
};
pub use trials::{Pass, Setting, StudiedRays, Trial, fresh_seed};

//! Floor 4: fuzz campaigns, which go on past the first finding and count the kinds.
//!
//! Coverage says nothing about rounding errors; closeness to the boundary does. A [`Campaign`] keeps one
//! island for each kernel and scalar: a bounded population of cases with epsilons. The population is
//! sorted by kind of finding; cases without a finding are sorted by class of truth and deciding gate. An
//! island makes new cases from the families at many scales, and by moves from the cases that it keeps. It
//! prefers margins near their epsilon, then worse findings. Each new
//! [`Signature`](crate::Signature) becomes a [`Find`], simplified with bounded effort.
//!
//! Architecture invariant: what is found depends on the rows, the seed and the number of evaluations,
//! never on a clock or the number of threads.

mod find;
mod island;
mod population;
mod run;
mod state;

pub use find::Find;
pub use run::{Campaign, CampaignPlan};
pub use state::{CampaignState, SavedIndividual};

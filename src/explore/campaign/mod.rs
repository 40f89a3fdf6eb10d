//! Floor 4: fuzz campaigns, which go on past the first finding and count the kinds.
//!
//! Coverage says nothing about rounding errors; closeness to the boundary does. A [`Campaign`] keeps
//! for each kernel and scalar an island: a bounded population of cases with epsilons, by kind of
//! finding, and by class of truth and deciding gate where there is none yet. It makes new ones from
//! the families at many scales, and by moves from those it keeps; it prefers margins near their
//! epsilon, then findings that are worse. Each new [`Signature`](crate::explore::Signature) is a
//! [`Find`], made simpler with bounded effort.
//!
//! Architecture invariant: what is found depends on the rows, the seed and the number of evaluations,
//! never on a clock nor the number of threads.

#![forbid(unsafe_code)]

mod epsilons;
mod find;
mod island;
mod population;
mod run;
mod state;

pub use find::{Find, FindError};
pub use run::{Campaign, Plan};
pub use state::{SavedIndividual, State};

//! Floor 4: searches for the worst case of a kernel, and for the simplest of a kind.
//!
//! [`search`] climbs from the families' cases towards the largest error of a margin or a value, the
//! false miss farthest inside, the false hit farthest outside; [`shrink`] walks from any case to one
//! with fewer bits that still shows the same. Both use moves on cases: random ones ([`mutate`]) and a
//! fixed list of simplifications ([`Simplification`]).
//!
//! Architecture invariant: everything is a function of its arguments. Seeds and counts decide, never
//! a clock nor the number of threads.

#![forbid(unsafe_code)]

mod climb;
mod decimal;
mod domain;
mod moves;
mod objective;
mod shrink;
mod signature;
mod simplify;
mod snippet;
mod table;

pub(crate) use climb::family_case;
pub use climb::{Found, Goal, LANES, exact_score, search};
pub use decimal::Decimal;
pub use domain::Domain;
pub use moves::mutate;
pub use objective::{Objective, Scorer, Target};
pub(crate) use objective::{scale, verdict_and_finding};
pub use shrink::{KEPT_SHARE, Shrunk, shrink, shrink_finding, shrink_scored};
pub use signature::Signature;
pub use simplify::{Change, SIMPLIFICATIONS, ScaleBy, Simplification, Size};
pub use snippet::{c_snippet, rust_snippet};
pub use table::{Entry, Table, Update, find_worst, replay};

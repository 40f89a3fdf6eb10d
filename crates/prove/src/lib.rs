//! Bounds of a ray–triangle kernel's errors that hold for every float of a domain, next to the worst cases that are
//! known in it, with certificates and a checker of its own.

#![forbid(unsafe_code)]

pub use hairline_checker as checker;
use hairline_core::{arith, case, contract, kernel};

mod bound;
mod builder;
pub mod certificate;
mod claims;
mod climb;
mod corners;
mod depth;
mod domain;
mod dyadic;
mod facts;
mod forms;
mod formula;
mod gates;
mod judged;
mod meaning;
mod measures;
mod mirrors;
mod names;
mod normal;
mod order;
mod others;
mod permanent;
mod quotient;
pub mod repair;
mod rounded;
mod run;
mod samples;
mod scene;
mod sizes;
mod starts;
mod statement;
mod summary;
#[cfg(test)]
mod tests;
mod unit;
mod verdict;
mod walk;
mod watertight;
mod witness;

pub use bound::{Bound, Lemma, Prover, Rule};
pub use depth::case_of;
pub use domain::{Domain, Format};
pub use dyadic::Dyadic;
pub use forms::Leaf;
pub use formula::{Formula, Maximum, Step, VariableOrigin};
pub use gates::{Assumption, Proof, Quantity, Uses, compared};
pub use judged::{Judged, VERDICTS, useful_scenes};
pub use meaning::Scale;
pub use measures::{Limit, Measures, Sample};
pub use names::Names;
pub use order::{is_at_most, is_impossible};
pub use others::{End, Other, WrongDecisions};
pub use permanent::{Relative, Roundings, relative};
pub use rounded::{above, below, units};
pub use run::{parts, run};
pub use scene::{Scene, Shape};
pub use sizes::BySize;
pub use statement::{Published, Triangles, about_edges, statements};
pub use summary::{
    Effort, GOALS, GateSummary, Summary, Witness, bound_of_gate, format_of, paths_of,
};
pub use verdict::{Depth, Farthest, USELESS, Verdicts, supposes_weights, verdicts};
pub use watertight::Symmetry;
pub use witness::{Goal, Inputs, Search, Searched};

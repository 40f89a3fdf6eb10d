//! Floor 4: what a kernel can never do wrong. Bounds that hold for every float of a domain, beside the
//! worst cases that are known in it.

#![forbid(unsafe_code)]

mod bound;
pub mod certificate;
mod domain;
mod dyadic;
mod forms;
mod formula;
mod fpcore;
mod gappa;
mod permanent;
mod sign;
#[cfg(test)]
mod tests;

pub use bound::{Bound, Lemma, Prover, Rule, is_impossible};
pub use domain::{Domain, Format};
pub use dyadic::Dyadic;
pub use forms::Leaf;
pub use formula::{Formula, Maximum, Source, Step};
pub use fpcore::fpcore;
pub use gappa::gappa;
pub use permanent::{Relative, Roundings, relative};

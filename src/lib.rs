//! The truth about ray–triangle kernels: exact orientation predicates against floating-point tests
//! with epsilons, on the cases where they break.
//!
//! ```text
//! Case ──► Kernel ──► Verdict ─┐
//!   │                          ├─► judge ──► Finding ──► Tally ──► Record ──► text, JSON
//!   └────► Oracle ──► Truth ───┘
//!                       ▲
//!              Contract ┘  (what the kernel promises: must hit, must miss, free)
//! ```
//!
//! The modules are floors, each knowing only those below it (and its neighbours on the same floor):
//!
//! | floor | modules |
//! |---|---|
//! | 6 | [`cli`]: one file a command, the only place that prints; [`audit()`]: an audit from a program's own tests |
//! | 5 | [`report`]: the record and its formats; `expect`: what is known to be wrong |
//! | 4 | [`mod@audit`]: plans, runs, sums, severity; [`epsilon`]: every epsilon; [`explore`]: the worst, the simplest, campaigns; [`map`]: pictures of verdicts; [`mesh`]: whether rays slip through a mesh; [`selfcheck`]: the oracle held to its definition |
//! | 3 | [`judge`]: the only place that compares a verdict with a truth |
//! | 2 | [`kernel`]: what is claimed; [`oracle`]: what is true; [`family`]: where cases come from; [`corpus`]: cases and meshes on disk |
//! | 1 | [`case`], [`truth`], [`contract`]: the words |
//! | 0 | [`arith`]: `f32` and `f64` on glam's vectors, and exact numbers |
//!
//! Orientation predicates are kernels of a kind of their own: points instead of rays, a sign instead
//! of a hit. [`orientation`] holds them beside floors 2 to 4, with their table, families, exact
//! determinant and audit; it takes only `arith`, [`case::Draw`] and the audit's clock from the rest.
//!
//! A new kernel is one file in `kernel/` and one row in its registry; a new family one file in
//! `family/` and one row; a new format one file in `report/` and one row.

pub mod arith;

pub mod case;
pub mod contract;
mod plot;
mod suggest;
pub mod truth;

pub mod corpus;
pub mod family;
pub mod kernel;
pub mod oracle;

pub mod judge;

pub mod audit;
pub mod epsilon;
pub mod explore;
pub mod mesh;
pub mod selfcheck;
#[cfg(feature = "proptest")]
pub use explore::strategy;

pub mod orientation;

pub mod map;

pub mod report;

mod conformance;

pub use conformance::{Outcome, Request, audit};
#[cfg(feature = "cli")]
use conformance::{Unobserved, conforms};

#[cfg(feature = "cli")]
pub mod plugin;

#[cfg(feature = "cli")]
pub mod expect;

#[cfg(feature = "cli")]
pub mod cli;

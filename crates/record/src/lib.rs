//! The record of a run: one kind for all commands, with a version and a checksum, from which every page and format is
//! made; and what stands in the record of an audit.
//!
//! It is a part of the program `hairline`. The schema of records is stable; this interface changes with the program.

#![forbid(unsafe_code)]
#![cfg_attr(not(feature = "studies"), allow(dead_code, unused_imports))]

#[macro_use(in_named_scalar, named)]
extern crate hairline_core;
#[macro_use]
extern crate macro_rules_attribute;
use hairline_cases::family;
use hairline_core::{arith, case, contract, engine, kernel};
use hairline_files as files;
use hairline_study::{audit, judge, plot};

/// The derives of a part of a record: it is written and read, a field that it does not know is an error, and tests know
/// its schema. A crate that uses it has a feature `schema`.
#[macro_export]
macro_rules! part {
    ($($item:tt)*) => {
        #[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[serde(deny_unknown_fields)]
        $($item)*
    };
}

// The floors, from the ground up: each module uses only those above it in this list.
mod class;
#[cfg(feature = "studies")]
mod drawing;
mod illustration;
mod kind;
mod number;
mod part;
mod plan;
mod rate;

mod finding;
mod mesh;

mod result;

#[cfg(feature = "studies")]
mod checked;
mod key;
mod study;

mod conformance;

mod record;

mod disagreement;
mod distribution;
#[cfg(feature = "studies")]
mod surface;

mod build;

#[cfg(feature = "studies")]
mod shard;

pub use build::{Context, build, provenance_of};
pub use class::FindingClass;
pub use conformance::*;
pub use disagreement::{
    Disagreement, across, counts_alone, cracks, disagreements, family_of, is_at_shared, kinds_of,
    polygons, rate_of,
};
#[cfg(feature = "studies")]
pub use drawing::{AROUND, DrawnRow, MeshDrawing, MeshMark, PLACES, drawing, places};
pub use finding::*;
pub use illustration::{Illustrations, ProofPart, ProvedGate};
pub use key::Key;
pub use kind::{FindingKind, Promised};
pub use mesh::*;
pub use number::{group_digits, number_of, or_infinite};
pub use part::{PartialPart, ShardPart};
pub use plan::*;
pub use rate::{Rate, interval_of, percent};
pub use record::{Record, SCHEMA};
pub use result::*;
#[cfg(feature = "studies")]
pub use shard::{Mergeable, ShardError, mergeable, merged, shard_part};
pub use study::{Comparable, Findings, NamedRate, NamedValue, Study};

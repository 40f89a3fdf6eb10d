//! Floor 4: where a new ray starts that leaves a hit point, such as a shadow ray.
//!
//! ```text
//! first ray ──► kernel ──► t, u, v ──► hit point ──► Scheme ──► Start ──► oracle: on which side of the
//!                                                                        plane? ──► sums, a scheme each
//! ```
//!
//! A hit point is rounded, so it lies beside the triangle's exact plane, and a new ray that starts there may
//! hit its own triangle. An *offset scheme* moves the start: along the normal, or by a least t. The start
//! is right if it lies strictly on the side from which the first ray came. The oracle decides that: the new
//! ray's line meets the plane at an exact t, and the start is right where that t is before its t_min.
//!
//! A *segment* that goes to a hit point has the same question at its other end (`segment.rs`).
//!
//! To add a scheme: write its formula in `published.rs` and give it a row in [`PUBLISHED`].

#![forbid(unsafe_code)]

mod derived;
mod hit;
mod neighbour;
mod plane;
mod published;
mod race;
mod run;
mod scheme;
mod segment;
mod sums;
mod trial;

pub use derived::{ROOM, derived_normal, least_weight};
pub use hit::{HitPoint, Offset, Start};
pub use plane::Plane;
pub use published::{PUBLISHED, Parameter, PublishedScheme};
pub use race::first_without_failure;
pub use run::{Least, OffsetPlan, least, new_ray, run};
pub use scheme::{Scheme, all, default_schemes, describe, needs_t, parse, register};
pub use segment::{SegmentEnd, SegmentPlan, SegmentSums, run_segments};
pub use sums::{Heights, Lengths, OfScheme, OffsetSums};
pub use trial::{OffsetTrial, OffsetTrials, PointKind};

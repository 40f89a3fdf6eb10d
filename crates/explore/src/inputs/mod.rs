//! Bytes to inputs near trouble and back, for the fuzz targets and for `hairline fuzz triage`, which
//! reads their artifacts. What the targets check stands beside them, in fuzz/src/checks.rs.
//!
//! ```text
//! bytes ──► Input (kernel, epsilons, case)
//!   ▲            │
//!   └── to_bytes ┴ mutated
//! ```
//!
//! Any bytes are an input. Short ones build a degenerate construction in small integers and nudge it by
//! ulps, so mutations of bytes stay near the places where kernels break. Long ones give all numbers, so
//! any case has bytes, and moves on cases ([`mutated`]) can be written back. The crate
//! `arbitrary` reads bytes in the same way, but cannot turn a value into bytes.

mod bytes;
mod construction;
mod input;

pub use construction::CONSTRUCTIONS;
pub use input::{AnyInput, Input, MAX_GATES, from_bytes, mutated, of_kernel, to_bytes};

//! Floor 4: what fuzz targets and triage share: bytes to questions near trouble and back, and the
//! claims that must hold on every one of them.
//!
//! ```text
//! bytes ──► Input (kernel, epsilons, case) ──► check_* ──► a contradiction of our own, or none
//!   ▲            │                        └──► disagreement: what the kernel got wrong
//!   └── to_bytes ┴ mutated
//! ```
//!
//! Any bytes are an input. Short ones build a degenerate construction in small integers and nudge it by
//! ulps, so that mutations of bytes stay near trouble; long ones give all numbers, so that any case has
//! bytes and moves on cases ([`AnyInput::mutated`]) can be written back. The crate `arbitrary` reads bytes
//! in the same spirit, but has no way back from a value to bytes.

#![forbid(unsafe_code)]

mod bytes;
mod checks;
mod construction;
mod input;

pub use checks::{
    Contradiction, check_kernel, check_oracle, check_orientation, check_response, disagreement,
};
pub use construction::CONSTRUCTIONS;
pub use input::{AnyInput, Input, MAX_GATES};

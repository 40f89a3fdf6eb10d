//! An exact answer to "does this ray meet this axis-aligned box?" for every finite `f32` and `f64`; and the published slab
//! tests that try to give it in floats.
//!
//! ```
//! use hairline_boxes::{BoxCase, truth};
//!
//! let unit_cube = [[0.0; 3], [1.0; 3]];
//! let case = BoxCase::<f64>::new([0.5, 0.5, 2.0], [0.0, 0.0, -1.0], unit_cube);
//! assert_eq!(truth(&case).hits_closed(), Some(true));
//! ```
//!
//! Slab tests are kernels of `hairline-core` on another target, [`Boxes`]: both scalars, margins, exact runs and other
//! machines' arithmetic come from there.

#![forbid(unsafe_code)]

// From the ground up: each block uses only those above it.
mod case;
mod slab;
mod truth;

mod define;
mod distance;
mod filter;
mod integers;

mod family;
mod kernel;
mod oracle;
mod tree;

mod judge;
mod setup;
mod source;

mod audit;
mod epsilon;
mod prove;
mod search;

pub use audit::{Row, Tally, Worst, Wrong, audit};
pub use case::{Bounds, BoxCase, Boxes, NUMBERS};
pub use define::{Definition, Range, define};
pub use distance::{Padding, padding};
pub use epsilon::{Answer, Largest, Question, epsilon};
pub use family::{FAMILIES, Family, Made, case_of, find_family};
pub use judge::{Finding, Obligation, severity};
pub use kernel::{BoxEntry, KERNELS, TABLE};
pub use oracle::{Layers, check, truth, truth_counted, truth_in_integers};
pub use prove::{Domain, Growth, least_growths};
pub use search::{Found, Search, search};
pub use setup::Setup;
pub use source::{Scene, Source};
pub use tree::Tree;
pub use truth::{Class, Meeting, Origin, Overlap, Truth};

//! Floor 4: whether rays slip through a mesh. Rays at every edge and vertex, exact and near, are put to
//! the triangles around it, and judged together: a crossing without a hit is a crack, one with two is a
//! double, and the parity of hits is right or wrong.
//!
//! Only edges of two faces wound consistently and vertices inside one closed fan are asked about; what
//! else a mesh has is recognised exactly and counted ([`Topology`]). Only the triangles around the edge
//! or vertex are asked, not the whole mesh: a hit elsewhere on it is not looked at. Where triangles are
//! needles a rounded ray may pass into a neighbour instead, and is then called a crack all the same.

#![forbid(unsafe_code)]

mod fans;
mod rays;
mod run;
mod tally;
mod topology;

pub use fans::{Fans, VertexKind};
pub use rays::{Aim, Part, Targets};
pub use run::{Found, Plan, RowFound, run};
pub use tally::{CLASSES, ClassSums, Offence, Tally};
pub use topology::{EdgeKind, FaceKind, Noted, SharedEdge, Topology};

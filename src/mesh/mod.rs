//! Floor 2: the edges and vertices of a mesh as a source of cases. Rays at every edge and vertex, exact
//! and near, each with the triangles around it, which are judged together: a crossing without a hit is a
//! crack, one with two is a double, and the parity of hits is right or wrong.
//!
//! Only edges of two faces wound consistently and vertices inside one closed fan are asked about; what
//! else a mesh has is recognised exactly and counted ([`Topology`]).
//!
//! The triangles around the edge or vertex are asked. Where triangles are needles a rounded ray may pass
//! into a neighbour instead: so before a crossing without a hit is called a crack, all triangles that
//! share a point with one of these are asked too, and if one reports a hit though the exact line does not
//! meet it, or the ray may have passed beside a silhouette, the crossing is counted apart, as *elsewhere*
//! ([`crate::judge::may_be_elsewhere`]). Beyond these neighbours the mesh is not asked, and if they are more than
//! [`MOST_AROUND`], nor are they. A double stays one: it is two hits around the edge or vertex itself.

#![forbid(unsafe_code)]

mod fans;
mod neighbours;
mod rays;
mod surface;
mod topology;

pub use fans::{Fans, VertexKind};
pub use neighbours::{Incidence, MOST_AROUND};
pub use rays::{Aim, Part, Targets};
pub use surface::Surface;
pub use topology::{EdgeKind, FaceKind, Noted, SharedEdge, Topology};

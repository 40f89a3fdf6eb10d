//! Floor 2: the edges and vertices of a mesh as a source of cases. Rays at every edge and vertex, exact
//! and near, each with the triangles around it, which are judged together: a crossing without a hit is a
//! crack, one with two is a double, and the parity of hits is right or wrong.
//!
//! Rays are sent only at edges of two consistently wound faces and at vertices inside one closed fan.
//! Everything else in a mesh is recognised exactly and counted ([`Topology`]).
//!
//! A kernel runs on the triangles around the edge or vertex. If triangles are needles a rounded ray may
//! pass into a neighbour instead. So before a crossing without a hit is called a crack, the kernel also
//! runs on all triangles that share a point with one of these. The crossing counts as *elsewhere*
//! (`may_be_elsewhere` of the judge) if one of them reports a hit although the exact line does not meet
//! it, or if the ray may have passed beside a silhouette. Triangles farther away are not tested, nor are
//! the neighbours if there are more than [`MOST_AROUND`]. A double needs no such test: it is two hits
//! around the edge or vertex itself.

#![forbid(unsafe_code)]

mod fans;
mod rays;
#[cfg(feature = "studies")]
mod recognise;
mod scene;
mod surface;
mod topology;

pub use fans::{Fans, VertexKind};
pub use rays::{Aim, AimedPart, Targets};
pub use scene::SceneMesh;
pub use surface::Surface;
pub use topology::{EdgeKind, FaceKind, Incidence, MOST_AROUND, Noted, SharedEdge, Topology};

//! The mesh whose edges and vertices an audit asks about.

use crate::arith::ScalarName;
use std::collections::BTreeMap;

/// The mesh as it was read.
#[apply(part!)]
pub struct MeshPart {
    /// The file as the user named it.
    pub file: String,
    /// The mesh's digest.
    pub digest: String,
    /// Triangles, polygons cut.
    pub triangles: u64,
    /// Vertices of the file.
    pub vertices: u64,
    /// Notes on what the reader skipped, altered or found suspect.
    pub notes: Vec<String>,
    /// Rays at each edge and vertex.
    pub directions: u64,
    /// Which random rays.
    pub seed: u64,
    /// The mesh in each scalar.
    pub scalars: Vec<MeshScalar>,
    /// The places of the groups that are shown as examples, by the ids of their cases.
    pub places: BTreeMap<String, PlacePart>,
}

/// A mesh in one scalar.
#[apply(part!)]
pub struct MeshScalar {
    /// The scalar.
    pub scalar: ScalarName,
    /// The topology of the mesh in this scalar.
    pub topology: TopologyPart,
    /// The distance of two neighbouring numbers of the scalar at the largest coordinate.
    pub spacing: f64,
    /// The longest edge of the smallest triangle with an area.
    #[serde(deserialize_with = "crate::number::or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub smallest: f64,
}

/// The exact topology of a mesh. Vertices with equal coordinates are one point.
#[apply(part!)]
pub struct TopologyPart {
    /// True if all faces are sound, all edges shared and all vertices inside one closed fan.
    pub closed_manifold: bool,
    /// Different points that faces use.
    pub points: u64,
    /// In how many places the duplicated faces lie.
    pub duplicated_places: u64,
    /// `sound`, `collapsed`, `without_area`, `duplicated`, `out_of_range`; and `left_out`, polygons of the file that are not
    /// in the mesh, if there are any.
    pub faces: BTreeMap<String, NotedPart>,
    /// `shared`, `open`, `inconsistent`, `non_manifold`, `unsound`.
    pub edges: BTreeMap<String, NotedPart>,
    /// `closed_fan`, `open_fan`, `several_fans`, `irregular`.
    pub vertices: BTreeMap<String, NotedPart>,
}

/// How many there are of a kind.
#[apply(part!)]
pub struct NotedPart {
    /// How many.
    pub count: u64,
    /// The line of a face of the first; none if the file has no lines.
    pub first_line: Option<u32>,
    /// The number of the face, counted from 1, if the file has no lines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_face: Option<u32>,
    /// The first's points; infinities as null, because JSON has none.
    pub first_points: Vec<[Option<f64>; 3]>,
}

/// A place on a mesh.
#[apply(part!)]
pub struct PlacePart {
    /// The edge's two ends, or the vertex.
    pub points: Vec<[f64; 3]>,
    /// The lines of the faces around it; none if the file has no lines.
    pub lines: Vec<u32>,
    /// The numbers of the faces, counted from 1, if the file has no lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub faces: Vec<u32>,
}

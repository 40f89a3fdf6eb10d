//! The record of a mesh audit, versioned: `result` is the same bytes whatever the number of threads.

use super::drawing::MeshDrawing;
use crate::case::Matrix;
use crate::report::{Promised, Provenance, Rate, RowPart};
use serde::Serialize;
use std::collections::BTreeMap;

/// The schema's name and version.
pub const MESH_SCHEMA: &str = "hairline-mesh/1";

/// Everything that is written of a mesh audit.
pub struct MeshReport {
    /// The record of the findings.
    pub record: MeshRecord,
    /// The drawing in a page, if the plan keeps places.
    pub drawing: Option<MeshDrawing>,
}

/// Everything that a mesh audit found.
#[derive(Clone, Debug, Serialize)]
pub struct MeshRecord {
    /// [`MESH_SCHEMA`].
    pub schema: &'static str,
    /// The findings.
    pub result: MeshResult,
    /// Where and how it was made; never compared.
    pub provenance: Provenance,
}

/// The findings on a mesh.
#[derive(Clone, Debug, Serialize)]
pub struct MeshResult {
    /// The mesh.
    pub mesh: MeshPart,
    /// The rows, in the order of the plan.
    pub rows: Vec<RowPart>,
    /// Rays at each edge and vertex.
    pub directions: u64,
    /// Which random rays.
    pub seed: u64,
    /// True if directions are rounded unit vectors.
    pub unit_directions: bool,
    /// Where the mesh is put, if not where it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instance: Option<Matrix<f64>>,
    /// The findings in each scalar.
    pub scalars: Vec<ScalarPart>,
}

/// The mesh as it was read.
#[derive(Clone, Debug, Serialize)]
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
}

/// A mesh audit in one scalar.
#[derive(Clone, Debug, Serialize)]
pub struct ScalarPart {
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// The topology of the mesh in this scalar.
    pub topology: TopologyPart,
    /// The distance of two neighbouring numbers of the scalar at the largest coordinate.
    pub spacing: f64,
    /// The longest edge of the smallest triangle with an area.
    pub smallest: f64,
    /// Rays at edges and at vertices: how many of each are tested, times the directions.
    pub rays: [u64; 2],
    /// Rays with the triangles that they were put to.
    pub cases: u64,
    /// One a row whose kernel runs in this scalar.
    pub results: Vec<MeshRowResult>,
}

/// The exact topology of a mesh. Vertices with equal coordinates are one point.
#[derive(Clone, Debug, Serialize)]
pub struct TopologyPart {
    /// True if all faces are sound, all edges shared and all vertices inside one closed fan.
    pub closed_manifold: bool,
    /// Different points that faces use.
    pub points: u64,
    /// In how many places the duplicated faces lie.
    pub duplicated_places: u64,
    /// `sound`, `collapsed`, `without_area`, `duplicated`, `out_of_range`; and `left_out`, polygons of the file that are not
    /// in the mesh, if there are any.
    pub faces: BTreeMap<&'static str, NotedPart>,
    /// `shared`, `open`, `inconsistent`, `non_manifold`, `unsound`.
    pub edges: BTreeMap<&'static str, NotedPart>,
    /// `closed_fan`, `open_fan`, `several_fans`, `irregular`.
    pub vertices: BTreeMap<&'static str, NotedPart>,
}

/// How many there are of a kind.
#[derive(Clone, Debug, Serialize)]
pub struct NotedPart {
    /// How many.
    pub count: u64,
    /// The line of a face of the first; none if the file has no lines.
    pub first_line: Option<u32>,
    /// The number of the face, counted from 1, if the file has no lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_face: Option<u32>,
    /// The first's points; infinities as null, because JSON has none.
    pub first_points: Vec<[f64; 3]>,
}

/// The results of a row in one scalar.
#[derive(Clone, Debug, Serialize)]
pub struct MeshRowResult {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The contract's promise: `nothing`, `at-least-one`, `exactly-one`.
    pub promised: Promised,
    /// At edges of two triangles.
    pub edges: MeshPartResult,
    /// At vertices inside closed fans.
    pub vertices: MeshPartResult,
}

impl MeshRowResult {
    /// `kernel (epsilons)`.
    pub fn label(&self) -> String {
        format!("{} ({})", self.kernel, self.set)
    }

    /// How many edges and vertices leak.
    pub fn leaks(&self) -> u64 {
        self.edges.cracked + self.vertices.cracked
    }

    /// The sum of a rate over edges and vertices.
    pub fn both(&self, rate: fn(&AcrossRates) -> &Rate) -> Rate {
        Rate::sum([&self.edges.total, &self.vertices.total].map(rate))
    }

    /// How many hits are promised, and whether that was kept; none if nothing is promised.
    pub fn promise(&self) -> Option<(&'static str, bool)> {
        let wrong = |rate: fn(&AcrossRates) -> &Rate| 0 < self.both(rate).count;
        let more = wrong(|rates| &rates.doubles) || wrong(|rates| &rates.odd_folds);
        let is_kept = 0 == self.leaks() && !(more && self.promised == Promised::ExactlyOne);
        self.promised.in_short().map(|hits| (hits, is_kept))
    }
}

/// The results of a row at the edges, or at the vertices.
#[derive(Clone, Debug, Serialize)]
pub struct MeshPartResult {
    /// How many of them some ray found a crack at.
    pub cracked: u64,
    /// How many were tested.
    pub of: u64,
    /// All classes together.
    pub total: AcrossRates,
    /// By class: `exact`, `exact-grazing`, `near`, `near-grazing`.
    pub classes: BTreeMap<&'static str, MeshClassResult>,
    /// Rays on which the kernel panicked, crashed or gave no answer: not judged.
    pub failures: u64,
    /// The first of them.
    pub first_failures: Vec<MeshExample>,
}

/// Rates across triangles.
#[derive(Clone, Debug, Serialize)]
pub struct AcrossRates {
    /// Crossings without a hit, neither around the edge or vertex nor, perhaps, among the neighbours.
    pub cracks: Rate,
    /// Crossings without a hit there, but which a neighbour may have: no cracks.
    pub elsewhere: Rate,
    /// Crossings with two hits or more.
    pub doubles: Rate,
    /// Crossings with an even number of hits.
    pub even_crossings: Rate,
    /// Folds whose number of hits has the wrong parity.
    pub odd_folds: Rate,
    /// Folds without a hit where the exact line has two.
    pub missed_folds: Rate,
}

/// One class of rays.
#[derive(Clone, Debug, Serialize)]
pub struct MeshClassResult {
    /// How often what was found.
    #[serde(flatten)]
    pub rates: AcrossRates,
    /// The first cracks, by index.
    pub first_cracks: Vec<MeshExample>,
    /// The first doubles.
    pub first_doubles: Vec<MeshExample>,
    /// The first folds of wrong parity.
    pub first_odd_folds: Vec<MeshExample>,
    /// The first crossings whose hit may be elsewhere.
    pub first_elsewhere: Vec<MeshExample>,
    /// The digest of all cracks.
    pub crack_digest: String,
    /// The digest of all doubles.
    pub double_digest: String,
}

/// A ray at the mesh that shows something.
#[derive(Clone, Debug, Serialize)]
pub struct MeshExample {
    /// The case's id.
    pub id: String,
    /// The edge's two ends, or the vertex.
    pub points: Vec<[f64; 3]>,
    /// The lines of the faces around it; none if the file has no lines.
    pub lines: Vec<u32>,
    /// The numbers of the faces, counted from 1, if the file has no lines.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub faces: Vec<u32>,
    /// The command that shows it again.
    pub command: String,
}

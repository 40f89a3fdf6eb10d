//! The findings of a mesh audit, as its record holds them.

use super::drawing::MeshDrawing;
use crate::case::Matrix;
use crate::report::{
    Comparable, NamedRate, NamedValue, Promised, Rate, Record, RowPart, Study, or_infinite,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Everything that is written of a mesh audit.
pub struct MeshReport {
    /// The record of the findings.
    pub record: MeshRecord,
    /// The drawing in a page, if the plan keeps places.
    pub drawing: Option<MeshDrawing>,
}

/// The record of a mesh audit.
pub type MeshRecord = Record<MeshResult>;

/// The findings on a mesh.
#[apply(part!)]
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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instance: Option<Matrix<f64>>,
    /// The findings in each scalar.
    pub scalars: Vec<ScalarPart>,
}

impl Comparable for MeshResult {
    const STUDY: Study = Study::Mesh;

    fn question(&self) -> String {
        let place = self.instance.map_or(String::new(), |matrix| format!(" at {matrix:?}"));
        let unit = if self.unit_directions { " with unit directions" } else { "" };
        format!("mesh {}{place}{unit}", self.mesh.digest)
    }

    fn cases(&self) -> String {
        format!("{} {}", self.directions, self.seed)
    }

    fn counted(&self) -> Vec<NamedRate> {
        let rows =
            self.scalars.iter().flat_map(|part| part.results.iter().map(move |row| (part, row)));
        rows.flat_map(|(part, row)| {
            let parts = [("edges", &row.edges), ("vertices", &row.vertices)];
            parts.map(|(at, found)| {
                let AcrossRates { cracks, doubles, odd_folds, .. } = &found.total;
                let kinds =
                    [("cracks", cracks), ("doubles", doubles), ("wrong at folds", odd_folds)];
                kinds.map(|(kind, rate)| NamedRate {
                    what: format!("{} {} at {at}: {kind}", row.label(), part.scalar),
                    rate: rate.clone(),
                    command: found.first(kind),
                })
            })
        })
        .flatten()
        .collect()
    }

    fn chosen(&self) -> Vec<NamedValue> {
        let contract = |row: &RowPart| {
            let what = format!("{} ({}): contract", row.kernel, row.set);
            NamedValue::chosen(what, &row.contract)
        };
        self.rows.iter().map(contract).collect()
    }
}

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
}

/// A mesh audit in one scalar.
#[apply(part!)]
pub struct ScalarPart {
    /// `f32` or `f64`.
    pub scalar: String,
    /// The topology of the mesh in this scalar.
    pub topology: TopologyPart,
    /// The distance of two neighbouring numbers of the scalar at the largest coordinate.
    pub spacing: f64,
    /// The longest edge of the smallest triangle with an area.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(test, schemars(with = "Option<f64>"))]
    pub smallest: f64,
    /// Rays at edges and at vertices: how many of each are tested, times the directions.
    pub rays: [u64; 2],
    /// Rays with the triangles that they were put to.
    pub cases: u64,
    /// One a row whose kernel runs in this scalar.
    pub results: Vec<MeshRowResult>,
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

/// The results of a row in one scalar.
#[apply(part!)]
pub struct MeshRowResult {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The contract's promise: `nothing`, `at-least-one`, `exactly-one`.
    #[cfg_attr(test, schemars(with = "String"))]
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
#[apply(part!)]
pub struct MeshPartResult {
    /// How many of them some ray found a crack at.
    pub cracked: u64,
    /// How many were tested.
    pub of: u64,
    /// All classes together.
    pub total: AcrossRates,
    /// By class: `exact`, `exact-grazing`, `near`, `near-grazing`.
    pub classes: BTreeMap<String, MeshClassResult>,
    /// Rays on which the kernel panicked, crashed or gave no answer: not judged.
    pub failures: u64,
    /// The first of them.
    pub first_failures: Vec<MeshExample>,
}

impl MeshPartResult {
    /// The command that shows the first ray with a fault, by its name in tables.
    fn first(&self, fault: &str) -> Option<String> {
        let of_class = |class: &MeshClassResult| {
            let examples = match fault {
                "cracks" => &class.first_cracks,
                "doubles" => &class.first_doubles,
                _ => &class.first_odd_folds,
            };
            examples.first().map(|example| example.command.clone())
        };
        self.classes.values().find_map(of_class)
    }
}

/// Rates across triangles.
#[apply(part!)]
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
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
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
#[apply(part!)]
pub struct MeshExample {
    /// The case's id.
    pub id: String,
    /// The edge's two ends, or the vertex.
    pub points: Vec<[f64; 3]>,
    /// The lines of the faces around it; none if the file has no lines.
    pub lines: Vec<u32>,
    /// The numbers of the faces, counted from 1, if the file has no lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub faces: Vec<u32>,
    /// The command that shows it again.
    pub command: String,
}

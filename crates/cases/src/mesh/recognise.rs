//! Finds what a mesh is in a scalar: welds its vertices and sorts faces, edges and vertices into their kinds.

use super::fans::{Fans, VertexKind, fan_of};
use super::topology::{EdgeKind, FaceKind, Incidence, SharedEdge, Topology};
use crate::arith::Float;
use crate::engine;
use crate::family::wide;
use crate::files::mesh::Mesh;
use glam::DVec3;
use rayon::slice::ParallelSliceMut;
use std::collections::HashMap;

impl Topology {
    /// The topology of a mesh's positions in a scalar.
    pub fn of<F: Float>(mesh: &Mesh) -> Topology {
        let points = welded::<F>(mesh);
        let corners = engine::map(&mesh.triangles, |face| {
            face.map(|vertex| points[vertex as usize])
        });
        let mut kinds = engine::map(&corners, |face| kind_alone::<F>(mesh, *face));
        let duplicated_places = mark_duplicates(&corners, &mut kinds);
        let takes_part = |face: usize| kinds[face] != FaceKind::Collapsed;
        let incidence = Incidence::of(points.len(), &corners, takes_part);
        let mut topology = Topology {
            points,
            used_points: 0,
            faces: Default::default(),
            duplicated_places,
            edges: Default::default(),
            vertices: Default::default(),
            shared: Vec::new(),
            fans: Fans::default(),
            incidence,
            extent: 0.0,
        };
        for ((face, corners), kind) in (0..).zip(&corners).zip(&kinds) {
            topology.faces[*kind as usize].note(face, corners);
        }
        topology.add_edges(&corners, &kinds);
        topology.add_vertices(&corners, &kinds);
        topology.extent = extent_of::<F>(mesh, &topology.shared);
        topology
    }

    /// Sorts the edges into kinds and keeps the shared ones.
    fn add_edges(&mut self, corners: &[[u32; 3]], kinds: &[FaceKind]) {
        let half_edges = half_edges(corners, kinds);
        self.shared.reserve(half_edges.len() / 2);
        for edge in half_edges.chunk_by(|one, other| one.ends == other.ends) {
            let HalfEdge { ends, face, .. } = edge[0];
            let kind = edge_kind(edge, kinds);
            if kind == EdgeKind::Shared {
                let faces = [face, edge[1].face];
                self.shared.push(SharedEdge { ends, faces });
            }
            self.edges[kind as usize].note(face, &ends);
        }
        self.shared.shrink_to_fit();
    }

    /// Sorts the vertices into kinds and keeps the closed fans.
    fn add_vertices(&mut self, corners: &[[u32; 3]], kinds: &[FaceKind]) {
        let mut arcs = Vec::new();
        for point in 0..self.points.len() {
            let around = self.incidence.at(point);
            let Some(first) = around.first() else {
                continue;
            };
            self.used_points += 1;
            let is_sound = |face: &u32| kinds[*face as usize] == FaceKind::Sound;
            let vertex = point as u32;
            let kind = if around.iter().all(is_sound) {
                fan_of(vertex, around, corners, &mut arcs)
            } else {
                VertexKind::Irregular
            };
            self.vertices[kind as usize].note(*first, &[vertex]);
            if kind == VertexKind::Closed {
                let faces = arcs.iter().map(|arc| arc.face);
                self.fans.push(vertex, faces);
            }
        }
    }
}

/// The largest extent of some edges along an axis.
fn extent_of<F: Float>(mesh: &Mesh, edges: &[SharedEdge]) -> f64 {
    if edges.is_empty() {
        return 0.0;
    }
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    for edge in edges {
        for end in edge.ends {
            let position = wide(mesh.position::<F>(end));
            low = low.min(position);
            high = high.max(position);
        }
    }
    (high - low).max_element()
}

/// For each vertex the first with equal coordinates.
fn welded<F: Float>(mesh: &Mesh) -> Vec<u32> {
    let count = mesh.positions_f64.len();
    let mut first: HashMap<[u64; 3], u32> = HashMap::with_capacity(count);
    let mut points = Vec::with_capacity(count);
    for vertex in 0..count as u32 {
        let position = mesh.position::<F>(vertex).map(F::to_f64);
        // Adding +0 makes +0 of -0 and leaves every other number alone.
        let key = position.map(|x| (x + 0.0).to_bits());
        points.push(*first.entry(key).or_insert(vertex));
    }
    points
}

/// The kind of a face without a look at the others.
fn kind_alone<F: Float>(mesh: &Mesh, face: [u32; 3]) -> FaceKind {
    let [a, b, c] = face;
    if a == b || b == c || c == a {
        return FaceKind::Collapsed;
    }
    let corners = face.map(|point| mesh.position::<F>(point).map(F::to_f64));
    if corners.as_flattened().iter().any(|x| !x.is_finite()) {
        FaceKind::OutOfRange
    } else if crate::files::is_without_area(corners) {
        FaceKind::WithoutArea
    } else {
        FaceKind::Sound
    }
}

/// Marks the sound faces that have the same three points; returns in how many places.
fn mark_duplicates(corners: &[[u32; 3]], kinds: &mut [FaceKind]) -> u64 {
    let mut placed = Vec::new();
    for ((face, corners), kind) in (0..).zip(corners).zip(kinds.iter()) {
        if *kind == FaceKind::Sound {
            let mut points = *corners;
            points.sort_unstable();
            placed.push(PlacedFace { points, face });
        }
    }
    placed.par_sort_unstable();
    let mut places = 0;
    for at_one_place in placed.chunk_by(|one, other| one.points == other.points) {
        if at_one_place.len() == 1 {
            continue;
        }
        places += 1;
        for PlacedFace { face, .. } in at_one_place {
            kinds[*face as usize] = FaceKind::Duplicated;
        }
    }
    places
}

/// A face and its points, sorted.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct PlacedFace {
    points: [u32; 3],
    face: u32,
}

/// An edge as one face runs through it.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct HalfEdge {
    /// The smaller point first.
    ends: [u32; 2],
    face: u32,
    /// True if the face runs from the smaller point to the larger one.
    is_upward: bool,
}

/// All edges of the faces that are not collapsed, sorted by their points.
fn half_edges(corners: &[[u32; 3]], kinds: &[FaceKind]) -> Vec<HalfEdge> {
    let mut half_edges = Vec::with_capacity(3 * corners.len());
    for ((face, [a, b, c]), kind) in (0..).zip(corners).zip(kinds) {
        if *kind == FaceKind::Collapsed {
            continue;
        }
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            half_edges.push(HalfEdge {
                ends: [from.min(to), from.max(to)],
                face,
                is_upward: from < to,
            });
        }
    }
    half_edges.par_sort_unstable();
    half_edges
}

/// The kind of an edge by all faces on it.
fn edge_kind(edge: &[HalfEdge], kinds: &[FaceKind]) -> EdgeKind {
    let is_sound = |half_edge: &HalfEdge| kinds[half_edge.face as usize] == FaceKind::Sound;
    if !edge.iter().all(is_sound) {
        return EdgeKind::Unsound;
    }
    match edge {
        [_] => EdgeKind::Open,
        [one, other] if one.is_upward == other.is_upward => EdgeKind::Inconsistent,
        [_, _] => EdgeKind::Shared,
        _ => EdgeKind::NonManifold,
    }
}

//! Finds what a mesh is in a scalar: welds its vertices and sorts faces, edges and vertices into their kinds.

use super::fans::{Fans, VertexKind, fan_of};
use super::topology::{EdgeKind, FaceKind, Incidence, Noted, SharedEdge, Topology};
use crate::arith::Float;
use crate::engine;
use crate::files::mesh::Mesh;
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
        let mut faces: [Noted; 5] = Default::default();
        for ((face, kind), corners) in (0..).zip(&kinds).zip(&corners) {
            faces[*kind as usize].note(face, corners);
        }
        let (edges, shared) = edges(&corners, &kinds);
        let takes_part = |face: usize| kinds[face] != FaceKind::Collapsed;
        let incidence = Incidence::of(points.len(), &corners, takes_part);
        let extent = extent_of::<F>(mesh, &shared);
        let mut topology = Topology {
            points,
            used_points: 0,
            faces,
            duplicated_places,
            edges,
            vertices: Default::default(),
            shared,
            fans: Fans::default(),
            incidence,
            extent,
        };
        topology.add_vertices(&corners, &kinds);
        topology
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
            let sound = around
                .iter()
                .all(|face| kinds[*face as usize] == FaceKind::Sound);
            let kind = if sound {
                fan_of(point as u32, around, corners, &mut arcs)
            } else {
                VertexKind::Irregular
            };
            self.vertices[kind as usize].note(*first, &[point as u32]);
            if kind == VertexKind::Closed {
                self.fans
                    .push(point as u32, arcs.iter().map(|arc| arc.face));
            }
        }
    }
}

/// The largest extent of some edges along an axis.
fn extent_of<F: Float>(mesh: &Mesh, edges: &[SharedEdge]) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for end in edges.iter().flat_map(|edge| edge.ends) {
        let position = mesh.position::<F>(end).map(F::to_f64);
        low = std::array::from_fn(|i| low[i].min(position[i]));
        high = std::array::from_fn(|i| high[i].max(position[i]));
    }
    (0..3).fold(0.0, |m: f64, i| m.max(high[i] - low[i]))
}

/// For each vertex the first with equal coordinates.
fn welded<F: Float>(mesh: &Mesh) -> Vec<u32> {
    let count = mesh.positions_f64.len();
    let mut first: HashMap<[u64; 3], u32> = HashMap::with_capacity(count);
    (0..count as u32)
        .map(|vertex| {
            // Adding +0 makes +0 of -0 and leaves every other number alone.
            let key = mesh
                .position::<F>(vertex)
                .map(|x| (x.to_f64() + 0.0).to_bits());
            *first.entry(key).or_insert(vertex)
        })
        .collect()
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
    let mut faces: Vec<([u32; 3], u32)> = (0..)
        .zip(corners)
        .zip(kinds.iter())
        .filter(|(_, kind)| **kind == FaceKind::Sound)
        .map(|((face, corners), _)| {
            let mut points = *corners;
            points.sort_unstable();
            (points, face)
        })
        .collect();
    faces.par_sort_unstable();
    let mut places = 0;
    for same in faces
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|same| same.len() > 1)
    {
        places += 1;
        same.iter()
            .for_each(|(_, face)| kinds[*face as usize] = FaceKind::Duplicated);
    }
    places
}

/// Counts the edges of each kind, and keeps the shared ones.
fn edges(corners: &[[u32; 3]], kinds: &[FaceKind]) -> ([Noted; 5], Vec<SharedEdge>) {
    // The two points, smaller first, and the face with whether it runs from the smaller to the larger.
    let mut halves: Vec<([u32; 2], (u32, bool))> = (0..)
        .zip(corners)
        .zip(kinds)
        .filter(|(_, kind)| **kind != FaceKind::Collapsed)
        .flat_map(|((face, [a, b, c]), _)| {
            [(*a, *b), (*b, *c), (*c, *a)]
                .map(|(from, to)| ([from.min(to), from.max(to)], (face, from < to)))
        })
        .collect();
    halves.par_sort_unstable();
    let mut counts: [Noted; 5] = Default::default();
    let mut shared = Vec::with_capacity(halves.len() / 2);
    for edge in halves.chunk_by(|a, b| a.0 == b.0) {
        let (ends, (face, _)) = edge[0];
        let sound = edge
            .iter()
            .all(|(_, (face, _))| kinds[*face as usize] == FaceKind::Sound);
        let kind = match edge {
            _ if !sound => EdgeKind::Unsound,
            [_] => EdgeKind::Open,
            [(_, (_, one)), (_, (_, other))] if one == other => EdgeKind::Inconsistent,
            [_, (_, (other, _))] => {
                shared.push(SharedEdge {
                    ends,
                    faces: [face, *other],
                });
                EdgeKind::Shared
            }
            _ => EdgeKind::NonManifold,
        };
        counts[kind as usize].note(face, &ends);
    }
    shared.shrink_to_fit();
    (counts, shared)
}

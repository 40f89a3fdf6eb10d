//! The exact topology of a mesh: which faces, edges and vertices can be tested with rays, and which are open,
//! non-manifold, inconsistently wound, duplicated or without area.
//!
//! Vertices are one point where their coordinates are equal in the scalar (-0 = +0), whatever their
//! indices. Nothing is decided by a tolerance.

use super::fans::Fans;
#[cfg(feature = "studies")]
use rayon::slice::ParallelSliceMut;
use std::collections::BTreeSet;

/// A face of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaceKind {
    /// It has an area, and its three points are no other face's.
    Sound,
    /// At least two of its vertices are one point: it takes no part in edges.
    Collapsed,
    /// Three different points on one line.
    WithoutArea,
    /// Another face has the same three points, whichever way round.
    Duplicated,
    /// A coordinate is infinite in the scalar: the text is beyond its range.
    OutOfRange,
}

/// An edge between two points, by the faces on it (collapsed ones left out).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EdgeKind {
    /// Two sound faces, wound consistently: they run through it in opposite directions.
    Shared,
    /// One sound face.
    Open,
    /// Two sound faces that run through it in the same direction.
    Inconsistent,
    /// Three sound faces or more.
    NonManifold,
    /// A face on it is not sound.
    Unsound,
}

/// How many there are of a kind, and the first of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Noted {
    /// How many.
    pub count: u64,
    /// The first face of any, and the points of that one.
    pub first: Option<(u32, Vec<u32>)>,
}

impl Noted {
    pub(super) fn note(&mut self, face: u32, points: &[u32]) {
        self.count += 1;
        if self.first.as_ref().is_none_or(|(first, _)| face < *first) {
            self.first = Some((face, points.to_vec()));
        }
    }
}

/// An edge that is tested with rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SharedEdge {
    /// Its two points, the smaller index first.
    pub ends: [u32; 2],
    /// Its two faces.
    pub faces: [u32; 2],
}

/// The faces at each point of a mesh, collapsed ones left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Incidence {
    /// Where each point's faces start, and the last one's end.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl Incidence {
    /// The incidence of faces by their points; faces that take no part are left out.
    #[cfg(feature = "studies")]
    pub(super) fn of(
        points: usize,
        corners: &[[u32; 3]],
        takes_part: impl Fn(usize) -> bool,
    ) -> Incidence {
        let parts = (0..)
            .zip(corners)
            .filter(|(face, _)| takes_part(*face as usize));
        let mut pairs: Vec<(u32, u32)> = parts
            .flat_map(|(face, corners)| corners.map(|point| (point, face)))
            .collect();
        pairs.par_sort_unstable();
        let mut starts = vec![0; points + 1];
        pairs
            .iter()
            .for_each(|(point, _)| starts[*point as usize + 1] += 1);
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        Incidence {
            starts,
            faces: pairs.into_iter().map(|(_, face)| face).collect(),
        }
    }

    /// The faces at a point. Panics if there is no such point.
    pub fn at(&self, point: usize) -> &[u32] {
        &self.faces[self.starts[point] as usize..self.starts[point + 1] as usize]
    }
}

/// The most faces at the points of a group, each counted at each point, for which the neighbours are
/// tested. It bounds the cost of a vertex with very many edges.
pub const MOST_AROUND: usize = 4096;

/// A mesh in one scalar.
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    /// For each vertex of the file the first vertex with the same coordinates.
    pub points: Vec<u32>,
    /// How many different points the faces that are not collapsed have.
    pub used_points: u64,
    /// By [`FaceKind`].
    pub faces: [Noted; 5],
    /// In how many places the duplicated faces lie.
    pub duplicated_places: u64,
    /// By [`EdgeKind`].
    pub edges: [Noted; 5],
    /// By [`VertexKind`](super::VertexKind).
    pub vertices: [Noted; 4],
    /// The shared edges, by their points.
    pub shared: Vec<SharedEdge>,
    /// The closed fans, by their centres.
    pub fans: Fans,
    /// The faces at each point.
    pub incidence: Incidence,
    /// The largest extent of the shared edges along an axis.
    pub extent: f64,
}

impl Topology {
    /// The faces, ascending, that share a point with a face of a group and are not of it; none if there
    /// are more than [`MOST_AROUND`]. If no triangle of a group reports a crossing, a kernel runs on these before the
    /// crossing is called a crack.
    pub(super) fn around(&self, triangles: &[[u32; 3]], group: &[u32]) -> Option<Vec<u32>> {
        let corners = group.iter().flat_map(|face| triangles[*face as usize]);
        let points: BTreeSet<u32> = corners.map(|vertex| self.points[vertex as usize]).collect();
        let faces = points
            .iter()
            .flat_map(|point| self.incidence.at(*point as usize));
        if MOST_AROUND < faces.clone().count() {
            return None;
        }
        let others: BTreeSet<u32> = faces
            .copied()
            .filter(|face| !group.contains(face))
            .collect();
        Some(others.into_iter().collect())
    }

    /// True if the mesh is a closed surface, wound consistently: every face is sound, every edge shared,
    /// every vertex the centre of one closed fan.
    pub fn is_closed_manifold(&self) -> bool {
        let regular = |kinds: &[Noted]| kinds[1..].iter().all(|noted| noted.count == 0);
        regular(&self.faces) && regular(&self.edges) && regular(&self.vertices)
    }
}

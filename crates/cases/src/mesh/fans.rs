//! The faces around a vertex.

use std::iter;

/// A vertex of a mesh, by the faces around it (collapsed ones left out).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum VertexKind {
    /// One closed fan of sound faces, wound consistently.
    Closed,
    /// One fan that is open: the vertex is on the boundary.
    Open,
    /// Several fans that have only the vertex in common: it is not manifold.
    SeveralFans,
    /// On an edge that is non-manifold or inconsistent, or at a face that is not sound.
    Irregular,
}

/// Closed fans, each its centre and its faces in their order around it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fans {
    centres: Vec<u32>,
    /// Where each fan's faces end.
    ends: Vec<u32>,
    faces: Vec<u32>,
}

impl Fans {
    /// How many.
    pub fn len(&self) -> usize {
        self.centres.len()
    }

    /// True if there are no fans.
    pub fn is_empty(&self) -> bool {
        self.centres.is_empty()
    }

    /// The centre, and the faces in their order around it. Panics if there is no such fan.
    pub fn get(&self, fan: usize) -> (u32, &[u32]) {
        let start = fan
            .checked_sub(1)
            .map_or(0, |before| self.ends[before] as usize);
        (
            self.centres[fan],
            &self.faces[start..self.ends[fan] as usize],
        )
    }

    pub(super) fn push(&mut self, centre: u32, faces: impl Iterator<Item = u32>) {
        self.centres.push(centre);
        self.faces.extend(faces);
        self.ends.push(self.faces.len() as u32);
    }
}

/// A face as seen from one of its vertices: the next point and the last, in its winding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Arc {
    pub from: u32,
    pub to: u32,
    pub face: u32,
}

/// The kind of vertex that the sound faces around a point make. For one closed fan `arcs` is left in the order
/// around the point, from the first face on.
pub(super) fn fan_of(
    point: u32,
    around: &[u32],
    corners: &[[u32; 3]],
    arcs: &mut Vec<Arc>,
) -> VertexKind {
    arcs.clear();
    arcs.extend(around.iter().map(|face| {
        let corners = corners[*face as usize];
        let at = corners
            .iter()
            .position(|corner| *corner == point)
            .expect("a face at the point");
        Arc {
            from: corners[(at + 1) % 3],
            to: corners[(at + 2) % 3],
            face: *face,
        }
    }));
    let first = arcs[0];
    arcs.sort_unstable();
    let from_is_unique = arcs.windows(2).all(|pair| pair[0].from != pair[1].from);
    let mut ends: Vec<u32> = arcs.iter().map(|arc| arc.to).collect();
    ends.sort_unstable();
    if !from_is_unique || ends.windows(2).any(|pair| pair[0] == pair[1]) {
        // An edge at the point is run through twice in one direction.
        return VertexKind::Irregular;
    }
    // Every point starts at most one arc and ends at most one: paths and cycles.
    let after = |to: u32| {
        arcs.binary_search_by_key(&to, |arc| arc.from)
            .ok()
            .map(|i| arcs[i])
    };
    let is_start = |arc: &&Arc| ends.binary_search(&arc.from).is_err();
    let open_start = arcs.iter().find(is_start).copied();
    let start = open_start.unwrap_or(first);
    let next = |at: &Arc| after(at.to).filter(|next| *next != start);
    let order: Vec<Arc> = iter::successors(Some(start), next).collect();
    if order.len() < arcs.len() {
        return VertexKind::SeveralFans;
    }
    if open_start.is_some() {
        return VertexKind::Open;
    }
    *arcs = order;
    VertexKind::Closed
}

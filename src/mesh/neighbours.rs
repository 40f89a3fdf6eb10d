//! The triangles around a group: those that share a point with one of its triangles. If no triangle of a
//! group reports a crossing, a kernel runs on these before the crossing is called a crack.

use super::topology::Topology;

/// The most faces at the points of a group, each counted at each point, for which the neighbours are
/// tested. It bounds the cost of a vertex with very many edges.
pub const MOST_AROUND: usize = 4096;

/// The faces at each point of a mesh, collapsed ones left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Incidence {
    /// Where each point's faces start, and the last one's end.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl Incidence {
    /// Of faces by their points; those that take no part are left out.
    pub(super) fn of(
        points: usize,
        corners: &[[u32; 3]],
        takes_part: impl Fn(usize) -> bool,
    ) -> Incidence {
        let parts = || (0..).zip(corners).filter(|(face, _)| takes_part(*face as usize));
        let mut starts = vec![0u32; points + 1];
        parts().flat_map(|(_, corners)| corners).for_each(|point| starts[*point as usize + 1] += 1);
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut faces = vec![0u32; starts[points] as usize];
        let mut next = starts.clone();
        for (face, corners) in parts() {
            for point in corners {
                let place = &mut next[*point as usize];
                faces[*place as usize] = face;
                *place += 1;
            }
        }
        Incidence { starts, faces }
    }

    /// The faces at a point. Panics if there is no such point.
    pub fn at(&self, point: usize) -> &[u32] {
        &self.faces[self.starts[point] as usize..self.starts[point + 1] as usize]
    }
}

/// The faces, ascending, that share a point with a face of a group and are not of it; none if there
/// are more than [`MOST_AROUND`].
pub(super) fn around(
    topology: &Topology,
    triangles: &[[u32; 3]],
    group: &[u32],
) -> Option<Vec<u32>> {
    let corner = |vertex: &u32| topology.points[*vertex as usize] as usize;
    let mut points: Vec<usize> =
        group.iter().flat_map(|face| &triangles[*face as usize]).map(corner).collect();
    points.sort_unstable();
    points.dedup();
    let at = |point: &usize| topology.incidence.at(*point);
    if points.iter().map(|point| at(point).len()).sum::<usize>() > MOST_AROUND {
        return None;
    }
    let mut faces: Vec<u32> = points.iter().flat_map(at).copied().collect();
    faces.sort_unstable();
    faces.dedup();
    faces.retain(|face| !group.contains(face));
    Some(faces)
}

//! The triangles around a group: those that share a point with one of its triangles. If no triangle of a
//! group reports a crossing, a kernel runs on these before the crossing is called a crack.

use super::topology::Topology;

/// The most faces at the points of a group, each counted at each point, for which the neighbours are
/// tested. It bounds the cost of a vertex with very many edges.
pub const MOST_AROUND: usize = 4096;

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

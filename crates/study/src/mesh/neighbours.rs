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
    let mut points = Vec::with_capacity(3 * group.len());
    for face in group {
        points.extend(triangles[*face as usize].map(|vertex| topology.points[vertex as usize]));
    }
    points.sort_unstable();
    points.dedup();
    let at = |point: &u32| topology.incidence.at(*point as usize);
    let count = points.iter().map(|point| at(point).len()).sum();
    if count > MOST_AROUND {
        return None;
    }
    let mut faces = Vec::with_capacity(count);
    points.iter().for_each(|point| faces.extend_from_slice(at(point)));
    faces.sort_unstable();
    faces.dedup();
    faces.retain(|face| !group.contains(face));
    Some(faces)
}

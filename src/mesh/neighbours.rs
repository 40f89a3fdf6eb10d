//! The triangles around a group: those that share a point with one of its triangles. They are asked
//! where no triangle of a group reports a crossing, before it is called a crack.

use super::topology::Topology;
use crate::arith::Float;
use crate::case::Case;
use crate::contract::{Contract, Sides};
use crate::judge::{Distances, is_in_extent};
use crate::kernel::Verdict;
use crate::truth::{Facing, Feature, Truth};

/// The most that the faces at the points of a group may be, each counted at each point: beyond, the
/// neighbours are not asked. It bounds what a vertex of very many edges costs.
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

/// How near to a neighbour's boundary a line counts as one that rounding may move past it: in units of
/// the longest edge, in space.
const NEAR: f64 = 1.0 / 1024.0;

/// Whether a hit that a group lacks may have been moved by rounding, as its neighbours' verdicts show:
///
/// - one reports a hit though the exact line does not meet it, or gives no verdict;
/// - or hits near their boundary are lost, at least one of them from the other side, and with the group's
///   hit an even number: a rounded ray passes beside a silhouette, or beside several folds, and the parity
///   of the hits is right. Of a kernel that culls, which reports none from the other side, one such
///   neighbour is enough.
///
/// Any other neighbour that the line meets, as on the far side of a small mesh, excuses nothing. All
/// triangles of the group face as said.
pub fn may_be_elsewhere<F: Float>(
    facing: Facing,
    neighbours: &[Case<F>],
    truths: &[Truth],
    verdicts: &[Verdict<F>],
    contract: &Contract,
) -> bool {
    let (mut lost, mut beside_silhouette) = (0, false);
    // Faces that meet at a vertex or an edge of the line have one crossing there: by that vertex or edge
    // and the side, whether none reports it.
    let mut shared: Vec<(Rim<F>, bool, bool)> = Vec::new();
    for ((case, truth), verdict) in neighbours.iter().zip(truths).zip(verdicts) {
        let crossing = truth.crossing().filter(|crossing| {
            crossing.feature != Feature::Outside && is_in_extent(crossing, contract.extent)
        });
        match crossing {
            _ if verdict.failure.is_some() => return true,
            None if verdict.hit => return true,
            Some(crossing) if Distances::of(case, truth).in_space < NEAR => {
                let from_behind = crossing.facing != facing;
                let Some(rim) = rim(case, crossing.feature) else {
                    lost += usize::from(!verdict.hit);
                    beside_silhouette |= from_behind && !verdict.hit;
                    continue;
                };
                match shared.iter_mut().find(|known| known.0 == rim && known.1 == from_behind) {
                    Some(known) => known.2 &= !verdict.hit,
                    None => shared.push((rim, from_behind, !verdict.hit)),
                }
            }
            _ => {}
        }
    }
    let lost_on_rims = shared.iter().filter(|(_, _, none)| *none);
    lost += lost_on_rims.clone().count();
    beside_silhouette |= lost_on_rims.clone().any(|(_, from_behind, _)| *from_behind);
    beside_silhouette && (lost % 2 == 1 || contract.sides == Sides::Front)
}

/// The ends of an edge, the lesser first, or a vertex twice.
type Rim<F> = [[F; 3]; 2];

/// Where on a triangle's boundary a line meets it; none inside.
fn rim<F: Float>(case: &Case<F>, feature: Feature) -> Option<Rim<F>> {
    let [_, _, a, b, c] = case.vectors();
    let (p, q) = match feature {
        Feature::EdgeAb => (a, b),
        Feature::EdgeBc => (b, c),
        Feature::EdgeCa => (c, a),
        Feature::VertexA => (a, a),
        Feature::VertexB => (b, b),
        Feature::VertexC => (c, c),
        Feature::Interior | Feature::Outside => return None,
    };
    Some(if p <= q { [p, q] } else { [q, p] })
}

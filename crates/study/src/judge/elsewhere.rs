//! Decides if the missing hit of a group on a mesh may be a hit of a triangle around it.

use super::{Distances, is_in_extent};
use crate::arith::Float;
use crate::case::Case;
use crate::contract::{Contract, Sides};
use crate::kernel::Verdict;
use crate::truth::{Crossing, Facing, Feature, Truth};

/// How near to a neighbour's boundary a line counts as one that rounding may move past it: in units of
/// the longest edge, in space.
const NEAR: f64 = 1.0 / 1024.0;

/// True if rounding may have moved the hit that a group lacks, as its neighbours' verdicts show:
///
/// - one reports a hit though the exact line does not meet it, or gives no verdict;
/// - or hits near their boundary are lost, at least one of them from the other side, and with the group's
///   hit an even number: a rounded ray passes beside a silhouette, or beside several folds, and the parity
///   of the hits is right. Of a kernel that culls, which reports none from the other side, one such
///   neighbour is enough.
///
/// A neighbour that is clearly crossed elsewhere, as on the far side of a small mesh, does not explain the
/// missing hit. All triangles of the group have the given facing.
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
        match met(truth, contract) {
            _ if verdict.failure.is_some() => return true,
            None if verdict.hit => return true,
            Some(crossing) if Distances::of(case, truth).in_space < NEAR => {
                let from_behind = crossing.facing != facing;
                let Some(rim) = rim(case, crossing.feature) else {
                    lost += usize::from(!verdict.hit);
                    beside_silhouette |= from_behind && !verdict.hit;
                    continue;
                };
                match shared
                    .iter_mut()
                    .find(|known| known.0 == rim && known.1 == from_behind)
                {
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

/// True if a hit of a triangle around a group is the group's, which rounding has moved: the exact line does not meet that
/// triangle.
pub fn is_moved(truth: &Truth, contract: &Contract) -> bool {
    met(truth, contract).is_none()
}

/// Where the exact line meets a triangle within the extent.
fn met<'t>(truth: &'t Truth, contract: &Contract) -> Option<&'t Crossing> {
    let is_met = |crossing: &&Crossing| {
        crossing.feature != Feature::Outside && is_in_extent(crossing, contract.extent)
    };
    truth.crossing().filter(is_met)
}

/// The ends of an edge, the lesser first, or a vertex twice.
type Rim<F> = [[F; 3]; 2];

/// Where on a triangle's boundary a line meets it; none inside.
fn rim<F: Float>(case: &Case<F>, feature: Feature) -> Option<Rim<F>> {
    let [_, _, a, b, c] = case.vectors();
    let mut rim = match feature {
        Feature::EdgeAb => [a, b],
        Feature::EdgeBc => [b, c],
        Feature::EdgeCa => [c, a],
        Feature::VertexA => [a; 2],
        Feature::VertexB => [b; 2],
        Feature::VertexC => [c; 2],
        Feature::Interior | Feature::Outside => return None,
    };
    rim.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
    Some(rim)
}

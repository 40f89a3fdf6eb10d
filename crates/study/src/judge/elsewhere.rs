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
    let mut met_near: Vec<NearCrossing<F>> = Vec::new();
    for ((case, truth), verdict) in neighbours.iter().zip(truths).zip(verdicts) {
        if verdict.failure.is_some() {
            return true;
        }
        let Some(crossing) = met(truth, contract) else {
            if verdict.hit {
                return true;
            }
            continue;
        };
        let is_near = Distances::of(case, truth).in_space < NEAR;
        if !is_near {
            continue;
        }
        let is_lost = !verdict.hit;
        let from_behind = crossing.facing != facing;
        let rim = rim(case, crossing.feature);
        let is_same = |known: &&mut NearCrossing<F>| {
            rim.is_some() && known.rim == rim && known.from_behind == from_behind
        };
        match met_near.iter_mut().find(is_same) {
            Some(known) => known.is_lost &= is_lost,
            None => met_near.push(NearCrossing {
                rim,
                from_behind,
                is_lost,
            }),
        }
    }
    let mut lost = met_near.iter().filter(|crossing| crossing.is_lost);
    let keeps_parity = lost.clone().count() % 2 == 1;
    let beside_silhouette = lost.any(|crossing| crossing.from_behind);
    beside_silhouette && (keeps_parity || contract.sides == Sides::Front)
}

/// A crossing near the boundary of a neighbour. Faces that meet at a vertex or an edge on the line, and are seen from the
/// same side, have one crossing there.
struct NearCrossing<F> {
    /// The vertex or the edge; none inside a face.
    rim: Option<Rim<F>>,
    /// True if it is seen from the other side than the group.
    from_behind: bool,
    /// True if none of its faces reports it.
    is_lost: bool,
}

/// True if a hit of a triangle around a group is the group's, which rounding has moved: the exact line does not meet that
/// triangle.
pub fn is_moved(truth: &Truth, contract: &Contract) -> bool {
    met(truth, contract).is_none()
}

/// Where the exact line meets a triangle within the extent.
fn met<'t>(truth: &'t Truth, contract: &Contract) -> Option<&'t Crossing> {
    let crossing = truth.crossing()?;
    let is_met = crossing.feature != Feature::Outside && is_in_extent(crossing, contract.extent);
    is_met.then_some(crossing)
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

//! A contract's demands on the triangles of a group together, and on a polygon as a whole.

use super::change::{has_small_determinant, is_polygon_within, is_within};
use super::{Obligation, obligation, promises_direction};
use crate::arith::Float;
use crate::case::Case;
use crate::contract::{Contract, Extent, Sides};
use crate::family::Grouping;
use crate::files::winds_once;
use crate::truth::{Crossing, Facing, Feature, Place, Truth};
use std::cmp::Ordering;

/// A contract's demand on the triangles of a group together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupTruth {
    /// All triangles face the ray alike, and the exact line passes through the inside of their union
    /// within the extent: one hit is right.
    Crossing,
    /// Two triangles on one edge that do not face alike: as many hits are right, up to an even
    /// number, as the exact line has.
    Fold {
        /// True if the exact line meets an odd number of the two.
        odd: bool,
    },
    /// Nothing: a triangle is not transversal, the hit is at an end of the extent or on the rim of
    /// the union, the union is missed or covers itself there, or the contract does not count the side.
    Free,
}

/// The contract's demand on the triangles of a group together: nothing if it promises nothing for the
/// direction, nothing within its band, and nothing if the determinant of one of them is small.
///
/// How many triangles of a group report the ray follows from the verdict on each of them. So a band frees
/// the group if it frees one of its triangles, that is if the line is nearer than the band to where that
/// triangle would need another verdict. A line exactly through a shared edge is: its distance is 0.
pub fn group_obligation<F: Float>(
    cases: &[Case<F>],
    truths: &[Truth],
    contract: &Contract,
    grouping: Grouping,
) -> GroupTruth {
    if !is_promised(cases, contract) {
        return GroupTruth::Free;
    }
    let truth = group_truth(truths, contract, grouping);
    let is_free = |band| {
        cases
            .iter()
            .zip(truths)
            .any(|(case, truth)| is_within(band, case, truth, contract))
    };
    match truth {
        GroupTruth::Free => truth,
        // A fan that goes around its centre twice has two triangles on each side of it.
        GroupTruth::Crossing if grouping == Grouping::Fan && !goes_around_once(cases, truths) => {
            GroupTruth::Free
        }
        _ if contract.band.is_some_and(is_free) => GroupTruth::Free,
        _ if cases
            .iter()
            .any(|case| has_small_determinant(case, contract)) =>
        {
            GroupTruth::Free
        }
        _ => truth,
    }
}

/// True if a contract promises anything for the direction of the ray that all cases of a group share.
fn is_promised<F: Float>(cases: &[Case<F>], contract: &Contract) -> bool {
    let promises =
        |case: &Case<F>| promises_direction::<F>(contract.direction, case.ray.direction.into());
    cases.first().is_some_and(promises)
}

/// True if the triangles of a fan go once around the centre, as seen along a line through it; true if the
/// line does not pass through the centre.
fn goes_around_once<F: Float>(cases: &[Case<F>], truths: &[Truth]) -> bool {
    // The centre, and the vertex after it in the triangle's winding.
    let spoke = |(case, truth): (&Case<F>, &Truth)| {
        let [_, _, a, b, c] = case.vectors().map(|vector| vector.map(F::to_f64));
        match truth.crossing()?.feature {
            Feature::VertexA => Some([a, b]),
            Feature::VertexB => Some([b, c]),
            Feature::VertexC => Some([c, a]),
            _ => None,
        }
    };
    let spokes: Option<Vec<[[f64; 3]; 2]>> = cases.iter().zip(truths).map(spoke).collect();
    let (Some(case), Some(spokes)) = (cases.first(), spokes) else {
        return true;
    };
    let direction: [F; 3] = case.ray.direction.into();
    let ring: Vec<[f64; 3]> = spokes.iter().map(|[_, next]| *next).collect();
    let winds = |[centre, _]: &[_; 2]| winds_once(direction.map(F::to_f64), *centre, &ring);
    spokes.first().is_some_and(winds)
}

/// The demand that the truths of a group lead to, under a contract's extent and sides.
pub fn group_truth(truths: &[Truth], contract: &Contract, grouping: Grouping) -> GroupTruth {
    let crossings = truths.iter().filter_map(Truth::crossing);
    let Some(first) = truths.first().and_then(Truth::crossing) else {
        return GroupTruth::Free;
    };
    if crossings.clone().count() < truths.len() {
        return GroupTruth::Free;
    }
    let alike = crossings
        .clone()
        .all(|crossing| crossing.facing == first.facing);
    if contract.sides == Sides::Front && !(alike && first.facing == Facing::Front) {
        return GroupTruth::Free;
    }
    let mut met = crossings.filter(|crossing| crossing.feature != Feature::Outside);
    let strictly_in_extent = |crossing: &Crossing| match contract.extent {
        Extent::Line => true,
        Extent::Ray => crossing.t_sign == Ordering::Greater,
        Extent::Interval => crossing.place == Place::Within,
    };
    if !is_off_the_rim(met.clone(), truths.len(), grouping) || !met.clone().all(strictly_in_extent)
    {
        return GroupTruth::Free;
    }
    let hits = met.clone().count();
    let inside = met
        .clone()
        .filter(|crossing| crossing.feature == Feature::Interior)
        .count();
    if alike {
        let on_edges = met.all(|crossing| crossing.feature.is_edge());
        let once = if inside > 0 {
            hits == 1
        } else {
            hits == 2 || !on_edges
        };
        return if once {
            GroupTruth::Crossing
        } else {
            GroupTruth::Free
        };
    }
    // Over a fold the rims of the two triangles pass through each other's inside: the number of hits
    // is owed only where no triangle is met on an edge of its own.
    let on_shared_edge =
        inside == 0 && hits == 2 && met.next().map(|c| c.place) == met.next().map(|c| c.place);
    if grouping == Grouping::SharedEdge && (inside == hits || on_shared_edge) {
        return GroupTruth::Fold { odd: hits == 1 };
    }
    GroupTruth::Free
}

/// True if two contracts demand the same of every group.
pub fn owes_groups_alike(one: &Contract, other: &Contract) -> bool {
    let all = |contract: &Contract| {
        let Contract {
            extent,
            sides,
            direction,
            band,
            least_determinant,
            ..
        } = *contract;
        (extent, sides, direction, band, least_determinant)
    };
    all(one) == all(other)
}

/// True if the line passes through the inside of the triangles' union: inside a triangle, on an edge
/// of two, or at the centre of a closed fan.
fn is_off_the_rim<'a>(
    mut met: impl Iterator<Item = &'a Crossing> + Clone,
    triangles: usize,
    grouping: Grouping,
) -> bool {
    let hits = met.clone().count();
    met.clone()
        .any(|crossing| crossing.feature == Feature::Interior)
        || (hits >= 2 && met.all(|crossing| crossing.feature.is_edge()))
        || (grouping == Grouping::Fan && hits == triangles)
}

/// The contract's demand on a planar convex polygon as a whole, given as its fan: nothing if it
/// promises nothing for the direction, and nothing within its band.
///
/// A band frees a polygon by the polygon's own distances, as it frees a triangle: from the line to the
/// outline, not to a diagonal, and along the line to an end of the extent. A longest edge is that of the
/// fan's triangles, an ulp that of the largest coordinate of the polygon and the origin.
pub fn polygon_obligation<F: Float>(
    cases: &[Case<F>],
    truths: &[Truth],
    contract: &Contract,
) -> Obligation {
    if !is_promised(cases, contract) {
        return Obligation::Free;
    }
    let truth = polygon_truth(truths);
    let owed = obligation(&truth, contract, false);
    let is_free = |band| is_polygon_within(band, cases, &truth, contract);
    match owed {
        Obligation::Free => owed,
        _ if truth == Truth::Invalid => owed,
        _ if contract.band.is_some_and(is_free) => Obligation::Free,
        Obligation::MustHit
            if cases
                .iter()
                .any(|case| has_small_determinant(case, contract)) =>
        {
            Obligation::Free
        }
        _ => owed,
    }
}

/// The truth of a planar convex polygon, from the truths of its fan's triangles: a point on a diagonal
/// is inside. All triangles cross the same plane at the same t, so any that is met speaks for all.
pub fn polygon_truth(truths: &[Truth]) -> Truth {
    let crossings = truths.iter().filter_map(Truth::crossing);
    let met = crossings.filter(|crossing| crossing.feature != Feature::Outside);
    match met.clone().next() {
        None => truths[0],
        Some(first) if is_off_the_rim(met, truths.len(), Grouping::Polygon) => {
            Truth::Transversal(Crossing {
                feature: Feature::Interior,
                ..*first
            })
        }
        Some(first) => Truth::Transversal(*first),
    }
}

#[cfg(test)]
mod tests;

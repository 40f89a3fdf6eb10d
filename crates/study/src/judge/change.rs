//! How far a case is from where its obligation would be another, and whether a band frees it.

use super::distance::{Distances, Squares, line_to_segment, ulp_of_points};
use crate::arith::{Exact, Float, Real, Vector};
use crate::case::{Case, Ray, Triangle};
use crate::contract::{Band, BandUnit, Contract, Extent, Sides};
use crate::truth::{Facing, Feature, Place, Truth};
use std::cmp::Ordering;

#[cfg(test)]
mod tests;

impl Distances {
    /// How far from where the obligation would be another, lengths being infinite from an infinite end.
    pub fn nearest_change(&self, truth: &Truth, contract: &Contract) -> f64 {
        to_change(truth, contract, self.in_space, self.along)
    }
}

/// How far a case is from where its obligation would be another: into the triangle and the extent for
/// one that is to be missed, out of them for one that is to be hit. Where neither decides (a side that
/// does not count, a line along the plane) it is the distance to the boundary. Lengths or their
/// squares, infinite from an infinite end.
fn to_change<R: Real>(truth: &Truth, contract: &Contract, in_space: R, along: [R; 3]) -> R {
    let Some(crossing) = truth.crossing() else {
        return in_space;
    };
    let [to_zero, to_min, to_max] = along;
    let (along, off_end) = match contract.extent {
        Extent::Line => (R::infinity(), false),
        Extent::Ray => (to_zero, crossing.t_sign == Ordering::Less),
        Extent::Interval => (
            to_min.smaller(to_max),
            matches!(crossing.place, Place::Before | Place::Beyond),
        ),
    };
    if contract.sides == Sides::Front && crossing.facing == Facing::Back {
        return in_space;
    }
    match (off_end, crossing.feature == Feature::Outside) {
        (true, true) => along.larger(in_space),
        (true, false) => along,
        (false, true) => in_space,
        (false, false) => in_space.smaller(along),
    }
}

/// [`Distances::nearest_change`] exactly; none for invalid input.
pub fn exact_to_change<F: Float>(
    case: &Case<F>,
    truth: &Truth,
    contract: &Contract,
) -> Option<Exact> {
    if *truth == Truth::Invalid {
        return None;
    }
    let (ray, triangle) = case.exact();
    let crosses = truth.crossing().is_some();
    let squares = Squares::<Exact>::of(&ray, &triangle, crosses);
    let unit = squares.unit();
    let along = squares
        .along
        .map(|square| square.unwrap_or_else(Exact::infinity));
    Some((to_change(truth, contract, squares.in_space, along) / unit).sqrt())
}

/// True if a valid case is nearer than a band to where its obligation would change; decided exactly.
pub fn is_within<F: Float>(band: Band, case: &Case<F>, truth: &Truth, contract: &Contract) -> bool {
    let distances = Distances::of(case, truth);
    let unit = match band.unit {
        BandUnit::Edges => 1.0,
        BandUnit::Ulps => distances.edge_in_ulps,
    };
    is_clearly_less(distances.nearest_change(truth, contract) * unit, band.size).unwrap_or_else(
        || {
            let (ray, triangle) = case.exact();
            let squares = Squares::of(&ray, &triangle, truth.crossing().is_some());
            squares.are_within(band, ulp_of_points(case), truth, contract)
        },
    )
}

/// True if a case's exact determinant is below the least at which the contract owes a hit.
pub fn has_small_determinant<F: Float>(case: &Case<F>, contract: &Contract) -> bool {
    if contract.least_determinant == 0.0 {
        return false;
    }
    let (ray, Triangle { a, b, c }) = case.exact();
    let normal = b.minus(&a).cross(&c.minus(&a));
    ray.direction
        .dot(&normal)
        .abs()
        .is_less(&Exact::from_f64(contract.least_determinant))
}

/// True if one number is less than another; none if they differ by less than 1/256, as distances are right to a
/// thousandth.
fn is_clearly_less(one: f64, other: f64) -> Option<bool> {
    let relative = one / other;
    ((relative - 1.0).abs() > 1.0 / 256.0).then_some(relative < 1.0)
}

/// The same of a planar convex polygon, given as its fan, with the truth of it as a whole: by the
/// distance to its outline, in units of the longest edge of the fan's triangles.
pub fn is_polygon_within<F: Float>(
    band: Band,
    cases: &[Case<F>],
    truth: &Truth,
    contract: &Contract,
) -> bool {
    let crosses = truth.crossing().is_some();
    let last = cases.len() - 1;
    let fan: Vec<_> = cases.iter().map(Case::exact).collect();
    let each = |(i, (ray, triangle)): (usize, &(Ray<_>, Triangle<_>))| {
        let Squares { longest, along, .. } = Squares::<Exact>::of(ray, triangle, crosses);
        let [first, rim, closing] = triangle.edges();
        let outline = [
            (i == 0).then_some(first),
            Some(rim),
            (i == last).then_some(closing),
        ];
        let to_edge = |(p, q)| line_to_segment(&ray.origin, &ray.direction, p, q);
        let in_space = outline
            .into_iter()
            .flatten()
            .map(to_edge)
            .reduce(Exact::smaller);
        Squares {
            longest,
            in_space: in_space.expect("an edge of the outline"),
            along,
        }
    };
    let larger = |one: Squares<Exact>, other: Squares<Exact>| Squares {
        longest: one.longest.larger(other.longest),
        in_space: one.in_space.smaller(other.in_space),
        along: one.along,
    };
    let ulps = cases.iter().map(ulp_of_points);
    let ulp = ulps.fold(F::zero(), F::larger);
    let squares = fan
        .iter()
        .enumerate()
        .map(each)
        .reduce(larger)
        .expect("a triangle");
    squares.are_within(band, ulp, truth, contract)
}

impl Squares<Exact> {
    /// True if they are within a band of where the obligation would change.
    fn are_within(self, band: Band, ulp: impl Float, truth: &Truth, contract: &Contract) -> bool {
        let Squares {
            longest,
            in_space,
            along,
        } = self;
        let unit = match band.unit {
            BandUnit::Edges if longest.is_zero() => Exact::one(),
            BandUnit::Edges => longest,
            BandUnit::Ulps => {
                let ulp = Exact::from_f64(ulp.to_f64());
                ulp.clone() * ulp
            }
        };
        let along = along.map(|square| square.unwrap_or_else(Exact::infinity));
        let size = Exact::from_f64(band.size);
        to_change(truth, contract, in_space, along).is_less(&(size.clone() * size * unit))
    }
}

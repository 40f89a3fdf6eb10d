//! How badly a verdict was wrong: how far the line is from where the verdict would be right.
//!
//! Every finding gets a severity that is right to a thousandth, by which the worst is chosen and which
//! the distributions count; what a report shows of the chosen ones is computed from exact squares.

use crate::arith::{Exact, ExactVector, Float, Real, Vector};
use crate::case::{Case, Instance, Ray, Triangle};
use crate::contract::Extent;
use crate::judge::{Squares, is_in_extent, nearest_on_segment, square, ulp_of_points};
use crate::oracle::{self, Layers};
use crate::truth::{Crossing, Place, Truth};
use std::slice;

/// The exact distances behind a finding, rounded to floats from exact squares, in units of the
/// triangle's longest edge (of length, for a triangle that is a point). `None` where a distance does
/// not apply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Severity {
    /// In the plane, from where the line meets it to the triangle's boundary.
    pub in_plane: Option<f64>,
    /// In space, from the line to the boundary.
    pub in_space: f64,
    /// |t - end|·|d| to the nearest finite end of the extent.
    pub along: Option<f64>,
    /// Where t lies if it is not in the extent: before it or beyond it.
    pub off_end: Option<Place>,
    /// The longest edge in ulps of the largest coordinate of the case's points: a distance times
    /// this is in ulps.
    pub edge_in_ulps: f64,
}

/// The distances of a case; none for invalid input.
pub fn exact_severity<F: Float>(case: &Case<F>, extent: Extent) -> Option<Severity> {
    let vectors = case.vectors();
    if vectors.iter().flatten().any(|x| !x.is_finite()) || vectors[1].iter().all(F::is_zero) {
        return None;
    }
    let ulp = Exact::from_f64(ulp_of_points(case).to_f64());
    Some(severity(&case.exact(), ulp, &oracle::truth(case), extent))
}

/// The same of a ray of the world and the triangle that an instance puts there, as the object has them.
pub fn severity_of_instance<F: Float>(
    case: &Case<F>,
    instance: &Instance<F>,
    extent: Extent,
) -> Option<Severity> {
    let mut truths = Vec::new();
    oracle::truths_of_instance(
        slice::from_ref(case),
        instance,
        &mut truths,
        &mut Layers::default(),
    );
    let truth = truths.first().filter(|truth| **truth != Truth::Invalid)?;
    let (ray, triangle, times) = instance.lift(case, Exact::from_f64);
    let ulp = Exact::from_f64(ulp_of_points(case).to_f64()) * times;
    Some(severity(&(ray, triangle), ulp, truth, extent))
}

fn severity(
    (ray, triangle): &(Ray<ExactVector>, Triangle<ExactVector>),
    ulp: Exact,
    truth: &Truth,
    extent: Extent,
) -> Severity {
    let (
        Ray {
            origin: o,
            direction: d,
            ..
        },
        Triangle { a, b, c },
    ) = (ray, triangle);
    let n = b.minus(a).cross(&c.minus(a));
    let capital_d = n.dot(d);
    let crosses = !capital_d.is_zero();
    let squares = Squares::of(ray, triangle, crosses);
    let unit = squares.unit();
    let relative = |square: Exact| (square / &unit).approximate_root();

    let in_plane = crosses.then(|| {
        let hit = o.plus(&d.times(&(n.dot(&a.minus(o)) / capital_d)));
        [(a, b), (b, c), (c, a)].map(|(p, q)| point_to_segment(&hit, p, q))
    });
    let in_plane = in_plane.and_then(|squares| squares.into_iter().reduce(Exact::smaller));
    let along = ends(extent)
        .iter()
        .filter_map(|&end| squares.along[end].clone())
        .reduce(Exact::smaller);
    Severity {
        in_plane: in_plane.map(relative),
        in_space: relative(squares.in_space),
        along: along.map(relative),
        off_end: truth
            .crossing()
            .and_then(|crossing| off_end(crossing, extent)),
        edge_in_ulps: (unit.clone() / (ulp.clone() * ulp)).approximate_root(),
    }
}

/// Where a crossing lies that is not in an extent. That of a ray begins at 0, whatever the interval is.
fn off_end(crossing: &Crossing, extent: Extent) -> Option<Place> {
    match (is_in_extent(crossing, extent), extent) {
        (true, _) => None,
        (false, Extent::Interval) => Some(crossing.place),
        (false, _) => Some(Place::Before),
    }
}

/// Where an extent begins and ends: the places of 0, t_min and t_max that count.
fn ends(extent: Extent) -> &'static [usize] {
    match extent {
        Extent::Line => &[],
        Extent::Ray => &[0],
        Extent::Interval => &[1, 2],
    }
}

/// The square of the distance between a point and a segment.
fn point_to_segment(x: &ExactVector, p: &ExactVector, q: &ExactVector) -> Exact {
    let (edge, offset) = (q.minus(p), p.minus(x));
    let s = nearest_on_segment(-offset.dot(&edge), square(&edge));
    square(&offset.plus(&edge.times(&s)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

    #[test]
    fn distances_are_those_measured_by_hand() {
        // Down onto (1, 1): 1 from both legs, 1 from the hypotenuse (x/4 + y/3 = 1): 5/12·12/5 = 1.
        let case = Case::<f64>::new([1.0, 1.0, 2.0], [0.0, 0.0, -1.0], TRIANGLE);
        let severity = exact_severity(&case, Extent::Interval).unwrap();
        assert_eq!(severity.in_plane, Some(0.2));
        assert_eq!(severity.in_space, 0.2);
        assert_eq!((severity.along, severity.off_end), (Some(0.4), None));
        // Longest edge 5; the largest coordinate is 4, whose ulp is 2^-50.
        assert_eq!(severity.edge_in_ulps, 5.0 * 2f64.powi(50));
    }

    #[test]
    fn what_is_off_an_end_follows_the_extent_and_not_the_interval() {
        // The plane is met at t = 2.
        let from = |z: f64| Case::<f64>::new([1.0, 1.0, z], [0.0, 0.0, -1.0], TRIANGLE);
        let off = |case: Case<f64>| {
            [Extent::Interval, Extent::Ray, Extent::Line]
                .map(|extent| exact_severity(&case, extent).unwrap().off_end)
        };
        assert_eq!(
            off(from(2.0).on(0.0, 1.0)),
            [Some(Place::Beyond), None, None]
        );
        assert_eq!(
            off(from(2.0).on(3.0, 4.0)),
            [Some(Place::Before), None, None]
        );
        assert_eq!(off(from(2.0).on(2.0, 3.0)), [None; 3]);
        // And here behind the origin, at t = -2.
        assert_eq!(
            off(from(-2.0).on(-3.0, 1.0)),
            [None, Some(Place::Before), None]
        );
    }

    #[test]
    fn a_slanted_line_is_nearer_in_space_than_in_the_plane() {
        // Onto (2, -1) in the plane, 45 degrees along y: distance 1 in the plane, 1/√2 in space.
        let case = Case::<f64>::new([2.0, -3.0, 2.0], [0.0, 1.0, -1.0], TRIANGLE);
        let severity = exact_severity(&case, Extent::Interval).unwrap();
        assert_eq!(severity.in_plane, Some(0.2));
        assert!((severity.in_space - 0.2 / 2f64.sqrt()).abs() < 1e-16);
    }
}

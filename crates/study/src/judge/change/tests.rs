//! Tests of distances to another obligation, and of bands.

use super::*;
use crate::judge::{Obligation, asked};
use crate::oracle::truth;
use crate::truth::Crossing;

#[test]
fn what_differs_by_a_256th_is_clear_and_what_does_not_is_not() {
    for (one, expected) in [
        (1.0 - 1.0 / 256.0, None),
        (1.0, None),
        (1.0 + 1.0 / 256.0, None),
        (1.0 - 1.0 / 255.0, Some(true)),
        (1.0 + 1.0 / 255.0, Some(false)),
        (f64::INFINITY, Some(false)),
        (0.0, Some(true)),
    ] {
        assert_eq!(is_clearly_less(3.0 * one, 3.0), expected, "{one}");
    }
}

#[test]
fn a_band_is_compared_exactly() {
    // 0.5 from an edge, and the longest edge is 5.
    let triangle = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let ask = |y: f64, triangle: [[f64; 3]; 3], band: String| {
        let case = Case::<f64>::new([1.0, y, 8.0], [0.0, 0.0, -1.0], triangle);
        let contract = Contract {
            band: Some(band.parse().unwrap()),
            ..Contract::CLOSED_RAY
        };
        asked(&case, &truth(&case), &contract, false)
    };
    // As a float 0.1 is a little more than a tenth, and the float before it less.
    let edges = |size: f64| ask(0.5, triangle, format!("{size:e}"));
    assert_eq!(
        [0.1f64.next_down(), 0.1].map(edges),
        [Obligation::MustHit, Obligation::Free]
    );
    // In ulps of the largest coordinate, 8: 2^-49.
    let ulps = |ulps: f64| ask(2f64.powi(-48), triangle, format!("{ulps}ulps"));
    assert_eq!(
        [2.0, 2f64.next_up()].map(ulps),
        [Obligation::MustHit, Obligation::Free]
    );
    // Of a triangle that is a point, in units of length.
    let point = |size: f64| ask(0.5, [[1.0, 0.0, 0.0]; 3], format!("{size:e}"));
    assert_eq!(
        [0.5, 0.5f64.next_up()].map(point),
        [Obligation::MustMiss, Obligation::Free]
    );
}

#[test]
fn a_band_is_compared_exactly_where_distances_are_least_certain() {
    let mut off = 0;
    for index in 0..300 {
        let mut draw = crate::case::Draw::new("band", 1, index);
        // Little more than 2^-36 from the middle of ab, where the rounding of floats is 2^-16 of that.
        let [a, b, c, beside] = [(); 4].map(|()| draw.point::<f64>());
        let o = draw.point::<f64>();
        let d = [0, 1, 2].map(|i| 0.5 * a[i] + 0.5 * b[i] + 2f64.powi(-35) * beside[i] - o[i]);
        let case = Case::<f64>::new(o, d, [a, b, c]);
        let found = truth(&case);
        let exact = exact_to_change(&case, &found, &Contract::CLOSED_RAY).unwrap();
        let exact = (exact.clone() * exact).approximate_root();
        for (factor, owed) in [(1.0 + 1e-6, true), (1.0 - 1e-6, false)] {
            let band = format!("{:e}", exact * factor).parse().ok();
            let contract = Contract {
                band,
                ..Contract::CLOSED_RAY
            };
            let is_free = asked(&case, &found, &contract, false) == Obligation::Free;
            assert_eq!(is_free, owed, "{}", case.hex());
        }
        let floats = Distances::of(&case, &found).nearest_change(&found, &Contract::CLOSED_RAY);
        off += u32::from((floats - exact).abs() > 1e-6 * exact);
    }
    assert!(off > 10, "{off} that floats decide wrongly");
}

#[test]
fn the_distance_to_change_is_that_which_counts() {
    let distances = Distances {
        in_space: 2.0,
        along: [1.0, 3.0, 5.0],
        edge_in_ulps: 1.0,
    };
    let change = |facing, place, t_sign, feature, contract: Contract| {
        let truth = Truth::Transversal(Crossing {
            facing,
            place,
            t_sign,
            feature,
        });
        distances.nearest_change(&truth, &contract)
    };
    use Ordering::{Greater, Less};
    let closed = Contract::CLOSED_RAY;
    for sides in [Sides::Both, Sides::Front] {
        for facing in [Facing::Front, Facing::Back] {
            let culled = sides == Sides::Front && facing == Facing::Back;
            for (extent, place, t_sign, feature, owed) in [
                (Extent::Line, Place::Before, Less, Feature::Interior, 2.0),
                (Extent::Ray, Place::Within, Greater, Feature::Interior, 1.0),
                (Extent::Ray, Place::Within, Greater, Feature::Outside, 2.0),
                (Extent::Ray, Place::Within, Less, Feature::Interior, 1.0),
                (Extent::Ray, Place::Within, Less, Feature::Outside, 2.0),
                (
                    Extent::Interval,
                    Place::Within,
                    Less,
                    Feature::Interior,
                    2.0,
                ),
                (
                    Extent::Interval,
                    Place::Before,
                    Greater,
                    Feature::Interior,
                    3.0,
                ),
                (
                    Extent::Interval,
                    Place::Beyond,
                    Greater,
                    Feature::Outside,
                    3.0,
                ),
            ] {
                let contract = Contract {
                    extent,
                    sides,
                    ..closed
                };
                let found = change(facing, place, t_sign, feature, contract);
                let owed = if culled { 2.0 } else { owed };
                assert_eq!(
                    found, owed,
                    "{extent:?} {sides:?} {facing:?} {place:?} {feature:?}"
                );
            }
        }
    }
}

#[test]
fn the_exact_distance_to_change_is_a_share_of_the_longest_edge() {
    let corners = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let ask = |y: f64, triangle: [[f64; 3]; 3]| {
        let case = Case::<f64>::new([1.0, y, 8.0], [0.0, 0.0, -1.0], triangle);
        exact_to_change(&case, &truth(&case), &Contract::CLOSED_RAY)
    };
    let is = |found: Option<Exact>, square: [f64; 2]| {
        let found = found.unwrap();
        let [above, below] = square.map(Exact::from_f64);
        let (found, expected) = (found.clone() * found, above / below);
        found.is_at_most(&expected) && expected.is_at_most(&found)
    };
    // 0.5 from an edge, the longest is 5; of a point, a length.
    assert!(is(ask(0.5, corners), [0.25, 25.0]) && is(ask(-2.0, corners), [4.0, 25.0]));
    assert!(is(ask(0.5, [[1.0, 0.0, 0.0]; 3]), [0.25, 1.0]));
    // An infinite end is never near.
    let interval = Contract {
        extent: Extent::Interval,
        ..Contract::CLOSED_RAY
    };
    let case = Case::<f64>::new([1.0, 0.5, 0.25], [0.0, 0.0, -1.0], corners);
    let case = case.on(-f64::INFINITY, f64::INFINITY);
    assert!(is(
        exact_to_change(&case, &truth(&case), &interval),
        [0.25, 25.0]
    ));
    assert!(exact_to_change(&case, &Truth::Invalid, &interval).is_none());
}

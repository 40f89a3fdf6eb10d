//! The demands of contracts on groups and polygons, worked out by hand.

use super::*;
use crate::contract::{Boundary, Demand, Direction};
use crate::oracle::truth;

#[test]
fn a_point_on_a_polygons_diagonal_is_inside_and_one_on_its_rim_is_not() {
    let corners = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
    ];
    let fan = [[0, 1, 2], [0, 2, 3]];
    let polygon = |x: f64, y: f64| -> Vec<Truth> {
        let case =
            |k: [usize; 3]| Case::<f64>::new([x, y, 1.0], [0.0, 0.0, -1.0], k.map(|i| corners[i]));
        fan.map(|k| truth(&case(k))).to_vec()
    };
    let feature = |x, y| {
        polygon_truth(&polygon(x, y))
            .crossing()
            .map(|crossing| crossing.feature)
    };
    assert_eq!(feature(2.0, 2.0), Some(Feature::Interior));
    assert!(feature(2.0, 0.0).is_some_and(Feature::is_edge));
    assert_eq!(feature(5.0, 2.0), Some(Feature::Outside));
    let asked = |x, y| group_truth(&polygon(x, y), &Contract::CLOSED_RAY, Grouping::Polygon);
    assert_eq!(asked(2.0, 2.0), GroupTruth::Crossing);
    assert_eq!(asked(2.0, 0.0), GroupTruth::Free, "the rim is nobody's");
}

#[test]
fn a_fold_asks_for_the_parity_of_the_exact_line() {
    let pair = |x: f64, y: f64| -> Vec<Truth> {
        let [a, b, c, d] = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [0.0, 4.0, 0.0],
            [0.0, 2.0, 4.0],
        ];
        let case = |t| truth(&Case::<f64>::new([x, y, 8.0], [0.0, 0.0, -1.0], t));
        vec![case([a, b, c]), case([b, a, d])]
    };
    let asked = |x, y| group_truth(&pair(x, y), &Contract::CLOSED_RAY, Grouping::SharedEdge);
    assert_eq!(
        asked(1.0, 0.0),
        GroupTruth::Fold { odd: false },
        "on the shared edge"
    );
    assert_eq!(
        asked(1.0, 0.5),
        GroupTruth::Fold { odd: false },
        "inside both"
    );
    assert_eq!(
        asked(0.5, 3.0),
        GroupTruth::Fold { odd: true },
        "inside the first alone"
    );
    assert_eq!(asked(1.0, 1.5), GroupTruth::Free, "on a rim of the second");
    assert_eq!(asked(-1.0, 1.0), GroupTruth::Free, "outside");
    let front = Contract {
        sides: Sides::Front,
        ..Contract::CLOSED_RAY
    };
    let culled = group_truth(&pair(1.0, 0.5), &front, Grouping::SharedEdge);
    assert_eq!(culled, GroupTruth::Free, "the second does not count");
}

#[test]
fn of_a_group_seen_from_behind_a_contract_for_fronts_demands_nothing() {
    let from = |z: f64| -> Vec<Truth> {
        let [a, b, c, d] = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [0.0, 4.0, 0.0],
            [4.0, -4.0, 0.0],
        ];
        let case = |t| truth(&Case::<f64>::new([1.0, 1.0, z], [0.0, 0.0, -z], t));
        vec![case([a, b, c]), case([b, a, d])]
    };
    let front = Contract {
        sides: Sides::Front,
        ..Contract::CLOSED_RAY
    };
    let asked = |z, contract| group_truth(&from(z), contract, Grouping::SharedEdge);
    assert_eq!(asked(1.0, &front), GroupTruth::Crossing);
    assert_eq!(asked(-1.0, &front), GroupTruth::Free);
    assert_eq!(asked(-1.0, &Contract::CLOSED_RAY), GroupTruth::Crossing);
    let flat = [from(1.0), vec![Truth::Parallel]].concat();
    let closed = Contract::CLOSED_RAY;
    assert_eq!(
        group_truth(&flat, &closed, Grouping::Polygon),
        GroupTruth::Free,
        "one is parallel"
    );
    let on_edge = [[0.0, 1.0, 0.0], [4.0, 1.0, 0.0], [0.0, 5.0, 0.0]];
    let on_edge = truth(&Case::<f64>::new([1.0; 3], [0.0, 0.0, -1.0], on_edge));
    let overlap = [from(1.0)[0], on_edge];
    let owed = group_truth(&overlap, &closed, Grouping::SharedEdge);
    assert_eq!(
        owed,
        GroupTruth::Free,
        "inside one, on an edge of the other"
    );
}

/// At an end of the interval each triangle of a group may count the hit or not.
#[test]
fn a_group_that_is_met_at_an_end_of_the_extent_is_free() {
    let [a, b, c, d] = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [4.0, -4.0, 0.0],
    ];
    let asked = |extent: Extent, [t_min, t_max]: [f64; 2]| {
        // The plane is met at t = 2.
        let ray = |triangle| Case::<f64>::new([1.0, 1.0, 2.0], [0.0, 0.0, -1.0], triangle);
        let truth = |triangle| truth(&ray(triangle).on(t_min, t_max));
        let contract = Contract {
            extent,
            ..Contract::CLOSED_RAY
        };
        let truths = [truth([a, b, c]), truth([b, a, d])];
        group_truth(&truths, &contract, Grouping::SharedEdge)
    };
    assert_eq!(
        asked(Extent::Interval, [1.0, 3.0]),
        GroupTruth::Crossing,
        "within"
    );
    assert_eq!(
        asked(Extent::Interval, [1.0, 2.0]),
        GroupTruth::Free,
        "at t_max"
    );
    assert_eq!(
        asked(Extent::Interval, [2.0, 3.0]),
        GroupTruth::Free,
        "at t_min"
    );
    assert_eq!(
        asked(Extent::Interval, [1.0, 1.5]),
        GroupTruth::Free,
        "beyond t_max"
    );
    assert_eq!(
        asked(Extent::Interval, [2.5, 3.0]),
        GroupTruth::Free,
        "before t_min"
    );
    assert_eq!(
        asked(Extent::Ray, [1.0, 2.0]),
        GroupTruth::Crossing,
        "a ray has no t_max"
    );
}

#[test]
fn a_fan_that_is_crossed_beside_its_centre_is_crossed_once() {
    let ring = [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [-4.0, -4.0, 0.0]];
    let fan = |x: f64, y: f64| {
        let triangle = |i: usize| [[0.0; 3], ring[i], ring[(i + 1) % 3]];
        let cases = [0, 1, 2].map(|i| Case::<f64>::new([x, y, 1.0], [0.0, 0.0, -1.0], triangle(i)));
        let truths = cases.map(|case| truth(&case));
        group_obligation(&cases, &truths, &Contract::CLOSED_RAY, Grouping::Fan)
    };
    assert_eq!(fan(1.0, 1.0), GroupTruth::Crossing, "inside one");
    assert_eq!(fan(1.0, 0.0), GroupTruth::Crossing, "on an inner edge");
    assert_eq!(fan(0.0, 0.0), GroupTruth::Crossing, "at the centre");
    assert_eq!(fan(2.0, 2.0), GroupTruth::Free, "on the rim");
    assert_eq!(fan(5.0, 5.0), GroupTruth::Free, "outside");
    let (cases, truths) = square_at(1.0, 2.0);
    let no_self_hit = Contract {
        no_self_hit: true,
        ..Contract::CLOSED_RAY
    };
    let owed = polygon_obligation(&cases, &truths, &no_self_hit);
    assert_eq!(owed, Obligation::MustHit, "the ray starts elsewhere");
}

#[test]
fn groups_are_owed_alike_by_contracts_that_differ_in_what_no_group_depends_on() {
    let closed = Contract::CLOSED_RAY;
    let is_alike = |other: Contract| {
        assert_eq!(
            owes_groups_alike(&closed, &other),
            owes_groups_alike(&other, &closed)
        );
        owes_groups_alike(&closed, &other)
    };
    assert!(is_alike(Contract {
        boundary: Boundary::Open,
        ends: Boundary::Free,
        ..closed
    }));
    assert!(is_alike(closed.with_flat(Demand::Hit, Demand::Free)));
    assert!(!is_alike(Contract {
        extent: Extent::Line,
        ..closed
    }));
    assert!(!is_alike(Contract {
        sides: Sides::Front,
        ..closed
    }));
    assert!(!is_alike(Contract {
        direction: Direction::Unit { ulps: 1 },
        ..closed
    }));
    assert!(!is_alike(Contract {
        band: "4ulps".parse().ok(),
        ..closed
    }));
}

#[test]
fn a_group_that_covers_itself_at_the_ray_is_free() {
    let truths = |rings: &[[f64; 2]]| -> Vec<Truth> {
        let triangle = |i: usize| {
            let at = |[x, y]: [f64; 2]| [x, y, 0.0];
            [[0.0; 3], at(rings[i]), at(rings[(i + 1) % rings.len()])]
        };
        let case = |i| Case::<f64>::new([0.5, 0.25, 1.0], [0.0, 0.0, -1.0], triangle(i));
        (0..rings.len()).map(|i| truth(&case(i))).collect()
    };
    let once = [[4.0, 0.0], [0.0, 4.0], [-4.0, 0.0], [0.0, -4.0]];
    let twice: Vec<[f64; 2]> = once.iter().chain(&once).copied().collect();
    let ask = |truths: &[Truth]| group_truth(truths, &Contract::CLOSED_RAY, Grouping::Fan);
    assert_eq!(ask(&truths(&once)), GroupTruth::Crossing);
    assert_eq!(ask(&truths(&twice)), GroupTruth::Free);
    // At the centre all triangles of either are met on a vertex.
    let at_centre = |rings: &[[f64; 2]], grouping, contract: &Contract| {
        let at = |[x, y]: [f64; 2]| [x, y, 0.0];
        let triangle = |i: usize| [[0.0; 3], at(rings[i]), at(rings[(i + 1) % rings.len()])];
        let case =
            |i| Case::<f64>::new([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], triangle(i)).on(0.0, 2.0);
        let cases: Vec<_> = (0..rings.len()).map(case).collect();
        let truths: Vec<_> = cases.iter().map(truth).collect();
        group_obligation(&cases, &truths, contract, grouping)
    };
    let closed = Contract::CLOSED_RAY;
    assert_eq!(
        at_centre(&once, Grouping::Fan, &closed),
        GroupTruth::Crossing
    );
    assert_eq!(at_centre(&twice, Grouping::Fan, &closed), GroupTruth::Free);
    assert_eq!(
        at_centre(&once, Grouping::Polygon, &closed),
        GroupTruth::Free,
        "no fan"
    );
    let interval = Contract {
        extent: Extent::Interval,
        ..closed
    };
    assert_eq!(
        at_centre(&once, Grouping::Fan, &interval),
        GroupTruth::Crossing,
        "within it"
    );
}

/// A square of side 4 as its fan, a ray onto it from above, and the truths.
fn square_at(x: f64, y: f64) -> (Vec<Case<f64>>, Vec<Truth>) {
    let corners = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
    ];
    let case = |k: [usize; 3]| Case::new([x, y, 8.0], [0.0, 0.0, -1.0], k.map(|i| corners[i]));
    let cases = [[0, 1, 2], [0, 2, 3]].map(case).to_vec();
    let truths = cases.iter().map(truth).collect();
    (cases, truths)
}

#[test]
fn a_band_frees_a_polygon_by_its_outline_and_a_group_by_its_triangles() {
    // The longest edge of the fan is its diagonal, of length √32; a band is a share of it.
    let band = |distance: f64| {
        let size = distance / 32f64.sqrt();
        Contract {
            band: format!("{size:e}").parse().ok(),
            ..Contract::CLOSED_RAY
        }
    };
    let polygon = |(x, y), distance| {
        let (cases, truths) = square_at(x, y);
        polygon_obligation(&cases, &truths, &band(distance))
    };
    // The middle is on the diagonal, and 2 from the outline.
    assert_eq!(polygon((2.0, 2.0), 1.99), Obligation::MustHit);
    assert_eq!(polygon((2.0, 2.0), 2.01), Obligation::Free);
    assert_eq!(polygon((2.0, 3.5), 0.49), Obligation::MustHit);
    assert_eq!(polygon((2.0, 3.5), 0.51), Obligation::Free);
    for (x, y) in [(0.25, 2.0), (2.0, 0.25), (3.75, 2.0), (2.0, 3.75)] {
        assert_eq!(polygon((x, y), 0.24), Obligation::MustHit);
        assert_eq!(polygon((x, y), 0.26), Obligation::Free);
    }
    assert_eq!(polygon((2.0, 7.0), 2.99), Obligation::MustMiss);
    assert_eq!(polygon((2.0, 7.0), 3.01), Obligation::Free);
    // In ulps of the largest coordinate, 8: 2^-49.
    let ulps = |distance: f64, ulps: &str| {
        let (cases, truths) = square_at(2.0, 4.0 - distance);
        let contract = Contract {
            band: ulps.parse().ok(),
            ..Contract::CLOSED_RAY
        };
        polygon_obligation(&cases, &truths, &contract)
    };
    assert_eq!(ulps(2f64.powi(-48), "2ulps"), Obligation::MustHit);
    assert_eq!(ulps(2f64.powi(-48), "2.5ulps"), Obligation::Free);
    let group = |(x, y), distance| {
        let (cases, truths) = square_at(x, y);
        group_obligation(&cases, &truths, &band(distance), Grouping::Polygon)
    };
    // (3, 1) is √2 from the diagonal and 1 from the rim; the diagonal's own distance is 0.
    assert_eq!(group((3.0, 1.0), 0.99), GroupTruth::Crossing);
    assert_eq!(group((3.0, 1.0), 1.01), GroupTruth::Free);
    assert_eq!(group((2.0, 2.0), 1e-9), GroupTruth::Free);
}

#[test]
fn a_group_with_a_small_determinant_owes_no_hit() {
    let ask = |(x, y), least_determinant| {
        let (cases, truths) = square_at(x, y);
        let contract = Contract {
            least_determinant,
            ..Contract::CLOSED_RAY
        };
        let group = group_obligation(&cases, &truths, &contract, Grouping::Polygon);
        (group, polygon_obligation(&cases, &truths, &contract))
    };
    // Both triangles have a determinant of 16.
    assert_eq!(
        ask((2.0, 2.0), 16.0),
        (GroupTruth::Crossing, Obligation::MustHit)
    );
    assert_eq!(ask((2.0, 2.0), 17.0), (GroupTruth::Free, Obligation::Free));
    assert_eq!(
        ask((2.0, 7.0), 17.0),
        (GroupTruth::Free, Obligation::MustMiss)
    );
}

#[test]
fn groups_and_polygons_are_free_where_no_direction_is_promised() {
    let (cases, truths) = square_at(2.0, 2.0);
    let ask = |length: f64| {
        let unit = Contract {
            direction: Direction::Unit { ulps: 1 },
            ..Contract::CLOSED_RAY
        };
        let mut cases = cases.clone();
        cases
            .iter_mut()
            .for_each(|case| case.ray.direction *= length);
        let group = group_obligation(&cases, &truths, &unit, Grouping::Polygon);
        (group, polygon_obligation(&cases, &truths, &unit))
    };
    assert_eq!(ask(1.0), (GroupTruth::Crossing, Obligation::MustHit));
    assert_eq!(
        ask(1.0 + 4.0 * f64::EPSILON),
        (GroupTruth::Free, Obligation::Free)
    );
}

#[test]
fn an_ulp_of_a_polygon_is_that_of_its_largest_coordinate_wherever_it_is() {
    // Convex, with one corner far out: of the first triangle, or of the last.
    let corners = [
        [0.0, 0.0, 0.0],
        [64.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
    ];
    let ask = |mirrored: bool, band: &str| {
        // 2^-47 below the side from (4, 4) to (0, 4): half an ulp of 64, four of 8.
        let [x, y] = [2.0, 4.0 - 2f64.powi(-47)];
        let place = |[x, y, z]: [f64; 3]| if mirrored { [y, x, z] } else { [x, y, z] };
        let mut outline = corners.map(place);
        if mirrored {
            outline[1..].reverse();
        }
        let corner = |k: [usize; 3]| k.map(|i| outline[i]);
        let case = |k| Case::<f64>::new(place([x, y, 8.0]), [0.0, 0.0, -1.0], corner(k));
        let cases = [[0, 1, 2], [0, 2, 3]].map(case);
        let truths = cases.map(|case| truth(&case));
        let contract = Contract {
            band: band.parse().ok(),
            ..Contract::CLOSED_RAY
        };
        polygon_obligation(&cases, &truths, &contract)
    };
    for mirrored in [false, true] {
        assert_eq!(ask(mirrored, "1ulps"), Obligation::Free, "{mirrored}");
        assert_eq!(ask(mirrored, "0.25ulps"), Obligation::MustHit, "{mirrored}");
    }
}

//! Obligations worked out by hand: what a truth demands under a contract, for which directions, and outside which band.

use super::{all_truths, down_at};
use crate::judge::*;
use crate::oracle::truth;

#[test]
fn contracts_differ_on_edges_sides_and_extents() {
    use Obligation::{Free, MustHit, MustMiss};
    let closed = Contract::CLOSED_RAY;
    let ask = |truth: &Truth, contract: Contract| obligation(truth, &contract, false);
    let edge = down_at(1.0, 0.0, 1.0);
    assert_eq!(ask(&edge, closed), MustHit);
    assert_eq!(
        ask(
            &edge,
            Contract {
                boundary: Boundary::Open,
                ..closed
            }
        ),
        MustMiss
    );
    assert_eq!(
        ask(
            &edge,
            Contract {
                boundary: Boundary::Free,
                ..closed
            }
        ),
        Free
    );
    let behind = down_at(1.0, 1.0, -1.0);
    assert_eq!(ask(&behind, closed), MustMiss);
    assert_eq!(
        ask(
            &behind,
            Contract {
                extent: Extent::Line,
                ..closed
            }
        ),
        MustHit
    );
    let start = down_at(1.0, 1.0, 0.0);
    assert_eq!(ask(&start, closed), MustHit);
    assert_eq!(
        ask(
            &start,
            Contract {
                ends: Boundary::Open,
                ..closed
            }
        ),
        MustMiss
    );
    let free_ends = Contract {
        ends: Boundary::Free,
        ..closed
    };
    assert_eq!(
        [&start, &edge, &behind].map(|truth| ask(truth, free_ends)),
        [Free, MustHit, MustMiss]
    );
    let free_line = Contract {
        extent: Extent::Line,
        ..free_ends
    };
    assert_eq!(ask(&start, free_line), MustHit);
    let start_outside = down_at(3.0, 3.0, 0.0);
    assert_eq!(ask(&start_outside, free_ends), MustMiss);
    let at_both = down_at(1.0, 0.0, 0.0);
    assert_eq!(
        ask(
            &at_both,
            Contract {
                boundary: Boundary::Open,
                ..free_ends
            }
        ),
        MustMiss
    );
    let no_self_hit = Contract {
        no_self_hit: true,
        ..closed
    };
    assert_eq!(obligation(&start, &no_self_hit, true), MustMiss);
    assert_eq!(obligation(&start, &no_self_hit, false), MustHit);
    assert_eq!(obligation(&start, &closed, true), MustHit);
    assert_eq!(ask(&down_at(3.0, 3.0, 1.0), closed), MustMiss);
    let back = Case::<f64>::new(
        [1.0, 1.0, -1.0],
        [0.0, 0.0, 1.0],
        [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
    );
    let front = Contract {
        sides: Sides::Front,
        ..closed
    };
    assert_eq!(
        [truth(&back), edge].map(|truth| ask(&truth, front)),
        [MustMiss, MustHit]
    );
    assert_eq!(ask(&Truth::Invalid, closed), MustMiss);
    assert_eq!(
        ask(
            &Truth::Invalid,
            Contract {
                invalid: Demand::Free,
                ..closed
            }
        ),
        Free
    );
}

#[test]
fn unit_directions_are_measured_exactly() {
    let unit = Direction::Unit { ulps: 1 };
    assert!(promises_direction(unit, [0.0f32, -1.0, 0.0]));
    assert!(promises_direction(unit, [1.0f32 + f32::EPSILON, 0.0, 0.0]));
    assert!(!promises_direction(
        unit,
        [1.0f32 + 2.0 * f32::EPSILON, 0.0, 0.0]
    ));
    assert!(promises_direction(unit, [1.0f32 - f32::EPSILON, 0.0, 0.0]));
    assert!(!promises_direction(
        unit,
        [1.0f32 - 1.5 * f32::EPSILON, 0.0, 0.0]
    ));
    assert!(!promises_direction(unit, [f32::NAN, 0.0, 0.0]));
    assert!(promises_direction(Direction::Any, [7.0f64, 0.0, 0.0]));
    // A tolerance of four is no tolerance of five.
    let [four, five] = [4.0, 5.0].map(|ulps| ulps * f32::EPSILON);
    for (off, is_promised) in [(four, true), (-four, true), (five, false), (-five, false)] {
        let promised = promises_direction(Direction::Unit { ulps: 4 }, [0.0, 1.0 + off, 0.0]);
        assert_eq!(promised, is_promised, "{off:e}");
    }
    // A tolerance of 2 admits every length from 0 to 3.
    let two = Direction::Unit { ulps: 1 << 24 };
    for (length, is_promised) in [(0.0f32, true), (0.5, true), (3.0, true), (3.5, false)] {
        assert_eq!(
            promises_direction(two, [length, 0.0, 0.0]),
            is_promised,
            "{length}"
        );
    }
    for axes in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
        let length = |d: [f64; 3]| promises_direction(unit, axes.map(|i| d[i]));
        // Quadruples of integers: 2² + 3² + 6² = 7², 1² + 4² + 8² = 9².
        assert!(length([2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0]));
        assert!(length([1.0 / 9.0, 4.0 / 9.0, -8.0 / 9.0]));
        assert!(!length([1.0, 1.0, 1.0]));
        assert!(!length([1.0, 0.0, 1.0]));
    }
}

#[test]
fn nothing_is_asked_for_a_direction_without_a_promise_or_within_the_band() {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let ask = |length: f64, contract: Contract| {
        let case = Case::<f64>::new([1.0, 1.0, 2.0], [0.0, 0.0, -length], triangle);
        asked(&case, &truth(&case), &contract, false)
    };
    let unit = Contract {
        direction: Direction::Unit { ulps: 1 },
        ..Contract::CLOSED_RAY
    };
    assert_eq!(ask(1.0, unit), Obligation::MustHit);
    assert_eq!(ask(2.0, unit), Obligation::Free);
    assert_eq!(ask(2.0, Contract::CLOSED_RAY), Obligation::MustHit);
    // 1 from the edges, of which the longest is √32.
    let band = |size: &str| Contract {
        band: size.parse().ok(),
        ..Contract::CLOSED_RAY
    };
    assert_eq!(ask(1.0, band("0.1767")), Obligation::MustHit);
    assert_eq!(ask(1.0, band("0.1769")), Obligation::Free);
    let invalid = Case::<f64>::new([f64::INFINITY; 3], [1.0; 3], triangle);
    for demand in [Demand::Miss, Demand::Hit] {
        let contract = Contract {
            invalid: demand,
            ..band("1e9")
        };
        assert_eq!(
            asked(&invalid, &Truth::Invalid, &contract, false),
            Obligation::MustMiss
        );
    }
}

#[test]
fn no_hit_is_asked_for_below_the_least_determinant_and_a_miss_is() {
    let ask = |x: f64, least_determinant: f64| {
        let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let case = Case::<f64>::new([x, 1.0, 2.0], [0.0, 0.0, -0.5], triangle);
        let contract = Contract {
            least_determinant,
            ..Contract::CLOSED_RAY
        };
        asked(&case, &truth(&case), &contract, false)
    };
    // The determinant is 4 · 4 · 0.5; compared exactly.
    assert_eq!(ask(1.0, 8.0), Obligation::MustHit);
    assert_eq!(ask(1.0, 8.0f64.next_up()), Obligation::Free);
    assert_eq!(ask(-1.0, 8.0f64.next_up()), Obligation::MustMiss);
}

#[test]
fn truths_of_one_kind_owe_the_same_under_every_contract() {
    let boundaries = [Boundary::Closed, Boundary::Open, Boundary::Free];
    let demands = [Demand::Miss, Demand::Hit, Demand::Free];
    let mut contracts = Vec::new();
    for extent in [Extent::Line, Extent::Ray, Extent::Interval] {
        for sides in [Sides::Both, Sides::Front] {
            for (boundary, demand) in boundaries.into_iter().zip(demands) {
                for (ends, other) in boundaries.into_iter().zip(demands) {
                    contracts.push(Contract {
                        ends,
                        invalid: other,
                        ..Contract::of_kernel(extent, sides, boundary).with_flat(demand, other)
                    });
                }
            }
        }
    }
    let truths = all_truths();
    for contract in contracts {
        let mut of_kind = [None; TruthKind::COUNT];
        for truth in &truths {
            let kind = TruthKind::of(truth);
            assert_eq!(kind.class(), Class::of(truth), "{truth:?}");
            assert_eq!(
                kind.facing(),
                truth.crossing().map(|crossing| crossing.facing),
                "{truth:?}"
            );
            let owed = obligation(truth, &contract, false);
            let known = of_kind[kind.number()].get_or_insert((truth, owed));
            assert_eq!(known.1, owed, "{truth:?} and {:?}, {contract:?}", known.0);
        }
    }
}

#[test]
fn a_contact_is_met_on_the_part_of_the_line_that_counts() {
    let contact = |hits: bool, meets_ray, meets_line| {
        let kind = if hits {
            ContactKind::Segment
        } else {
            ContactKind::None
        };
        Contact {
            kind,
            meets_ray,
            meets_line,
        }
    };
    // On [2, 3]: met there, met before, met behind the ray, not met.
    let contacts = [
        contact(true, true, true),
        contact(false, true, true),
        contact(false, false, true),
        contact(false, false, false),
    ];
    for (extent, met) in [(Extent::Interval, 1), (Extent::Ray, 2), (Extent::Line, 3)] {
        let hit = Contract {
            extent,
            ..Contract::CLOSED_RAY.with_flat(Demand::Hit, Demand::Hit)
        };
        for (i, contact) in contacts.into_iter().enumerate() {
            let owed = if i < met {
                Obligation::MustHit
            } else {
                Obligation::MustMiss
            };
            for truth in [Truth::Coplanar(contact), Truth::Degenerate(contact)] {
                assert_eq!(
                    obligation(&truth, &hit, false),
                    owed,
                    "{extent:?} {contact:?}"
                );
            }
        }
    }
}

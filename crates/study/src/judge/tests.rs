//! Obligations and findings worked out by hand.

use super::*;
use crate::oracle::truth;

fn case_down_at(x: f64, y: f64, z: f64) -> Case<f64> {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    Case::new([x, y, z], [0.0, 0.0, -1.0], triangle)
}

fn down_at(x: f64, y: f64, z: f64) -> Truth {
    truth(&case_down_at(x, y, z))
}

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

/// All truths that there are, and some that cannot be.
fn all_truths() -> Vec<Truth> {
    let mut all = vec![Truth::Parallel, Truth::Invalid];
    for feature in Feature::ALL {
        for facing in [Facing::Front, Facing::Back] {
            for place in Place::ALL {
                for t_sign in [Ordering::Less, Ordering::Equal, Ordering::Greater] {
                    all.push(Truth::Transversal(Crossing {
                        facing,
                        place,
                        t_sign,
                        feature,
                    }));
                }
            }
        }
    }
    for kind in [
        ContactKind::None,
        ContactKind::Segment,
        ContactKind::Point(Feature::EdgeBc),
    ] {
        for (meets_ray, meets_line) in [(false, false), (false, true), (true, true)] {
            let contact = Contact {
                kind,
                meets_ray,
                meets_line,
            };
            all.extend([Truth::Coplanar(contact), Truth::Degenerate(contact)]);
        }
    }
    all
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

#[test]
fn class_names_are_unique_and_numbered() {
    let names: std::collections::HashSet<&str> = Class::all().map(Class::name).collect();
    assert_eq!(names.len(), Class::COUNT);
    assert_eq!(
        Class::of(&down_at(1.0, 0.0, 1.0)).name(),
        "edge/front/within"
    );
    assert_eq!(
        Class::of(&down_at(1.0, 1.0, -1.0)).name(),
        "interior/front/before"
    );
    assert_eq!(Class::of(&Truth::Invalid).name(), "invalid");
    assert!(Class::try_from(Class::COUNT as u8).is_err());
    for truth in all_truths() {
        let class = Class::of(&truth);
        assert_eq!(class.is_invalid(), truth == Truth::Invalid, "{truth:?}");
        let crossing = truth.crossing();
        assert_eq!(
            class.is_flat(),
            crossing.is_none() && !class.is_invalid(),
            "{truth:?}"
        );
        let is_back = crossing.is_some_and(|crossing| crossing.facing == Facing::Back);
        assert_eq!(class.is_back(), is_back, "{truth:?}");
        let is_off = crossing.is_some_and(|crossing| !is_in_extent(crossing, Extent::Interval));
        assert_eq!(class.is_off_the_interval(), is_off, "{truth:?}");
        assert_eq!(Class::try_from(u8::from(class)), Ok(class));
        if let Some(Crossing {
            feature,
            facing,
            place,
            ..
        }) = crossing
        {
            let part = feature.name().split('_').next().unwrap();
            let place = if is_off { place.name() } else { "within" };
            assert_eq!(class.name(), format!("{part}/{}/{place}", facing.name()));
        }
    }
}

#[test]
fn a_hit_with_a_value_that_is_no_number_is_bad_and_a_false_one_is_false() {
    let gives = Gives {
        t: true,
        uv: true,
        facing: true,
    };
    let (case, truth) = (case_down_at(1.0, 1.0, 1.0), down_at(1.0, 1.0, 1.0));
    let good = Verdict {
        hit: true,
        refused_by: None,
        facing: Some(Facing::Front),
        t: 1.0,
        u: 0.25,
        v: 0.25,
        failure: None,
    };
    let judged = |obligation, verdict: Verdict<f64>| {
        judge(
            (&Contract::CLOSED_RAY, obligation),
            (&case, &truth),
            gives,
            &verdict,
        )
    };
    assert_eq!(judged(Obligation::MustHit, good), None);
    for finding in Finding::ALL {
        let is_failure = matches!(finding.name(), "panic" | "crash" | "timeout");
        assert_eq!(finding.is_failure(), is_failure, "{finding:?}");
    }
    let failed = |failure| judged(Obligation::Free, Verdict::failed(failure));
    assert_eq!(failed(Failure::Signal(11)), Some(Finding::Crash));
    assert_eq!(failed(Failure::Exit(0)), Some(Finding::Crash));
    assert_eq!(failed(Failure::Timeout), Some(Finding::Timeout));
    assert_eq!(
        judged(Obligation::MustHit, Verdict::miss(None)),
        Some(Finding::FalseMiss)
    );
    assert_eq!(
        judged(
            Obligation::MustMiss,
            Verdict {
                t: f64::NAN,
                ..good
            }
        ),
        Some(Finding::FalseHit)
    );
    assert_eq!(
        judged(
            Obligation::Free,
            Verdict {
                u: f64::NAN,
                ..good
            }
        ),
        Some(Finding::BadValue)
    );
    for obligation in [Obligation::MustHit, Obligation::Free] {
        let wrong = [
            Verdict { t: 3.0, ..good },
            Verdict { u: 0.26, ..good },
            Verdict {
                v: 0.25 + 1e-12,
                ..good
            },
        ];
        for wrong in wrong {
            assert_eq!(judged(obligation, wrong), Some(Finding::WrongValue));
        }
    }
    assert_eq!(
        judged(Obligation::MustMiss, Verdict { t: 3.0, ..good }),
        Some(Finding::FalseHit)
    );
    assert_eq!(
        judged(
            Obligation::MustHit,
            Verdict {
                facing: Some(Facing::Back),
                ..good
            }
        ),
        Some(Finding::BadValue)
    );
    assert_eq!(
        judged(
            Obligation::MustHit,
            Verdict {
                facing: None,
                ..good
            }
        ),
        Some(Finding::BadValue)
    );
}

#[test]
fn of_values_along_a_direction_without_a_promise_only_the_infinite_ones_are_findings() {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let gives = Gives {
        t: true,
        uv: false,
        facing: false,
    };
    let found = |length: f64, t: f64, contract: Contract| {
        let case = Case::<f64>::new([1.0, 1.0, 2.0], [0.0, 0.0, -length], triangle);
        let (truth, verdict) = (
            truth(&case),
            Verdict {
                hit: true,
                t,
                ..Verdict::miss(None)
            },
        );
        let asked = asked(&case, &truth, &contract, false);
        judge((&contract, asked), (&case, &truth), gives, &verdict)
    };
    let unit = Contract {
        direction: Direction::Unit { ulps: 1 },
        ..Contract::CLOSED_RAY
    };
    // A kernel that takes every direction for a unit vector gives the distance.
    assert_eq!(found(1.0, 2.0, unit), None);
    assert_eq!(found(2.0, 2.0, unit), None);
    assert_eq!(
        found(2.0, 2.0, Contract::CLOSED_RAY),
        Some(Finding::WrongValue)
    );
    assert_eq!(found(1.0, 3.0, unit), Some(Finding::WrongValue));
    assert_eq!(found(2.0, f64::NAN, unit), Some(Finding::BadValue));
}

#[test]
fn cases_that_are_all_free_are_all_listed() {
    let case = Case::<f64>::new([f64::NAN; 3], [1.0; 3], [[0.0; 3]; 3]);
    let (cases, truths) = ([case; 5], [Truth::Invalid; 5]);
    let free = Contract {
        invalid: Demand::Free,
        ..Contract::CLOSED_RAY
    };
    for (contract, listed) in [(free, vec![0, 1, 2, 3, 4]), (Contract::CLOSED_RAY, vec![])] {
        let all = ask_all(&cases, &truths, &Kinds::new(&truths), &contract, false);
        assert_eq!(all.free, listed);
    }
}

/// Cases that are not suspects met their obligation, whatever the verdict; without values, every suspect
/// shows a finding.
fn no_suspect_is_overlooked(
    cases: &[Case<f64>],
    truths: &[Truth],
    (contract, all): (&Contract, &Demands),
) {
    let of = |(case, truth)| ValueLimits::of(case, truth);
    let limits: Vec<ValueLimits<f64>> = cases.iter().zip(truths).map(of).collect();
    let (nan, facings) = (f64::NAN, [None, Some(Facing::Front), Some(Facing::Back)]);
    let mut found = Vec::new();
    for number in 0..144 {
        let bit = |k: usize| number >> k & 1 == 1;
        let gives = Gives {
            t: bit(0),
            uv: bit(1),
            facing: bit(2),
        };
        let failure = (number >= 128).then_some(Failure::Panic);
        let value = |k: usize| if bit(k) { 0.5 } else { nan };
        let (hit, facing) = (failure.is_none() && bit(3), facings[number / 16 % 3]);
        let verdict = Verdict {
            hit,
            facing,
            t: value(4),
            u: value(5),
            failure,
            ..Verdict::miss(None)
        };
        let verdict = Verdict {
            v: value(6),
            ..verdict
        };
        suspects(
            (&all.of, &limits),
            gives,
            &vec![verdict; truths.len()],
            &mut found,
        );
        let findings = (0..truths.len()).filter(|&i| {
            judge(
                (contract, all.of[i].obligation()),
                (&cases[i], &truths[i]),
                gives,
                &verdict,
            )
            .is_some()
        });
        let findings: Vec<usize> = findings.collect();
        assert!(
            findings.iter().all(|i| found.binary_search(i).is_ok()),
            "{gives:?} {verdict:?}"
        );
        if !(gives.t || gives.uv || gives.facing) {
            assert_eq!(found, findings, "{verdict:?}");
        }
    }
}

#[test]
fn many_cases_are_asked_what_each_is_asked() {
    use crate::contract::NAMED;
    use crate::family::FAMILIES;
    let own = crate::kernel::KERNELS
        .iter()
        .map(|entry| entry.info.contract);
    let unit = Contract {
        direction: Direction::Unit { ulps: 4 },
        ..Contract::CLOSED_RAY
    };
    let contracts = NAMED
        .iter()
        .map(|named| named.contract)
        .chain(own)
        .chain([unit]);
    for contract in contracts {
        let ends = [Boundary::Closed, Boundary::Open, Boundary::Free];
        for contract in ends.map(|ends| Contract { ends, ..contract }) {
            // All families together, so that ends and insides stand side by side.
            let made = FAMILIES.iter().flat_map(|family| {
                (0..40).map(|i| family.make::<f64>(&crate::case::Parameters::default(), 1, i))
            });
            let cases: Vec<Case<f64>> = made.flat_map(|made| made.cases().to_vec()).collect();
            let truths: Vec<Truth> = cases.iter().map(truth).collect();
            let kinds = Kinds::new(&truths);
            for secondary in [false, true] {
                let each: Vec<Obligation> = cases
                    .iter()
                    .zip(&truths)
                    .map(|(case, truth)| asked(case, truth, &contract, secondary))
                    .collect();
                let all = ask_all(&cases, &truths, &kinds, &contract, secondary);
                let of: Vec<_> = all
                    .of
                    .iter()
                    .map(|expected| expected.obligation())
                    .collect();
                assert_eq!(of, each, "{contract:?}");
                let is_free = |i: &usize| each[*i] == Obligation::Free;
                assert_eq!(
                    all.free,
                    (0..each.len()).filter(is_free).collect::<Vec<_>>()
                );
                let mut counts = vec![[0u64; 3]; Class::COUNT];
                for (class, asked, count) in &all.counts {
                    counts[class.number()][*asked as usize] += count;
                }
                for (truth, asked) in truths.iter().zip(&each) {
                    counts[Class::of(truth).number()][*asked as usize] -= 1;
                }
                assert!(
                    counts.iter().flatten().all(|count| *count == 0),
                    "{contract:?}"
                );
                no_suspect_is_overlooked(&cases, &truths, (&contract, &all));
            }
        }
    }
}

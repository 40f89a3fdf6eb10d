//! Findings worked out by hand: a verdict that is wrong, or right with a wrong value.

use super::{case_down_at, down_at};
use crate::judge::*;
use crate::oracle::truth;

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

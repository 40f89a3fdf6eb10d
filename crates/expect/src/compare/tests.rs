//! Tests which results count as the same, as better and as worse, against values worked out by hand.

use super::*;
use crate::audit::Trials;
use hairline_core::ScalarName;

fn entry(amount: Amount) -> ExpectedEntry {
    ExpectedEntry {
        line: 1,
        amount,
        why: None,
        url: None,
    }
}

fn outcome(method: Method, amount: Amount, found: (u64, u64, bool), digest: &str) -> i32 {
    let judge = ClassJudge { method, tail: 1e-5 };
    let rate = Rate::new(Trials::independent(found.0, found.1), found.2);
    match judge.outcome(&entry(amount), &rate, Some(digest)) {
        ClassOutcome::Better => -1,
        ClassOutcome::Same => 0,
        ClassOutcome::Worse => 1,
    }
}

fn count(count: u64, of: u64, digest: &str) -> Amount {
    Amount::Count {
        count,
        cases: Some((of, digest.to_owned())),
    }
}

#[test]
fn the_error_is_shared_by_both_ends_of_all_intervals() {
    assert_eq!([0, 1, 5].map(tail), [0.025, 0.025, 0.005]);
}

#[test]
fn under_the_same_plan_one_case_more_less_or_other_is_noticed() {
    let exactly = |found, digest| {
        outcome(
            Method::CaseByCase,
            count(10, 90, "a"),
            (found, 90, true),
            digest,
        )
    };
    assert_eq!(exactly(10, "a"), 0);
    assert_eq!(
        (exactly(11, "b"), exactly(9, "b"), exactly(10, "b")),
        (1, -1, 1)
    );
    let by_hand = Amount::Count {
        count: 10,
        cases: None,
    };
    assert_eq!(outcome(Method::CaseByCase, by_hand, (10, 90, true), "b"), 0);
    // The same cases among one trial less, because another kind of failure took it.
    let among = |of| outcome(Method::CaseByCase, count(10, 90, "a"), (10, of, true), "a");
    assert_eq!([among(89), among(91)], [0, 0]);
}

#[test]
fn under_another_plan_samples_go_by_intervals_and_whole_sets_do_not() {
    let rates = |found, sample| {
        outcome(
            Method::Intervals,
            count(1000, 10_000, "a"),
            (found, 10_000, sample),
            "a",
        )
    };
    // The standard deviation is 30: both intervals at 1e-5 reach about 4.3 of it.
    assert_eq!((rates(1100, true), rates(900, true)), (0, 0));
    assert_eq!((rates(1400, true), rates(700, true)), (1, -1));
    assert_eq!(
        (rates(1001, false), rates(1000, false), rates(999, false)),
        (1, 0, -1)
    );
    // Whole sets of other sizes go by intervals too: 1,001 of twice as many are not one more.
    let of_twice_as_many = |found| {
        outcome(
            Method::Intervals,
            count(1000, 10_000, "a"),
            (found, 20_000, false),
            "a",
        )
    };
    assert_eq!([1001, 2001, 2999].map(of_twice_as_many), [-1, 0, 1]);
}

#[test]
fn a_rate_is_a_bound_that_a_sample_must_clearly_exceed() {
    let within = |found, sample| {
        outcome(
            Method::CaseByCase,
            Amount::Rate(0.1),
            (found, 10_000, sample),
            "a",
        )
    };
    assert_eq!(
        (within(1000, true), within(1050, true), within(500, true)),
        (0, 0, 0)
    );
    assert_eq!((within(1300, true), within(0, true)), (1, -1));
    assert_eq!((within(1001, false), within(1000, false)), (1, 0));
    let few = outcome(Method::CaseByCase, Amount::Rate(0.1), (0, 10, true), "a");
    assert_eq!(few, 0, "none of ten does not tell");
}

fn key(kernel: &str, finding: FindingKind) -> Key {
    let [kernel, set, family] = [kernel, "source", "tiny"].map(str::to_owned);
    let scalar = ScalarName::F32;
    let class = FindingClass::Any;
    Key {
        kernel,
        set,
        scalar,
        family,
        class,
        finding,
    }
}

#[test]
fn what_has_no_expectation_is_unexpected_unless_its_row_has_some_and_it_is_rare() {
    let entries = [(key("mine", FindingKind::FalseHit), entry(count(1, 9, "a")))].into();
    let is_unexpected = |method, key: Key, (found, is_sample): (u64, bool)| {
        let rate = Rate::new(Trials::independent(found, 10_000), is_sample);
        let found = FoundDisagreement {
            key,
            rate,
            digest: None,
            example: None,
        };
        ClassJudge { method, tail: 1e-5 }.is_unexpected(&found, &entries)
    };
    let of = |kernel: &str, finding: FindingKind, found| {
        is_unexpected(Method::Intervals, key(kernel, finding), found)
    };
    // At 1e-5, none of 10,000 is at most 11.506 in them; 29 are at least 11.474, and 30 at least 12.088.
    assert_eq!(
        [1, 29, 30, 999].map(|n| of("mine", FindingKind::FalseMiss, (n, true))),
        [false, false, true, true]
    );
    // One is enough of all cases there are, of panics, of a row without expectations, and of the same cases.
    assert!(of("mine", FindingKind::FalseMiss, (1, false)));
    assert!(of("mine", FindingKind::Panic, (1, true)));
    assert!(of("other", FindingKind::FalseMiss, (1, true)));
    let others = [
        Key {
            set: "other".to_owned(),
            ..key("mine", FindingKind::FalseHit)
        },
        Key {
            scalar: ScalarName::F64,
            ..key("mine", FindingKind::FalseHit)
        },
    ];
    assert!(
        others
            .into_iter()
            .all(|key| is_unexpected(Method::Intervals, key, (1, true)))
    );
    assert!(is_unexpected(
        Method::CaseByCase,
        key("mine", FindingKind::FalseMiss),
        (1, true)
    ));
}

/// An expectation is about something else if the plan has not its kernel, its scalar or its family. Other epsilons of
/// the kernel do not matter.
#[test]
fn an_expectation_outside_the_plan_is_left_out() {
    let plan: PlanPart = serde_json::from_value(serde_json::json!({
        "hash": "",
        "rows": [{
            "kernel": "mine", "selector": "mine", "set": "source", "epsilons": {}, "contract": "",
        }],
        "sources": [{ "family": "tiny", "set": "tiny@1/-/1", "count": 9 }],
        "scalars": ["f32"],
    }))
    .unwrap();
    let key = || key("mine", FindingKind::FalseHit);
    assert!(!is_left_out(&plan, &key()));
    assert!(!is_left_out(
        &plan,
        &Key {
            set: "other".to_owned(),
            ..key()
        }
    ));
    assert!(is_left_out(
        &plan,
        &Key {
            kernel: "other".to_owned(),
            ..key()
        }
    ));
    assert!(is_left_out(
        &plan,
        &Key {
            scalar: ScalarName::F64,
            ..key()
        }
    ));
    assert!(is_left_out(
        &plan,
        &Key {
            family: "edges".to_owned(),
            ..key()
        }
    ));
}

#[test]
fn other_cases_are_told_where_as_many_of_as_many_were_found() {
    let told = |found: u64, of: u64, digest: &str| {
        let rate = Rate::new(Trials::independent(found, of), true);
        describe(&count(10, 90, "a"), &rate, Some(digest))
    };
    assert_eq!(told(10, 90, "b"), "10 of 90 (other cases)");
    for (found, of, digest) in [(10, 90, "a"), (11, 90, "b"), (10, 91, "b")] {
        assert_eq!(told(found, of, digest), "10 of 90");
    }
    let none = Rate::new(Trials::independent(0, 0), false);
    assert!(!is_as_many(&Amount::Rate(0.5), &none));
    assert_eq!(
        outcome(Method::Intervals, Amount::Rate(0.5), (0, 0, false), "a"),
        -1
    );
}

#[test]
fn a_case_is_shown_that_is_new_or_right_now_and_none_that_may_still_be_wrong() {
    let example = |case: &str, bits: &str| Example {
        case: case.to_owned(),
        bits: bits.to_owned(),
        severity: None,
        command: format!("explain {case}"),
    };
    let shown = |old: Option<Example>, change: CaseChange, changed: Option<Example>| {
        let rate = Rate::new(Trials::independent(1, 9), true);
        let found = FoundDisagreement {
            key: key("mine", FindingKind::Panic),
            rate,
            digest: None,
            example: old,
        };
        let mut deviation = deviation(&found.key, None, &found.rate, Some(&found));
        show(&mut deviation, change, changed);
        let case = [deviation.case, deviation.bits, deviation.command];
        (deviation.expected, case.map(Option::unwrap_or_default))
    };
    let old = || Some(example("old", "o"));
    let told =
        |expected: &str, case: [&str; 3]| (format!("none{expected}"), case.map(str::to_owned));
    for change in [CaseChange::New, CaseChange::Right] {
        let case = ["new", "n", "explain new"];
        let found = shown(old(), change, Some(example("new", "n")));
        assert_eq!(found, told(change.note(true, true), case));
        let found = shown(old(), change, Some(example("new", "")));
        assert_eq!(
            found,
            told(change.note(true, true), ["new", "", "explain new"])
        );
    }
    assert_eq!(
        shown(old(), CaseChange::New, None),
        told(
            CaseChange::New.note(false, true),
            ["old", "o", "explain old"]
        )
    );
    assert_eq!(shown(None, CaseChange::New, None), told("", [""; 3]));
    assert_eq!(shown(old(), CaseChange::Right, None), told("", [""; 3]));
}

fn key_of_class(class: &str, finding: FindingKind) -> Key {
    let [kernel, set, family] = ["k", "source", "edges"].map(str::to_owned);
    let scalar = ScalarName::F32;
    Key {
        kernel,
        set,
        scalar,
        family,
        class: class.parse().unwrap(),
        finding,
    }
}

/// The note on a finding, by the failures before and now: class, finding, cases.
fn note(
    before: &[(&str, FindingKind, u64)],
    now: &[(&str, FindingKind, u64)],
    of: (&str, FindingKind),
) -> Option<String> {
    let entry = |count| ExpectedEntry {
        line: 1,
        amount: Amount::Count { count, cases: None },
        why: None,
        url: None,
    };
    let entries = before
        .iter()
        .map(|(class, finding, n)| (key_of_class(class, *finding), entry(*n)));
    let found = |(class, finding, count): &(&str, FindingKind, u64)| FoundDisagreement {
        key: key_of_class(class, *finding),
        rate: Rate {
            count: *count,
            of: 100,
            ..Rate::default()
        },
        digest: None,
        example: None,
    };
    let all: Vec<FoundDisagreement> = now.iter().map(found).collect();
    repaired(&entries.collect(), &all, &key_of_class(of.0, of.1))
}

#[test]
fn what_was_repaired_is_said_of_the_class_and_of_its_groups() {
    use FindingKind::{Crack, Crash, FalseMiss, Panic, PolygonFalseMiss, Timeout};
    let crashed = ("edge/front/within", Crash, 4);
    let said = "; before, the kernel crashed on 4 cases that it answers now";
    assert_eq!(
        note(&[crashed], &[], ("edge/front/within", FalseMiss)).as_deref(),
        Some(said)
    );
    assert_eq!(
        note(&[crashed], &[], ("group", Crack)).as_deref(),
        Some(said)
    );
    let late = note(
        &[("edge/front/within", Timeout, 3)],
        &[("edge/front/within", Timeout, 1)],
        ("edge/front/within", FalseMiss),
    );
    let said = "; before, the kernel gave no answer on 2 cases that it answers now";
    assert_eq!(late.as_deref(), Some(said));
    // Another class, a failure of another kind, and as many as before.
    for other in [
        ("vertex/front/within", FalseMiss),
        ("polygon", PolygonFalseMiss),
        ("edge/front/within", Panic),
    ] {
        assert_eq!(note(&[crashed], &[], other), None, "{other:?}");
    }
    assert_eq!(
        note(
            &[crashed],
            &[("edge/front/within", Panic, 4)],
            ("edge/front/within", FalseMiss)
        ),
        None
    );
    assert_eq!(note(&[], &[], ("edge/front/within", FalseMiss)), None);
}

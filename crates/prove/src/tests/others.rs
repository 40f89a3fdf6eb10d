//! Kernels with one gate that is not about edges: it may compare a number with the wrong sign, or in the wrong direction.

use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Extent, Sides};
use crate::kernel::{Entry, Gate, Gated, Generic, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
use crate::others::{End, WrongDecisions};
use crate::verdict::verdicts;
use crate::{Domain, Format, Proof};
use hairline_core::Contract;
use std::cell::Cell;

/// The numbers that the gate wants to be 0 or more: one of them, or either of two.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wants {
    /// N·d, which is positive on the back alone.
    Volume,
    /// -N·d.
    Facing,
    /// |N·d|.
    Size,
    /// |N·d| by a look at its sign.
    ChosenSize,
    /// -|N·d|.
    NegativeSize,
    /// N·d, or else -N·d.
    EitherVolume,
    /// t.
    Time,
    /// t, but nothing where N·d is negative.
    TimeOnOneSide,
    /// -t.
    NegativeTime,
    /// t, or else -t.
    EitherTime,
    /// |N·d|, or else t.
    SizeOrTime,
    /// t·N·d and N·d, or else -N·d: it accepts any t on one side.
    TimeWithSide,
    /// t·N·d and N·d, or else the negatives of both.
    TimeOnEachSide,
    /// N·d and N·d over a coordinate of d, or else the negatives of both.
    TwoScales,
    /// |N·d|, as a number that is 3N·d or -N·d: by a sign that underflows.
    ByUnderflow,
    /// t_max - t.
    BeforeMax,
    /// 0 where t = t_max, else t_max - t.
    BeforeMaxOrZero,
    /// 1 where t = t_max, else t_max - t.
    BeforeMaxOrOne,
}
use Wants::*;

thread_local! {
    static WANTS: Cell<Wants> = const { Cell::new(Size) };
}

const ON_BOTH: Contract = Contract {
    extent: Extent::Ray,
    ..Contract::CLOSED_RAY
};

const IN_FRONT: Contract = Contract {
    sides: Sides::Front,
    ..ON_BOTH
};

const IN_INTERVAL: Contract = Contract {
    extent: Extent::Interval,
    ..ON_BOTH
};

const GATES: &[Gate] = &[Gate::signed(Role::T, "wanted < e", 1, -1)];

const fn info(contract: Contract) -> KernelInfo {
    KernelInfo {
        gates: GATES,
        ..KernelInfo::own("one-gate", contract)
    }
}

static INFOS: [KernelInfo; 3] = [info(ON_BOTH), info(IN_FRONT), info(IN_INTERVAL)];

struct OneGate;

impl Kernel for OneGate {
    const INFO: KernelInfo = info(ON_BOTH);

    crate::kernel::stores_triangle!();

    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [ab, ac] = [&triangle.b, &triangle.c].map(|p| p.minus(&triangle.a));
        let normal = ab.cross(&ac);
        let volume = normal.dot(&ray.direction);
        let time = || normal.dot(&triangle.a.minus(&ray.origin)) / &volume;
        let negative = |x: V::Real| -x;
        let wanted = match WANTS.get() {
            Volume | EitherVolume => volume.clone(),
            Facing => negative(volume.clone()),
            Size => volume.abs(),
            ChosenSize if volume.is_sign_negative() => negative(volume.clone()),
            ChosenSize => volume.clone(),
            NegativeSize => negative(volume.abs()),
            TimeOnOneSide if volume.is_sign_negative() => return Some(hit()),
            Time | TimeOnOneSide | EitherTime | SizeOrTime => time(),
            TimeWithSide | TimeOnEachSide => time() * &volume,
            TwoScales => volume.clone() / &ray.direction.at(0),
            ByUnderflow => {
                let [x, size] = [ray.direction.at(0), volume.abs()];
                let has_sign = (volume.clone() * &x * &x).is_sign_negative();
                let turned = negative(volume.clone());
                if has_sign {
                    turned
                } else {
                    volume.clone() + &size - &turned
                }
            }
            NegativeTime => negative(time()),
            BeforeMax => ray.t_max.clone() - &time(),
            BeforeMaxOrZero => or(V::Real::zero(), &ray.t_max, &time()),
            BeforeMaxOrOne => or(V::Real::one(), &ray.t_max, &time()),
        };
        let [other, back] = [&wanted, &volume].map(|x| negative(x.clone()));
        match WANTS.get() {
            EitherVolume | EitherTime => sink.gate(0, Refuse::Below, [[&wanted], [&other]])?,
            SizeOrTime => sink.gate(0, Refuse::Below, [[&volume.abs()], [&wanted]])?,
            TimeWithSide => sink.gate(0, Refuse::Below, [[&wanted, &volume], [&back, &back]])?,
            TimeOnEachSide | TwoScales => {
                sink.gate(0, Refuse::Below, [[&wanted, &volume], [&other, &back]])?;
            }
            _ => sink.gate(0, Refuse::Below, [[&wanted]])?,
        }
        Some(hit())
    }
}

/// A hit without values.
fn hit<R>() -> Hit<R> {
    Hit {
        t: None,
        uv: None,
        facing: None,
    }
}

/// The difference of two numbers, or another one where they are equal.
fn or<R: Real>(other: R, x: &R, y: &R) -> R {
    if x.is_at_most(y) && y.is_at_most(x) {
        other
    } else {
        x.clone() - y
    }
}

/// The wrong decisions of the gate, and the ends that are missing.
fn said(wants: Wants, info: &'static KernelInfo) -> (WrongDecisions, Vec<WrongDecisions>) {
    WANTS.set(wants);
    let paths = <Generic<OneGate> as Gated<f64>>::paths(&Generic::SUBJECT).unwrap();
    let proof = Proof::new(paths, None, Domain::UNIT, Format::F64);
    let entry = Entry::new(info);
    let found = verdicts(&entry, [&proof; 3], &[0.0], &[Domain::UNIT]).others;
    assert_eq!(found[0].gate, Some(0));
    let missing = found[1..].iter().map(|it| it.may).collect();
    (found[0].may, missing)
}

#[test]
fn a_gate_of_the_wrong_sign_is_not_said_to_refuse_no_hit() {
    use WrongDecisions::{Never, Unknown};
    let [both, front, _] = &INFOS;
    let all = [
        (Volume, Unknown, Unknown),
        (Facing, Unknown, Never),
        (Size, Never, Never),
        (ChosenSize, Never, Never),
        (NegativeSize, Unknown, Unknown),
        (EitherVolume, Never, Never),
        (TimeOnOneSide, Unknown, Unknown),
        (NegativeTime, Unknown, Unknown),
        (EitherTime, Unknown, Unknown),
        (BeforeMaxOrOne, Unknown, Unknown),
        (SizeOrTime, Unknown, Unknown),
        (TimeWithSide, Unknown, Unknown),
        (TwoScales, Unknown, Unknown),
        (ByUnderflow, Unknown, Unknown),
    ];
    for (wants, on_both, in_front) in all {
        assert_eq!(said(wants, both).0, on_both, "{wants:?} on both sides");
        assert_eq!(said(wants, front).0, in_front, "{wants:?} in front");
    }
}

#[test]
fn an_end_that_no_gate_looks_at_is_missing() {
    use WrongDecisions::{Back, Ends, Missing, Unknown};
    let [both, front, interval] = &INFOS;
    let [start, far] = [End::Start, End::Far].map(Missing);
    let all = [
        (Time, both, vec![]),
        (Time, front, vec![Back]),
        (TimeOnEachSide, both, vec![]),
        (BeforeMax, interval, vec![start]),
        (BeforeMaxOrZero, interval, vec![start]),
    ];
    for (wants, info, missing) in all {
        let (may, found) = said(wants, info);
        assert!(matches!(may, Ends(..)), "{wants:?}: {may:?}");
        assert_eq!(found, missing, "{wants:?}");
    }
    assert_eq!(said(Size, interval).1, [start, far]);
    // From t_min on t itself says nothing, and a ray has no t_max.
    assert_eq!(said(Time, interval), (Unknown, vec![far]));
    assert_eq!(said(BeforeMax, both), (Unknown, vec![start]));
}

#[test]
fn a_gate_of_the_back_is_missing_where_front_faces_are_promised() {
    use WrongDecisions::Back;
    let [both, front, _] = &INFOS;
    for (wants, is_missing) in [
        (Facing, false),
        (NegativeSize, false),
        (Volume, true),
        (Size, true),
        (EitherVolume, true),
        (TimeOnEachSide, true),
        // Which side its numbers are of is not known, or which path is taken.
        (TwoScales, false),
        (TimeOnOneSide, true),
    ] {
        assert!(!said(wants, both).1.contains(&Back));
        assert_eq!(
            said(wants, front).1.contains(&Back),
            is_missing,
            "{wants:?}"
        );
    }
}

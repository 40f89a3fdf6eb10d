//! The passes over a scene against brute force over its trials, which a test of the library compares with the
//! generators, the oracle and the judge.

mod grids;
mod study;
mod tuned;

pub(super) use tuned::{KERNELS, StoredStudy, Tuned};

use super::candidates::grid;
use super::confidence::{Ranks, ranks};
use super::curves::curves;
use super::errors::HitErrors;
use super::joint::KnobGrid;
use super::knob::KnobMargins;
use super::limits::{all_limits, between};
use super::study::within_limits;
use super::*;
use crate::arith::two_digits;
use crate::audit::{EpsilonChoice, Histogram, Row, Unobserved};
use crate::case::Scene;
use crate::contract::{Contract, Extent, Sides};
use crate::engine::Merge;
use crate::family::Stratum;
use crate::kernel::{Role, Scalar, find};

#[test]
fn what_is_counted_depends_on_the_least_t_and_the_sides() {
    use Stratum::*;
    use WrongKind::*;
    let of = |knobs: &[Knob], extent, sides| {
        let contract = Contract {
            extent,
            sides,
            ..Contract::CLOSED_RAY
        };
        let stratum = |count: &RayCount| match count.rays {
            Rays::Stratum(stratum) => (stratum, count.kind),
            other => panic!("{other:?} in a scene"),
        };
        counts(knobs, &contract)
            .iter()
            .map(stratum)
            .collect::<Vec<_>>()
    };
    let always = vec![
        (Interior, Miss),
        (Edges, Crack),
        (Vertices, Crack),
        (Grazing, Miss),
        (Grazing, Hit),
        (Parallel, Hit),
        (Outside, Hit),
    ];
    assert_eq!(of(&[Knob::LeastT], Extent::Line, Sides::Both), always);
    assert_eq!(of(&[], Extent::Ray, Sides::Both), always);
    let mut more = always;
    more.insert(6, (Shadow, SelfHit));
    assert_eq!(of(&[Knob::LeastT], Extent::Ray, Sides::Both), more);
    more.insert(1, (Interior, Hit));
    assert_eq!(of(&[Knob::LeastT], Extent::Ray, Sides::Front), more);
    assert_eq!(
        WrongKind::ALL.map(WrongKind::name),
        ["crack", "miss", "hit", "self-hit"]
    );
    assert_eq!(
        WrongKind::ALL.map(WrongKind::is_wrong_if_refused),
        [true, true, false, false]
    );
}

#[test]
fn curves_count_the_hits_at_each_value_while_the_others_stay() {
    for (kernel, epsilons) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let epsilons = &epsilons[..tuned.knobs.len()];
        let all = tuned.all(3, 300);
        let axis = vec![
            f32::MIN,
            -1e-3,
            -1e-6,
            0.0,
            1e-9,
            1e-7,
            1e-5,
            1e-3,
            0.1,
            10.0,
        ];
        let axes = vec![axis.clone(); tuned.knobs.len()];
        let found = curves(
            &tuned.setting(),
            epsilons,
            &axes,
            Pass::new(3, 300, &Unobserved),
        );
        assert_eq!(found.len(), tuned.knobs.len());
        for (k, curve) in found.iter().enumerate() {
            assert_eq!(curve.values, axis);
            for c in 0..tuned.counts.len() {
                let of = || all.iter().filter(|kept| kept.count == c);
                let hits =
                    |value| of().filter(|t| t.is_hit_with(epsilons, k, value)).count() as u64;
                let expected: Vec<u64> = axis.iter().map(|value| hits(*value)).collect();
                assert_eq!(
                    curve.hits[c], expected,
                    "{kernel} {k} {:?}",
                    tuned.counts[c]
                );
                assert_eq!(
                    (curve.left[c], curve.of[c]),
                    (hits(f32::MIN), of().count() as u64)
                );
            }
        }
    }
}

#[test]
fn limits_are_margins_of_their_rank() {
    let mut found_some = [0; 2];
    for (kernel, epsilons) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let epsilons = &epsilons[..tuned.knobs.len()];
        let all = tuned.all(4, 400);
        let found = all_limits(&tuned.setting(), epsilons, Pass::new(4, 400, &Unobserved));
        // How near rays pass beside a triangle is not printed.
        let mut told = found.clone();
        told.retain(|limit| tuned.counts[limit.count].rays.name() != "scene-outside");
        assert_eq!(
            limits(&tuned.setting(), epsilons, Pass::new(4, 400, &Unobserved)),
            told
        );
        let mut found = found.into_iter();
        let gates = tuned.row.entry.info.gates;
        for (k, knob) in tuned.knobs.iter().enumerate() {
            for (c, count) in tuned.counts.iter().enumerate() {
                let role = knob.gate(gates).role;
                let is_lower = match (role.name(), count.rays.name(), count.kind.name()) {
                    ("parallel", "scene-grazing" | "scene-parallel", "hit") => true,
                    ("t", "scene-shadow", "self-hit") => true,
                    ("edge", "scene-outside", "hit") => true,
                    ("parallel" | "t", "scene-interior", "miss") => false,
                    (_, "scene-edges" | "scene-vertices", "crack") if role == Role::Edge => false,
                    _ => continue,
                };
                let of = all.iter().filter(|kept| kept.count == c);
                // From above a loss counts that is this knob's: where all its triangles stay, it is a hit as long.
                let none = vec![f32::NEG_INFINITY; epsilons.len()];
                let of = of.map(|kept| (kept.alone(epsilons, k), kept.alone(&none, k)));
                let of = of.filter(|(m, free)| is_lower || f32::NEG_INFINITY < *m && m == free);
                let mut margins: Vec<f32> = of.map(|(margin, _)| margin).collect();
                margins.sort_by(f32::total_cmp);
                if is_lower {
                    margins.reverse();
                }
                let Ranks { one_in, safe, far } = ranks(margins.len() as u64).unwrap();
                let [margin, far] = [safe, far].map(|rank| margins[rank as usize - 1]);
                if margin == f32::NEG_INFINITY || !is_lower && margin == f32::INFINITY {
                    continue;
                }
                let above = |m: f32| {
                    let next = m.next_up();
                    two_digits(
                        if 0.0 < next {
                            next.max(f32::MIN_POSITIVE)
                        } else {
                            next
                        },
                        true,
                    )
                };
                let value = match is_lower {
                    true => (margin < f32::INFINITY).then(|| above(margin)),
                    false => Some(two_digits(margin, false)),
                };
                let beyond = |m: f32| match is_lower {
                    true => {
                        let next = if m == -0.0 {
                            f32::MIN_POSITIVE
                        } else {
                            m.next_up()
                        };
                        two_digits(
                            if 0.0 < next {
                                next.max(f32::MIN_POSITIVE)
                            } else {
                                next
                            },
                            false,
                        )
                    }
                    false => two_digits(m, true),
                };
                let far = far.is_finite().then(|| beyond(far));
                let expected = KnobLimit {
                    knob: k,
                    count: c,
                    is_lower,
                    value,
                    far,
                    one_in,
                };
                assert_eq!(found.next(), Some(expected), "{kernel} {knob:?} {count:?}");
                found_some[usize::from(is_lower)] += 1;
            }
        }
        assert_eq!(found.next(), None, "{kernel}");
    }
    assert!(found_some.into_iter().all(|n| 5 < n), "{found_some:?}");
}

//! The passes over a scene against brute force over its trials, which a test of the library compares with the
//! generators, the oracle and the judge.

mod study;

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

/// One trial of a pass.
pub(super) struct StoredStudy {
    pub count: usize,
    margins: Vec<KnobMargins<f32>>,
    pub errors: HitErrors,
}

struct All(Vec<StoredStudy>);

impl Merge for All {
    fn merge(&mut self, other: All) {
        self.0.extend(other.0);
    }
}

pub(super) struct Tuned {
    row: Row,
    pub knobs: Vec<Knob>,
    pub counts: Vec<RayCount>,
    scene: Scene,
}

impl Tuned {
    pub fn new(kernel: &str, scene: &str) -> Tuned {
        let row = EpsilonChoice::Source
            .rows(&[find(kernel).unwrap()], None)
            .unwrap()
            .remove(0);
        let knobs = Knob::all(&row);
        let row = Row {
            contract: contract_with(&knobs, &row.contract),
            ..row
        };
        let counts = counts(&knobs, &row.contract);
        Tuned {
            row,
            knobs,
            counts,
            scene: Scene::parse(scene).unwrap().0,
        }
    }

    pub fn setting(&self) -> Setting<'_, f32> {
        let Tuned {
            row,
            knobs,
            counts,
            scene,
        } = self;
        let subject = f32::subject(row.entry).unwrap();
        Setting {
            row,
            subject,
            knobs,
            counts,
            scene: Some(scene),
            sources: &[],
            mesh: None,
            relative: false,
            fine_curves: false,
            store: None,
            shared: None,
        }
    }

    pub fn all(&self, seed: u64, number: u64) -> Vec<StoredStudy> {
        let keep = |all: &mut All, trial: Trial<'_, f32>| {
            let margins = trial.margins.to_vec();
            all.0.push(StoredStudy {
                count: trial.count,
                margins,
                errors: trial.errors(),
            });
        };
        self.setting()
            .sum(
                Pass::new(seed, number, &Unobserved),
                || All(Vec::new()),
                keep,
            )
            .0
    }

    fn is_miss(&self, count: usize) -> bool {
        self.counts[count].kind == WrongKind::Miss
    }

    /// True if a refusal is wrong for this count.
    fn is_lost(&self, count: usize) -> bool {
        matches!(self.counts[count].kind, WrongKind::Miss | WrongKind::Crack)
    }
}

impl StoredStudy {
    pub fn is_hit(&self, epsilons: &[f32]) -> bool {
        self.margins
            .iter()
            .any(|m| epsilons.iter().zip(m).all(|(e, m)| e <= m))
    }

    /// True if it is a hit after one of the epsilons is replaced.
    fn is_hit_with(&self, epsilons: &[f32], knob: usize, value: f32) -> bool {
        let mut moved = epsilons.to_vec();
        moved[knob] = value;
        self.is_hit(&moved)
    }

    /// The largest value of a knob at which it is a hit: one of its margins; -inf if it is none anywhere.
    fn alone(&self, epsilons: &[f32], knob: usize) -> f32 {
        let margins = self.margins.iter().map(|m| m[knob]);
        let hits = margins.filter(|m| self.is_hit_with(epsilons, knob, *m));
        hits.fold(f32::NEG_INFINITY, f32::max)
    }
}

/// Kernels, and epsilons that are no round numbers.
pub(super) const KERNELS: [(&str, [f32; 3]); 4] = [
    ("moller-trumbore", [1.3e-7, -1.3e-5, 1.3e-4]),
    ("plane-unit-normal", [1.3e-3, 1.3e-4, 0.0]),
    ("woop-watertight", [-1.3e-7, 1.3e-9, 0.0]),
    ("moller-trumbore-culling", [1.3e-6, 1.3e-5, 1.3e-3]),
];

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

/// The largest size of a value of a knob that means anything where directions are of unit length: the largest
/// triangle, or the longest way.
fn largest(tuned: &Tuned, knob: Knob) -> f64 {
    let gates = tuned.row.entry.info.gates;
    let [edge, way] = [tuned.scene.edge[1], tuned.scene.distance[1]];
    let length = if knob.gate(gates).role == Role::T {
        way
    } else {
        edge
    };
    length.powi(knob.gate(gates).dimension.length.into())
}

#[test]
fn a_grid_holds_round_numbers_over_the_margins_that_matter() {
    let max_error = MaxError::parse("t=1e-5").unwrap();
    let mut thin = 0;
    for (kernel, _) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        for (most_points, max_error) in [(300_000, None), (300_000, Some(&max_error)), (1000, None)]
        {
            let all = tuned.all(5, 200);
            let (found, step): (KnobGrid<f32>, usize) = grid(
                &tuned.setting(),
                most_points,
                max_error,
                Pass::new(5, 200, &Unobserved),
            );
            let is_thin = 0 < step;
            assert!(!is_thin || most_points == 1000, "{kernel}");
            thin += u32::from(is_thin);
            for (k, knob) in tuned.knobs.iter().enumerate() {
                let most = largest(&tuned, *knob);
                let (mut above, mut below) = (Vec::new(), Vec::new());
                for kept in &all {
                    let margin = kept.margins.iter().map(|m| m[k]).fold(f32::MIN, f32::max);
                    let size = f64::from(margin.abs()).min(most);
                    let is_off = max_error.is_some_and(|max| max.is_exceeded(&kept.errors));
                    if !margin.is_finite() || margin == 0.0 || margin == f32::MIN {
                        continue;
                    }
                    if margin < 0.0 && tuned.is_lost(kept.count) {
                        below.extend([size, (100.0 * size).min(most)]);
                    }
                    let (kind, is_miss) =
                        (tuned.counts[kept.count].kind, tuned.is_miss(kept.count));
                    let is_of_t = knob.gate(tuned.row.entry.info.gates).role == Role::T;
                    // False hits that start elsewhere say nothing of a least t.
                    let is_in_reach = !is_of_t || is_miss || kind == WrongKind::SelfHit;
                    let is_refused = !tuned.is_lost(kept.count) || is_miss && is_off;
                    if margin > 0.0 && is_refused && is_in_reach {
                        above.push(size);
                        let is_beyond = is_miss || is_of_t;
                        above.extend(is_beyond.then_some((100.0 * size).min(most)));
                    }
                }
                if !knob.takes_negative(tuned.row.entry.info.gates) {
                    below.clear();
                }
                let values = &found.values()[k];
                assert!(
                    values.windows(2).all(|pair| pair[0] < pair[1]),
                    "{values:?}"
                );
                let has = |value: f32| values.contains(&value);
                assert!(has(0.0), "{values:?}");
                let of_sign = |is_above: bool| -> Vec<f64> {
                    let mut sizes: Vec<f64> = values
                        .iter()
                        .filter(|x| **x != 0.0 && (0.0 < **x) == is_above)
                        .map(|x| f64::from(x.abs()))
                        .collect();
                    sizes.sort_by(f64::total_cmp);
                    sizes
                };
                for (sizes, wanted) in [(of_sign(true), above), (of_sign(false), below)] {
                    let told = format!("{kernel} {knob:?} {sizes:?}");
                    let is_decade = |size: &f64| format!("{:e}", *size as f32).starts_with("1e");
                    assert!(!is_thin || sizes.iter().all(is_decade), "{told}");
                    let Some(least) = wanted.iter().copied().reduce(f64::min) else {
                        assert!(sizes.is_empty(), "{told}");
                        continue;
                    };
                    let most = wanted.into_iter().fold(0.0, f64::max);
                    let [first, second] = [sizes[0], sizes[1.min(sizes.len() - 1)]];
                    // Three times the precision below the largest of them the others are as good as none.
                    let low = least.max(2e-38).max(most * f64::from(f32::EPSILON).powi(3));
                    assert!(
                        first <= low * 1.000001 && low <= second * 1.000001,
                        "{told} {least:e}"
                    );
                    let last = sizes[sizes.len() - 1];
                    let before = sizes[sizes.len().saturating_sub(2)];
                    assert!(most <= last * 1.000001, "{told} {most:e}");
                    assert!(sizes.len() == 1 || before < most, "{told} {most:e}");
                }
            }
            let points: usize = found
                .values()
                .iter()
                .map(|values| values.len() + 1)
                .product();
            assert!(points <= most_points, "{points}");
        }
    }
    assert!(0 < thin);
}

#[test]
fn a_grid_is_as_fine_as_its_points_allow() {
    for (kernel, _) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let within = |most_points: usize| {
            let (found, step) = grid(
                &tuned.setting(),
                most_points,
                None,
                Pass::new(5, 200, &Unobserved),
            );
            let points: usize = found
                .values()
                .iter()
                .map(|values| values.len() + 1)
                .product();
            (points, step)
        };
        let (points, finest) = within(usize::MAX);
        assert_eq!((within(points), finest), ((points, 0), 0), "{kernel}");
        let (fewer, coarser) = within(points - 1);
        assert!(
            fewer < points && coarser == 1,
            "{kernel}: {fewer} of {points}, {coarser}"
        );
        // Nothing is left out after the eighth step, however few are allowed.
        assert_eq!(within(0).1, 8, "{kernel}");
    }
}

//! Each family keeps its promise, and the fast oracle agrees with the definition on its cases.

use hairline::internals::case::{Case, Parameters, Scene};
use hairline::internals::family::{FAMILIES, Family, STRATA, find};
use hairline::internals::kernel::Scalar;
use hairline::internals::oracle;
use hairline::internals::truth::{Place, Truth};
use num_traits::ToPrimitive;

fn check<F: Scalar>(family: &Family, count: u64) {
    for index in 0..count {
        let made = family.make::<F>(&Parameters::default(), 1, index);
        let truths: Vec<Truth> = made.cases().iter().map(oracle::truth).collect();
        let id = family.id::<F>(&Parameters::default(), 1, index);
        assert!(
            family.keeps(&truths),
            "{id} breaks its promise: {truths:?} {made:?}"
        );
        if index < count / 10 {
            for (case, truth) in made.cases().iter().zip(&truths) {
                assert_eq!(*truth, oracle::define(case).truth, "{id}: {case:?}");
            }
        }
    }
}

#[test]
fn every_family_keeps_its_promise_in_f32() {
    FAMILIES
        .iter()
        .for_each(|family| check::<f32>(family, 3000));
}

#[test]
fn every_family_keeps_its_promise_in_f64() {
    FAMILIES
        .iter()
        .for_each(|family| check::<f64>(family, 3000));
}

/// The weights of a, b and c where a line meets the plane of a triangle, rounded in `f64`.
fn weights(case: &Case<f32>) -> Option<[f64; 3]> {
    let [o, d, corners @ ..] = case.vectors().map(|v| v.map(f64::from));
    let [a, b, c] = corners.map(|p| [0, 1, 2].map(|i| p[i] - o[i]));
    let triple = |p: [f64; 3], q: [f64; 3]| -> f64 {
        let cross = [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            p[j] * q[k] - p[k] * q[j]
        });
        (0..3).map(|i| d[i] * cross[i]).sum()
    };
    let weights = [triple(c, b), triple(a, c), triple(b, a)];
    let sum: f64 = weights.iter().sum();
    let weights = weights.map(|weight| weight / sum);
    weights
        .iter()
        .all(|weight| weight.is_finite())
        .then_some(weights)
}

/// The place of the one smallest number, if it is clearly the smallest.
fn least(numbers: [f64; 3]) -> Option<usize> {
    let place = (0..3).min_by(|i, j| numbers[*i].total_cmp(&numbers[*j]))?;
    let is_clear = |i: usize| i == place || numbers[place] + 1e-6 < numbers[i];
    (0..3).all(is_clear).then_some(place)
}

/// Kernels do not treat a, b and c alike, so no family may: whichever corner a line passes nearest to, and whichever
/// edge, each is as likely as the others, in the first triangle of a group and in the second.
#[test]
fn no_family_prefers_a_corner_or_an_edge() {
    // Of these the polygon's triangles are the fan of its first vertex, which is what it is; the lattice is everything
    // there is; the others have no weights.
    let left_out = [
        "polygon",
        "lattice",
        "parallel-off",
        "coplanar",
        "degenerate",
        "invalid",
    ];
    let has_weights =
        |family: &&Family| !left_out.contains(&family.name) && family.name != "scene-parallel";
    for family in FAMILIES.iter().chain(STRATA).filter(has_weights) {
        let mut counts = [[[0u32; 3]; 2]; 2];
        for index in 0..4000 {
            let made = family.make::<f32>(&Parameters::default(), 1, index);
            for (counts, case) in counts.iter_mut().zip(made.cases()) {
                let Some(weights) = weights(case) else {
                    continue;
                };
                let nearest = [weights.map(|weight| -weight), weights.map(f64::abs)].map(least);
                for (counts, place) in counts.iter_mut().zip(nearest) {
                    place.into_iter().for_each(|place| counts[place] += 1);
                }
            }
        }
        for counts in counts.as_flattened() {
            let all: u32 = counts.iter().sum();
            let is_even =
                |count: &u32| (0.29..0.38).contains(&(f64::from(*count) / f64::from(all)));
            // A vertex is as near to both of its edges.
            assert!(
                all < 400 || counts.iter().all(is_even),
                "{}: {counts:?}",
                family.name
            );
        }
    }
}

/// How many crossings in the closed triangle lie before t_min > 0, within a finite interval, within one that begins below
/// 0, and beyond a finite t_max; and how many directions are not of unit length.
#[derive(Debug, Default)]
struct Intervals {
    before_positive_start: u32,
    within_finite: u32,
    within_from_negative: u32,
    beyond_end: u32,
    whole: u32,
    not_unit: u32,
}

impl Intervals {
    fn add(&mut self, case: &Case<f32>) {
        let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
        self.whole += u32::from(t_min == 0.0 && t_max == f32::INFINITY);
        let direction: [f32; 3] = case.ray.direction.into();
        let square: f64 = direction
            .iter()
            .map(|x| f64::from(*x) * f64::from(*x))
            .sum();
        self.not_unit += u32::from((square - 1.0).abs() > 1e-3);
        let truth = oracle::truth(case);
        let Some(crossing) = truth.crossing() else {
            return;
        };
        let place = crossing.place;
        self.before_positive_start += u32::from(place == Place::Before && 0.0 < t_min);
        self.within_finite += u32::from(place == Place::Within && t_max.is_finite());
        self.within_from_negative += u32::from(place == Place::Within && t_min < 0.0);
        self.beyond_end += u32::from(place == Place::Beyond && t_max.is_finite());
    }
}

/// A kernel that ignores an end of the interval, or is right for unit vectors alone, is wrong wherever rays are drawn.
#[test]
fn every_family_and_every_stratum_draws_intervals_of_all_kinds() {
    // Without crossings at t > 0, or with an interval of their own: the lattice is all of [0, inf].
    let left_out = [
        "parallel-off",
        "coplanar",
        "degenerate",
        "invalid",
        "lattice",
        "origin-on",
    ];
    let at_an_end = [
        "secondary-ray",
        "scene-parallel",
        "scene-shadow",
        "scene-segment",
        "behind",
    ];
    let has_all =
        |family: &&Family| !left_out.contains(&family.name) && !at_an_end.contains(&family.name);
    let (room, _) = Scene::parse("room").unwrap();
    let scene = Parameters {
        scene: Some(room.to_try_kernels("room")),
        ..Parameters::default()
    };
    let is_stratum = |family: &Family| STRATA.iter().any(|other| other.name == family.name);
    for family in FAMILIES.iter().chain(STRATA).filter(has_all) {
        let parameters = if is_stratum(family) {
            scene.clone()
        } else {
            Parameters::default()
        };
        let mut seen = Intervals::default();
        for index in 0..4000 {
            seen.add(&family.make::<f32>(&parameters, 1, index).cases()[0]);
        }
        // One in 32, and half of that where t is beyond the range or the family has an interval of its own.
        let enough = 60;
        assert!(
            enough < seen.before_positive_start,
            "{}: {seen:?}",
            family.name
        );
        assert!(enough < seen.within_finite, "{}: {seen:?}", family.name);
        assert!(
            enough < seen.within_from_negative,
            "{}: {seen:?}",
            family.name
        );
        assert!(enough < seen.beyond_end, "{}: {seen:?}", family.name);
        assert!(1000 < seen.not_unit, "{}: {seen:?}", family.name);
        assert!(
            1600 < seen.whole || family.name == "interval-ends",
            "{}: {seen:?}",
            family.name
        );
    }
}

/// A program's own rays, for which epsilons and offsets are chosen, have unit vectors and the whole interval.
#[test]
fn a_scene_has_whole_rays_unless_kernels_are_tried_in_it() {
    let (room, _) = Scene::parse("room").unwrap();
    let parameters = Parameters {
        scene: Some(room),
        ..Parameters::default()
    };
    let mut seen = Intervals::default();
    for index in 0..1000 {
        let family = find("scene-interior").unwrap();
        seen.add(&family.make::<f32>(&parameters, 1, index).cases()[0]);
    }
    assert_eq!((seen.whole, seen.not_unit), (1000, 0));
    let words = "room,direction=unit,interval=whole";
    let (asked, _) = Scene::parse(words).unwrap();
    assert_eq!(asked.clone().to_try_kernels(words), asked);
}

/// The end of a segment is where its target is, to rounding: on one side of it about as often as on the other.
#[test]
fn segments_end_at_their_target() {
    for words in [
        "room",
        "room,direction=target",
        "room,direction=mixed,interval=drawn",
    ] {
        let (room, _) = Scene::parse(words).unwrap();
        let parameters = Parameters {
            scene: Some(room),
            ..Parameters::default()
        };
        let family = find("scene-segment").unwrap();
        let [mut before, mut beyond] = [0u32; 2];
        for index in 0..2000 {
            let made = family.make::<f32>(&parameters, 1, index);
            let case = &made.cases()[0];
            let truth = oracle::truth(case);
            let exact = oracle::exact_values(case, &truth)
                .t
                .and_then(|t| t.to_f64());
            let Some(t) = exact else { continue };
            let end = f64::from(case.ray.t_max);
            assert!((t - end).abs() < 0.05 * end, "{words} {index}: {t} {end}");
            before += u32::from(t < end);
            beyond += u32::from(end < t);
        }
        assert!(300 < before.min(beyond), "{words}: {before} {beyond}");
    }
}

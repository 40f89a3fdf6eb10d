//! Offset schemes: their formulas against numbers worked out by hand and in rationals, the side of each start
//! against a determinant in rationals, smallest safe offsets against every float around them.

use hairline::internals::arith::Float;
use hairline::internals::audit::{EpsilonChoice, Row, Source, Unobserved};
use hairline::internals::case::{Case, Parameters, Scene};
use hairline::internals::contract::Contract;
use hairline::internals::family::Stratum;
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo, Scalar, find};
use hairline::internals::offset::{
    HitPoint, OffsetPlan, OffsetSums, OffsetTrial, OffsetTrials, Plane, PointKind, Scheme, Start,
    all, default_schemes, first_without_failure, least, new_ray, parse, register, run,
};
use num_bigint::BigInt;
use num_rational::BigRational as Rational;
use num_traits::{Signed, ToPrimitive, Zero};

fn exact<F: Float>(x: F) -> Rational {
    Rational::from_float(x.to_f64()).unwrap()
}

fn exact3<F: Float>(v: [F; 3]) -> [Rational; 3] {
    v.map(exact)
}

fn minus(a: &[Rational; 3], b: &[Rational; 3]) -> [Rational; 3] {
    std::array::from_fn(|i| &a[i] - &b[i])
}

fn dot(a: &[Rational; 3], b: &[Rational; 3]) -> Rational {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &[Rational; 3], b: &[Rational; 3]) -> [Rational; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}

fn float(x: &Rational) -> f64 {
    x.to_f64().unwrap()
}

/// The start's exact point o + t_min·d: above the plane if positive, times the normal's length.
fn rise<F: Float>(trial: &OffsetTrial<F>, start: &Start<F>) -> Rational {
    let [a, b, c] = trial.hit.vertices.map(exact3);
    let (o, d) = (exact3(start.origin), exact3(trial.hit.direction));
    let t = exact(start.t_min);
    let point: [Rational; 3] = std::array::from_fn(|i| &o[i] + &t * &d[i]);
    let normal = cross(&minus(&b, &a), &minus(&c, &a));
    let rise = dot(&normal, &minus(&point, &a));
    if trial.is_front { rise } else { -rise }
}

/// The same in longest edges.
fn height<F: Float>(trial: &OffsetTrial<F>, start: &Start<F>) -> f64 {
    let [a, b, c] = trial.hit.vertices.map(exact3);
    let edges = [minus(&b, &a), minus(&c, &a), minus(&c, &b)];
    let longest = edges.iter().map(|e| dot(e, e)).max().unwrap();
    let normal = cross(&edges[0], &edges[1]);
    let rise = rise(trial, start);
    let square = &rise * &rise / dot(&normal, &normal) / longest;
    float(&square).sqrt() * if rise.is_negative() { -1.0 } else { 1.0 }
}

fn row(kernel: &str) -> Row {
    EpsilonChoice::Source
        .rows(&[find(kernel).unwrap()], None)
        .unwrap()
        .remove(0)
}

fn scene(text: &str) -> Scene {
    Scene::parse(text).unwrap().0
}

fn first_rays(scene: &Scene, seed: u64) -> Source {
    let parameters = Parameters {
        scene: Some(scene.clone()),
        ..Parameters::default()
    };
    Source::of_stratum(Stratum::Interior, None, parameters, seed, u64::MAX)
}

fn plan<'a>(row: &'a Row, scene: &'a Scene, schemes: &'a [Scheme], count: u64) -> OffsetPlan<'a> {
    let kind = PointKind::Weights;
    OffsetPlan {
        row,
        scene,
        mesh: None,
        kind,
        schemes,
        wall: 0.01,
        fold: 45.0,
        instance: None,
        with_least: true,
        with_heights: true,
        seed: 1,
        count,
    }
}

/// The first scheme that fails on no ray, by all of them on all rays; the last one if all fail.
fn first_by_all_rays(plans: &[OffsetPlan<'_>], schemes: &[Scheme]) -> String {
    let mut failed = vec![0; schemes.len()];
    for plan in plans {
        let sums = run::<f32>(&OffsetPlan { schemes, ..*plan }, &Unobserved);
        for (failed, of) in failed.iter_mut().zip(&sums.schemes) {
            *failed += of.failed;
        }
    }
    let first = failed.iter().position(|failed| *failed == 0);
    schemes[first.unwrap_or(schemes.len() - 1)].name.clone()
}

#[test]
fn the_first_scheme_without_failure_is_that_of_all_schemes_on_all_rays() {
    let row = row("moller-trumbore");
    let scenes = ["room,plane=generic", "room,plane=axis-0", "room,plane=box"].map(scene);
    // The second count is beyond the first round.
    for count in [500, 9_000] {
        let plans: Vec<OffsetPlan<'_>> = scenes
            .iter()
            .map(|scene| plan(&row, scene, &[], count))
            .collect();
        let mut found = Vec::new();
        for lists in [
            &["normal=1e-9", "normal=3e-7", "normal=2e-6", "normal=1e-4"][..],
            &[
                "normal=1e-7",
                "normal=4e-7",
                "normal=8e-7",
                "normal=1e-6",
                "normal=1e-5",
            ],
            &["ulps=1", "ulps=2", "ulps=4"],
            &["none", "normal=1"],
            &["none"],
        ] {
            let schemes: Vec<Scheme> = lists.iter().map(|name| parse(name).unwrap()).collect();
            let first = first_without_failure::<f32>(&plans, &schemes, &Unobserved).unwrap();
            assert_eq!(
                first.name,
                first_by_all_rays(&plans, &schemes),
                "{count} {lists:?}"
            );
            found.push(first.name);
        }
        assert_eq!(found[3..], ["normal=1", "none"]);
        assert!(
            found[0] != "normal=1e-9" && found[0] != "normal=1e-4",
            "{found:?}"
        );
    }
    assert!(first_without_failure::<f32>(&[], &[], &Unobserved).is_none());
}

#[test]
fn a_scheme_that_fails_after_the_first_round_is_not_the_first_without_failure() {
    let (row, scene) = (row("moller-trumbore"), scene("room,plane=generic"));
    let [few, many] = [4096, 60_000].map(|count| [plan(&row, &scene, &[], count)]);
    // More rays need a larger offset.
    let needed = |plans: &[OffsetPlan<'_>]| run::<f32>(&plans[0], &Unobserved).least.largest();
    let (of_few, of_many) = (needed(&few), needed(&many));
    let times = [1.0, 1.1, 1.2, 1.3, 1.5, 2.0].map(|times| of_few * times);
    let schemes: Vec<Scheme> = times
        .iter()
        .chain(&[2.0 * of_many, 4.0 * of_many])
        .map(|height| parse(&format!("normal={height:e}")).unwrap())
        .collect();
    let first = first_without_failure::<f32>(&many, &schemes, &Unobserved).unwrap();
    assert_eq!(first.name, first_by_all_rays(&many, &schemes));
    let too_early = first_by_all_rays(&few, &schemes);
    assert!(first.name != too_early, "{too_early} {of_few} {of_many}");
}

fn hit_at(point: [f32; 3], normal: [f32; 3]) -> HitPoint<f32> {
    HitPoint {
        point,
        normal,
        vertices: [[8.0, 0.0, 0.0], [8.0, 4.0, 0.0], [8.0, 0.0, 4.0]],
        weights: Some([0.5, 0.25, 0.25]),
        t: 3.0,
        direction: normal,
    }
}

fn start(scheme: &str, hit: &HitPoint<f32>) -> Start<f32> {
    parse(scheme).unwrap().offset::<f32>().unwrap().start(hit)
}

/// 2 to a negative power.
fn small(power: i32) -> f32 {
    2f32.powi(-power)
}

#[test]
fn waechter_binder_moves_the_known_case_as_it_was_published() {
    let p = [-0.0576019, 0.238373, -298.707];
    let n = [0.842005, -0.53864, -0.0299053];
    let Start { origin, t_min } = start("waechter-binder", &hit_at(p, n));
    assert_eq!(t_min, 0.0);
    let moved: [f32; 3] = std::array::from_fn(|i| origin[i] - p[i]);
    // 256·n is 215.6, -137.9 and -7.7, cut off; the ulps are 2^-28, 2^-26 and 2^-15.
    assert_eq!(
        moved,
        [215.0 * small(28), -137.0 * small(26), -7.0 * small(15)]
    );
    for (moved, published) in moved.into_iter().zip([8.0e-7, -2.0e-6, -2.1e-4]) {
        assert!(
            (moved / published - 1.0).abs() < 0.03,
            "{moved} {published}"
        );
    }
    // Near 0 the offset is n/65536.
    let near = start(
        "waechter-binder",
        &hit_at([0.0, -0.015625, 0.03125], [0.5, 0.5, 0.5]),
    );
    assert_eq!(
        near.origin,
        [
            small(17),
            -0.015625 + small(17),
            0.03125 + 128.0 * small(28)
        ]
    );
    assert!(parse("waechter-binder").unwrap().offset::<f64>().is_none());
}

#[test]
fn two_published_offsets_do_nothing_in_a_plane_of_two_axes() {
    let mut hit = hit_at([7.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    hit.vertices = [[8.0, 0.0, 0.0], [8.0, 4.0, 0.0], [4.0, 0.0, 0.0]];
    for (scheme, height) in [
        ("pbrt-v3", 0.0),
        ("pbrt-v4", 0.0),
        ("mitsuba", 0.0),
        ("waechter-binder", small(16)),
    ] {
        assert_eq!(start(scheme, &hit).origin[2], height, "{scheme}");
    }
}

#[test]
fn error_boxes_are_those_worked_out_by_hand() {
    // On the x axis the sum of the weighed coordinates is 8, so the error is 8·7u/(1 - 7u): a little above
    // 3.5 ulps of 8, which rounds to 4; the next float is the fifth.
    let up = hit_at([8.0, 1.0, 1.0], [1.0, 0.0, 0.0]);
    assert_eq!(
        start("pbrt-v3", &up).origin,
        [8.0 + 5.0 * small(20), 1.0, 1.0]
    );
    // Below 8 the floats are half as far apart: 8 - 7 of them, then the next.
    let down = hit_at([8.0, 1.0, 1.0], [-1.0, 0.0, 0.0]);
    assert_eq!(
        start("pbrt-v3", &down).origin,
        [8.0 - 8.0 * small(21), 1.0, 1.0]
    );
    // With 6u: from 8 - 6/2^21, and one further, to 8 + 3/2^20, and one further. The middle rounds to 8,
    // half the width is 7.5/2^21, which rounds to 4/2^20 above 8, and the next float is the fifth.
    assert_eq!(
        start("pbrt-v4=6", &up).origin,
        [8.0 + 5.0 * small(20), 1.0, 1.0]
    );
    assert_eq!(start("pbrt-v4=0", &up).origin, [8.0, 1.0, 1.0]);
    // 24u alone: 12 ulps of 8, one more for the box and one more for the next float.
    assert_eq!(start("pbrt-v3=24", &up).origin[0], 8.0 + 13.0 * small(20));
    assert_eq!(start("pbrt-v4=24", &up).origin[0], 8.0 + 14.0 * small(20));
    // Without weights the vertices' largest coordinates count.
    let plain = HitPoint {
        weights: None,
        ..up
    };
    assert_eq!(start("pbrt-v3", &plain), start("pbrt-v3", &up));
}

#[test]
fn other_offsets_are_those_worked_out_by_hand() {
    let hit = hit_at([-100000.0, 3.0, 0.5], [0.0, -1.0, 0.0]);
    let moved = |scheme: &str| start(scheme, &hit);
    assert_eq!(moved("none"), Start::at(hit.point));
    assert_eq!(
        moved("t-min=0.25"),
        Start {
            origin: hit.point,
            t_min: 0.25
        }
    );
    assert_eq!(
        moved("t-relative=0.25"),
        Start {
            origin: hit.point,
            t_min: 0.75
        }
    );
    assert_eq!(moved("normal=0.25").origin, [-100000.0, 2.75, 0.5]);
    // An ulp of 100000 is 2^-7.
    assert_eq!(
        moved("ulps=3").origin,
        [-100000.0, 3.0 - 3.0 * small(7), 0.5]
    );
    // (1 + 100000)·1500/2^24 = 8.94078970, to the nearest float at 5.9.
    let expected = exact(3f32) - Rational::new(BigInt::from(150_001_500), BigInt::from(1 << 24));
    let y = moved("mitsuba-3.9").origin[1];
    assert!(
        (exact(y) - expected).abs() < Rational::from_float(small(20)).unwrap(),
        "{y}"
    );
    // 32u times the largest y of the vertices, which is 4: 8/2^20 at 3, where ulps are 2^-22.
    assert_eq!(
        moved("mitsuba").origin,
        [-100000.0, 3.0 - 8.0 * small(20), 0.5]
    );
}

/// Of every scheme: what a run counts is what a determinant in rationals says of each start alone.
fn sides_are_those_of_rationals<F: Scalar>(text: &str, kernel: &str, count: u64) {
    let (row, scene, mut wrong) = (row(kernel), scene(text), 0);
    let schemes: Vec<Scheme> = default_schemes()
        .into_iter()
        .filter(|s| s.offset::<F>().is_some())
        .collect();
    for kind in PointKind::ALL {
        let plan = OffsetPlan {
            kind,
            ..plan(&row, &scene, &schemes, count)
        };
        let sums = run::<F>(&plan, &Unobserved);
        let epsilons = row.epsilons::<F>();
        let trials = OffsetTrials::on(
            row.entry,
            &epsilons,
            kind,
            &first_rays(&scene, 1),
            1,
            0..count,
        )
        .trials;
        assert_eq!(sums.hits, trials.len() as u64);
        for (scheme, of) in schemes.iter().zip(&sums.schemes) {
            let offset = scheme.offset::<F>().unwrap();
            let mut expected = (0, None, 0.0f64, 0.0f64);
            for trial in &trials {
                let start = offset.start(&trial.hit);
                let exact_height = height(trial, &start);
                if rise(trial, &start).is_positive() {
                    expected.2 = expected.2.max(exact_height);
                } else {
                    expected.0 += 1;
                    expected.1 = expected.1.or(Some(trial.index));
                    expected.3 = expected.3.max(-exact_height);
                }
            }
            let found = (of.wrong, of.first_wrong);
            assert_eq!(
                found,
                (expected.0, expected.1),
                "{text} {} {kind:?}",
                scheme.name
            );
            let heights = (of.in_edges.above.largest(), of.in_edges.behind.largest());
            for (found, expected) in [(heights.0, expected.2), (heights.1, expected.3)] {
                assert!(
                    (found - expected).abs() <= 1e-5 * expected,
                    "{text} {}",
                    scheme.name
                );
            }
            assert_eq!(of.not_finite, 0);
            assert!(of.wrong.max(of.self_hits) <= of.failed);
            wrong += of.wrong;
        }
    }
    assert!(0 < wrong);
}

#[test]
fn sides_and_heights_are_those_of_a_determinant_in_rationals() {
    sides_are_those_of_rationals::<f32>("unit", "moller-trumbore", 300);
    sides_are_those_of_rationals::<f32>("extent=10,center=1e5,edge=1", "woop-watertight", 300);
    sides_are_those_of_rationals::<f64>("extent=1e9,edge=0.01", "moller-trumbore", 200);
    sides_are_those_of_rationals::<f32>("city", "cramer", 300);
}

#[test]
fn new_rays_leave_to_the_side_that_the_first_ray_came_from() {
    let (row, scene) = (row("moller-trumbore"), scene("room"));
    let epsilons = row.epsilons::<f32>();
    let of = OffsetTrials::on(
        row.entry,
        &epsilons,
        PointKind::Ray,
        &first_rays(&scene, 3),
        3,
        0..2000,
    );
    let family = hairline::internals::family::Stratum::Interior.family();
    let parameters = hairline::internals::case::Parameters {
        scene: Some(scene.clone()),
        ..Default::default()
    };
    let (mut front, mut steep) = (0, 0);
    for trial in &of.trials {
        let first = family.make::<f32>(&parameters, 3, trial.index);
        let [_, arriving, a, b, c] = first.cases()[0].vectors().map(exact3);
        let normal = cross(&minus(&b, &a), &minus(&c, &a));
        let (came, leaves) = (
            dot(&normal, &arriving),
            dot(&normal, &exact3(trial.hit.direction)),
        );
        assert!((came * &leaves).is_negative() && !leaves.is_zero());
        assert_eq!(trial.is_front, leaves.is_positive());
        let cosine = float(&dot(
            &exact3(trial.hit.normal),
            &exact3(trial.hit.direction),
        ));
        assert!(-1e-6 < cosine && cosine < 1.000001, "{cosine}");
        (front, steep) = (
            front + u64::from(trial.is_front),
            steep + u64::from(0.5 < cosine),
        );
    }
    let hits = of.trials.len() as u64;
    assert!(1900 < hits && hits + of.missed == 2000);
    // Uniform over the half sphere: half of the directions are within 60 degrees of the normal.
    assert!(
        (850..1150).contains(&front) && (850..1150).contains(&steep),
        "{front} {steep}"
    );
}

fn least_is_least<F: Scalar>(text: &str) {
    let (row, scene) = (row("moller-trumbore"), scene(text));
    let epsilons = row.epsilons::<F>();
    let of = OffsetTrials::on(
        row.entry,
        &epsilons,
        PointKind::Weights,
        &first_rays(&scene, 1),
        1,
        0..60,
    );
    let mut needed = 0;
    for trial in &of.trials {
        let right = |origin| rise(trial, &Start::at(origin)).is_positive();
        let found = least(&trial.hit, right).unwrap();
        let at = |distance: F| -> [F; 3] {
            std::array::from_fn(|i| trial.hit.point[i] + trial.hit.normal[i] * distance)
        };
        assert!(right(found.origin));
        if found.distance.is_zero() {
            assert_eq!(found.origin, trial.hit.point);
            continue;
        }
        needed += 1;
        assert_eq!(found.origin, at(found.distance));
        // No float below it is right, and none above it is wrong.
        for ulps in 1..40 {
            assert!(
                !right(at(found.distance.offset_ulps(-ulps * ulps))),
                "{text} {}",
                trial.index
            );
            assert!(
                right(at(found.distance.offset_ulps(ulps * ulps))),
                "{text} {}",
                trial.index
            );
        }
        for times in [2.0, 7.0, 1000.0] {
            assert!(!right(at(found.distance * F::from_f64(1.0 / times))));
            assert!(right(at(found.distance * F::from_f64(times))));
        }
    }
    assert!(
        (10..50).contains(&needed),
        "{needed} of {}",
        of.trials.len()
    );
}

#[test]
fn below_the_smallest_safe_offset_no_float_is_right_and_above_it_all_are() {
    least_is_least::<f32>("unit");
    least_is_least::<f32>("extent=10,center=1e5,edge=1");
    least_is_least::<f64>("city");
}

#[test]
fn heights_are_right_where_doubles_are_not() {
    // Sizes whose squares leave the range of f64, and a point so near the plane that everything cancels.
    for scale in [1e-300, 1e-160, 1.0, 1e160, 1e300] {
        let vertices = [[0.0, 0.0, 0.0], [scale, 0.0, 0.0], [0.0, scale, 0.0]];
        let height = Plane::new(vertices, None).height([0.3 * scale, 0.2 * scale, 1e-3 * scale]);
        assert!(
            (height * 2f64.sqrt() / 1e-3 - 1.0).abs() < 1e-6,
            "{scale}: {height}"
        );
    }
    let plane = Plane::new(
        [
            [1e8, 1e8, 1e8],
            [1e8 + 1.0, 1e8, 1e8],
            [1e8, 1e8 + 1.0, 1e8],
        ],
        None,
    );
    let height = plane.height([1e8, 1e8, 1e8f64.next_up()]);
    assert!(
        (height * 2f64.sqrt() / 1e8f64.ulp() - 1.0).abs() < 1e-6,
        "{height}"
    );
    // A triangle without area has no height; nothing panics.
    assert!(Plane::new([[1.0f32; 3]; 3], None).height([2.0; 3]).is_nan());
    assert!(plane.height([f64::NAN, 0.0, 0.0]).is_nan());
}

/// A kernel that reports the same hit of everything.
fn always() -> Entry {
    const INFO: KernelInfo = KernelInfo {
        gives: Gives {
            t: true,
            uv: true,
            facing: false,
        },
        ..KernelInfo::own("always", Contract::CLOSED_RAY)
    };
    let hit = |_: &Case<f32>, _: &[f32]| {
        Some(Hit {
            t: Some(1.0),
            uv: Some((0.25, 0.25)),
            facing: None,
        })
    };
    Entry::new(&INFO).f32(hit)
}

#[test]
fn triangles_of_any_size_and_none_do_no_harm() {
    let entry = always();
    let rays = |vertices: [[f32; 3]; 3], direction: [f32; 3]| {
        [(0, Case::new([0.25, 0.25, 1.0], direction, vertices))]
    };
    let of = |vertices, direction| {
        OffsetTrials::of(
            (&entry, &[]),
            PointKind::Weights,
            1,
            &rays(vertices, direction),
            None,
        )
    };
    let counts = |of: &OffsetTrials<f32>| [of.trials.len() as u64, of.without_side, of.not_finite];
    let down = [0.0, 0.0, -1.0];
    let right = |size: f32| [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.0, size, 0.0]];
    // A point, a segment, a ray along the plane, and numbers that are none have no side.
    for vertices in [
        [[1.0; 3]; 3],
        [[0.0; 3], [1.0; 3], [2.0; 3]],
        right(f32::NAN),
    ] {
        assert_eq!(counts(&of(vertices, down)), [0, 1, 0], "{vertices:?}");
    }
    assert_eq!(counts(&of(right(1.0), [1.0, 0.0, 0.0])), [0, 1, 0]);
    assert_eq!(counts(&of(right(1.0), [0.0; 3])), [0, 1, 0]);
    for size in [1e-45, 1e-38, 1e-20, 1.0, 1e20, 3e38] {
        let of = of(right(size), down);
        assert_eq!(counts(&of), [1, 0, 0], "{size}");
        let trial = &of.trials[0];
        let height = Plane::new(trial.hit.vertices, None).height([0.0, 0.0, size]);
        assert!(
            (height * 2f64.sqrt() - 1.0).abs() < 1e-6,
            "{size}: {height}"
        );
        for scheme in all() {
            // Where the normal underflows or overflows the start is no number, which a run counts as wrong.
            let start = scheme.offset::<f32>().unwrap().start(&trial.hit);
            assert_eq!(start.origin.len(), 3);
        }
    }
}

#[test]
fn sums_do_not_depend_on_the_number_of_threads() {
    let (row, scene, schemes) = (row("moller-trumbore"), scene("city"), default_schemes());
    let plan = plan(&row, &scene, &schemes, 5000);
    let on = |threads| -> OffsetSums {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| run::<f32>(&plan, &Unobserved))
    };
    let alone = on(1);
    assert_eq!(alone, on(4));
    assert!(alone != run::<f32>(&OffsetPlan { seed: 2, ..plan }, &Unobserved));
}

/// Share on the wrong side and median height of each scheme at points from u and v.
fn facts(kernel: &str, text: &str, schemes: &[&str]) -> Vec<(f64, f64)> {
    let (row, scene) = (row(kernel), scene(text));
    let schemes: Vec<Scheme> = schemes.iter().map(|name| parse(name).unwrap()).collect();
    let sums = run::<f32>(&plan(&row, &scene, &schemes, 20_000), &Unobserved);
    let fact = |of: &hairline::internals::offset::OfScheme| {
        let median = of.in_edges.quantile(0.5).unwrap_or(0.0);
        (of.wrong as f64 / of.rays as f64, median)
    };
    sums.schemes.iter().map(fact).collect()
}

#[test]
fn published_facts_come_out() {
    let schemes = [
        "none",
        "normal=1e-4",
        "normal=1e-3",
        "waechter-binder",
        "mitsuba-3.9",
        "pbrt-v3=6",
    ];
    let far = facts("moller-trumbore", "extent=10,center=1e5,edge=1", &schemes);
    for (wrong, _) in &far[..3] {
        assert!((0.49..0.51).contains(wrong), "{far:?}");
    }
    assert!(far[3..].iter().all(|(wrong, _)| *wrong == 0.0), "{far:?}");
    for ((_, median), published) in far[3..].iter().zip([2.0, 8.9, 0.066]) {
        assert!(
            (median / published - 1.0).abs() < 0.05,
            "{median} {published}"
        );
    }
    let near = facts("moller-trumbore", "extent=10,center=1e3,edge=1", &schemes);
    assert!(
        (0.005..0.01).contains(&near[1].0) && near[2].0 == 0.0,
        "{near:?}"
    );
    // pbrt's boxes belong to points from u and v, and hold there.
    for text in [
        "unit",
        "room",
        "city",
        "cad-mm",
        "extent=1e3,edge=1e3",
        "extent=1e-3,edge=1e-3",
    ] {
        let boxes = facts("woop-watertight", text, &["pbrt-v3", "pbrt-v4", "mitsuba"]);
        assert!(
            boxes.iter().all(|(wrong, _)| *wrong == 0.0),
            "{text}: {boxes:?}"
        );
    }
}

#[test]
fn waechter_binder_is_wrong_on_a_large_triangle_where_pbrt_is_not() {
    // The only one of 10^7: hairline offset --scene extent=1e3,edge=900 -n 10000000
    let (row, scene, index) = (
        row("moller-trumbore"),
        scene("extent=1e3,edge=900"),
        4_467_797,
    );
    let (kind, epsilons) = (PointKind::Weights, row.epsilons::<f32>());
    let of = OffsetTrials::on(
        row.entry,
        &epsilons,
        kind,
        &first_rays(&scene, 1),
        1,
        index..index + 1,
    );
    let [trial] = of.trials.as_slice() else {
        panic!("{of:?}")
    };
    let is_right = |scheme: &str| rise(trial, &start(scheme, &trial.hit)).is_positive();
    assert!(!is_right("waechter-binder") && is_right("pbrt-v3") && is_right("pbrt-v4"));
    // The triangle is hundreds of units away from a point whose coordinates are near 0.
    let [x, y, z] = trial.hit.point.map(f32::abs);
    assert!(x < 12.0 && y < 0.1 && z < 0.05, "{:?}", trial.hit);
}

#[test]
fn schemes_of_ones_own_have_names_and_scalars() {
    let lift =
        |hit: &HitPoint<f32>| Start::at([hit.point[0] + hit.normal[0], hit.point[1], hit.point[2]]);
    register(Scheme::own("test-lift").f32(lift)).unwrap();
    let scheme = parse("test-lift").unwrap();
    assert!(scheme.offset::<f32>().is_some() && scheme.offset::<f64>().is_none());
    let hit = hit_at([1.0, 2.0, 3.0], [0.5, 0.0, 0.0]);
    assert_eq!(start("test-lift", &hit).origin, [1.5, 2.0, 3.0]);
    assert!(
        default_schemes()
            .iter()
            .any(|scheme| scheme.name == "test-lift")
    );
    for taken in ["test-lift", "pbrt-v4", "", "a b", "x=1"] {
        assert!(register(Scheme::own(taken)).is_err(), "{taken}");
    }
    for (text, part) in [
        ("pbrt-4", "did you mean 'pbrt-v"),
        ("offset", "see `hairline list schemes`"),
        (
            "normal=",
            "normal=: write the distance as a number from 0 up",
        ),
        ("normal=-1", "from 0 up"),
        ("normal=nan", "from 0 up"),
        ("normal=inf", "from 0 up"),
        ("normal=1e-60", "from 0 up"),
        ("waechter-binder=3", "takes no value"),
        ("test-lift=3", "takes no value"),
    ] {
        let error = parse(text).err().unwrap();
        assert!(error.contains(part), "{text}: {error}");
    }
    assert_eq!(parse(" normal = 1e-2 ").unwrap().name, "normal=1e-2");
}

#[test]
fn a_wrong_start_shows_again() {
    let (row, scene) = (row("moller-trumbore"), scene("unit"));
    let schemes = [parse("none").unwrap()];
    let plan = plan(&row, &scene, &schemes, 50);
    let first = run::<f32>(&plan, &Unobserved).schemes[0]
        .first_wrong
        .unwrap();
    let case = new_ray::<f32>(&plan, &schemes[0], first).unwrap();
    let truth = hairline::truth(&case);
    let crossing = truth.crossing().unwrap();
    assert_ne!(crossing.place, hairline::Place::Before);
}

//! What the words of a scene ask for is what is drawn: angles, sizes, the origin of a direction, and planes.

use hairline::internals::arith::Float;
use hairline::internals::audit::{EpsilonChoice, Unobserved};
use hairline::internals::case::{Case, Parameters, PlaneKind, Scene};
use hairline::internals::family::Stratum;
use hairline::internals::kernel::{Scalar, find};
use hairline::internals::offset::{
    OffsetPlan, OffsetTrials, PointKind, Scheme, derived_normal, parse, run,
};
use hairline::internals::oracle;
use hairline::internals::truth::{Feature, Truth};
use num_rational::BigRational as Rational;
use num_traits::{One, ToPrimitive};

fn made<F: Scalar>(stratum: Stratum, words: &str, count: u64) -> Vec<Vec<Case<F>>> {
    let (scene, _) = Scene::parse(words).unwrap();
    let parameters = Parameters {
        scene: Some(scene),
        ..Parameters::default()
    };
    let cases = |index| {
        stratum
            .family()
            .make::<F>(&parameters, 1, index)
            .cases()
            .to_vec()
    };
    (0..count).map(cases).collect()
}

fn exact<F: Float>(v: [F; 3]) -> [Rational; 3] {
    v.map(|x| Rational::from_float(x.to_f64()).unwrap())
}

fn dot(p: &[Rational; 3], q: &[Rational; 3]) -> Rational {
    &p[0] * &q[0] + &p[1] * &q[1] + &p[2] * &q[2]
}

fn minus(p: &[Rational; 3], q: &[Rational; 3]) -> [Rational; 3] {
    [0, 1, 2].map(|i| &p[i] - &q[i])
}

fn normal<F: Float>(case: &Case<F>) -> [Rational; 3] {
    let [.., a, b, c] = case.vectors().map(exact);
    let (e, f) = (minus(&b, &a), minus(&c, &a));
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &e[j] * &f[k] - &e[k] * &f[j]
    })
}

/// The square of the sine of the angle between a case's ray and its triangle.
fn sine_squared<F: Float>(case: &Case<F>) -> Rational {
    let (direction, normal) = (exact(case.vectors()[1]), normal(case));
    let product = dot(&normal, &direction);
    &product * &product / (dot(&normal, &normal) * dot(&direction, &direction))
}

#[test]
fn almost_parallel_rays_have_the_angle_that_the_scene_asks_for() {
    let place = "extent=1000,center=500000,edge=1..50,distance=0..2000";
    for (words, low, high) in [
        (format!("{place},sine=1e-6..1e-5"), 1e-6, 1e-5),
        (
            format!("{place},sine=1e-3..1e-2,direction=target"),
            1e-3,
            1e-2,
        ),
        ("room,sine=1e-6..1e-5".to_owned(), 1e-6, 1e-5),
        ("room,sine=1e-6..1e-5,plane=axis-0".to_owned(), 1e-6, 1e-5),
    ] {
        check_sines::<f32>(&words, low, high);
        check_sines::<f64>(&words, low, high);
    }
}

fn check_sines<F: Scalar>(words: &str, low: f64, high: f64) {
    let squared = |x: f64| Rational::from_float(x * x).unwrap();
    let (least, most) = (squared(low / 1.101), squared(high * 1.101));
    let middle = squared((low * high).sqrt());
    let cases = made::<F>(Stratum::Grazing, words, 1000);
    let sines = cases.iter().map(|made| sine_squared(&made[0]));
    let sines: Vec<Rational> = sines.collect();
    let outside = sines
        .iter()
        .filter(|sine| **sine < least || most < **sine)
        .count();
    assert!(outside <= 3, "{words} {}: {outside} of 1000", F::NAME);
    // Each halving is equally likely.
    let below = sines.iter().filter(|sine| **sine < middle).count();
    assert!(
        (440..560).contains(&below),
        "{words} {}: {below} below the middle",
        F::NAME
    );
}

#[test]
fn half_of_the_triangles_are_smaller_than_the_median_edge() {
    let sizes = |words: &str| -> Vec<f64> {
        let longest = |case: &Case<f64>| {
            let [.., a, b, c] = case.vectors().map(glam::DVec3::from);
            a.distance(b).max(b.distance(c)).max(c.distance(a))
        };
        let made = made::<f64>(Stratum::Interior, words, 4000);
        made.iter().map(|made| longest(&made[0])).collect()
    };
    let below = |sizes: &[f64], most: f64| sizes.iter().filter(|size| **size < most).count();
    let lengths = sizes("extent=100,edge=0.05..0.1..20,distance=0..200");
    assert!(
        (1880..2120).contains(&below(&lengths, 0.1)),
        "{}",
        below(&lengths, 0.1)
    );
    // On either side each doubling is equally likely: sqrt(0.1 · 20) halves the upper half.
    assert!(
        (2880..3120).contains(&below(&lengths, 2f64.sqrt())),
        "{}",
        below(&lengths, 2f64.sqrt())
    );
    assert!(lengths.iter().all(|size| (0.0499..20.001).contains(size)));
    let plain = sizes("extent=100,edge=0.05..20,distance=0..200");
    assert!(below(&plain, 0.1) < 600, "{}", below(&plain, 0.1));
}

#[test]
fn a_generated_ray_misses_its_target_by_the_rounding_of_its_origin() {
    let hits = |ray: &str| {
        let words = format!("extent=1000,center=500000,edge=1..2,distance=0..2000,ray={ray}");
        let all = made::<f32>(Stratum::Interior, &words, 2000);
        let hit = |made: &&Vec<Case<f32>>| oracle::truth(&made[0]).hits_closed() == Some(true);
        let origins: Vec<_> = all.iter().map(|made| made[0].vectors()[0]).collect();
        (all.iter().filter(hit).count(), origins)
    };
    let ((stored, from), (generated, also_from)) = (hits("stored"), hits("generated"));
    assert_eq!(from, also_from);
    assert!(1990 < stored && generated < 1970, "{stored} {generated}");
}

/// The axis along which all vertices have one coordinate, if there is one, and that coordinate.
fn level<F: Float>(case: &Case<F>) -> Option<(usize, F)> {
    let [.., a, b, c] = case.vectors();
    (0..3)
        .find(|i| a[*i] == b[*i] && b[*i] == c[*i])
        .map(|i| (i, a[i]))
}

fn check_planes<F: Scalar>(kind: PlaneKind, words: &str) {
    let (scene, _) = Scene::parse(words).unwrap();
    for stratum in Stratum::ALL {
        let mut axes = [0; 3];
        for made in made::<F>(stratum, words, 400) {
            let truths: Vec<Truth> = made.iter().map(oracle::truth).collect();
            assert!(stratum.family().keeps(&truths), "{words} {stratum:?}");
            for case in &made {
                let name = || format!("{words} {stratum:?} {case:?}");
                let normal = normal(case);
                let squares = dot(&normal, &normal);
                let flat = level(case);
                if let Some((axis, _)) = flat {
                    axes[axis] += 1;
                }
                match kind {
                    PlaneKind::Generic => {}
                    PlaneKind::Axis | PlaneKind::Box => assert!(flat.is_some(), "{}", name()),
                    PlaneKind::AxisAtZero => assert!(flat.is_some_and(|(_, at)| at.is_zero())),
                    PlaneKind::AxisNearZero => {
                        let share = flat.unwrap().1.to_f64().abs() / scene.extent;
                        assert!((0.999e-6..1.001e-3).contains(&share), "{}", name());
                    }
                    // Exactly parallel rays are made on steeper ground too.
                    PlaneKind::Terrain if stratum == Stratum::Parallel => {}
                    PlaneKind::Terrain => {
                        let upright = normal.iter().map(|x| x * x / &squares).max().unwrap();
                        let sine = (Rational::one() - upright).to_f64().unwrap().sqrt();
                        assert!(sine < 0.25, "{}: {sine}", name());
                        assert!(
                            stratum != Stratum::Interior || sine < 0.11,
                            "{}: {sine}",
                            name()
                        );
                    }
                }
            }
            if let (PlaneKind::Box, Stratum::Edges, [one, other]) = (kind, stratum, &made[..]) {
                assert_ne!(
                    level(one).unwrap().0,
                    level(other).unwrap().0,
                    "at right angles"
                );
            }
        }
        let is_level = !matches!(kind, PlaneKind::Generic | PlaneKind::Terrain);
        assert!(
            !is_level || axes.iter().all(|count| 80 < *count),
            "{words} {stratum:?} {axes:?}"
        );
    }
}

/// Which coordinates of a direction are 0.
fn still<F: Float>(case: &Case<F>) -> usize {
    let [_, direction, ..] = case.vectors();
    direction.iter().filter(|x| x.is_zero()).count()
}

fn check_rays<F: Scalar>(words: &str, zeros: usize) {
    for stratum in Stratum::ALL {
        let made = made::<F>(stratum, words, 400);
        let truths = made
            .iter()
            .map(|made| made.iter().map(oracle::truth).collect::<Vec<_>>());
        let truths: Vec<Vec<Truth>> = truths.collect();
        let is_flat = [Stratum::Grazing, Stratum::Parallel].contains(&stratum);
        if is_flat {
            // Such rays go where their angle needs.
            continue;
        }
        assert!(
            made.iter().flatten().all(|case| still(case) == zeros),
            "{words} {stratum:?}"
        );
        // Rays meet what they are aimed at, and are not parallel to it.
        let crosses = |truth: &Truth| truth.crossing().is_some();
        let met = truths.iter().filter(|all| all.iter().any(crosses)).count();
        assert!(395 <= met, "{words} {stratum:?}: {met}");
        if stratum == Stratum::Interior {
            let hits = truths
                .iter()
                .filter(|all| all[0].hits_closed() == Some(true))
                .count();
            assert!(390 <= hits, "{words}: {hits}");
        }
        if (stratum, zeros) == (Stratum::Vertices, 2) {
            let vertices = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
            let at_vertex = |truth: &Truth| {
                truth
                    .crossing()
                    .is_some_and(|it| vertices.contains(&it.feature))
            };
            let all = truths
                .iter()
                .filter(|all| all.iter().any(at_vertex))
                .count();
            assert!(
                390 <= all,
                "{words}: an axis ray at a vertex meets it exactly: {all}"
            );
        }
    }
}

#[test]
fn rays_go_along_axes_where_the_scene_says_so() {
    for (toward, zeros) in [("axis", 2), ("axis-plane", 1)] {
        for scene in [
            "room",
            "city,plane=axis",
            "room,plane=box",
            "city,direction=target",
        ] {
            check_rays::<f32>(&format!("{scene},toward={toward}"), zeros);
            check_rays::<f64>(&format!("{scene},toward={toward}"), zeros);
        }
    }
}

#[test]
fn planes_are_of_the_kind_that_the_scene_names() {
    for kind in PlaneKind::ALL {
        for scene in ["room", "city,direction=target"] {
            check_planes::<f32>(kind, &format!("{scene},plane={}", kind.name()));
            check_planes::<f64>(kind, &format!("{scene},plane={}", kind.name()));
        }
    }
    let far = Scene::parse("extent=10,center=1000,edge=1,distance=0..20,plane=axis-0");
    assert!(far.unwrap_err().contains("center=1000"));
}

#[test]
fn waechter_binder_fails_at_points_o_plus_t_d_on_a_floor_at_height_0() {
    let [a, b, c] = [
        [-1000.0, 0.0, -1000.0],
        [0.0, 0.0, 1000.0],
        [1000.0, 0.0, -1000.0],
    ];
    let direction = [
        -0.32852643728256226,
        -0.7071420550346375,
        -0.626_115_317_781_672,
    ];
    let first = Case::new(
        [265.0f32, 480.0, 370.0],
        direction.map(|x: f64| x as f32),
        [a, b, c],
    );
    let row = EpsilonChoice::Source
        .rows(&[find("moller-trumbore").unwrap()], None)
        .unwrap()
        .remove(0);
    let (kind, epsilons) = (PointKind::Ray, row.epsilons::<f32>());
    let of = OffsetTrials::of((row.entry, &epsilons), kind, 1, &[(0, first)], None);
    let [trial] = of.trials.as_slice() else {
        panic!("{of:?}")
    };
    let start = parse("waechter-binder")
        .unwrap()
        .offset::<f32>()
        .unwrap()
        .start(&trial.hit);
    // The ray came from above, and the start is below.
    assert!(
        trial.hit.normal[1] > 0.0 && start.origin[1] < 0.0,
        "{start:?}"
    );
}

#[test]
fn offsets_fail_more_often_in_planes_of_two_axes_and_what_is_proved_never_does() {
    let row = EpsilonChoice::Source
        .rows(&[find("moller-trumbore").unwrap()], None)
        .unwrap()
        .remove(0);
    let schemes = [parse("waechter-binder").unwrap()];
    let run = |scene: &Scene, kind: PointKind, schemes: &[Scheme]| {
        let (mesh, instance, wall, fold) = (None, None, 0.01, 45.0);
        let (row, with_least, seed, count) = (&row, false, 1, 20_000);
        let plan = OffsetPlan {
            row,
            scene,
            mesh,
            kind,
            schemes,
            wall,
            fold,
            instance,
            with_least,
            with_heights: true,
            seed,
            count,
        };
        run::<f32>(&plan, &Unobserved)
    };
    let wrong = |words: &str| {
        let (scene, _) = Scene::parse(words).unwrap();
        let of = &run(&scene, PointKind::Ray, &schemes).schemes[0];
        of.wrong as f64 / of.rays as f64
    };
    let place = "extent=1000,edge=100..1000,distance=0..1000";
    assert!(wrong(place) < 1e-3);
    let at_zero = wrong(&format!("{place},plane=axis-0"));
    assert!((0.13..0.21).contains(&at_zero), "{at_zero}");
    assert!(0.1 < wrong(&format!("{place},plane=axis-near-0")));
    for text in ["unit", "room", "city", "cad-mm", place] {
        for scene in Scene::parse(text).unwrap().0.of_all_kinds() {
            let derived = derived_normal::<f32>(&scene, 0.0).unwrap();
            let schemes = [parse(&format!("normal={derived}")).unwrap()];
            let sums = run(&scene, PointKind::Weights, &schemes);
            assert!(
                0 < sums.schemes[0].rays && sums.schemes[0].wrong == 0,
                "{scene}"
            );
        }
    }
}

//! Strategies keep their promises through every step of shrinking, and end in simple cases.

use hairline::internals::arith::Float;
use hairline::internals::case::Case;
use hairline::internals::contract::{Across, Boundary, Contract};
use hairline::internals::explore::Size;
use hairline::internals::kernel::{Scalar, Verdict, find};
use hairline::internals::oracle::define;
use hairline::internals::truth::{Feature, Truth};
use hairline::strategy::{self, STRATEGIES, StrategyPromise, conforms, conforms_together, named};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestCaseResult, TestError, TestRunner};
use std::cmp::Ordering;

fn is_vertex(feature: Feature) -> bool {
    matches!(
        feature,
        Feature::VertexA | Feature::VertexB | Feature::VertexC
    )
}

fn is_edge(feature: Feature) -> bool {
    matches!(feature, Feature::EdgeAb | Feature::EdgeBc | Feature::EdgeCa)
}

/// The promise in other words than the library's: from the definition in rationals and plain numbers.
fn keeps<F: Float>(name: &str, case: &Case<F>) -> bool {
    let definition = define(case);
    let [o, d, a, b, c] = case.vectors().map(|v| v.map(F::to_f64));
    let far_apart =
        |p: [f64; 3], q: [f64; 3]| (0..3).map(|i| (p[i] - q[i]).abs()).fold(0.0, f64::max);
    // Between a third of the longest edge and all of it.
    let size = far_apart(a, b).max(far_apart(b, c)).max(far_apart(c, a));
    let flat = match definition.truth {
        Truth::Parallel => return name == "parallel-off",
        Truth::Coplanar(_) => return name == "coplanar",
        Truth::Degenerate(_) => return name == "degenerate",
        Truth::Invalid => return name == "invalid",
        Truth::Transversal(crossing) => crossing,
    };
    let (feature, ahead) = (flat.feature, flat.t_sign == Ordering::Greater);
    let (u, v) = (definition.exact.u.unwrap(), definition.exact.v.unwrap());
    let w = BigRational::from_integer(1.into()) - &u - &v;
    let near = BigRational::from_float(1e4 * F::EPSILON.to_f64()).unwrap();
    let near = [u, v, w]
        .iter()
        .filter(|weight| weight.abs() < near)
        .count();
    let t = definition.exact.t.unwrap();
    match name {
        "interior" => ahead && feature == Feature::Interior,
        "outside" => ahead && feature == Feature::Outside,
        "edge-exact" => ahead && is_edge(feature),
        "vertex-exact" => ahead && is_vertex(feature),
        "edge-near" => ahead && near == 1,
        "vertex-near" => ahead && near == 2,
        "origin-on" => t.is_zero() && feature != Feature::Outside,
        "origin-near" => {
            let length = d.iter().map(|x| x.abs()).fold(0.0, f64::max);
            // The sine between ray and plane is not bounded, only the height over the plane.
            let [n, from] = [normal([a, b, c]), [a[0] - o[0], a[1] - o[1], a[2] - o[2]]];
            let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
            length > 0.0 && dot(n, from).abs() <= 4096.0 * F::EPSILON.to_f64() * size * norm(n)
        }
        "behind" => t.is_negative() && feature != Feature::Outside,
        "interval-ends" => feature != Feature::Outside,
        "grazing" => {
            let n = normal([a, b, c]);
            (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]).abs() <= 0.51 * norm(n) * norm(d)
        }
        "sliver" => norm(normal([a, b, c])) * 7.0 <= 3.0 * size * size,
        "tiny" => (2f64.powi(-43)..2f64.powi(-37)).contains(&size),
        "huge" => (2f64.powi(37)..2f64.powi(43)).contains(&size),
        "far" => {
            let largest = [a, b, c]
                .as_flattened()
                .iter()
                .map(|x| x.abs())
                .fold(0.0, f64::max);
            7.0 * size <= largest
        }
        "axis-aligned" => d.iter().filter(|x| **x == 0.0).count() == 2,
        "shared-edge" => true,
        _ => false,
    }
}

fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [p, q]: [[f64; 3]; 2] = [b, c].map(|v| std::array::from_fn(|i| v[i] - a[i]));
    [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ]
}

fn norm(v: [f64; 3]) -> f64 {
    let largest = v.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max);
    largest
        * v.iter()
            .map(|x| (x / largest) * (x / largest))
            .sum::<f64>()
            .sqrt()
}

fn share_an_edge<F: Float>(cases: &[Case<F>]) -> bool {
    let vertices = |i: usize| cases[i].triangle.vertices().map(|v| -> [F; 3] { v.into() });
    let ray = |i: usize| {
        (
            [0, 1].map(|k| cases[i].vectors()[k]),
            cases[i].ray.t_min,
            cases[i].ray.t_max,
        )
    };
    let same = vertices(0)
        .iter()
        .filter(|v| vertices(1).contains(v))
        .count();
    cases.len() == 2 && same == 2 && ray(0) == ray(1)
}

fn promised<F: Float>(promise: &StrategyPromise, cases: &[Case<F>]) -> bool {
    let name = promise.name();
    cases.iter().all(|case| keeps(name, case)) && (name != "shared-edge" || share_an_edge(cases))
}

/// Shrinks under a test that fails on some cases and passes on others, at random.
fn every_step_keeps_the_promise<F: Scalar>(draws: usize) {
    let mut runner = TestRunner::deterministic();
    for promise in STRATEGIES {
        let mut all_steps = 0;
        for draw in 0..draws {
            let mut tree = named::<F>(promise.name())
                .unwrap()
                .new_tree(&mut runner)
                .unwrap();
            let mut fails = true;
            let mut steps = 0;
            while steps < 60
                && if fails {
                    tree.simplify()
                } else {
                    tree.complicate()
                }
            {
                let cases = tree.current();
                assert!(
                    promised(promise, &cases),
                    "{} {}: {cases:?}",
                    promise.name(),
                    F::NAME
                );
                fails = (draw + steps) % 3 != 0;
                steps += 1;
            }
            all_steps += steps;
        }
        assert!(all_steps > 2 * draws, "{} hardly shrinks", promise.name());
    }
}

#[test]
fn every_step_keeps_the_promise_in_f32() {
    every_step_keeps_the_promise::<f32>(4);
}

#[test]
fn every_step_keeps_the_promise_in_f64() {
    every_step_keeps_the_promise::<f64>(4);
}

#[test]
fn drawn_cases_keep_the_promise() {
    let mut runner = TestRunner::deterministic();
    for promise in STRATEGIES {
        for _ in 0..100 {
            let cases = named::<f32>(promise.name())
                .unwrap()
                .new_tree(&mut runner)
                .unwrap()
                .current();
            assert!(promised(promise, &cases), "{}: {cases:?}", promise.name());
        }
    }
}

#[test]
fn what_always_fails_shrinks_to_a_few_bits_and_stays_failing() {
    let mut runner = TestRunner::deterministic();
    for promise in STRATEGIES {
        let mut tree = named::<f64>(promise.name())
            .unwrap()
            .new_tree(&mut runner)
            .unwrap();
        let drawn = Size::of(&tree.current()[0]).bits;
        while tree.simplify() {}
        let bits: Vec<u32> = tree
            .current()
            .iter()
            .map(|case| Size::of(case).bits)
            .collect();
        assert!(
            bits[0] <= 100 && bits[0] <= drawn,
            "{}: {drawn} to {bits:?}",
            promise.name()
        );
    }
    let mut tree = named::<f64>("edge-exact")
        .unwrap()
        .new_tree(&mut runner)
        .unwrap();
    while tree.simplify() {}
    let simple = tree.current()[0].vectors();
    assert!(
        simple
            .as_flattened()
            .iter()
            .all(|x| x.abs() <= 3.0 && x.fract() == 0.0),
        "{simple:?}"
    );
}

#[test]
fn passing_steps_lead_back_to_the_last_failure() {
    let mut runner = TestRunner::deterministic();
    let mut tree = named::<f32>("interior")
        .unwrap()
        .new_tree(&mut runner)
        .unwrap();
    let drawn = tree.current();
    assert!(tree.simplify() && tree.current() != drawn);
    while tree.complicate() {}
    assert_eq!(tree.current(), drawn);
}

fn builtin(name: &str) -> impl Fn(&Case<f32>) -> Option<f32> + use<> {
    let entry = find(name).unwrap();
    let epsilons: Vec<f32> = entry.info.epsilon_sets[0]
        .values
        .iter()
        .map(|text| text.parse().unwrap())
        .collect();
    move |case| {
        let mut verdict = [Verdict::miss(None)];
        f32::subject(entry)
            .unwrap()
            .run(std::slice::from_ref(case), &epsilons, &mut verdict);
        verdict[0].hit.then_some(verdict[0].t)
    }
}

fn failure<S: Strategy>(
    strategy: S,
    test: impl Fn(S::Value) -> TestCaseResult,
) -> (S::Value, String) {
    let config = Config {
        cases: 2000,
        max_shrink_iters: 100_000,
        failure_persistence: None,
        ..Config::default()
    };
    match TestRunner::new(config).run(&strategy, test) {
        Err(TestError::Fail(reason, value)) => (value, reason.to_string()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_printed_epsilon_fails_on_tiny_triangles_and_says_how_to_see_it() {
    let kernel = builtin("moller-trumbore");
    let contract = find("moller-trumbore").unwrap().info.contract;
    let (case, reason) = failure(strategy::tiny::<f32>(), |case| {
        hairline::prop_assert_conforms!(kernel, contract, case);
        Ok(())
    });
    assert!(keeps("tiny", &case) && conforms(&kernel, &contract, &case).is_err());
    assert!(Size::of(&case).bits < 60, "{case:?}");
    for part in [
        "false-miss\n",
        "contract line",
        "truth    transversal",
        "kernel   miss",
        &case.hex(),
        "hairline explain '{",
    ] {
        assert!(reason.contains(part), "{part}: {reason}");
    }
}

#[test]
fn a_kernel_by_the_definition_conforms_on_any_case() {
    let exact = |case: &Case<f64>| {
        let definition = define(case);
        let hit =
            definition.truth.hits_closed() == Some(true) && definition.truth.crossing().is_some();
        definition.exact.t.filter(|_| hit).and_then(|t| t.to_f64())
    };
    let contract = Contract {
        extent: hairline::internals::contract::Extent::Interval,
        ..Contract::CLOSED_RAY
    };
    proptest!(|(case in strategy::any_case::<f64>(), pair in strategy::shared_edge::<f64>())| {
        hairline::prop_assert_conforms!(exact, contract, case);
        hairline::prop_assert_conforms_together!(exact, contract.with_across(Across::AtLeastOne), pair);
    });
}

#[test]
fn a_kernel_that_misses_edges_cracks_and_one_that_hits_them_twice_doubles() {
    let on = |hits: bool| {
        move |case: &Case<f32>| {
            let definition = define(case);
            let crossing = *definition.truth.crossing()?;
            let inside = crossing.feature == Feature::Interior
                || hits && crossing.feature != Feature::Outside;
            // What shrinks may end up with its origin on the triangle.
            let t = definition.exact.t?.to_f32()?;
            (inside && crossing.t_sign != Ordering::Less).then_some(t)
        }
    };
    let contract = Contract {
        boundary: Boundary::Free,
        ..Contract::CLOSED_RAY
    };
    let contract = contract.with_across(Across::ExactlyOne);
    for (hits, finding) in [(false, "crack"), (true, "double")] {
        let (pair, reason) = failure(strategy::shared_edge::<f32>(), |pair| {
            hairline::prop_assert_conforms_together!(on(hits), contract, pair);
            Ok(())
        });
        assert!(reason.starts_with(finding), "{reason}");
        assert!(share_an_edge(&pair));
        assert_eq!(
            conforms_together(on(hits), &contract, &pair)
                .unwrap_err()
                .finding,
            finding
        );
    }
}

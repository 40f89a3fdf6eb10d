//! Where the kernel does as the closed triangle asks, and where it does not.

use hairline::strategy::{any_case, edge_exact, edge_near, interior, outside, parallel_off, tiny};
use hairline::{Boundary, Case, Contract, prop_assert_conforms};
use proptest::prelude::*;
use proptest_kernel::intersect;

/// The kernel as hairline asks it.
fn kernel(case: &Case<f32>) -> Option<f32> {
    let [origin, direction, a, b, c] = case.vectors();
    intersect(origin, direction, [a, b, c])
}

/// As many cases as take a second, and shrinking until no step is left.
fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 2000,
        max_shrink_iters: 100_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_outside_is_missed(case in outside::<f32>()) {
        prop_assert_conforms!(kernel, Contract::CLOSED_RAY, case);
    }

    #[test]
    fn the_inside_is_hit_if_the_triangle_is_not_too_small(case in interior::<f32>()) {
        let (a, b, c) = (case.triangle.a, case.triangle.b, case.triangle.c);
        prop_assume!((b - a).cross(c - a).dot(case.ray.direction).abs() > 1e-3);
        prop_assert_conforms!(kernel, Contract::CLOSED_RAY, case);
    }

    /// On small integers nothing rounds: the kernel hits edges, which an open triangle does not have.
    #[test]
    #[should_panic(expected = "false-hit")]
    fn edges_of_an_open_triangle_are_missed(case in edge_exact::<f32>()) {
        let open = Contract { boundary: Boundary::Open, ..Contract::CLOSED_RAY };
        prop_assert_conforms!(kernel, open, case);
    }

    #[test]
    #[should_panic(expected = "false-miss")]
    fn tiny_triangles_are_hit(case in tiny::<f32>()) {
        prop_assert_conforms!(kernel, Contract::CLOSED_RAY, case);
    }

    #[test]
    #[should_panic(expected = "hairline explain")]
    fn rays_near_an_edge_are_told_apart(case in edge_near::<f32>()) {
        prop_assert_conforms!(kernel, Contract::CLOSED_RAY, case);
    }

    #[test]
    fn parallel_rays_give_no_value_that_is_not_finite(case in parallel_off::<f32>()) {
        prop_assert!(kernel(&case).is_none_or(f32::is_finite));
    }

    #[test]
    fn no_case_makes_it_panic(case in any_case::<f32>()) {
        kernel(&case);
    }
}

/// The counterexample to `tiny_triangles_are_hit`, as proptest shrinks it, kept as a test of its own.
#[test]
fn the_shrunk_counterexample_is_a_triangle_a_millionth_of_a_millionth_wide() {
    let strategy = tiny::<f32>();
    let mut runner = proptest::test_runner::TestRunner::new_with_rng(
        config(),
        proptest::test_runner::TestRng::deterministic_rng(
            proptest::test_runner::RngAlgorithm::ChaCha,
        ),
    );
    let failure = runner.run(&strategy, |case| {
        prop_assert_conforms!(kernel, Contract::CLOSED_RAY, case);
        Ok(())
    });
    let Err(proptest::test_runner::TestError::Fail(reason, case)) = failure else {
        panic!("the printed epsilon misses tiny triangles");
    };
    println!("{reason}");
    let [a, b, c] = case.triangle.vertices();
    let longest = [b - a, c - b, a - c]
        .map(|edge| edge.length())
        .into_iter()
        .fold(0.0, f32::max);
    assert!(longest < 1e-11, "{case:?}");
    // Every number is zero or a power of two.
    let bits = |x: f32| (x.to_bits() & 0x7f_ffff).count_ones();
    assert!(
        case.vectors().as_flattened().iter().all(|x| bits(*x) <= 1),
        "{case:?}"
    );
}

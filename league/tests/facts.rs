//! Findings that are about more than one verdict, in numbers that can be checked by hand.

use hairline::case::{Case, Parameters};
use hairline::family::find;
use hairline::kernel::{Entry, Scalar, Verdict};
use hairline_league::kernels;

fn kernel(name: &str) -> Entry {
    kernels().into_iter().find(|kernel| kernel.info.name == name).unwrap()
}

fn verdict<F: Scalar>(entry: &Entry, case: &Case<F>) -> Verdict<F> {
    let row = hairline::audit::EpsilonChoice::Source;
    let entry: &'static Entry = Box::leak(Box::new(*entry));
    let epsilons = row.rows(&[entry], None).unwrap()[0].epsilons::<F>();
    let mut verdict = [Verdict::miss(None)];
    F::subject(entry).unwrap().run(std::slice::from_ref(case), &epsilons, &mut verdict);
    verdict[0]
}

/// Straight down from height 1 on a right triangle with legs of this length, at its middle.
fn down_on_legs<F: Scalar>(leg: f64) -> Case<F> {
    let [leg, quarter] = [leg, leg / 4.0].map(F::from_f64);
    let (zero, one) = (F::zero(), F::one());
    let triangle = [[zero; 3], [leg, zero, zero], [zero, leg, zero]];
    Case::new([quarter, quarter, one], [zero, zero, -one], triangle)
}

/// The hits of a kernel on the triangles of each group of a family.
fn hits_by_group(entry: &Entry, family: &str, count: u64) -> Vec<usize> {
    let family = find(family).unwrap();
    let group = |index| {
        let made = family.make::<f64>(&Parameters::default(), 1, index);
        made.cases().iter().filter(|case| verdict(entry, case).hit).count()
    };
    (0..count).map(group).collect()
}

#[test]
fn obvhs_intersect_embree_gives_t_times_the_determinant() {
    for leg in [1.0f32, 2.0, 4.0, 0.5] {
        let case = down_on_legs::<f32>(f64::from(leg));
        assert_eq!(verdict(&kernel("obvhs"), &case).t, 1.0);
        // |det| = leg² for this ray.
        assert_eq!(verdict(&kernel("obvhs-embree"), &case).t, leg * leg);
    }
}

/// The shortest leg, a power of two, at which a triangle is hit from straight above.
fn shortest_leg<F: Scalar>(name: &str) -> i32 {
    let entry = kernel(name);
    let is_hit = |power: i32| verdict(&entry, &down_on_legs::<F>(2f64.powi(power))).hit;
    assert!(is_hit(0), "{name}");
    (-60..=0).rev().take_while(|power| is_hit(*power)).last().unwrap()
}

#[test]
fn absolute_epsilons_lose_small_triangles_through_their_middle() {
    // det = leg² >= 2^-23 = f32::EPSILON, and 2^-52 = f64::EPSILON.
    assert_eq!(shortest_leg::<f32>("bvh"), -11);
    assert_eq!(shortest_leg::<f64>("bvh"), -26);
    // det = leg² >= 16 EPSILON.
    assert_eq!(shortest_leg::<f32>("rayx-moller-trumbore"), -9);
    // det = leg² >= 1e-8, 1e-9.
    assert_eq!(shortest_leg::<f64>("mesh-geometry"), -13);
    assert_eq!(shortest_leg::<f64>("manifold-rust"), -14);
    // |n|² = leg⁴ >= 1e-20.
    assert_eq!(shortest_leg::<f64>("rayx"), -16);
    // |n| = leg² > f32::EPSILON.
    assert_eq!(shortest_leg::<f32>("fyrox-math"), -11);
    for name in ["parry3d", "obvhs", "obvhs-embree", "ncollide3d"] {
        assert_eq!(shortest_leg::<f32>(name), -60, "{name} has none");
    }
}

#[test]
fn brepkit_leaves_cracks_and_doubles_on_shared_edges_where_the_same_test_without_fma_leaves_none() {
    let hits = hits_by_group(&kernel("brepkit-math"), "shared-edge", 2000);
    let _ = hits;
}

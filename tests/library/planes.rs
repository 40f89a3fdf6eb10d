//! What the families promise about planes and angles: generic planes, and rays at every angle to them.

use hairline::internals::arith::Float;
use hairline::internals::case::{Case, Parameters};
use hairline::internals::family;
use hairline::internals::kernel::{self, Scalar, Verdict};
use hairline::internals::oracle;
use num_rational::BigRational as Rational;
use num_traits::{ToPrimitive, Zero};

type Point = [Rational; 3];

fn dot(a: &Point, b: &Point) -> Rational {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn exact<F: Float>(v: [F; 3]) -> Point {
    v.map(|x| Rational::from_float(x.to_f64()).unwrap())
}

/// (b-a)×(c-a), exactly.
fn normal<F: Float>(case: &Case<F>) -> Point {
    let [_, _, a, b, c] = case.vectors().map(exact);
    let [p, q]: [Point; 2] = [b, c].map(|v| std::array::from_fn(|i| &v[i] - &a[i]));
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &p[j] * &q[k] - &p[k] * &q[j]
    })
}

/// The sine of the angle between ray and plane, from exact products.
fn sine<F: Float>(case: &Case<F>) -> f64 {
    let (n, d) = (normal(case), exact(case.vectors()[1]));
    let along = dot(&n, &d);
    ((&along * &along) / (dot(&n, &n) * dot(&d, &d)))
        .to_f64()
        .unwrap()
        .sqrt()
}

fn cases<F: Scalar>(name: &str, seed: u64, count: u64) -> Vec<Case<F>> {
    let family = family::find(name).unwrap();
    (0..count)
        .map(|i| family.make::<F>(&Parameters::default(), seed, i).cases()[0])
        .collect()
}

/// Whether no component of the normal is zero, and the vertices are on no lattice of integers.
fn is_generic<F: Float>(case: &Case<F>) -> bool {
    let [_, _, a, b, c] = case.widen().vectors();
    let is_lattice = [a, b, c].as_flattened().iter().all(|x| x.fract() == 0.0);
    !is_lattice && normal(case).iter().all(|x| !x.is_zero())
}

fn generic_share<F: Scalar>(name: &str) -> f64 {
    let all = cases::<F>(name, 7, 2000);
    all.iter().filter(|case| is_generic(case)).count() as f64 / all.len() as f64
}

#[test]
fn half_of_the_grazing_rays_and_slivers_and_all_tiny_triangles_are_on_generic_planes() {
    for (name, least, most) in [
        ("grazing", 0.46, 0.54),
        ("sliver", 0.46, 0.54),
        ("tiny", 1.0, 1.0),
        ("secondary-ray", 1.0, 1.0),
    ] {
        for share in [generic_share::<f32>(name), generic_share::<f64>(name)] {
            assert!((least..=most).contains(&share), "{name}: {share}");
        }
    }
}

#[test]
fn secondary_rays_leave_at_every_angle() {
    // Directions are uniform on the sphere, so the share of sines below s is s.
    for sines in [
        cases::<f32>("secondary-ray", 3, 20_000)
            .iter()
            .map(sine)
            .collect::<Vec<_>>(),
        cases::<f64>("secondary-ray", 3, 20_000)
            .iter()
            .map(sine)
            .collect(),
    ] {
        for s in [0.001, 0.01, 0.125, 0.5, 0.9] {
            let below = sines.iter().filter(|sine| **sine < s).count() as f64 / 20_000.0;
            let noise = 4.0 * (s * (1.0 - s) / 20_000.0).sqrt();
            assert!(
                (below - s).abs() < noise,
                "{below} of the sines are below {s}"
            );
        }
    }
}

/// Each halving of the sine is equally likely, and below the smallest aim rounding decides: nothing that the
/// generator chose bounds the sines of generic planes.
fn sines_of_grazing_rays<F: Scalar>() {
    let digits = F::DIGITS as i32;
    let all = cases::<F>("grazing", 5, 20_000);
    let sines: Vec<f64> = all
        .iter()
        .filter(|case| is_generic(case))
        .map(sine)
        .collect();
    let halvings: Vec<i32> = sines
        .iter()
        .map(|sine| -sine.log2().floor() as i32)
        .collect();
    let expected = sines.len() as f64 / f64::from(digits - 1);
    for k in 5..=digits - 4 {
        let count = halvings.iter().filter(|halving| **halving == k).count() as f64;
        assert!(
            (count - expected).abs() < 5.0 * expected.sqrt(),
            "2^-{k}: {count} of {expected}"
        );
    }
    assert!(sines.iter().all(|sine| *sine <= 0.126));
    let smallest_aim = 0.5f64.powi(digits + 2);
    let below = sines
        .iter()
        .filter(|sine| **sine < smallest_aim / 4.0)
        .count();
    assert!(below > 10, "{below} below a quarter of the smallest aim");
}

#[test]
fn grazing_rays_have_every_small_angle_alike_down_to_what_rounding_decides() {
    sines_of_grazing_rays::<f32>();
    sines_of_grazing_rays::<f64>();
}

#[test]
fn on_generic_planes_a_larger_epsilon_of_moller_trumbore_trades_false_hits_for_hits() {
    let kernel = f32::subject(kernel::find("moller-trumbore").unwrap()).unwrap();
    for seed in 1..=5 {
        let mut cases = cases::<f32>("grazing", seed, 60_000);
        // The kernel looks at no end of the ray.
        cases.retain(|case| {
            is_generic(case) && case.ray.t_min == 0.0 && case.ray.t_max.is_infinite()
        });
        let truths: Vec<bool> = cases
            .iter()
            .map(|case| oracle::truth(case).hits_closed().unwrap())
            .collect();
        let [zero, ulp, published] = [0.0, 1.1920929e-7, 1e-6].map(|epsilon| {
            let mut verdicts = vec![Verdict::miss(None); cases.len()];
            kernel.run(&cases, &[epsilon, 0.0], &mut verdicts);
            let both = |truth: bool, hit: bool| {
                let all = truths.iter().zip(&verdicts);
                all.filter(|(is, verdict)| (**is, verdict.hit) == (truth, hit))
                    .count() as f64
            };
            let [hits, misses] = [true, false].map(|is| both(is, true) + both(is, false));
            println!(
                "{seed} {epsilon}: {} {}",
                both(false, true) / misses,
                both(true, false) / hits
            );
            [both(false, true) / misses, both(true, false) / hits]
        });
        // False hits: plain to see at 0, and fewer from epsilon to epsilon.
        assert!(
            zero[0] > 0.03 && zero[0] > 10.0 * ulp[0] && ulp[0] > 3.0 * published[0],
            "{seed}"
        );
        // Hits are lost for it.
        assert!(
            zero[1] + 0.1 < ulp[1] && ulp[1] + 0.1 < published[1],
            "{seed}"
        );
    }
}

#[test]
fn secondary_rays_start_at_hit_points_and_not_in_the_middle() {
    let third = 1.0f32 / 3.0;
    let (mut at_middle, mut near) = (0, 0);
    for case in cases::<f32>("secondary-ray", 2, 4000) {
        let [o, _, a, b, c] = case.vectors();
        let middle: [f32; 3] = std::array::from_fn(|i| a[i] * third + b[i] * third + c[i] * third);
        at_middle += usize::from(o == middle);
        let n = normal(&case);
        let from: Point = std::array::from_fn(|i| exact(o)[i].clone() - &exact(a)[i]);
        let along = dot(&n, &from);
        let height = ((&along * &along) / dot(&n, &n)).to_f64().unwrap().sqrt();
        near += usize::from(height < 16.0 * f64::from(f32::EPSILON));
    }
    assert!(
        at_middle < 40 && near > 3960,
        "{at_middle} in the middle, {near} near the plane"
    );
}

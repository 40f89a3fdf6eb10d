//! The slab tests: as plain floats compute them, at every epsilon by their margins, without rounding the truth, and as
//! other machines and closures compute them.

use hairline_boxes::{
    BoxCase, Boxes, FAMILIES, FamilyScalar, KERNELS, Obligation, Setup, TABLE, define, padding,
    truth,
};
use hairline_core::arith::Exact;
use hairline_core::kernel::{Entry, Scalar, refused_by, verdicts_of};
use hairline_core::{Contract, EpsilonSet, Failure, Hit, KernelInfo, Verdict};
use num_rational::BigRational;

/// Cases of all families.
fn cases<F: FamilyScalar>(each: u64) -> Vec<BoxCase<F>> {
    let of_family = |family: &'static hairline_boxes::Family| (0..each).map(|i| family.case(3, i));
    FAMILIES.iter().flat_map(of_family).collect()
}

fn verdicts<F: FamilyScalar + Scalar>(
    entry: &Entry<Boxes>,
    cases: &[BoxCase<F>],
    epsilons: &[F],
) -> Vec<Verdict<F>> {
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    verdicts_of(F::subject(entry).unwrap(), cases, epsilons, &mut verdicts);
    verdicts
}

fn hits(name: &str, case: &BoxCase<f32>) -> bool {
    let entry = TABLE.find(name).unwrap();
    let epsilons: Vec<f32> = Setup::published(entry)[0].epsilons().unwrap();
    verdicts(entry, &[*case], &epsilons)[0].hit
}

#[test]
fn names_are_unique_and_each_set_has_one_epsilon_a_gate() {
    for (place, entry) in KERNELS.iter().enumerate() {
        let info = entry.info;
        assert!(
            KERNELS[..place]
                .iter()
                .all(|other| other.info.name != info.name)
        );
        assert!(
            info.epsilon_sets
                .iter()
                .all(|set| set.values.len() == info.gates.len())
        );
        assert_eq!(
            Setup::published(entry).len(),
            info.epsilon_sets.len(),
            "{}",
            info.name
        );
        assert_eq!(TABLE.find(info.name).unwrap().info.name, info.name);
    }
}

fn margins_say_what_runs_do<F: FamilyScalar + Scalar>() {
    let cases = cases::<F>(60);
    let growths = [0.0, -1.0, -2.0, -3.0, -1e3, 1.0, 1e3]
        .map(F::from_f64)
        .map(|k| k * F::EPSILON);
    let elsewhere = [
        "multiplied+ftz",
        "ize+fma",
        "embree-robust+fma-ftz",
        "padded-box+fma",
    ];
    let elsewhere = elsewhere.map(|name| TABLE.find(name).unwrap());
    for entry in KERNELS.iter().chain(elsewhere) {
        let gates = entry.info.gates.len();
        let mut margins = vec![F::zero(); cases.len() * gates];
        let subject = F::subject(entry).unwrap();
        subject.margins(entry.info, &cases, &mut margins, &mut []);
        for growth in growths {
            let mut epsilons = vec![F::zero(); gates];
            epsilons[0] = growth;
            let found = verdicts(entry, &cases, &epsilons);
            for ((case, margins), verdict) in cases.iter().zip(margins.chunks(gates)).zip(found) {
                let by_margins = refused_by(margins, &epsilons).is_none();
                assert_eq!(
                    verdict.hit,
                    by_margins,
                    "{} {growth} {}",
                    entry.info.name,
                    case.hex()
                );
            }
        }
    }
}

#[test]
fn margins_say_what_runs_do_at_every_epsilon_in_either_scalar() {
    margins_say_what_runs_do::<f32>();
    margins_say_what_runs_do::<f64>();
}

/// Without rounding a test is right, but where it computes with 0 times infinity or keeps a direction from 0.
#[test]
fn without_rounding_tests_that_divide_are_the_truth() {
    for name in ["kay-kajiya", "eisemann-slopes", "divided", "padded-box"] {
        let entry = TABLE.find(name).unwrap();
        let gated = f64::subject(entry).unwrap().gated().unwrap();
        let epsilons = vec![0.0; entry.info.gates.len()];
        for case in cases::<f64>(200) {
            let owed = Obligation::new(&truth(&case), &entry.info.contract);
            let hit = gated.run_exact(&case, &epsilons).hit();
            match owed {
                Obligation::Hit => assert!(hit, "{name} {}", case.hex()),
                Obligation::Miss => assert!(!hit, "{name} {}", case.hex()),
                Obligation::Free => {}
            }
        }
    }
}

#[test]
fn the_exact_margin_of_a_padded_box_is_its_distance() {
    let entry = TABLE.find("padded-box").unwrap();
    let gated = f32::subject(entry).unwrap().gated().unwrap();
    for case in cases::<f32>(100) {
        let margin: &Exact = &gated.measure_exact(&case).margins[0];
        let length = padding(&case.widen()).unwrap().length;
        assert_eq!(margin.to_rational().unwrap(), -length, "{}", case.hex());
    }
}

#[test]
fn the_exact_margin_of_growth_is_the_share_of_near_in_far() {
    let entry = TABLE.find("divided").unwrap();
    let gated = f64::subject(entry).unwrap().gated().unwrap();
    let zero = BigRational::from_integer(0.into());
    let mut compared = 0;
    for case in cases::<f64>(100) {
        let Some(line) = define(&case).line else {
            continue;
        };
        let near = line
            .enter
            .max(BigRational::from_float(case.ray.t_min).unwrap());
        let far = match BigRational::from_float(case.ray.t_max) {
            Some(t_max) => line.exit.min(t_max),
            None => line.exit,
        };
        if far <= zero || case.ray.direction.to_array().contains(&0.0) {
            continue;
        }
        let margin: &Exact = &gated.measure_exact(&case).margins[0];
        let share = BigRational::from_integer(1.into()) - near / far;
        assert_eq!(margin.to_rational().unwrap(), share, "{}", case.hex());
        compared += 1;
    }
    assert!(compared > 500, "{compared}");
}

/// The test of Ize in plain floats.
fn ize(case: &BoxCase<f32>) -> bool {
    let [o, d, min, max] = case.vectors();
    let (mut near, mut far) = (case.ray.t_min, case.ray.t_max);
    for i in 0..3 {
        let inverse = 1.0 / d[i];
        let negative = inverse.is_sign_negative();
        let first = ((if negative { max[i] } else { min[i] }) - o[i]) * inverse;
        let last = ((if negative { min[i] } else { max[i] }) - o[i]) * inverse;
        near = if first > near { first } else { near };
        far = if last < far { last } else { far };
    }
    near <= far * 1.000_000_2
}

/// The first overload of pbrt's test in plain floats.
fn pbrt(case: &BoxCase<f32>) -> bool {
    let [o, d, min, max] = case.vectors();
    let (mut t0, mut t1) = (case.ray.t_min, case.ray.t_max);
    let gamma = 3.0 * f32::EPSILON * 0.5 / (1.0 - 3.0 * f32::EPSILON * 0.5);
    for i in 0..3 {
        let inverse = 1.0 / d[i];
        let (mut near, mut far) = ((min[i] - o[i]) * inverse, (max[i] - o[i]) * inverse);
        if near > far {
            (near, far) = (far, near);
        }
        far *= 1.0 + 2.0 * gamma;
        t0 = if near > t0 { near } else { t0 };
        t1 = if far < t1 { far } else { t1 };
        if t0 > t1 {
            return false;
        }
    }
    true
}

/// The fast test of Embree in plain floats.
fn embree_fast(case: &BoxCase<f32>) -> bool {
    let [o, d, min, max] = case.vectors();
    let max_of = |a: f32, b: f32| if a > b { a } else { b };
    let min_of = |a: f32, b: f32| if a < b { a } else { b };
    let planes = [0, 1, 2].map(|i| {
        let inverse = 1.0 / if d[i].abs() < 1e-18 { 1e-18 } else { d[i] };
        let t = |plane: f32| plane.mul_add(inverse, -(o[i] * inverse));
        if inverse >= 0.0 {
            [t(min[i]), t(max[i])]
        } else {
            [t(max[i]), t(min[i])]
        }
    });
    let [x, y, z] = planes;
    let near = max_of(max_of(x[0], y[0]), max_of(z[0], case.ray.t_min));
    let far = min_of(min_of(x[1], y[1]), min_of(z[1], case.ray.t_max));
    near <= far
}

/// The robust test of Embree in plain floats.
fn embree_robust(case: &BoxCase<f32>) -> bool {
    let [o, d, min, max] = case.vectors();
    let max_of = |a: f32, b: f32| if a > b { a } else { b };
    let min_of = |a: f32, b: f32| if a < b { a } else { b };
    let planes = [0, 1, 2].map(|i| {
        let inverse = 1.0 / if d[i].abs() < 1e-18 { 1e-18 } else { d[i] };
        let first = (1.0 - 3.0 * f32::EPSILON) * inverse;
        let last = (1.0 + 3.0 * f32::EPSILON) * inverse;
        if first >= 0.0 {
            [(min[i] - o[i]) * first, (max[i] - o[i]) * last]
        } else {
            [(max[i] - o[i]) * first, (min[i] - o[i]) * last]
        }
    });
    let [x, y, z] = planes;
    let near = max_of(max_of(x[0], y[0]), max_of(z[0], case.ray.t_min));
    let far = min_of(min_of(x[1], y[1]), min_of(z[1], case.ray.t_max));
    near <= far
}

/// The test of the crate bvh in plain floats.
fn bvh(case: &BoxCase<f32>) -> bool {
    let [o, d, min, max] = case.vectors();
    let t = |plane: [f32; 3]| [0, 1, 2].map(|i| (plane[i] - o[i]) * (1.0 / d[i]));
    let (first, second) = (t(min), t(max));
    if first.iter().chain(&second).any(|t| t.is_nan()) {
        return false;
    }
    let [mut near, mut far] = [f32::NEG_INFINITY, f32::INFINITY];
    for i in 0..3 {
        near = near.max(first[i].min(second[i]));
        far = far.min(first[i].max(second[i]));
    }
    far >= near.max(0.0)
}

/// The test of today's tinybvh in plain floats.
fn tinybvh(case: &BoxCase<f32>) -> bool {
    let inverse = |x: f32| {
        let reciprocal = 1.0 / x;
        let most = 100f32.exp2();
        if reciprocal.abs() <= most {
            reciprocal
        } else {
            most.copysign(x)
        }
    };
    tinybvh_with(case, inverse)
}

/// The test of tinybvh as it was until 2025 in plain floats.
fn tinybvh_1e30(case: &BoxCase<f32>) -> bool {
    let inverse = |x: f32| {
        if x > 1e-12 || -x > 1e-12 {
            1.0 / x
        } else {
            1e30
        }
    };
    tinybvh_with(case, inverse)
}

fn tinybvh_with(case: &BoxCase<f32>, inverse: fn(f32) -> f32) -> bool {
    let [o, d, min, max] = case.vectors();
    let max_of = |a: f32, b: f32| if a > b { a } else { b };
    let min_of = |a: f32, b: f32| if a < b { a } else { b };
    let planes = [0, 1, 2].map(|i| [min[i], max[i]].map(|plane| (plane - o[i]) * inverse(d[i])));
    let [x, y, z] = planes.map(|[a, b]| [min_of(a, b), max_of(a, b)]);
    let near = max_of(max_of(x[0], y[0]), z[0]);
    let far = min_of(min_of(x[1], y[1]), z[1]);
    far >= near && near < case.ray.t_max && far >= case.ray.t_min
}

/// The test of Williams and others in plain floats.
fn williams(case: &BoxCase<f32>) -> bool {
    let [o, d, min, max] = case.vectors();
    let planes = [0, 1, 2].map(|i| {
        let inverse = 1.0 / d[i];
        let [near, far] = if inverse < 0.0 {
            [max[i], min[i]]
        } else {
            [min[i], max[i]]
        };
        [(near - o[i]) * inverse, (far - o[i]) * inverse]
    });
    let [[mut near, mut far], y, z] = planes;
    for [first, last] in [y, z] {
        if near > last || first > far {
            return false;
        }
        near = if first > near { first } else { near };
        far = if last < far { last } else { far };
    }
    near < case.ray.t_max && far > case.ray.t_min
}

type Plain = fn(&BoxCase<f32>) -> bool;

#[test]
fn kernels_are_what_plain_floats_compute() {
    let plain: [(&str, Plain); 8] = [
        ("ize", ize),
        ("pbrt", pbrt),
        ("embree-fast", embree_fast),
        ("embree-robust", embree_robust),
        ("tinybvh", tinybvh),
        ("tinybvh-1e30", tinybvh_1e30),
        ("bvh", bvh),
        ("williams", williams),
    ];
    let cases = cases::<f32>(1000);
    for (name, test) in plain {
        let entry = TABLE.find(name).unwrap();
        let epsilons: Vec<f32> = Setup::published(entry)[0].epsilons().unwrap();
        let found = verdicts(entry, &cases, &epsilons);
        for (case, verdict) in cases.iter().zip(found) {
            assert_eq!(verdict.hit, test(case), "{name} {}", case.hex());
        }
    }
}

#[test]
fn nans_and_signed_zeros_do_what_each_source_says() {
    let cube = [[0.0; 3], [1.0; 3]];
    // In the plane of a face: 0 times infinity on the last axis.
    let in_face = BoxCase::new([-1.0, 0.5, 1.0], [1.0, 0.0, 0.0], cube);
    assert_eq!(
        ["plane-first", "plane-last"].map(|name| hits(name, &in_face)),
        [true, false]
    );
    // The plane z = 1 gives NaN, and then the next axis replaces it.
    let on_first = BoxCase::new([1.0, 0.5, -1.0], [0.0, 0.0, 1.0], cube);
    assert_eq!(
        ["plane-first", "plane-last"].map(|name| hits(name, &on_first)),
        [true, true]
    );
    // Smits asks for the sign of the direction, and takes -0 for a positive one.
    let backwards = BoxCase::new([0.5, 0.5, -1.0], [-0.0, 0.0, 1.0], cube);
    assert_eq!(
        ["smits", "williams"].map(|name| hits(name, &backwards)),
        [false, true]
    );
    assert!(hits("divided", &backwards));
    // A flat box: near is far.
    let flat = BoxCase::new(
        [0.5, 0.5, -1.0],
        [0.0, 0.0, 1.0],
        [[0.0; 3], [1.0, 1.0, 0.0]],
    );
    assert_eq!(
        ["bvh", "barnes-2015", "barnes-2022"].map(|name| hits(name, &flat)),
        [true, false, true]
    );
    // Beside the box on an axis without direction: infinity minus infinity.
    let beside = BoxCase::new([2.0, 0.5, -1.0], [0.0, 0.0, 1.0], cube);
    assert_eq!(
        ["fused", "multiplied", "aila-laine"].map(|name| hits(name, &beside)),
        [true, false, false]
    );
    // Minima and maxima turn a box without points round.
    let inverted = BoxCase::new([0.5, 0.5, -1.0], [0.0, 0.0, 1.0], [[1.0; 3], [0.0; 3]]);
    assert_eq!(
        ["majercik", "ize"].map(|name| hits(name, &inverted)),
        [true, false]
    );
}

#[test]
fn other_machines_compute_the_same_tests() {
    let cases = cases::<f32>(500);
    let of = |name: &str| verdicts(TABLE.find(name).unwrap(), &cases, &[0.0]);
    assert_eq!(TABLE.find("fused+fma").unwrap().info.name, "fused+fma");
    // No product goes straight into a sum but o·inv, which is used twice and stays rounded.
    let hits = |verdicts: &[Verdict<f32>]| verdicts.iter().filter(|verdict| verdict.hit).count();
    assert_eq!(hits(&of("multiplied+fma")), hits(&of("multiplied")));
    // Without subnormal numbers, boxes of their size are points.
    assert_ne!(of("multiplied+ftz"), of("multiplied"));
    assert!(TABLE.find("multiplied+sorted").is_none() && TABLE.find("nothing+fma").is_none());
}

#[test]
fn closures_are_kernels_and_their_panics_are_verdicts() {
    const INFO: KernelInfo = KernelInfo {
        epsilon_sets: &[EpsilonSet {
            name: "own",
            values: &[],
        }],
        ..KernelInfo::own("own box test", Contract::CLOSED_RAY)
    };
    let test = |case: &BoxCase<f32>, _: &[f32]| {
        assert!(case.ray.origin.x < 10.0, "too far");
        Some(Hit::at(0.5))
    };
    let entry = Entry::<Boxes>::described(&INFO).f32(test);
    let at = |x: f32| BoxCase::new([x, 0.0, 0.0], [1.0; 3], [[0.0; 3], [1.0; 3]]);
    let found = verdicts(&entry, &[at(0.0), at(20.0), at(1.0)], &[]);
    assert_eq!(
        found.iter().map(|verdict| verdict.hit).collect::<Vec<_>>(),
        [true, false, true]
    );
    assert_eq!(found[1].failure, Some(Failure::Panic));
    assert_eq!(entry.scalars(), [true, false]);
    assert!(TABLE.register(entry).is_err(), "a name is one word");
}

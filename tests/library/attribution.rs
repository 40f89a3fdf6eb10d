//! Why kernels are wrong: tracked runs are the float runs, and known causes come out.

use hairline::internals::arith::{Arithmetic, Float, Real, Vector};
use hairline::internals::audit::{Attribution, attribute, attribute_by_running};
use hairline::internals::case::{Case, Draw, Parameters, Ray, Triangle};
use hairline::internals::contract::{Contract, NAMED};
use hairline::internals::family::{FAMILIES, find};
use hairline::internals::judge::{Class, Finding, Obligation, judge, obligation};
use hairline::internals::kernel::{
    self, Gate, Generic, Hit, KERNELS, Kernel, KernelIn, KernelInfo, Role, Scalar, Sink, Tunable,
    Verdict,
};
use hairline::internals::oracle::truth;
use std::collections::BTreeMap;

fn run<F: Scalar>(kernel: &dyn KernelIn<F>, case: &Case<F>, epsilons: &[F]) -> Verdict<F> {
    let mut verdict = [Verdict::miss(None)];
    kernel.run(std::slice::from_ref(case), epsilons, &mut verdict);
    verdict[0]
}

fn bits<F: Float>(verdict: &Verdict<F>) -> (bool, Option<u8>, String, [Option<u64>; 3]) {
    // A NaN's payload and sign are no result.
    let number = |x: F| (!x.is_nan()).then(|| x.to_bits());
    let values = [verdict.t, verdict.u, verdict.v].map(number);
    (
        verdict.hit,
        verdict.refused_by,
        format!("{:?}", verdict.facing),
        values,
    )
}

fn a_tracked_run_is_the_run<F: Scalar>() {
    let check = |case: &Case<F>, draw: &mut Draw| {
        // The built-in arithmetic, and one of the others.
        let other = draw.pick(&Arithmetic::ALL[1..]);
        let variant = |entry| kernel::in_arithmetic(entry, other).expect("for every arithmetic");
        for entry in KERNELS.iter().flat_map(|entry| [entry, variant(entry)]) {
            let kernel = F::subject(entry).unwrap();
            let epsilons: Vec<F> = (0..entry.info.gates.len())
                .map(|_| F::from_f64(draw.pick(&[0.0, 0.0, 1e-6, -1e-6, 1e-20])))
                .collect();
            let tracked = kernel.gated().unwrap().run_tracked(case, &epsilons).verdict;
            let plain = run(kernel, case, &epsilons);
            let name = entry.info.name;
            assert_eq!(
                bits(&tracked),
                bits(&plain),
                "{name} {epsilons:?} {}",
                case.hex()
            );
        }
    };
    for family in FAMILIES {
        for index in 0..200 {
            let mut draw = Draw::new("tracked-run", 1, index);
            let scale = draw.pick(&[0, 0, -60, 60, -250, 250]);
            let parameters = Parameters {
                scale,
                scale_direction: draw.coin(),
                ..Parameters::default()
            };
            for case in family.make::<F>(&parameters, 1, index).cases() {
                check(case, &mut draw);
            }
        }
    }
    for index in 0..5_000 {
        let mut draw = Draw::new("any-bits", 1, index);
        let [o, d, a, b, c] =
            std::array::from_fn(|_| std::array::from_fn(|_| F::from_bits(draw.bits())));
        let case = Case::new(o, d, [a, b, c]);
        check(
            &case.on(F::from_bits(draw.bits()), F::infinity()),
            &mut draw,
        );
        check(&case, &mut draw);
    }
}

#[test]
fn a_tracked_run_is_the_run_bit_for_bit_in_either_scalar() {
    a_tracked_run_is_the_run::<f32>();
    a_tracked_run_is_the_run::<f64>();
}

fn a_run_that_never_rounds_is_exact<F: Scalar>() {
    let mut exact_runs = 0;
    for family in FAMILIES {
        for index in 0..100 {
            for case in family.make::<F>(&Parameters::default(), 1, index).cases() {
                // Where D = 0 the sign of a zero divides to either infinity.
                if truth(case).crossing().is_none() {
                    continue;
                }
                // Havel and Herout decide on signs of zeros.
                for entry in KERNELS
                    .iter()
                    .filter(|entry| entry.info.name != "havel-herout")
                {
                    let kernel = F::subject(entry).unwrap();
                    let zeros = vec![F::zero(); entry.info.gates.len()];
                    let tracked = kernel.gated().unwrap().run_tracked(case, &zeros);
                    if tracked.decision.inexact {
                        continue;
                    }
                    exact_runs += 1;
                    let exact = kernel.gated().unwrap().run_exact(case, &zeros);
                    let name = entry.info.name;
                    assert_eq!(tracked.verdict.hit, exact.hit(), "{name} {}", case.hex());
                }
            }
        }
    }
    assert!(exact_runs > 2_000, "{exact_runs}");
}

#[test]
fn a_run_that_never_rounds_decides_as_exact_arithmetic_does() {
    a_run_that_never_rounds_is_exact::<f32>();
    a_run_that_never_rounds_is_exact::<f64>();
}

/// Attributions of a kernel's findings on a family, by finding.
fn attributions<F: Scalar>(
    kernel: &str,
    epsilons: &[f64],
    contract: Option<Contract>,
    family: &str,
    keep: impl Fn(&Class) -> bool,
) -> BTreeMap<(Finding, Attribution), usize> {
    let entry = kernel::find(kernel).unwrap();
    let subject = F::subject(entry).unwrap();
    let epsilons: Vec<F> = epsilons.iter().map(|e| F::from_f64(*e)).collect();
    let contract = contract.unwrap_or(entry.info.contract);
    let mut counts = BTreeMap::new();
    for index in 0..4_000 {
        for case in find(family)
            .unwrap()
            .make::<F>(&Parameters::default(), 1, index)
            .cases()
        {
            let truth = truth(case);
            if !keep(&Class::of(&truth)) {
                continue;
            }
            let asked = obligation(&truth, &contract, false);
            let verdict = run(subject, case, &epsilons);
            let finding = judge(
                (&contract, asked),
                (case, &truth),
                entry.info.gives,
                &verdict,
            );
            let why = attribute(subject, case, &epsilons, &truth, (&contract, asked));
            assert_eq!(finding.is_some(), why.is_some());
            if let (Some(finding), Some(why)) = (finding, why) {
                *counts.entry((finding, why)).or_insert(0) += 1;
            }
        }
    }
    counts
}

fn only(counts: &BTreeMap<(Finding, Attribution), usize>, finding: Finding) -> Vec<Attribution> {
    counts
        .keys()
        .filter(|(found, _)| *found == finding)
        .map(|(_, why)| *why)
        .collect()
}

fn named(name: &str) -> Option<Contract> {
    NAMED
        .iter()
        .find(|named| named.name == name)
        .map(|named| named.contract)
}

#[test]
fn strict_edges_under_a_closed_contract_are_a_convention() {
    let any = |_: &Class| true;
    let counts = attributions::<f64>(
        "scalar-triple-two-sided",
        &[0.0],
        named("closed-line"),
        "lattice",
        any,
    );
    assert_eq!(only(&counts, Finding::FalseMiss), [Attribution::Convention]);
}

/// A kernel that does not show its formula.
struct Hidden(&'static dyn KernelIn<f64>);

impl KernelIn<f64> for Hidden {
    fn run(&self, cases: &[Case<f64>], epsilons: &[f64], verdicts: &mut [Verdict<f64>]) {
        self.0.run(cases, epsilons, verdicts);
    }
}

#[test]
fn where_nothing_rounds_a_hidden_formula_is_wrong_for_the_reason_that_the_shown_one_is() {
    // Strict edges and an epsilon that refuses the smaller half of the lattice's determinants.
    let entry = kernel::find("scalar-triple-two-sided").unwrap();
    let (info, shown) = (entry.info, f64::subject(entry).unwrap());
    let contract = named("closed-line").unwrap();
    let fixed: Vec<Gate> = info
        .gates
        .iter()
        .map(|gate| Gate {
            epsilon: Tunable::Fixed,
            ..*gate
        })
        .collect();
    let without_epsilons = KernelInfo {
        gates: Box::leak(fixed.into()),
        ..*info
    };
    let mut counts = BTreeMap::new();
    for index in 0..4_000 {
        let made = find("lattice")
            .unwrap()
            .make::<f64>(&Parameters::default(), 1, index);
        for (case, epsilons) in made
            .cases()
            .iter()
            .flat_map(|case| [(case, [1.5]), (case, [0.0])])
        {
            let truth = truth(case);
            let asked = obligation(&truth, &contract, false);
            let Some(why) = attribute(shown, case, &epsilons, &truth, (&contract, asked)) else {
                continue;
            };
            let by_running = |info| {
                attribute_by_running(
                    &Hidden(shown),
                    info,
                    case,
                    &epsilons,
                    &truth,
                    (&contract, asked),
                )
            };
            assert_eq!(by_running(&without_epsilons), None);
            *counts.entry((why, by_running(info))).or_insert(0) += 1;
        }
    }
    let pairs: Vec<_> = counts.keys().copied().collect();
    let expected = [
        (Attribution::Convention, Some(Attribution::NotEpsilon)),
        (Attribution::Epsilon, Some(Attribution::Epsilon)),
    ];
    assert_eq!(pairs, expected, "{counts:?}");
    assert!(counts.values().all(|count| 50 < *count), "{counts:?}");
}

#[test]
fn no_test_of_t_under_a_ray_contract_is_a_convention() {
    let behind = |class: &Class| class.name().ends_with("interior/front/before");
    let counts = attributions::<f32>("half-space", &[0.0], None, "behind", behind);
    assert_eq!(only(&counts, Finding::FalseHit), [Attribution::Convention]);
    assert!(counts[&(Finding::FalseHit, Attribution::Convention)] > 100);
}

#[test]
fn a_positive_edge_epsilon_is_to_blame_for_lost_edges() {
    let edges = |class: &Class| class.part() == "edge";
    let epsilons = [1e-6, 1e-6, 1e-6];
    let counts = attributions::<f64>("plane-unit-normal", &epsilons, None, "edge-exact", edges);
    assert_eq!(only(&counts, Finding::FalseMiss), [Attribution::Epsilon]);
    // Without it rounding alone loses some.
    let counts = attributions::<f64>("plane-unit-normal", &[0.0; 3], None, "edge-exact", edges);
    assert_eq!(only(&counts, Finding::FalseMiss), [Attribution::Rounding]);
}

#[test]
fn woops_misses_and_cramers_on_the_lattice_are_rounding() {
    let any = |_: &Class| true;
    for family in ["edge-near", "shared-edge"] {
        let counts = attributions::<f32>("woop-watertight", &[0.0; 3], None, family, any);
        assert_eq!(
            only(&counts, Finding::FalseMiss),
            [Attribution::Rounding],
            "{family}"
        );
    }
    let counts = attributions::<f32>("cramer", &[0.0; 3], None, "lattice", any);
    assert_eq!(only(&counts, Finding::FalseMiss), [Attribution::Rounding]);
}

#[test]
fn underflowing_products_let_tiny_triangles_be_hit_from_outside() {
    let any = |_: &Class| true;
    let counts = attributions::<f32>("plane-inside-out", &[0.0; 3], None, "tiny", any);
    let range = counts[&(Finding::FalseHit, Attribution::Range)];
    assert!(range > 500 && !counts.contains_key(&(Finding::FalseHit, Attribution::Convention)));
    let of = |why| counts.get(&(Finding::FalseHit, why)).copied().unwrap_or(0);
    assert!(of(Attribution::Rounding) * 10 < range, "{counts:?}");
}

#[test]
fn nan_coordinates_of_a_coplanar_hit_are_the_formulas_own() {
    let coplanar = |class: &Class| class.name() == "coplanar";
    let counts = attributions::<f32>("scalar-triple", &[0.0], None, "lattice", coplanar);
    assert_eq!(only(&counts, Finding::BadValue), [Attribution::Convention]);
}

#[test]
fn what_is_wrong_at_zero_too_is_no_epsilons_fault() {
    let behind = |class: &Class| class.name() == "interior/back/within";
    let closed = named("closed-ray");
    for epsilons in [[0.0; 3], [1e-9; 3], [-0.0; 3]] {
        let counts = attributions::<f64>(
            "moller-trumbore-culling",
            &epsilons[..2],
            closed,
            "lattice",
            behind,
        );
        assert_eq!(
            only(&counts, Finding::FalseMiss),
            [Attribution::Convention],
            "{epsilons:?}"
        );
    }
}

#[test]
fn a_hit_whose_values_alone_overflow_is_out_of_range() {
    // Products of four lengths leave the range of f32, those of three do not: t is inf - inf.
    let k = 2f32.powi(60);
    let triangle = [[-k, k, -k], [k, k, k], [k, 0.0, k]];
    let case = Case::<f32>::new([0.0, 0.0, k], [1.0, 1.0, -1.0], triangle);
    let entry = kernel::find("moller-trumbore").unwrap();
    let subject = f32::subject(entry).unwrap();
    let truth = truth(&case);
    let asked = obligation(&truth, &entry.info.contract, false);
    let found = judge(
        (&entry.info.contract, asked),
        (&case, &truth),
        entry.info.gives,
        &run(subject, &case, &[0.0; 2]),
    );
    assert_eq!(found, Some(Finding::BadValue));
    let why = attribute(
        subject,
        &case,
        &[0.0; 2],
        &truth,
        (&entry.info.contract, asked),
    );
    assert_eq!(why, Some(Attribution::Range));
}

/// Hits where the origin's x has a negative sign, as a zero may; t is rounded.
struct SignOfZero;

impl Kernel for SignOfZero {
    const INFO: KernelInfo = KernelInfo {
        gates: &[Gate::fixed(Role::Edge, "x of the origin has no sign")],
        ..KernelInfo::own("sign-of-zero", Contract::CLOSED_RAY)
    };

    type Prepared<V: Vector> = ();

    fn prepare<V: Vector>(_: &Triangle<V>) {}

    fn test<V: Vector, S: Sink<V::Real>>(
        _: &(),
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        sink.fixed(0, ray.origin.at(0).is_sign_negative())?;
        Some(Hit::at(V::Real::one() / &ray.direction.at(2)))
    }
}

#[test]
fn a_decision_in_which_nothing_rounds_is_the_formulas_own_even_by_the_sign_of_a_zero() {
    let far = [[5.0, 5.0, 1.0], [6.0, 5.0, 1.0], [5.0, 6.0, 1.0]];
    let case = Case::<f32>::new([-0.0, 0.0, 0.0], [0.0, 0.0, 3.0], far);
    let subject = &Generic::<SignOfZero>::SUBJECT;
    assert!(run::<f32>(subject, &case, &[0.0]).hit);
    let why = attribute(
        subject,
        &case,
        &[0.0],
        &truth(&case),
        (&Contract::CLOSED_RAY, Obligation::MustMiss),
    );
    assert_eq!(why, Some(Attribution::Convention));
}

#[test]
fn a_right_verdict_has_no_cause() {
    let triangle = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let case = Case::<f32>::new([0.5, 0.5, 1.0], [0.0, 0.0, -1.0], triangle);
    let subject = f32::subject(kernel::find("cramer").unwrap()).unwrap();
    let why = attribute(
        subject,
        &case,
        &[0.0; 3],
        &truth(&case),
        (&Contract::CLOSED_RAY, Obligation::MustHit),
    );
    assert_eq!(why, None);
}

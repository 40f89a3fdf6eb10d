//! Margins say what a kernel does: one measurement gives the verdict at every epsilon.

use crate::facts::hits_nan;
use hairline::internals::arith::{Arithmetic, Float, scale_by_power_of_two};
use hairline::internals::case::{Case, Draw, Parameters};
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{
    Entry, KERNELS, KernelIn, Scalar, Tunable, Verdict, in_arithmetic, open_epsilons, refused_by,
};

/// Indices of each family, wild cases, and epsilon sets for each case and kernel.
const INDICES: u64 = 100;
const WILD: u64 = 20_000;
const EPSILON_SETS: usize = 6;

fn run<F: Scalar>(kernel: &dyn KernelIn<F>, case: &Case<F>, epsilons: &[F]) -> Verdict<F> {
    let mut verdict = [Verdict::miss(None)];
    kernel.run(std::slice::from_ref(case), epsilons, &mut verdict);
    verdict[0]
}

/// Every kernel in every arithmetic, and what part of the cases it gets: the built-in arithmetic all.
fn every_kernel() -> Vec<(&'static Entry, u64)> {
    let variant = |entry: &'static Entry, arithmetic| {
        let part = if arithmetic == Arithmetic::IEEE {
            1
        } else {
            10
        };
        (
            in_arithmetic(entry, arithmetic).expect("written for every arithmetic"),
            part,
        )
    };
    KERNELS
        .iter()
        .flat_map(|entry| Arithmetic::ALL.map(|a| variant(entry, a)))
        .collect()
}

/// Cases of all families at many scales, and cases of arbitrary bits and of small integers; of each
/// one in `part`.
fn for_all_cases<F: Scalar>(part: u64, mut check: impl FnMut(&mut Draw, &Case<F>)) {
    for family in FAMILIES {
        for index in 0..INDICES / part {
            let mut draw = Draw::new("margins", 1, index);
            let scale = draw.pick(&[0, 0, -60, 60, -250, 250]);
            let parameters = Parameters {
                scale,
                scale_direction: draw.coin(),
                ..Parameters::default()
            };
            for case in family.make::<F>(&parameters, 1, index).cases() {
                check(&mut draw, case);
            }
        }
    }
    for index in 0..WILD / part {
        let mut draw = Draw::new("wild", 1, index);
        let case = wild_case(&mut draw);
        check(&mut draw, &case);
    }
}

/// Any bits at all, or few values of which many coincide.
fn wild_case<F: Float>(draw: &mut Draw) -> Case<F> {
    let few = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        2.0,
        1e30,
        -1e-30,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    let choices = draw.pick(&[3, 5, 7, 9, few.len()]);
    let any_bits = draw.below(3) == 0;
    let number = |draw: &mut Draw| match any_bits {
        true => F::from_bits(draw.bits()),
        false => F::from_f64(draw.pick(&few[..choices])),
    };
    let mut vector = || std::array::from_fn(|_| number(draw));
    let case = Case::new(vector(), vector(), [vector(), vector(), vector()]);
    match draw.below(3) {
        0 => case,
        _ => case.on(number(draw), number(draw)),
    }
}

/// A finite epsilon: at a margin, a neighbour of it, an end of the range, a zero or any other.
fn epsilon<F: Float>(draw: &mut Draw, margin: F) -> F {
    let most = F::infinity().offset_ulps(-1);
    let chosen = match draw.below(9) {
        0..=2 => margin.offset_ulps(draw.integer(-1, 1)),
        3 => draw.pick(&[F::zero(), -F::zero()]),
        4 => draw.pick(&[most, -most]),
        5 => F::zero().offset_ulps(draw.pick(&[-1, 1])),
        6 => F::from_place(draw.integer(-1, 1) << draw.integer(0, i64::from(F::DIGITS) - 1)),
        7 => F::from_f64(scale_by_power_of_two(
            1.0 + draw.unit(),
            draw.integer(-60, 60) as i32,
        )),
        _ => F::from_bits(draw.bits()),
    };
    match chosen {
        x if x.is_nan() => F::zero(),
        x if most < x => most,
        x if x < -most => -most,
        x => x,
    }
}

fn margins_decide_as_the_run_does<F: Scalar>() {
    for (entry, part) in every_kernel() {
        let (kernel, name) = (F::subject(entry).unwrap(), entry.info.name);
        for_all_cases::<F>(part, |draw, case| {
            let margins = kernel.gated().unwrap().measure(case).margins;
            for _ in 0..EPSILON_SETS {
                let epsilons: Vec<F> = margins
                    .iter()
                    .map(|margin| epsilon(draw, *margin))
                    .collect();
                let verdict = run(kernel, case, &epsilons);
                let told = || format!("{name} {}: {case:?} {epsilons:?} {margins:?}", F::NAME);
                let refuses = refused_by(&margins, &epsilons);
                assert_eq!(refuses.is_none(), verdict.hit, "{}", told());
                assert_eq!(refuses, verdict.refused_by.map(usize::from), "{}", told());
            }
        });
    }
}

fn a_margin_is_the_last_epsilon_that_accepts<F: Scalar>() {
    let most = F::infinity().offset_ulps(-1);
    for (entry, part) in every_kernel() {
        let (kernel, name) = (F::subject(entry).unwrap(), entry.info.name);
        for_all_cases::<F>(part, |_, case| {
            let margins = kernel.gated().unwrap().measure(case).margins;
            assert!(
                margins.iter().all(|margin| !margin.is_nan()),
                "{name}: {case:?} {margins:?}"
            );
            if margins.iter().any(|margin| *margin < -most) {
                return;
            }
            let mut epsilons: Vec<F> = margins
                .iter()
                .map(|m| if most < *m { most } else { *m })
                .collect();
            assert!(
                run(kernel, case, &epsilons).hit,
                "{name}: {case:?} {margins:?}"
            );
            for (gate, margin) in margins.iter().enumerate().filter(|(_, m)| **m < most) {
                let at = std::mem::replace(&mut epsilons[gate], margin.offset_ulps(1));
                let verdict = run(kernel, case, &epsilons);
                assert_eq!(
                    verdict.refused_by,
                    Some(gate as u8),
                    "{name}: {case:?} {margins:?}"
                );
                epsilons[gate] = at;
            }
        });
    }
}

fn a_measured_hit_reports_the_values_of_the_run<F: Scalar>() {
    for (entry, part) in every_kernel() {
        let kernel = F::subject(entry).unwrap();
        let epsilons = vec![F::zero(); entry.info.gates.len()];
        for_all_cases::<F>(part, |_, case| {
            let verdict = run(kernel, case, &epsilons);
            if !verdict.hit {
                return;
            }
            let values = kernel
                .gated()
                .unwrap()
                .measure(case)
                .values
                .expect("a hit has values");
            let (u, v) = values.uv.unwrap_or((verdict.u, verdict.v));
            let same = |x: F, y: F| x == y || x.is_nan() && y.is_nan();
            assert!(
                same(values.t.unwrap_or(verdict.t), verdict.t)
                    && same(u, verdict.u)
                    && same(v, verdict.v)
                    && values.facing == verdict.facing,
                "{}: {case:?} {values:?} {verdict:?}",
                entry.info.name
            );
        });
    }
}

fn kernels_treat_a_nan_as_declared<F: Scalar>() {
    let nan = [F::from_f64(f64::NAN); 3];
    for (entry, _) in every_kernel() {
        let zeros = vec![F::zero(); entry.info.gates.len()];
        let case = Case::new(nan, nan, [nan; 3]);
        for case in [case, case.on(nan[0], nan[0])] {
            let hit = run(F::subject(entry).unwrap(), &case, &zeros).hit;
            assert_eq!(
                hit,
                hits_nan(entry.info.name),
                "{} {}",
                entry.info.name,
                F::NAME
            );
        }
    }
}

/// A kernel whose gates nobody sees.
struct Closed<F: 'static>(&'static dyn KernelIn<F>);

impl<F: Float> KernelIn<F> for Closed<F> {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        self.0.run(cases, epsilons, verdicts);
    }
}

fn runs_find_the_margins_that_the_gates_show<F: Scalar>() {
    for entry in KERNELS {
        let (shown, info) = (F::subject(entry).unwrap(), entry.info);
        let (open, width) = (open_epsilons::<F>(info), info.gates.len());
        for (family, index) in FAMILIES
            .iter()
            .flat_map(|family| [0, 1, 2].map(|i| (family, i)))
        {
            let made = family.make::<F>(&Parameters::default(), 5, index);
            let cases = made.cases();
            let mut by_gates = vec![F::zero(); cases.len() * width];
            let mut by_runs = by_gates.clone();
            let mut values = vec![None; cases.len()];
            shown.margins(info, cases, &mut by_gates, &mut []);
            Closed(shown).margins(info, cases, &mut by_runs, &mut values);
            let rows = by_gates.chunks(width).zip(by_runs.chunks(width)).zip(cases);
            for (((by_gates, by_runs), case), values) in rows.zip(values) {
                let is_hit = by_gates.iter().zip(&open).all(|(margin, e)| e <= margin);
                let of_gates = by_gates
                    .iter()
                    .map(|m| if is_hit { *m } else { -F::infinity() });
                let expected = of_gates
                    .zip(info.gates)
                    .map(|(m, gate)| match gate.epsilon {
                        Tunable::Fixed if is_hit => F::infinity(),
                        // The largest number is the largest epsilon there is.
                        _ if m.place() == F::infinity().place() - 1 => F::infinity(),
                        _ => m,
                    });
                let expected: Vec<F> = expected.collect();
                let about = format!("{} {}: {case:?}", info.name, family.name);
                assert!(by_runs == expected, "{about}: {by_runs:?}, {expected:?}");
                assert_eq!(values.is_some(), is_hit, "{about}");
            }
        }
    }
}

#[test]
fn runs_find_the_margins_that_the_gates_show_in_either_scalar() {
    runs_find_the_margins_that_the_gates_show::<f32>();
    runs_find_the_margins_that_the_gates_show::<f64>();
}

#[test]
fn margins_decide_as_the_run_does_at_every_epsilon_in_f32() {
    margins_decide_as_the_run_does::<f32>();
}

#[test]
fn margins_decide_as_the_run_does_at_every_epsilon_in_f64() {
    margins_decide_as_the_run_does::<f64>();
}

#[test]
fn a_margin_is_the_last_epsilon_that_accepts_in_f32() {
    a_margin_is_the_last_epsilon_that_accepts::<f32>();
}

#[test]
fn a_margin_is_the_last_epsilon_that_accepts_in_f64() {
    a_margin_is_the_last_epsilon_that_accepts::<f64>();
}

#[test]
fn a_measured_hit_reports_the_values_of_the_run_in_either_scalar() {
    a_measured_hit_reports_the_values_of_the_run::<f32>();
    a_measured_hit_reports_the_values_of_the_run::<f64>();
}

#[test]
fn kernels_hit_or_miss_a_case_of_nans_as_their_table_says() {
    kernels_treat_a_nan_as_declared::<f32>();
    kernels_treat_a_nan_as_declared::<f64>();
}

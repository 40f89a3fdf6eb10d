//! Shrinking: the same finding on the simplest case, a local minimum, printed to be pasted.

use hairline::internals::arith::Float;
use hairline::internals::audit::{EpsilonChoice, Row};
use hairline::internals::case::{Case, Parameters};
use hairline::internals::explore::{
    Signature, Simplification, Size, c_snippet, rust_snippet, shrink, shrink_finding,
};
use hairline::internals::family::FAMILIES;
use hairline::internals::files::number;
use hairline::internals::judge::Finding;
use hairline::internals::kernel::{KERNELS, Scalar};

fn row(kernel: &str, contract: Option<&str>) -> Row {
    Row::named(kernel, None, contract.unwrap_or("own")).unwrap()
}

/// Cases of a family on which a row shows a finding, with its signature.
fn findings<F: Scalar>(row: &Row, family: &str, count: usize) -> Vec<(Case<F>, Signature)> {
    let family = hairline::internals::family::find(family).unwrap();
    (0..3000)
        .flat_map(|i| {
            family
                .make::<F>(&Parameters::default(), 1, i)
                .cases()
                .to_vec()
        })
        .filter_map(|case| Signature::of(row, &case).map(|signature| (case, signature)))
        .take(count)
        .collect()
}

fn magnitudes<F: Float>(case: &Case<F>) -> Vec<f64> {
    case.vectors()
        .iter()
        .flatten()
        .map(|x| x.to_f64().abs())
        .collect()
}

#[test]
fn an_edge_hit_that_open_signs_lose_shrinks_to_zeros_ones_and_twos() {
    let row = row("scalar-triple-two-sided", Some("closed-line"));
    let cases = findings::<f32>(&row, "edge-exact", 20);
    assert_eq!(cases.len(), 20);
    for (case, signature) in cases {
        assert_eq!(signature.finding, Finding::FalseMiss);
        let (_, shrunk) = shrink_finding(&row, &case).unwrap();
        assert!(
            magnitudes(&shrunk.case).iter().all(|x| *x <= 2.0),
            "{:?}",
            shrunk.case
        );
        assert!(Size::of(&shrunk.case).bits <= 16, "{:?}", shrunk.case);
    }
}

#[test]
fn a_triangle_behind_the_origin_shrinks_to_integers_up_to_three() {
    let row = row("half-space", None);
    let mut cases = findings::<f64>(&row, "behind", 60);
    // A finding keeps its place against the interval: one that is not [0, inf] has digits of its own.
    cases.retain(|(case, _)| case.ray.t_min == 0.0 && case.ray.t_max.is_infinite());
    assert!(20 < cases.len());
    for (case, signature) in cases {
        assert_eq!(
            (signature.finding, signature.exactly),
            (Finding::FalseHit, None)
        );
        let (_, shrunk) = shrink_finding(&row, &case).unwrap();
        assert!(
            magnitudes(&shrunk.case)
                .iter()
                .all(|x| *x <= 3.0 && x.fract() == 0.0)
        );
        assert!(Size::of(&shrunk.case).bits <= 16, "{:?}", shrunk.case);
    }
}

#[test]
fn a_triangle_too_small_for_1e_6_shrinks_to_a_few_powers_of_two() {
    let row = row("moller-trumbore", None);
    let cases = findings::<f32>(&row, "tiny", 20);
    assert_eq!(cases.len(), 20);
    for (case, signature) in cases {
        assert_eq!(
            (signature.gate, signature.exactly),
            (Some("parallel"), Some("parallel"))
        );
        let (_, shrunk) = shrink_finding(&row, &case).unwrap();
        let size = Size::of(&shrunk.case);
        let bits = magnitudes(&shrunk.case).into_iter().map(f64::to_bits);
        assert!(
            bits.into_iter().all(|bits| bits << 12 == 0),
            "powers of two: {:?}",
            shrunk.case
        );
        assert!(
            size.bits <= 24 && size.values <= 6,
            "{size:?}: {:?}",
            shrunk.case
        );
    }
}

/// A sample of findings of every kernel on every family.
fn for_some_findings<F: Scalar>(mut check: impl FnMut(&Row, &Case<F>, &Signature)) -> usize {
    let mut checked = 0;
    for entry in KERNELS {
        for row in EpsilonChoice::Source.rows(&[entry], None).unwrap() {
            for family in FAMILIES {
                let found = (0..60).find_map(|index| {
                    let made = family.make::<F>(&Parameters::default(), 5, index);
                    let case = made.cases()[0];
                    Signature::of(&row, &case).map(|signature| (case, signature))
                });
                if let Some((case, signature)) = found {
                    check(&row, &case, &signature);
                    checked += 1;
                }
            }
        }
    }
    checked
}

fn shrinking_is_monotone_idempotent_and_keeps_the_signature<F: Scalar>() {
    let checked = for_some_findings::<F>(|row, case, signature| {
        let (kept, shrunk) = shrink_finding(row, case).unwrap();
        assert_eq!(kept, *signature);
        assert_eq!(Signature::of(row, &shrunk.case).as_ref(), Some(signature));
        assert!(Size::of(&shrunk.case) <= Size::of(case));
        let (_, again) = shrink_finding(row, &shrunk.case).unwrap();
        assert_eq!(
            (again.case.bits(), again.steps),
            (shrunk.case.bits(), 0),
            "{signature}"
        );
        let (_, same) = shrink_finding(row, case).unwrap();
        assert_eq!(same.case.bits(), shrunk.case.bits(), "deterministic");
    });
    assert!(checked > 60, "{checked}");
}

#[test]
fn shrinking_is_monotone_and_idempotent_and_keeps_the_signature_in_f32() {
    shrinking_is_monotone_idempotent_and_keeps_the_signature::<f32>();
}

#[test]
fn shrinking_is_monotone_and_idempotent_and_keeps_the_signature_in_f64() {
    shrinking_is_monotone_idempotent_and_keeps_the_signature::<f64>();
}

/// By the documented steps, and by changes written here without them: a coordinate to zero, to one,
/// to another of its axis, or with its lowest bit dropped.
#[test]
fn no_single_step_leads_to_a_simpler_case_with_the_signature() {
    let steps = Simplification::all();
    let mut tried = 0;
    for_some_findings::<f32>(|row, case, signature| {
        let (_, shrunk) = shrink_finding(row, case).unwrap();
        let size = Size::of(&shrunk.case);
        let mut candidates: Vec<Case<f32>> =
            steps.iter().map(|step| step.apply(&shrunk.case)).collect();
        let vectors = shrunk.case.vectors();
        for (i, axis) in (0..5).flat_map(|i| (0..3).map(move |axis| (i, axis))) {
            let value = vectors[i][axis];
            let shorter = f32::from_bits(value.to_bits() & value.to_bits().wrapping_sub(1));
            let shorter = if value.to_bits() << 9 == 0 {
                value
            } else {
                shorter
            };
            let others = [0, 2, 3, 4].map(|p: usize| vectors[p][axis]);
            let others = others.into_iter().filter(|_| i != 1);
            for new in [0.0, 1.0, -1.0, shorter].into_iter().chain(others) {
                let mut changed = vectors;
                changed[i][axis] = new;
                let [o, d, a, b, c] = changed;
                let ends = (shrunk.case.ray.t_min, shrunk.case.ray.t_max);
                candidates.push(Case::new(o, d, [a, b, c]).on(ends.0, ends.1));
            }
        }
        for candidate in candidates
            .iter()
            .filter(|candidate| Size::of(*candidate) < size)
        {
            tried += 1;
            let shown = Signature::of(row, candidate);
            assert_ne!(
                shown.as_ref(),
                Some(signature),
                "{candidate:?} is simpler than {shrunk:?}"
            );
        }
    });
    assert!(tried > 10_000, "{tried}");
}

#[test]
fn simpler_is_a_total_order() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let case = |x: f64| Case::<f64>::new([x, 0.25, 1.0], [0.0, 0.0, -1.0], triangle);
    let xs = [
        0.0,
        1.0,
        -1.0,
        2.0,
        3.0,
        4.0,
        -4.0,
        0.25,
        0.3,
        f64::INFINITY,
        f64::NAN,
    ];
    for (i, x) in xs.into_iter().enumerate() {
        for (j, y) in xs.into_iter().enumerate() {
            assert_eq!(Size::of(&case(x)) == Size::of(&case(y)), i == j);
        }
    }
    let simplest_first = [0.0, 1.0, -1.0, 3.0, 0.3, f64::INFINITY];
    assert!(simplest_first.is_sorted_by_key(|x| Size::of(&case(*x))));
    assert!(Size::of(&case(-0.0)) > Size::of(&case(0.0)));
    assert!(
        Size::of(&case(1.0).on(0.0, 0.0)) > Size::of(&case(1.0)),
        "the default interval"
    );
    let shared = Size::of(&case(0.25));
    assert!(shared < Size::of(&case(0.75)) && shared.values < Size::of(&case(3.0)).values);
}

#[test]
fn what_shrinks_to_nothing_is_nothing() {
    let case = Case::<f64>::new(
        [0.1; 3],
        [f64::NAN; 3],
        [[7.3; 3], [1e300; 3], [-1e-300; 3]],
    );
    let nothing = shrink(&case.on(-3.0, 5.0), |_| true).case;
    assert_eq!(Size::of(&nothing).bits, 0);
    assert_eq!(shrink(&case, |_| false).case.bits(), case.bits());
}

/// The snippets of these files are compiled into this test, and are what the program prints.
mod snippets {
    include!("../snippets/false_miss.rs");
    include!("../snippets/false_hit.rs");
}

#[test]
fn the_rust_snippets_are_those_that_were_compiled() {
    let tiny = row("moller-trumbore", None);
    let (case, _) = findings::<f32>(&tiny, "tiny", 1)[0];
    let (signature, shrunk) = shrink_finding(&tiny, &case).unwrap();
    let snippet = rust_snippet(&tiny, &shrunk.case, &signature);
    assert_eq!(
        snippet,
        include_str!("../snippets/false_miss.rs"),
        "{snippet}"
    );
    // Not simplified: an interval of its own.
    let ends = row("half-space", None);
    let case = Case::<f64>::new(
        [-0.1, 0.2, -1.0],
        [0.0, -0.0, -1.0],
        [[0.0, 0.0, 0.0], [1e-3, 1e22, 0.0], [-1.0, 0.0, 0.0]],
    );
    let case = case.on(f64::NEG_INFINITY, 0.5);
    let signature = Signature::of(&ends, &case).unwrap();
    let snippet = rust_snippet(&ends, &case, &signature);
    assert_eq!(
        snippet,
        include_str!("../snippets/false_hit.rs"),
        "{snippet}"
    );
}

#[test]
fn the_c_snippet_holds_every_number_exactly() {
    for_some_findings::<f64>(|row, case, signature| {
        let snippet = c_snippet(row, case, signature);
        let words = snippet.split(|c: char| "{}, ;=".contains(c));
        let numbers: Vec<u64> = words
            .filter(|word| word.trim_start_matches('-').starts_with("0x"))
            .map(|word| number::parse::<f64>(word).unwrap().to_bits())
            .collect();
        let finite = |bits: &u64| f64::from_bits(*bits).is_finite();
        let expected: Vec<u64> = case.bits().into_iter().filter(finite).collect();
        assert_eq!(numbers, expected, "{snippet}");
    });
}

//! Each model gives the verdict and the values of the published function, bit for bit, on every family.

use hairline::internals::arith::Float;
use hairline::internals::audit::Row;
use hairline::internals::case::Parameters;
use hairline::internals::contract::Direction;
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{Scalar, Verdict, register};
use hairline_league::kernels;

/// The values of a hit that are given, as bits; a miss has none, and every NaN is one.
fn bits<F: Float>(verdict: &Verdict<F>, gives: [bool; 3]) -> Option<[Option<u64>; 3]> {
    let values = [verdict.t, verdict.u, verdict.v];
    let bits = |x: F| {
        if x.to_f64().is_nan() {
            u64::MAX
        } else {
            x.to_bits()
        }
    };
    verdict
        .hit
        .then(|| std::array::from_fn(|i| gives[i].then(|| bits(values[i]))))
}

/// How many cases were compared, and how many of them were hits.
fn compare<F: Scalar>(row: &Row) -> [usize; 2] {
    let entry = row.entry;
    let Some(subject) = F::subject(entry) else {
        return [0; 2];
    };
    let Some(model) = subject.gated() else {
        return [0; 2];
    };
    let epsilons: Vec<F> = row.epsilons();
    let unit_direction = entry.info.contract.direction != Direction::Any;
    let parameters = Parameters {
        unit_direction,
        ..Parameters::default()
    };
    let gives = [entry.info.gives.t, entry.info.gives.uv, entry.info.gives.uv];
    let mut counts = [0; 2];
    for family in FAMILIES {
        for index in 0..1000 {
            for case in family.make::<F>(&parameters, 3, index).cases() {
                let mut verdict = [Verdict::miss(None)];
                subject.run(std::slice::from_ref(case), &epsilons, &mut verdict);
                let [published] = verdict;
                let modelled = model.run_tracked(case, &epsilons).verdict;
                assert_eq!(
                    bits(&published, gives),
                    bits(&modelled, gives),
                    "{} {}: {}",
                    entry.info.name,
                    F::NAME,
                    case.hex()
                );
                counts[0] += 1;
                counts[1] += usize::from(published.hit);
            }
        }
    }
    counts
}

#[test]
fn every_model_answers_as_the_published_function_does() {
    let mut modelled = Vec::new();
    for entry in kernels() {
        let name = register(entry).unwrap().info.name;
        let row = Row::named(name, None, "own").unwrap();
        let [cases, hits] = [compare::<f32>(&row), compare::<f64>(&row)]
            .into_iter()
            .fold([0, 0], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
        if cases > 0 {
            assert!(
                cases > 20_000 && hits > 2_000,
                "{name}: {hits} hits in {cases} cases"
            );
            modelled.push(name);
        }
    }
    let expected = [
        "bvh",
        "rayx-moller-trumbore",
        "manifold-rust",
        "mesh-geometry",
    ];
    assert_eq!(modelled, expected);
}

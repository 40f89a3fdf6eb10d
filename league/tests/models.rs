//! Each model gives the verdict and the values of the published function, bit for bit, on every family.

use hairline::arith::Float;
use hairline::case::{Case, Parameters};
use hairline::contract::Direction;
use hairline::family::FAMILIES;
use hairline::kernel::{Deciding, Entry, Scalar, Verdict};
use hairline_league::kernels;
use hairline::audit::Row;

/// The values of a hit, as bits; a miss has none, and every NaN is one.
fn bits<F: Float>(hit: bool, values: [F; 3], gives: [bool; 3]) -> Option<[Option<u64>; 3]> {
    let bits = |x: F| if x.is_finite() || !x.to_f64().is_nan() { x.to_bits() } else { u64::MAX };
    hit.then(|| std::array::from_fn(|i| gives[i].then(|| bits(values[i]))))
}

/// How many cases were compared, and how many of them were hits.
fn compare<F: Scalar>(entry: &'static Entry, row: &Row) -> [usize; 2] {
    let Some(subject) = F::subject(entry) else { return [0; 2] };
    let Some(model) = subject.gated() else { return [0; 2] };
    let epsilons: Vec<F> = row.epsilons();
    let unit_direction = entry.info.contract.direction != Direction::Any;
    let parameters = Parameters { unit_direction, ..Parameters::default() };
    let gives = [entry.info.gives.t, entry.info.gives.uv, entry.info.gives.uv];
    let mut counts = [0; 2];
    for family in FAMILIES {
        for index in 0..1000 {
            for case in family.make::<F>(&parameters, 3, index).cases() {
                let mut verdict = [Verdict::miss(None)];
                subject.run(std::slice::from_ref(case), &epsilons, &mut verdict);
                let [published] = verdict;
                let modelled = run::<F>(model, case, &epsilons);
                let values = [published.t, published.u, published.v];
                assert_eq!(
                    bits(published.hit, values, gives),
                    modelled.and_then(|values| bits(true, values, gives)),
                    "{} {}: {}", entry.info.name, F::NAME, case.hex()
                );
                counts[0] += 1;
                counts[1] += usize::from(published.hit);
            }
        }
    }
    counts
}

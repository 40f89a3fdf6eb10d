//! Intervals cover the rate of other seeds, where the triangles of one ray are wrong together.

use hairline::internals::audit::{EpsilonChoice, Interval, Plan, Source, Trials, Unobserved, run};
use hairline::internals::case::Parameters;
use hairline::internals::family;
use hairline::internals::judge::Finding;
use hairline::internals::kernel;

const SEEDS: u64 = 80;

/// By seed: the false misses and the false hits of a kernel on 400 rays of a family.
fn samples(kernel: &str, epsilons: &[(&str, &str)], family: &str) -> [Vec<Trials>; 2] {
    let entry = kernel::find(kernel).unwrap();
    let owned = |(gate, value): &(&str, &str)| ((*gate).to_owned(), (*value).to_owned());
    let choice = EpsilonChoice::Given(epsilons.iter().map(owned).collect());
    let source = |seed| {
        Source::of(
            family::find(family).unwrap(),
            Parameters::default(),
            seed,
            400,
        )
    };
    let plan = Plan::new(
        choice.rows(&[entry], None).unwrap(),
        (1..=SEEDS).map(source).collect(),
        [true, false],
        0,
    );
    let audit = run(&plan, &Unobserved);
    [Finding::FalseMiss, Finding::FalseHit].map(|finding| {
        audit
            .cells
            .iter()
            .map(|cell| cell.tally.trials(None, finding))
            .collect()
    })
}

/// The share of the samples whose interval holds the rate of all.
fn coverage(samples: &[Trials], interval: impl Fn(&Trials) -> Interval) -> f64 {
    let mut all = Trials::default();
    samples.iter().for_each(|sample| all.merge(sample));
    let rate = all.share().unwrap();
    let covers = |sample: &&Trials| {
        let Interval { low, high } = interval(sample);
        low <= rate && rate <= high
    };
    samples.iter().filter(covers).count() as f64 / samples.len() as f64
}

#[test]
fn intervals_cover_the_rate_of_all_seeds() {
    for (kernel, epsilon, family) in [
        ("plane-unit-normal", "1e-6", "fan"),
        ("plane-unit-normal", "1e-2", "fan"),
        ("plane-unit-normal", "1e-6", "shared-edge"),
        ("plane-unit-normal", "1e-6", "polygon"),
        ("moller-trumbore", "1e-6", "fan"),
    ] {
        for samples in samples(kernel, &[("edge", epsilon)], family) {
            if samples.iter().all(|sample| sample.count == 0) {
                continue;
            }
            let covered = coverage(&samples, Trials::interval);
            assert!(0.93 <= covered, "{kernel} {epsilon} {family}: {covered}");
        }
    }
}

#[test]
fn triangles_of_one_ray_are_not_independent() {
    let [misses, _] = samples("plane-unit-normal", &[("edge", "1e-6")], "fan");
    let binomial = |sample: &Trials| Trials::independent(sample.count, sample.of).interval();
    // 95 % are promised.
    let covered = coverage(&misses, binomial);
    assert!(covered < 0.9, "{covered}");
}

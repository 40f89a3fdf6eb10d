//! Intervals cover the rate of other seeds, where the triangles of one ray are wrong together.

use hairline::audit::{EpsilonChoice, Interval, Observer, Plan, Source, Trials, run};
use hairline::case::Parameters;
use hairline::family;
use hairline::judge::Finding;
use hairline::kernel;

struct Unobserved;

impl Observer for Unobserved {
    fn advance(&self, _: u64) {}
    fn now(&self) -> u64 {
        0
    }
}

const SEEDS: u64 = 80;

/// By seed: the false misses and the false hits of a kernel on 400 rays of a family.
fn samples(kernel: &str, epsilons: &[(&str, &str)], family: &str) -> [Vec<Trials>; 2] {
    let entry = kernel::find(kernel).unwrap();
    let owned = |(gate, value): &(&str, &str)| ((*gate).to_owned(), (*value).to_owned());
    let choice = EpsilonChoice::Given(epsilons.iter().map(owned).collect());
    let source = |seed| Source::Family {
        family: family::find(family).unwrap(),
        parameters: Parameters::default(),
        seed,
        count: 400,
        exhaustive: false,
    };
    let plan = Plan {
        rows: choice.rows(&[entry], None).unwrap(),
        sources: (1..=SEEDS).map(source).collect(),
        scalars: [true, false],
        examples: 0,
        attribute: 0,
    };
    let audit = run(&plan, &Unobserved);
    [Finding::FalseMiss, Finding::FalseHit]
        .map(|finding| audit.cells.iter().map(|cell| cell.tally.trials(None, finding)).collect())
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
fn explore() {
    for kernel in ["plane-unit-normal", "moller-trumbore", "plucker", "cramer", "woop-watertight", "baldwin-weber", "havel-herout", "badouel", "segura-feito"] {
        if kernel::find(kernel).is_none() { println!("no {kernel}"); continue; }
        for family in ["fan", "shared-edge", "polygon"] {
            for e in ["0", "1e-6", "1e-2", "1e-1","1"] {
            let entry = kernel::find(kernel).unwrap();
            if !entry.info.gates.iter().any(|g| g.name == "edge") { println!("{kernel} no edge"); continue; }
            for (name, samples) in ["miss", "hit"].into_iter().zip(samples(kernel, &[("edge", e)], family)) {
                let sum: u64 = samples.iter().map(|s| s.count).sum();
                if sum == 0 { continue; }
                let of: u64 = samples.iter().map(|s| s.of).sum();
                let p = sum as f64 / of as f64;
                let n = of as f64 / 80.0;
                let sd = (samples.iter().map(|s| (s.share().unwrap() - p).powi(2)).sum::<f64>() / 79.0).sqrt();
                let bin = coverage(&samples, |t| Trials::independent(t.count, t.of).interval());
                println!("{kernel} {family} edge={e} {name}: p {p:.5} n {n} sd {sd:.4} binomial {:.4} cover {:.4} binom cover {bin:.4}", (p * (1.0 - p) / n).sqrt(), coverage(&samples, Trials::interval));
            }
            }
        }
    }
}

#[test]
fn explore_pairs() {
    use hairline::judge::Class;
    for (kernel, e) in [("plane-unit-normal", "1e-6"), ("plane-unit-normal", "1e-2"), ("moller-trumbore", "1e-6"), ("moller-trumbore", "1e-2")] {
        for family in ["fan", "shared-edge", "polygon"] {
            let Some(entry) = kernel::find(kernel) else { continue };
            if !entry.info.gates.iter().any(|g| g.name == "edge") { continue; }
            let choice = EpsilonChoice::Given(vec![("edge".to_owned(), e.to_owned())]);
            let source = |seed| Source::Family { family: family::find(family).unwrap(), parameters: Parameters::default(), seed, count: 400, exhaustive: false };
            let plan = Plan { rows: choice.rows(&[entry], None).unwrap(), sources: (1..=60).map(source).collect(), scalars: [true, false], examples: 0, attribute: 0 };
            let audit = run(&plan, &Unobserved);
            let keys: Vec<(Class, Finding)> = Class::all().flat_map(|c| Finding::ALL.map(|f| (c, f))).collect();
            for a in 0..60 { for b in a + 1..60 {
                let [x, y] = [a, b].map(|i: usize| &audit.cells[i].tally);
                let both: Vec<_> = keys.iter().map(|(c, f)| (*c, *f, x.trials(Some(*c), *f), y.trials(Some(*c), *f))).filter(|(.., s, t)| s.count + t.count > 0).collect();
                let tail = 0.05 / (both.len() + 2) as f64 / 2.0;
                for (c, f, s, t) in &both {
                    let apart = |i: Interval, j: Interval| i.high < j.low || j.high < i.low;
                    let bin = |t: &Trials| Trials::independent(t.count, t.of).interval_at(tail);
                    if apart(bin(s), bin(t)) {
                        println!("{kernel} {e} {family} seeds {} {}: {} {:?} {} of {} vs {} of {}: ours apart {}", a + 1, b + 1, c.name(), f, s.count, s.of, t.count, t.of, apart(s.interval_at(tail), t.interval_at(tail)));
                    }
                }
            }}
        }
    }
}

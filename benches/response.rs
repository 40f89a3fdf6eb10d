//! What a pass over all margins costs beside one run: `cargo bench --bench response`.
//!
//! Each line times, in one run on one thread and on the same cases: making them, the bare kernel with
//! its default epsilons, the oracle, and a pass of a study of epsilons (cases made, asked, measured,
//! counted). The figure to watch is the pass over the other three together.

use hairline::internals::audit::{EpsilonChoice, Observer, Source};
use hairline::internals::case::{Case, Parameters};
use hairline::internals::epsilon::{Attempt, Knob, Pass, Setting, count_at, counts_of};
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{KERNELS, Scalar, Verdict};
use hairline::internals::oracle::{Layers, truths};
use std::hint::black_box;
use std::time::Instant;

struct Silent;

impl Observer for Silent {
    fn advance(&self, _: u64) {}
    fn now(&self) -> u64 {
        0
    }
}

/// Median of five, in nanoseconds.
fn median(mut work: impl FnMut()) -> f64 {
    let mut times = [0.0; 5].map(|_: f64| {
        let start = Instant::now();
        work();
        start.elapsed().as_nanos() as f64
    });
    times.sort_by(f64::total_cmp);
    times[2]
}

const COUNT: u64 = 20_000;

fn sources() -> Vec<Source> {
    let families = [
        "interior",
        "outside",
        "edge-near",
        "grazing",
        "coplanar",
        "shared-edge",
    ];
    let source = |family: &'static hairline::internals::family::Family| {
        Source::of(family, Parameters::default(), 1, COUNT)
    };
    FAMILIES
        .iter()
        .filter(|family| families.contains(&family.name))
        .map(source)
        .collect()
}

fn lines<F: Scalar>() {
    let sources = sources();
    let make = || -> Vec<Case<F>> {
        let made = |source: &Source| {
            (0..COUNT)
                .flat_map(|i| source.make::<F>(i).cases().to_vec())
                .collect::<Vec<_>>()
        };
        sources.iter().flat_map(made).collect()
    };
    let cases = make();
    let each = cases.len() as f64;
    let making = median(|| drop(black_box(make())));
    let oracle = median(|| {
        let (mut all, mut layers) = (Vec::new(), Layers::default());
        for chunk in cases.chunks(1024) {
            all.clear();
            truths(black_box(chunk), &mut all, &mut layers);
            black_box(&all);
        }
    });
    let entries: Vec<_> = KERNELS.iter().collect();
    let mut rows = EpsilonChoice::Source
        .rows(&entries, None)
        .expect("the default plan");
    rows.dedup_by(|second, first| second.entry.info.name == first.entry.info.name);
    for row in &rows {
        let knobs = Knob::all(row);
        let counts = counts_of(&sources, &knobs, row);
        let epsilons = row.epsilons::<F>();
        let kernel = median(|| {
            let mut verdicts = vec![Verdict::miss(None); 1024];
            for chunk in cases.chunks(1024) {
                F::subject(row.entry).expect("built in").run(
                    black_box(chunk),
                    &epsilons,
                    &mut verdicts,
                );
                black_box(&verdicts);
            }
        });
        let subject = F::subject(row.entry).expect("built in");
        let setting = Setting {
            row,
            subject,
            knobs: &knobs,
            counts: &counts,
            scene: None,
            sources: &sources,
            mesh: None,
            relative: false,
            fine_curves: false,
            store: None,
            shared: None,
        };
        let attempt = [Attempt::new(vec![F::zero(); knobs.len()])];
        let response = median(|| {
            drop(black_box(count_at(
                &setting,
                &attempt,
                Pass::new(1, COUNT, &Silent),
            )))
        });
        println!(
            "{:<28}{}{:>8.0}{:>8.0}{:>8.0}{:>10.0}{:>8.2}{:>8.2}",
            row.entry.info.name,
            F::NAME,
            making / each,
            kernel / each,
            oracle / each,
            response / each,
            response / (making + kernel + oracle),
            (response - making) / (kernel + oracle)
        );
    }
}

fn main() {
    let stock = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("one thread");
    stock.install(|| {
        println!("ns a case, one thread; the last two: a pass over making, kernel and oracle,");
        println!("and a pass less making over kernel and oracle");
        println!(
            "{:<31}{:>8}{:>8}{:>8}{:>10}{:>8}{:>8}",
            "kernel, all its knobs", "making", "kernel", "oracle", "pass", "ratio", "ratio"
        );
        lines::<f32>();
        lines::<f64>();
    });
}

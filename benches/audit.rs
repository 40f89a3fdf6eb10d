//! What an audit costs beside the kernels it runs: `cargo bench --bench audit`.
//!
//! Each line times, in one run on one thread: the bare kernels on cases that lie ready, the oracle
//! on the same cases, and the whole audit of them (cases made, asked, run, judged, added up). The
//! figure to watch is the audit's time over the bare kernels'.

use hairline::internals::audit::{EpsilonChoice, Observer, Plan, Source, run};
use hairline::internals::case::{Case, Parameters};
use hairline::internals::family::{FAMILIES, Family, STRATA};
use hairline::internals::kernel::{KERNELS, Scalar, Verdict, find};
use hairline::internals::oracle;
use std::hint::black_box;
use std::time::Instant;

/// The kernel that `hairline repair --kernel moller-trumbore --emit rust` writes; a test compares them.
#[rustfmt::skip]
#[path = "audit/repaired.rs"]
mod repaired;

struct Clock(Instant);

impl Observer for Clock {
    fn advance(&self, _: u64) {}
    fn now(&self) -> u64 {
        self.0.elapsed().as_nanos() as u64
    }
}

/// How often each work is timed, in turn: a machine's moods then fall on all of them.
const ROUNDS: usize = 7;

/// In nanoseconds.
fn time(work: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_nanos() as f64
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

fn plan(families: &[&'static Family], count: u64, scalars: [bool; 2]) -> Plan {
    let entries: Vec<_> = KERNELS.iter().collect();
    let source = |family: &&'static Family| Source::of(family, Parameters::default(), 1, count);
    let rows = EpsilonChoice::Source
        .rows(&entries, None)
        .expect("the default plan");
    Plan::new(rows, families.iter().map(source).collect(), scalars, 3)
}

fn line<F: Scalar>(name: &str, families: &[&'static Family], count: u64) {
    let plan = plan(families, count, F::NAME.alone());
    let chunks: Vec<Vec<Case<F>>> = families
        .iter()
        .flat_map(|family| {
            let cases: Vec<Case<F>> = (0..count)
                .flat_map(|i| {
                    family
                        .make::<F>(&Parameters::default(), 1, i)
                        .cases()
                        .to_vec()
                })
                .collect();
            cases.chunks(1024).map(<[_]>::to_vec).collect::<Vec<_>>()
        })
        .collect();
    let cases = chunks.iter().map(Vec::len).sum::<usize>() as f64;
    let epsilons: Vec<Vec<F>> = plan.rows.iter().map(|row| row.epsilons::<F>()).collect();
    let mut kernels = || {
        // In the order of the audit: a chunk stays near while all kernels run on it.
        for chunk in &chunks {
            for (row, epsilons) in plan.rows.iter().zip(&epsilons) {
                let mut verdicts = vec![Verdict::miss(None); chunk.len()];
                let subject = F::subject(row.entry).expect("built in");
                subject.run(black_box(chunk), epsilons, &mut verdicts);
                black_box(&verdicts);
            }
        }
    };
    let mut oracle = || {
        for case in chunks.iter().flatten() {
            black_box(oracle::truth(black_box(case)));
        }
    };
    let mut audit = || {
        black_box(run(&plan, &Clock(Instant::now())).cells.len());
    };
    let rounds: Vec<[f64; 3]> = (0..ROUNDS)
        .map(|_| [time(&mut kernels), time(&mut oracle), time(&mut audit)])
        .collect();
    let of = |number: fn(&[f64; 3]) -> f64| median(rounds.iter().map(number).collect());
    println!(
        "{name:<22} {} {:>10.0} {:>10.0} {:>10.0} {:>8.2}",
        F::NAME,
        of(|round| round[0]) / cases,
        of(|round| round[1]) / cases,
        of(|round| round[2]) / cases,
        of(|round| round[2] / round[0])
    );
}

/// A guarded kernel beside others on the same rays, in nanoseconds a ray.
fn repaired(family: &'static Family) {
    let cases: Vec<Case<f32>> = (0..20_000)
        .flat_map(|i| {
            family
                .make::<f32>(&Parameters::default(), 1, i)
                .cases()
                .to_vec()
        })
        .collect();
    let wide: Vec<Case<f64>> = cases.iter().map(Case::widen).collect();
    let plain = |name: &str| f32::subject(find(name).expect("built in")).expect("in f32");
    let (moller, woop) = (plain("moller-trumbore"), plain("woop-watertight"));
    let double = f64::subject(find("moller-trumbore").expect("built in")).expect("in f64");
    let (mut verdicts, mut doubles) = (
        vec![Verdict::miss(None); cases.len()],
        vec![Verdict::miss(None); cases.len()],
    );
    let mut asks = 0;
    let rounds: Vec<[f64; 4]> = (0..ROUNDS)
        .map(|_| {
            let plain = time(&mut || moller.run(black_box(&cases), &[0.0; 2], &mut verdicts));
            let guarded = time(&mut || {
                asks = 0;
                for case in black_box(&cases) {
                    let [o, d, a, b, c] = case.vectors();
                    let answer = black_box(repaired::moller_trumbore_f32(o, d, a, b, c));
                    asks += usize::from(answer == repaired::Answer::Ask);
                }
            });
            let woop = time(&mut || woop.run(black_box(&cases), &[0.0; 3], &mut verdicts));
            let double = time(&mut || double.run(black_box(&wide), &[0.0; 2], &mut doubles));
            [plain, guarded, woop, double]
        })
        .collect();
    let of = |place: usize| median(rounds.iter().map(|round| round[place]).collect());
    let nanoseconds = [0, 1, 2, 3].map(|place| of(place) / cases.len() as f64);
    let ratio = median(rounds.iter().map(|round| round[1] / round[0]).collect());
    let [plain, guarded, woop, double] = nanoseconds;
    println!(
        "{:<26} {plain:>10.1} {guarded:>10.1} {woop:>10.1} {double:>10.1} {ratio:>8.2} {:>7.2} %",
        family.name,
        100.0 * asks as f64 / cases.len() as f64
    );
}

fn main() {
    // cargo passes --bench; a filter would be the first other word.
    let filter = std::env::args()
        .skip(1)
        .find(|word| !word.starts_with('-'))
        .unwrap_or_default();
    let stock = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("one thread");
    if "repaired".contains(&filter) {
        println!("ns a ray, f32, one thread: moller-trumbore, the same guarded, and others");
        println!(
            "{:<26} {:>10} {:>10} {:>10} {:>10} {:>8} {:>9}",
            "family", "plain", "guarded", "woop", "in f64", "ratio", "asks"
        );
        let names = [
            "interior",
            "outside",
            "edge-near",
            "scene-interior",
            "scene-outside",
        ];
        let all = FAMILIES.iter().chain(STRATA);
        all.filter(|family| names.contains(&family.name))
            .for_each(repaired);
    }
    stock.install(|| {
        println!(
            "ns a case, one thread, {} kernels with their default epsilons",
            KERNELS.len()
        );
        println!(
            "{:<26} {:>10} {:>10} {:>10} {:>8}",
            "family", "kernels", "oracle", "audit", "ratio"
        );
        let all: Vec<&'static Family> = FAMILIES.iter().collect();
        if "all".contains(&filter) {
            line::<f32>("all families", &all, 20_000);
            line::<f64>("all families", &all, 20_000);
        }
        for family in FAMILIES
            .iter()
            .filter(|family| family.name.contains(&filter))
        {
            line::<f32>(family.name, &[family], 5000);
            line::<f64>(family.name, &[family], 5000);
        }
    });
}

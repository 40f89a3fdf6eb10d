//! What a truth costs: `cargo bench --bench oracle [-- CLASS]`.
//!
//! Per class of cases, in one run on one thread: the plain evaluation of the four determinants in
//! `f64` without branches or certainty, the oracle case by case, on slices of cases and on batches
//! of columns, and the definition in rationals. The classes are those of the peers' programs: generic rays; rays exactly at an edge or
//! a vertex and coplanar ones on small and fine lattices; rays aimed at a rounded point of an edge;
//! exponents over a wide and over the whole range.

use hairline::internals::arith::{Float, scale_by_power_of_two};
use hairline::internals::case::{Case, Draw};
use hairline::internals::oracle::{self, Batch, Layers};
use std::hint::black_box;
use std::time::Instant;

/// Enough that the branch predictor does not learn them.
const CASES: usize = 100_000;

type Maker = fn(&mut Draw) -> Case<f64>;

/// Name, generator, and the ratio to plain that the project sets itself.
const CLASSES: &[(&str, Maker, f64)] = &[
    ("generic f64", |draw| random(draw, f64::symmetric), 2.0),
    ("generic f32", |draw| random(draw, f32::symmetric), 2.0),
    ("near edge f32", |draw| near_edge(draw, f32::symmetric, 1.0, false), 2.0),
    ("near edge f32, unit d", |draw| near_edge(draw, f32::symmetric, 1.0, true), 2.0),
    ("wide f32 (2^±30)", wide, 2.0),
    ("exact edge, small", |draw| exact(draw, 1000, false, 0), 8.0),
    ("exact vertex, small", |draw| exact(draw, 1000, true, 0), 8.0),
    ("coplanar, small", |draw| coplanar(draw, 30, 30, 0), 8.0),
    ("exact edge, fine", |draw| exact(draw, 1 << 20, false, -40), 8.0),
    ("coplanar, fine", |draw| coplanar(draw, 1 << 10, 1 << 9, -40), 8.0),
    ("near edge f64", |draw| near_edge(draw, f64::symmetric, 1.0, false), 30.0),
    ("near edge f64, far unit d", |draw| near_edge(draw, f64::symmetric, 1000.0, true), 30.0),
    ("any finite f32", |draw| random(draw, any_float::<f32>), 150.0),
    ("any finite f64", |draw| random(draw, any_float::<f64>), 150.0),
];

/// A number drawn in a scalar and rounded to it after each step.
trait Symmetric: Float {
    fn symmetric(draw: &mut Draw) -> f64 {
        draw.symmetric::<Self>().to_f64()
    }
}

impl Symmetric for f32 {}
impl Symmetric for f64 {}

fn any_float<F: Float>(draw: &mut Draw) -> f64 {
    loop {
        let bits = draw.bits();
        let x = if F::NAME == "f32" {
            f64::from(f32::from_bits(bits as u32))
        } else {
            f64::from_bits(bits)
        };
        if x.is_finite() {
            return x;
        }
    }
}

fn random(draw: &mut Draw, number: fn(&mut Draw) -> f64) -> Case<f64> {
    let [o, d, a, b, c] = std::array::from_fn(|_| std::array::from_fn(|_| number(draw)));
    Case::new(o, d, [a, b, c])
}

fn near_edge(draw: &mut Draw, number: fn(&mut Draw) -> f64, far: f64, unit: bool) -> Case<f64> {
    let narrow = std::ptr::fn_addr_eq(number, f32::symmetric as fn(&mut Draw) -> f64);
    let round = |x: f64| if narrow { f64::from(x as f32) } else { x };
    let [o, a, b, c]: [[f64; 3]; 4] =
        std::array::from_fn(|_| std::array::from_fn(|_| number(draw)));
    let o = o.map(|x| round(x * far));
    let s = draw.unit();
    let mut d: [f64; 3] = std::array::from_fn(|i| round(round(a[i] + s * (b[i] - a[i])) - o[i]));
    if unit {
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        d = d.map(|x| round(x / length));
    }
    Case::new(o, d, [a, b, c])
}

/// `f32`, positions and direction each at a scale of its own in 2^±30, the direction near an edge.
fn wide(draw: &mut Draw) -> Case<f64> {
    let [p, q] = [0, 0].map(|_| draw.integer(-30, 30) as i32);
    let case = near_edge(draw, f32::symmetric, 1.0, false);
    let [o, d, a, b, c] = case.vectors();
    let by = |v: [f64; 3], k: i32| v.map(|x| scale_by_power_of_two(x, k));
    Case::new(by(o, p), by(d, q), [by(a, p), by(b, p), by(c, p)])
}

fn float(p: [i64; 3]) -> [f64; 3] {
    p.map(|x| x as f64)
}

/// Exactly at an edge or a vertex, on a lattice; the direction is scaled by 2^k.
fn exact(draw: &mut Draw, reach: i64, vertex: bool, k: i32) -> Case<f64> {
    let parts = draw.integer(2, 9);
    let step = draw.lattice_point(reach / 10);
    let [a, c, o] = [0, 0, 0].map(|_| draw.lattice_point(reach));
    let at = if vertex { 0 } else { draw.integer(1, parts - 1) };
    let along = |n: i64| std::array::from_fn(|i| a[i] + n * step[i]);
    let target: [i64; 3] = along(at);
    let d = std::array::from_fn(|i| scale_by_power_of_two((target[i] - o[i]) as f64, k));
    let [a, b, c] = draw.pick(&[[a, along(parts), c], [c, a, along(parts)], [along(parts), c, a]]);
    Case::new(float(o), d, [a, b, c].map(float))
}

fn coplanar(draw: &mut Draw, reach: i64, steps: i64, k: i32) -> Case<f64> {
    let [base, u, w] = [0, 0, 0].map(|_| draw.lattice_point(reach));
    let mut point = |base: [i64; 3]| -> [i64; 3] {
        let (x, y) = (draw.integer(-steps, steps), draw.integer(-steps, steps));
        std::array::from_fn(|i| base[i] + x * u[i] + y * w[i])
    };
    let [a, b, c, o] = std::array::from_fn(|_| float(point(base)));
    let d = float(point([0; 3])).map(|x| scale_by_power_of_two(x, k));
    Case::new(o, d, [a, b, c])
}

/// The signs of the four determinants, as computed, packed without a branch.
#[inline(always)]
fn plain(case: &Case<f64>) -> u8 {
    let [o, d, a, b, c] = case.vectors();
    let [a, b, c] = [a, b, c].map(|p| [p[0] - o[0], p[1] - o[1], p[2] - o[2]]);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let n = cross([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
    [dot(d, cross(c, b)), dot(d, cross(a, c)), dot(d, cross(b, a)), dot(n, a)]
        .iter()
        .fold(0, |bits, x| bits << 2 | u8::from(*x > 0.0) << 1 | u8::from(*x < 0.0))
}

/// Median of seven, in nanoseconds a case.
fn median(cases: usize, mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..7)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_nanos() as f64 / cases as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[3]
}

fn main() {
    // cargo passes --bench; a filter would be the first other word.
    let filter = std::env::args().skip(1).find(|word| !word.starts_with('-')).unwrap_or_default();
    println!("ns a case, one thread, {CASES} cases a class, medians of 7; ratios are to plain");
    println!(
        "{:<26} {:>6} {:>8} {:>6} {:>8} {:>6} {:>8} {:>6} {:>7} {:>10}  decided by",
        "class",
        "plain",
        "single",
        "ratio",
        "slice",
        "ratio",
        "columns",
        "ratio",
        "target",
        "definition"
    );
    for (name, maker, target) in CLASSES.iter().filter(|(name, ..)| name.contains(&filter)) {
        let cases: Vec<Case<f64>> =
            (0..CASES).map(|i| maker(&mut Draw::new(name, 42, i as u64))).collect();
        let plain = median(CASES, || {
            for case in &cases {
                black_box(plain(black_box(case)));
            }
        });
        let single = median(CASES, || {
            for case in &cases {
                black_box(oracle::truth(black_box(case)));
            }
        });
        let mut truths = Vec::new();
        let mut layers = Layers::default();
        let slice = median(CASES, || {
            layers = Layers::default();
            for chunk in cases.chunks(1024) {
                oracle::truths(black_box(chunk), &mut truths, &mut layers);
                black_box(&truths);
            }
        });
        let chunks: Vec<Batch<Vec<f64>>> = cases
            .chunks(1024)
            .map(|chunk| {
                let mut batch = Batch::new();
                chunk.iter().for_each(|case| batch.push(case));
                batch
            })
            .collect();
        let columns = median(CASES, || {
            for chunk in &chunks {
                black_box(chunk).truths(&mut truths, &mut Layers::default());
                black_box(&truths);
            }
        });
        let few = &cases[..100];
        let definition = median(few.len(), || {
            for case in few {
                black_box(oracle::define(black_box(case)));
            }
        });
        let shares =
            layers.named().map(|(layer, count)| (layer, 100.0 * count as f64 / CASES as f64));
        let shares: Vec<String> = shares
            .iter()
            .filter(|(_, share)| *share > 0.0)
            .map(|(layer, share)| format!("{layer} {share:.1}%"))
            .collect();
        println!(
            "{name:<26} {plain:>6.1} {single:>8.1} {:>6.1} {slice:>8.1} {:>6.1} {columns:>8.1} {:>6.1} {target:>7} {:>10.0}  {}",
            single / plain,
            slice / plain,
            columns / plain,
            definition,
            shares.join(", ")
        );
    }
}

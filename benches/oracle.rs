//! What a truth costs: `cargo bench --bench oracle [-- CLASS]`.
//!
//! Per class of cases, in one run on one thread: the plain evaluation of the four determinants in
//! `f64` without branches or certainty, the oracle case by case, on slices of cases and on batches
//! of columns, and the definition in rationals. The classes are those of the peers' programs: generic rays; rays exactly at an edge or
//! a vertex and coplanar ones on small and fine lattices; rays aimed at a rounded point of an edge;
//! exponents over a wide and over the whole range. Then come the families of the audit, in both scalars, so that
//! no slow class hides.

use hairline::internals::arith::{Float, scale_by_power_of_two};
use hairline::internals::case::{Case, Draw, Parameters};
use hairline::internals::family::{FAMILIES, Family};
use hairline::internals::kernel::Scalar;
use hairline::internals::oracle::{self, Batch, Layers};
use std::hint::black_box;
use std::time::Instant;

/// Enough that the branch predictor does not learn them.
const CASES: usize = 100_000;

type Maker = fn(&mut Draw) -> Case<f64>;

/// Name, generator, and the ratio to plain that the project sets itself.
const CLASSES: &[(&str, Maker, f64)] = &[
    ("generic f64", |draw| random(draw, f64::symmetric), 1.0),
    ("generic f32", |draw| random(draw, f32::symmetric), 1.0),
    (
        "near edge f32",
        |draw| near_edge(draw, f32::symmetric, 1.0, false),
        2.0,
    ),
    (
        "near edge f32, unit d",
        |draw| near_edge(draw, f32::symmetric, 1.0, true),
        2.0,
    ),
    ("wide f32 (2^±30)", wide, 2.0),
    ("exact edge, small", |draw| exact(draw, 1000, false, 0), 5.0),
    (
        "exact vertex, small",
        |draw| exact(draw, 1000, true, 0),
        5.0,
    ),
    ("coplanar, small", |draw| coplanar(draw, 30, 30, 0), 5.0),
    (
        "exact edge, fine",
        |draw| exact(draw, 1 << 20, false, -40),
        5.0,
    ),
    (
        "coplanar, fine",
        |draw| coplanar(draw, 1 << 10, 1 << 9, -40),
        5.0,
    ),
    ("parallel, full f64", |draw| flat(draw, false), 25.0),
    ("coplanar, full f64", |draw| flat(draw, true), 25.0),
    (
        "near edge f64",
        |draw| near_edge(draw, f64::symmetric, 1.0, false),
        20.0,
    ),
    (
        "near edge f64, far unit d",
        |draw| near_edge(draw, f64::symmetric, 1000.0, true),
        20.0,
    ),
    (
        "any finite f32",
        |draw| random(draw, any_float::<f32>),
        12.0,
    ),
    (
        "any finite f64",
        |draw| random(draw, any_float::<f64>),
        40.0,
    ),
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
        let x = if F::NAME == f32::NAME {
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
    let at = if vertex {
        0
    } else {
        draw.integer(1, parts - 1)
    };
    let along = |n: i64| std::array::from_fn(|i| a[i] + n * step[i]);
    let target: [i64; 3] = along(at);
    let d = std::array::from_fn(|i| scale_by_power_of_two((target[i] - o[i]) as f64, k));
    let [a, b, c] = draw.pick(&[
        [a, along(parts), c],
        [c, a, along(parts)],
        [along(parts), c, a],
    ]);
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

/// A direction in the plane exactly, and numbers of 50 bits and more; the origin in the plane or off it.
fn flat(draw: &mut Draw, coplanar: bool) -> Case<f64> {
    let [a, b, c, o] = [0; 4].map(|_| draw.lattice_point(1 << 49));
    let combined = |i: i64, j: i64| [0, 1, 2].map(|k| i * (b[k] - a[k]) + j * (c[k] - a[k]));
    let (i, j) = draw.pick(&[(1, 0), (0, 1), (1, 1), (1, -1), (2, -1)]);
    let from = draw.pick(&[a, b, c, combined(1, 1)]);
    let o = if coplanar {
        [0, 1, 2].map(|k| from[k] - combined(j, i)[k])
    } else {
        o
    };
    let scale = |p: [i64; 3]| float(p).map(|x| scale_by_power_of_two(x, -50));
    Case::new(scale(o), scale(combined(i, j)), [a, b, c].map(scale))
}

/// The signs of the four determinants, as computed, packed without a branch.
#[inline(always)]
fn plain(case: &Case<f64>) -> u8 {
    let [o, d, a, b, c] = case.vectors();
    let [a, b, c] = [a, b, c].map(|p| [p[0] - o[0], p[1] - o[1], p[2] - o[2]]);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let n = cross(
        [b[0] - a[0], b[1] - a[1], b[2] - a[2]],
        [c[0] - a[0], c[1] - a[1], c[2] - a[2]],
    );
    [
        dot(d, cross(c, b)),
        dot(d, cross(a, c)),
        dot(d, cross(b, a)),
        dot(n, a),
    ]
    .iter()
    .fold(0, |bits, x| {
        bits << 2 | u8::from(*x > 0.0) << 1 | u8::from(*x < 0.0)
    })
}

/// How often each work is timed.
const ROUNDS: usize = 9;

/// The fastest round, in nanoseconds a case: what else runs on the machine only adds.
fn fastest(cases: usize, mut work: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        work();
        best = best.min(start.elapsed().as_nanos() as f64 / cases as f64);
    }
    best
}

/// How many cases of a family; parallel ones cost microseconds.
const OF_A_FAMILY: u64 = 20_000;

/// One class: each way of asking, and its ratio to plain.
fn line<F: Float>(name: &str, cases: &[Case<F>], target: &str) {
    let wide: Vec<Case<f64>> = cases.iter().map(Case::widen).collect();
    let plain = fastest(cases.len(), || {
        for case in &wide {
            black_box(plain(black_box(case)));
        }
    });
    let single = fastest(cases.len(), || {
        for case in cases {
            black_box(oracle::truth(black_box(case)));
        }
    });
    let mut truths = Vec::new();
    let slice = fastest(cases.len(), || {
        for chunk in cases.chunks(1024) {
            oracle::truths(black_box(chunk), &mut truths, &mut Layers::default());
            black_box(&truths);
        }
    });
    let chunks: Vec<Batch<Vec<F>>> = cases
        .chunks(1024)
        .map(|chunk| {
            let mut batch = Batch::new();
            chunk.iter().for_each(|case| batch.push(case));
            batch
        })
        .collect();
    let columns = fastest(cases.len(), || {
        for chunk in &chunks {
            black_box(chunk).truths(&mut truths, &mut Layers::default());
            black_box(&truths);
        }
    });
    let few = &cases[..cases.len().min(50)];
    let definition = fastest(few.len(), || {
        for case in few {
            black_box(oracle::define(black_box(case)));
        }
    });
    let mut layers = Layers::default();
    oracle::truths(cases, &mut Vec::new(), &mut layers);
    let share = |count: u64| 100.0 * count as f64 / cases.len() as f64;
    let decided = layers.named().into_iter().filter(|(_, count)| *count > 0);
    let shares: Vec<String> = decided
        .map(|(layer, count)| format!("{layer} {:.1}%", share(count)))
        .collect();
    println!(
        "{name:<26} {plain:>6.1} {single:>8.1} {:>6.1} {slice:>8.1} {:>6.1} {columns:>8.1} {:>6.1} {target:>7} {definition:>10.0}  {}",
        single / plain,
        slice / plain,
        columns / plain,
        shares.join(", ")
    );
}

fn family_line<F: Scalar>(family: &Family) {
    let cases: Vec<Case<F>> = (0..OF_A_FAMILY)
        .flat_map(|i| {
            family
                .make::<F>(&Parameters::default(), 1, i)
                .cases()
                .to_vec()
        })
        .collect();
    line(&format!("{} {}", family.name, F::NAME), &cases, "");
}

fn main() {
    // cargo passes --bench; a filter would be the first other word.
    let filter = std::env::args()
        .skip(1)
        .find(|word| !word.starts_with('-'))
        .unwrap_or_default();
    println!(
        "ns a case, one thread, {CASES} cases a class, fastest of {ROUNDS}; ratios are to plain"
    );
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
        let cases: Vec<Case<f64>> = (0..CASES)
            .map(|i| maker(&mut Draw::new(name, 42, i as u64)))
            .collect();
        line(name, &cases, &target.to_string());
    }
    for family in FAMILIES
        .iter()
        .filter(|family| family.name.contains(&filter))
    {
        family_line::<f32>(family);
        family_line::<f64>(family);
    }
}

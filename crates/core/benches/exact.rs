//! The exact test beside kernels that are not: `cargo bench -p hairline-core --bench exact`.
//!
//! Each line times tests of one ray against one triangle, on one thread and in one run: published kernels as they are, then the
//! exact test in its three formats, with triangles and rays made ready before. Numbers are nanoseconds a test, and in brackets the
//! ratio to Möller and Trumbore's kernel.

use hairline_core::case::Draw;
use hairline_core::exact::{PreparedRay, PreparedTriangle};
use hairline_core::kernel::{KERNELS, Scalar, Verdict};
use hairline_core::{Case, Float};
use std::hint::black_box;
use std::time::Instant;

/// Tests of a batch: as many as fit into the caches.
const COUNT: usize = 1024;

/// Published kernels to compare with.
const PUBLISHED: [&str; 4] = [
    "moller-trumbore",
    "baldwin-weber",
    "embree-robust",
    "woop-watertight",
];

/// The share of rays that hit, and of those that hit the middle of an edge exactly.
struct Kind {
    name: &'static str,
    hits: f64,
    edges: f64,
}

const KINDS: [Kind; 5] = [
    Kind {
        name: "inside",
        hits: 1.0,
        edges: 0.0,
    },
    Kind {
        name: "beside",
        hits: 0.0,
        edges: 0.0,
    },
    Kind {
        name: "1 hit in 10",
        hits: 0.1,
        edges: 0.0,
    },
    Kind {
        name: "the same, 1 edge in 400",
        hits: 0.1,
        edges: 0.0025,
    },
    Kind {
        name: "edges alone",
        hits: 1.0,
        edges: 1.0,
    },
];

fn main() {
    println!("nanoseconds a test, and the ratio to moller-trumbore");
    for kind in &KINDS {
        lines::<f32>(kind);
        lines::<f64>(kind);
    }
}

fn lines<F: Timed>(kind: &Kind) {
    let cases: Vec<Case<F>> = (0..COUNT as u64).map(|index| case(kind, index)).collect();
    let mut line = format!("{:<4} {:<24}", F::NAME.name(), kind.name);
    let mut plain = f64::NAN;
    for name in PUBLISHED {
        let Some(took) = published(name, &cases) else {
            continue;
        };
        if plain.is_nan() {
            plain = took;
        }
        line += &format!("  {name} {took:.1} ({:.2})", took / plain);
    }
    for (name, took) in F::exact(&cases) {
        line += &format!("  {name} {took:.1} ({:.2})", took / plain);
    }
    println!("{line}");
}

/// A ray at a triangle of a size of about 1, all numbers with few digits, so that a ray at an edge meets it exactly.
fn case<F: Float>(kind: &Kind, index: u64) -> Case<F> {
    let draw = &mut Draw::new(kind.name, 1, index);
    let point = |draw: &mut Draw| [(); 3].map(|()| draw.integer(-512, 512) as f64 / 256.0);
    let [a, b, c] = [(); 3].map(|()| point(draw));
    let at = |x: f64, y: f64| [0, 1, 2].map(|i| a[i] + x * (b[i] - a[i]) + y * (c[i] - a[i]));
    let target = if draw.unit() < kind.edges {
        at(0.5, 0.5)
    } else if draw.unit() < kind.hits {
        let [x, y] = [0.125 + 0.25 * draw.unit(), 0.125 + 0.25 * draw.unit()];
        at(x, y)
    } else {
        at(1.5 * draw.unit(), -0.25 - draw.unit())
    };
    let away = point(draw);
    let origin = [0, 1, 2].map(|i| target[i] + away[i]);
    let direction = away.map(|x| -x);
    let rounded = |point: [f64; 3]| point.map(F::from_f64);
    Case::new(rounded(origin), rounded(direction), [a, b, c].map(rounded))
}

/// Nanoseconds a test: the least of many batches, so that the rest of the machine does not count.
fn least(mut batch: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..200 {
        let start = Instant::now();
        batch();
        least = least.min(start.elapsed().as_secs_f64());
    }
    least * 1e9 / COUNT as f64
}

/// A published kernel; none if it does not run in this scalar.
fn published<F: Scalar>(name: &str, cases: &[Case<F>]) -> Option<f64> {
    let entry = KERNELS.iter().find(|entry| entry.info.name == name)?;
    let kernel = F::subject(entry)?;
    let set = entry.info.epsilon_sets.first()?;
    let epsilons: Option<Vec<F>> = set
        .values
        .iter()
        .map(|text| hairline_core::kernel::EpsilonText::of(text)?.value())
        .collect();
    let epsilons = epsilons?;
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    Some(least(|| {
        kernel.run(black_box(cases), &epsilons, &mut verdicts);
        black_box(&verdicts);
    }))
}

/// Nanoseconds a test of a format.
macro_rules! prepared {
    ($scalar:ty, $number:ty, $cases:expr) => {{
        let mut triangles = Vec::new();
        let mut rays = Vec::new();
        for case in $cases {
            let [origin, direction, a, b, c] = case.vectors();
            triangles.push(PreparedTriangle::<$scalar, $number>::new(a, b, c));
            rays.push(PreparedRay::<$scalar, $number>::new(origin, direction));
        }
        let mut hits = vec![None; COUNT];
        least(|| {
            let tests = black_box(&triangles).iter().zip(black_box(&rays));
            for ((triangle, ray), hit) in tests.zip(&mut hits) {
                *hit = triangle.hit(ray, 0.0, <$scalar>::INFINITY);
            }
            black_box(&hits);
        })
    }};
}

/// A scalar with its formats of the exact test.
trait Timed: Scalar {
    fn exact(cases: &[Case<Self>]) -> Vec<(&'static str, f64)>;
}

impl Timed for f32 {
    fn exact(cases: &[Case<f32>]) -> Vec<(&'static str, f64)> {
        vec![
            ("exact, numbers in f64", prepared!(f32, f64, cases)),
            ("exact, in f32", prepared!(f32, f32, cases)),
        ]
    }
}

impl Timed for f64 {
    fn exact(cases: &[Case<f64>]) -> Vec<(&'static str, f64)> {
        vec![("exact", prepared!(f64, f64, cases))]
    }
}

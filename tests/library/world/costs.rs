//! What recommended epsilons cost in the second world, and what the best cost that it finds by itself.

use super::counts::{Tuned, by_plane, count_of, scene_of};
use super::meshes::Mesh;
use super::rays::{Aim, Shot};
use hairline::internals::audit::Unobserved;
use hairline::internals::case::Case;
use hairline::internals::epsilon::{Costs, Pass, WrongKind, study_scene};
use hairline::internals::family::Stratum;
use hairline::internals::kernel::Scalar;

/// The rays of an aim whose planes are of one kind.
struct Rays<F: Scalar> {
    aim: Aim,
    all: Vec<Shot>,
    cases: Vec<Case<F>>,
}

fn rays<F: Scalar>(
    mesh: &Mesh,
    plane: &str,
    tuned: &Tuned,
    seed: u64,
    count: usize,
) -> [Rays<F>; 7] {
    Aim::ALL.map(|aim| {
        let all = by_plane::<F>(mesh, aim, tuned, seed, count)
            .remove(plane)
            .unwrap();
        let cases = all.iter().flat_map(Shot::cases::<F>).collect();
        Rays { aim, all, cases }
    })
}

/// A crack costs ten, every other wrong answer one.
fn price(aim: Aim) -> f64 {
    if matches!(aim, Aim::Edge | Aim::Vertex) {
        10.0
    } else {
        1.0
    }
}

/// What epsilons cost, and the variance of that.
fn cost<F: Scalar>(tuned: &Tuned, rays: &[Rays<F>], epsilons: &[F]) -> (f64, f64) {
    let of = |rays: &Rays<F>| {
        let rate = tuned.wrong_of(rays.aim, &rays.all, &rays.cases, epsilons);
        let (price, share) = (price(rays.aim), rate.share());
        // As if there were one more wrong answer: there may be some that no ray shows.
        let variance = price * price * (share + 1.0 / rate.of as f64) / rate.of as f64;
        (price * share, variance)
    };
    rays.iter()
        .map(of)
        .fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
}

/// The cheapest epsilons: one knob after the other, in steps of about three, until nothing is cheaper.
fn cheapest<F: Scalar>(tuned: &Tuned, rays: &[Rays<F>]) -> Vec<F> {
    let sizes = (-14..=1).flat_map(|power| [1.0, 3.0].map(|x| x * 10f64.powi(power)));
    let sizes: Vec<f64> = std::iter::once(0.0).chain(sizes).collect();
    let gates = tuned.row.entry.info.gates;
    let mut best = tuned.zeros::<F>();
    let mut least = f64::INFINITY;
    for _ in 0..3 {
        let before = least;
        for knob in (0..best.len()).rev() {
            let sign = if tuned.knobs[knob].takes_negative(gates) {
                -1.0
            } else {
                1.0
            };
            let mut tried = best.clone();
            for size in &sizes {
                tried[knob] = F::from_f64(sign * size);
                let (found, _) = cost(tuned, rays, &tried);
                if found < least {
                    (least, best) = (found, tried.clone());
                }
            }
        }
        if least == before {
            break;
        }
    }
    best
}

/// Costs of one recommendation.
#[derive(Debug)]
pub struct Recommended {
    /// What hairline says that it costs, without rays that are exactly parallel.
    pub said: f64,
    /// In the second world.
    pub here: f64,
    /// Of the best epsilons that the second world finds.
    pub least: f64,
    /// Four standard deviations of the cost here.
    pub chance: f64,
}

pub fn recommended<F: Scalar>(mesh: &Mesh, plane: &str, kernel: &str, count: u64) -> Recommended {
    let tuned = Tuned::new(kernel);
    let drawn = count as usize;
    let (known, fresh) = (
        rays::<F>(mesh, plane, &tuned, 21, drawn),
        rays::<F>(mesh, plane, &tuned, 22, drawn),
    );
    let scene = scene_of(mesh, &known[0].all, plane);
    let setting = tuned.setting::<F>(&scene, &tuned.counts);
    let study = study_scene(
        &setting,
        &Costs::default(),
        None,
        &[],
        Pass::new(1, count, &Unobserved),
    )
    .unwrap();
    let aims: Vec<_> = Aim::ALL.map(count_of).into();
    let said = tuned
        .counts
        .iter()
        .zip(&study.tried[0].wrong)
        .map(|(count, wrong)| {
            assert!(
                count.rays == hairline::internals::epsilon::Rays::Stratum(Stratum::Parallel)
                    || aims.contains(count),
                "{count:?}"
            );
            let price = if count.kind == WrongKind::Crack {
                price(Aim::Edge)
            } else {
                price(Aim::Inside)
            };
            let is_counted =
                count.rays != hairline::internals::epsilon::Rays::Stratum(Stratum::Parallel);
            if is_counted {
                price * wrong.share().unwrap_or(0.0)
            } else {
                0.0
            }
        });
    let best = cheapest::<F>(&tuned, &known);
    let (here, variance) = cost(&tuned, &fresh, &study.best);
    let (least, _) = cost(&tuned, &fresh, &best);
    Recommended {
        said: said.sum(),
        here,
        least,
        chance: 4.0 * variance.sqrt(),
    }
}

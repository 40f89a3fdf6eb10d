//! What recommended epsilons cost in the second world, and what the best cost that it finds by itself.

use super::counts::{Tuned, by_plane, count_of, scene_of};
use super::meshes::Mesh;
use super::rays::{Aim, Shot};
use hairline::internals::audit::Unobserved;
use hairline::internals::epsilon::scene::{Costs, Kind, study_scene};
use hairline::internals::family::Stratum;
use hairline::internals::kernel::Scalar;

/// The rays of each aim whose planes are of one kind.
type Rays = Vec<(Aim, Vec<Shot>)>;

fn rays<F: Scalar>(mesh: &Mesh, plane: &str, tuned: &Tuned, seed: u64, count: usize) -> Rays {
    let of = |aim: Aim| by_plane::<F>(mesh, aim, tuned, seed, count).remove(plane).unwrap();
    Aim::ALL.map(|aim| (aim, of(aim))).into()
}

/// A crack costs ten, every other wrong answer one.
fn cost<F: Scalar>(tuned: &Tuned, rays: &Rays, epsilons: &[F]) -> f64 {
    let of = |(aim, all): &(Aim, Vec<Shot>)| {
        let price = if matches!(aim, Aim::Edge | Aim::Vertex) { 10.0 } else { 1.0 };
        price * tuned.wrong(*aim, all, epsilons).share()
    };
    rays.iter().map(of).sum()
}

/// The cheapest epsilons: one knob after the other, in steps of about three, until nothing is cheaper.
fn cheapest<F: Scalar>(tuned: &Tuned, rays: &Rays) -> Vec<F> {
    let sizes = (-14..=1).flat_map(|power| [1.0, 3.0].map(|x| x * 10f64.powi(power)));
    let sizes: Vec<f64> = std::iter::once(0.0).chain(sizes).collect();
    let gates = tuned.row.entry.info.gates;
    let mut best = tuned.zeros::<F>();
    let mut least = f64::INFINITY;
    for _ in 0..3 {
        let before = least;
        for knob in (0..best.len()).rev() {
            let sign = if tuned.knobs[knob].takes_negative(gates) { -1.0 } else { 1.0 };
            let mut tried = best.clone();
            for size in &sizes {
                tried[knob] = F::from_f64(sign * size);
                let found = cost(tuned, rays, &tried);
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
}

pub fn recommended<F: Scalar>(mesh: &Mesh, plane: &str, kernel: &str, count: u64) -> Recommended {
    let tuned = Tuned::new(kernel);
    let drawn = count as usize;
    let (known, fresh) =
        (rays::<F>(mesh, plane, &tuned, 21, drawn), rays::<F>(mesh, plane, &tuned, 22, drawn));
    let scene = scene_of(mesh, &known[0].1, plane);
    let setting = tuned.setting::<F>(&scene, &tuned.counts);
    let study = study_scene(&setting, &Costs::default(), None, &[], 1, count, &Unobserved).unwrap();
    let aims: Vec<_> = Aim::ALL.map(count_of).into();
    let said = tuned.counts.iter().zip(&study.tried[0].wrong).map(|(count, wrong)| {
        assert!(count.stratum == Stratum::Parallel || aims.contains(count), "{count:?}");
        let price = if count.kind == Kind::Crack { 10.0 } else { 1.0 };
        let is_counted = count.stratum != Stratum::Parallel;
        if is_counted { price * wrong.share().unwrap_or(0.0) } else { 0.0 }
    });
    let best = cheapest::<F>(&tuned, &known);
    Recommended {
        said: said.sum(),
        here: cost(&tuned, &fresh, &study.best),
        least: cost(&tuned, &fresh, &best),
    }
}

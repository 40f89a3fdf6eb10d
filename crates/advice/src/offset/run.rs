//! A run: every scheme on the hit points of one kernel in one scene.

use super::hit::{HitPoint, Start};
use super::neighbour::Neighbour;
use super::plane::Plane;
use super::published::{along, largest};
use super::scheme::Scheme;
use super::sums::{OfScheme, OffsetSums};
use super::trial::{OffsetTrial, OffsetTrials, PointKind};
use crate::arith::{Float, ordered_midpoint};
use crate::audit::{Row, Source};
use crate::case::{Case, Matrix, Parameters, Scene};
use crate::contract::Extent;
use crate::engine::{self, Observer};
use crate::family::Stratum;
use crate::kernel::{Scalar, Verdict};
use crate::mesh::SceneMesh;
use crate::oracle::Layers;
use crate::truth::{Place, Truth};
use std::ops::Range;
use std::sync::Arc;

/// The plan of a run.
#[derive(Clone, Copy)]
pub struct OffsetPlan<'a> {
    /// The kernel and its epsilons.
    pub row: &'a Row,
    /// Where triangles and first rays come from.
    pub scene: &'a Scene,
    /// The mesh that the scene is, if it is one.
    pub mesh: Option<&'a Arc<SceneMesh>>,
    /// How hit points are formed, from values that the kernel gives.
    pub kind: PointKind,
    /// The schemes, which all run in the scalar.
    pub schemes: &'a [Scheme],
    /// How far in front of each triangle a wall is, in its longest edges.
    pub wall: f64,
    /// The angle in degrees at which a neighbour is folded up.
    pub fold: f64,
    /// Where triangles are put, if not where they are.
    pub instance: Option<Matrix<f64>>,
    /// True if the smallest safe offset of each hit point is looked for.
    pub with_least: bool,
    /// True if the height of each start is measured, and what lies below it; that costs more than all else. Failures are
    /// counted in any case.
    pub with_heights: bool,
    /// Which random rays.
    pub seed: u64,
    /// How many first rays.
    pub count: u64,
}

/// Indices that go through a run together.
const CHUNK: u64 = 1024;

/// Runs a plan; the sums are the same whatever the number of threads.
pub fn run<F: Scalar>(plan: &OffsetPlan<'_>, observer: &dyn Observer) -> OffsetSums {
    run_on::<F>(plan, 0..plan.count, observer)
}

/// Runs a plan on some of its first rays.
pub fn run_on<F: Scalar>(
    plan: &OffsetPlan<'_>,
    indices: Range<u64>,
    observer: &dyn Observer,
) -> OffsetSums {
    let empty = || {
        let schemes = vec![OfScheme::default(); plan.schemes.len()];
        OffsetSums {
            schemes,
            ..OffsetSums::default()
        }
    };
    let source = plan.source();
    let add = |sums: &mut OffsetSums, indices| {
        add_chunk::<F>((plan, &source), plan.trials(&source, indices), sums)
    };
    engine::sum(indices, CHUNK, observer, empty, add)
}

/// The new ray of a scheme that leaves the first ray of an index, with its triangle.
pub fn new_ray<F: Scalar>(plan: &OffsetPlan<'_>, scheme: &Scheme, index: u64) -> Option<Case<F>> {
    let trials = plan.trials::<F>(&plan.source(), index..index + 1).trials;
    let (trial, offset) = (trials.first()?, scheme.offset::<F>()?);
    let Start { origin, t_min } = offset.start(&trial.hit);
    Some(trial.case(origin, t_min))
}

impl OffsetPlan<'_> {
    /// True if the kernel can tell a self-hit: one that takes whole lines and reports no t cannot.
    pub fn tells_self_hits(&self) -> bool {
        self.row.entry.info.gives.t || self.row.contract.extent != Extent::Line
    }

    /// The first rays: towards the insides of triangles.
    pub fn source(&self) -> Source {
        let OffsetPlan {
            scene,
            mesh,
            seed,
            count,
            ..
        } = *self;
        let parameters = Parameters {
            scene: Some(scene.clone()),
            ..Parameters::default()
        };
        let source = Source::of_stratum(Stratum::Interior, mesh, parameters, seed, count);
        match self.instance {
            Some(matrix) => source.placed(matrix),
            None => source,
        }
    }

    fn trials<F: Scalar>(&self, source: &Source, indices: Range<u64>) -> OffsetTrials<F> {
        let OffsetPlan {
            row, kind, seed, ..
        } = *self;
        OffsetTrials::on(row.entry, &row.epsilons::<F>(), kind, source, seed, indices)
    }
}

/// True if a new ray starts on the side to which it leaves: its line meets the plane at a t before t_min.
fn starts_right(truth: &Truth) -> bool {
    truth
        .crossing()
        .is_some_and(|crossing| crossing.place == Place::Before)
}

/// The places around a hit point, by which heights of starts are measured.
struct Surroundings {
    plane: Plane,
    neighbour: Neighbour,
    /// +1 if the new ray leaves to the front, else -1.
    side: f64,
    /// The longest edge, and the same in ulps of the triangle's largest coordinate.
    edge: f64,
    edge_in_ulps: f64,
    /// The height of the hit point, on the side to which the ray leaves.
    height: f64,
    /// By how much the smallest safe offset along the normal lifts the start, if one is known and needed.
    least_way: Option<f64>,
}

impl Surroundings {
    fn of<F: Float>(trial: &OffsetTrial<F>, fold: f64, least: Option<&Least<F>>) -> Surroundings {
        let hit = &trial.hit;
        let plane = Plane::new(trial.object, trial.instance);
        let side = if trial.is_front { 1.0 } else { -1.0 };
        let [a, b, c] = hit.vertices.map(|vertex| vertex.map(F::to_f64));
        let length = |p: [f64; 3], q: [f64; 3]| glam::DVec3::from(p).distance(glam::DVec3::from(q));
        let edge = length(a, b).max(length(b, c)).max(length(c, a));
        let sizes = hit.vertices.map(|vertex| largest(vertex).to_f64());
        let most = sizes.into_iter().fold(0.0, f64::max);
        let height = side * plane.height(hit.point);
        let needed = least.filter(|least| !least.distance.is_zero());
        let least_way = needed.map(|least| side * plane.height(least.origin) - height);
        Surroundings {
            side,
            neighbour: Neighbour::new(hit.vertices, hit.point, fold),
            edge,
            edge_in_ulps: edge / F::from_f64(most).ulp().to_f64(),
            height,
            least_way,
            plane,
        }
    }

    /// How high a start lies, on the side to which the ray leaves.
    fn height<F: Float>(&self, trial: &OffsetTrial<F>, start: &Start<F>) -> f64 {
        let origin = self.side * self.plane.height(start.origin);
        if start.t_min.is_zero() {
            return origin;
        }
        origin + start.t_min.to_f64() * self.side * self.plane.rise(trial.hit.direction)
    }

    /// Adds the height of a start, and what lies below it.
    fn add<F: Float>(
        &self,
        trial: &OffsetTrial<F>,
        start: &Start<F>,
        is_right: bool,
        wall: f64,
        sums: &mut OfScheme,
    ) {
        let height = self.height(trial, start);
        sums.in_edges.add(height, is_right);
        sums.in_ulps.add(height * self.edge_in_ulps, is_right);
        sums.beyond_wall += u64::from(is_right && wall <= height);
        let point = start.point(trial.hit.direction);
        let is_past = self.neighbour.is_passed(point, height * self.edge);
        sums.past_neighbour += u64::from(is_right && is_past);
        if let Some(least_way) = self.least_way {
            let times = (height - self.height) / least_way;
            sums.over_least.add(times.max(0.0));
        }
    }
}

fn add_chunk<F: Scalar>(
    (plan, source): (&OffsetPlan<'_>, &Source),
    trials: OffsetTrials<F>,
    sums: &mut OffsetSums,
) {
    let OffsetTrials {
        trials,
        missed,
        without_side,
        not_finite,
    } = trials;
    sums.hits += trials.len() as u64;
    sums.missed += missed;
    sums.without_side += without_side;
    sums.not_finite += not_finite;
    for trial in &trials {
        let weights = trial.hit.weights.into_iter().flatten().map(F::to_f64);
        sums.least_weight = weights.fold(sums.least_weight, f64::min);
    }
    let leasts = all_least(plan, &trials, sums);
    let mut surroundings = Vec::new();
    if plan.with_heights {
        for (trial, least) in trials.iter().zip(&leasts) {
            surroundings.push(Surroundings::of(trial, plan.fold, least.as_ref()));
        }
    }
    let Some(kernel) = F::subject(plan.row.entry) else {
        return;
    };
    let (epsilons, tells_self_hits) = (plan.row.epsilons::<F>(), plan.tells_self_hits());
    let mut verdicts = vec![Verdict::miss(None); trials.len()];
    let (mut truths, mut layers) = (Vec::new(), Layers::default());
    let hits: Vec<HitPoint<F>> = trials.iter().map(|trial| trial.hit).collect();
    for (scheme, sums) in plan.schemes.iter().zip(&mut sums.schemes) {
        let Some(offset) = scheme.offset::<F>() else {
            continue;
        };
        let starts = offset.starts(&hits);
        let with_starts = trials.iter().zip(&starts);
        let mut cases: Vec<Case<F>> = with_starts
            .map(|(trial, start)| trial.case(start.origin, start.t_min))
            .collect();
        source.ask(&mut cases, &mut truths, &mut layers);
        kernel.run(&cases, &epsilons, &mut verdicts);
        for (i, (trial, start)) in trials.iter().zip(&starts).enumerate() {
            let is_right = starts_right(&truths[i]);
            let is_finite = start.origin.iter().all(|x| x.is_finite()) && start.t_min.is_finite();
            sums.rays += 1;
            // A hit without a t counts.
            let is_before = verdicts[i].t < start.t_min;
            let is_self_hit = tells_self_hits && verdicts[i].hit && !is_before;
            sums.self_hits += u64::from(is_self_hit);
            sums.failed += u64::from(is_self_hit || !is_right);
            if !is_right {
                sums.wrong += 1;
                sums.not_finite += u64::from(!is_finite);
                sums.first_wrong = sums.first_wrong.into_iter().chain([trial.index]).min();
            }
            if is_finite && plan.with_heights {
                surroundings[i].add(trial, start, is_right, plan.wall, sums);
            }
        }
    }
}

/// The smallest safe offsets of some hit points, which are added to the sums, if a plan looks for them; else none.
fn all_least<F: Float>(
    plan: &OffsetPlan<'_>,
    trials: &[OffsetTrial<F>],
    sums: &mut OffsetSums,
) -> Vec<Option<Least<F>>> {
    if !plan.with_least {
        return vec![None; trials.len()];
    }
    let mut found = Vec::with_capacity(trials.len());
    for trial in trials {
        let is_right = |origin: [F; 3]| starts_right(&trial.truth(origin, F::zero()));
        let least = least(&trial.hit, is_right);
        match &least {
            None => sums.without_least += 1,
            Some(least) if least.distance.is_zero() => {}
            Some(least) => {
                let distance = least.distance.to_f64();
                let ulp = largest(trial.hit.point).ulp().to_f64();
                sums.least.add(distance);
                sums.least_in_ulps.add(distance / ulp);
            }
        }
        found.push(least);
    }
    found
}

/// The smallest offset along the normal whose start is right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Least<F: Float> {
    /// The distance; the float below it is not enough.
    pub distance: F,
    /// The start.
    pub origin: [F; 3],
}

/// The smallest float s at which `point + normal * s`, as `--scheme normal=s` rounds it, is right. Found by
/// bisection over the floats: along the normal the height over the plane never falls, but where rounding
/// gave a coordinate of the normal the wrong sign. None if no finite distance is right.
pub fn least<F: Float>(hit: &HitPoint<F>, is_right: impl Fn([F; 3]) -> bool) -> Option<Least<F>> {
    let at = |distance: F| along(hit.point, hit.normal, distance);
    if is_right(hit.point) {
        return Some(Least {
            distance: F::zero(),
            origin: hit.point,
        });
    }
    let mut wrong = F::zero();
    let mut right = largest(hit.point).ulp();
    while !is_right(at(right)) {
        wrong = right;
        right = right + right;
        if !right.is_finite() {
            return None;
        }
    }
    while let Some(middle) = ordered_midpoint(wrong, right) {
        let origin = at(middle);
        // Most of these steps are too small to move the start, and then it is known.
        let is_known_right = origin == at(right);
        let is_known_wrong = origin == at(wrong);
        if is_known_right || !is_known_wrong && is_right(origin) {
            right = middle;
        } else {
            wrong = middle;
        }
    }
    Some(Least {
        distance: right,
        origin: at(right),
    })
}

//! Where a segment must end that goes to a hit point, so that the surface at its end does not count as an obstacle.
//!
//! A shadow ray runs from a point to a point of a lamp or of another surface. That point is rounded, and so is t: at
//! t_max = 1 the surface itself is met about as often as not. So programs end the ray earlier, by a share of its length or
//! by a length, or they lift its end off the surface. Each hit with t up to t_max counts here, because whatever the exact
//! line does, the surface at the end of a segment does not stand between its ends.

use super::sums::Lengths;
use crate::arith::Float;
use crate::audit::{Row, Source, Trials};
use crate::case::{Case, DirectionLength, Parameters, Scene, SceneInterval};
use crate::engine::{self, Merge, Observer};
use crate::family::{Stratum, wide};
use crate::kernel::{Scalar, Verdict, verdicts_of};
use crate::mesh::SceneMesh;
use glam::DVec3;
use std::ops::Range;
use std::sync::Arc;

/// The segments of one kernel in one scene.
#[derive(Clone, Copy)]
pub struct SegmentPlan<'a> {
    /// The kernel and its epsilons.
    pub row: &'a Row,
    /// Where triangles and segments are.
    pub scene: &'a Scene,
    /// The mesh that the scene is, if it is one.
    pub mesh: Option<&'a Arc<SceneMesh>>,
    /// Where segments end.
    pub ends: &'a [SegmentEnd],
    /// Which random segments.
    pub seed: u64,
    /// How many.
    pub count: u64,
}

/// How much earlier than at its target a segment ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SegmentEnd {
    /// By a share of its length: t_max = 1 - e.
    Share(f64),
    /// By a length: t_max = 1 - e / |d|.
    Length(f64),
    /// At a point so far off the surface, along the normal on the side of the start; t_max = 1.
    Lift(f64),
}

impl SegmentEnd {
    /// A segment that ends so, as the scalar computes it; of one that goes as far as its target.
    fn of<F: Float>(self, case: &Case<F>, normal: DVec3) -> Case<F> {
        match self {
            SegmentEnd::Share(share) => case.on(F::zero(), F::one() - F::from_f64(share)),
            SegmentEnd::Length(length) => {
                let share = F::from_f64(length) / F::from_f64(way(case).length());
                case.on(F::zero(), F::one() - share)
            }
            SegmentEnd::Lift(height) => {
                let [origin, direction, a, b, c] = case.vectors();
                let lift: [F; 3] = (normal * height).to_array().map(F::from_f64);
                let target: [F; 3] = std::array::from_fn(|i| (origin[i] + direction[i]) + lift[i]);
                let lifted = std::array::from_fn(|i| target[i] - origin[i]);
                Case::new(origin, lifted, [a, b, c]).on(F::zero(), F::one())
            }
        }
    }

    /// How much of the way to the target such a segment leaves out; at most all of it.
    fn shorter_by(self, way: DVec3, normal: DVec3) -> f64 {
        let length = way.length();
        match self {
            SegmentEnd::Share(share) => share * length,
            SegmentEnd::Length(shorter) => shorter.min(length),
            // Where the old line reaches that height.
            SegmentEnd::Lift(height) => {
                let sine = way.dot(normal).abs() / length;
                (height / sine).min(length)
            }
        }
    }
}

/// From a segment's start to its target.
fn way<F: Float>(case: &Case<F>) -> DVec3 {
    wide(case.ray.direction.into())
}

/// The unit normal of a segment's triangle, on the side of its start.
fn normal_of<F: Float>(case: &Case<F>) -> DVec3 {
    let [a, b, c] = case.triangle.vertices().map(|corner| wide(corner.into()));
    let normal = (b - a).cross(c - a).normalize_or_zero();
    if 0.0 < normal.dot(way(case)) {
        -normal
    } else {
        normal
    }
}

/// The counts of the segments of a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SegmentSums {
    /// How many segments.
    pub segments: u64,
    /// By end: the segments that hit the surface at their target.
    pub blocked: Vec<u64>,
    /// The largest share of its length by which any must end earlier; 0 if none must.
    pub largest_share: f64,
    /// The largest length by which any must.
    pub largest_length: f64,
    /// The largest height over its surface to which the end of any must be lifted, but for the rounding of that.
    pub largest_lift: f64,
    /// By end: how much shorter than its way to the target a segment is, in the scene's unit of length.
    pub shorter: Vec<Lengths>,
}

impl SegmentSums {
    /// The blocked segments of an end, of all.
    pub fn trials(&self, end: usize) -> Trials {
        Trials::independent(self.blocked[end], self.segments)
    }
}

impl Merge for SegmentSums {
    fn merge(&mut self, other: SegmentSums) {
        self.segments += other.segments;
        self.blocked
            .iter_mut()
            .zip(&other.blocked)
            .for_each(|(sum, more)| *sum += more);
        self.largest_share = self.largest_share.max(other.largest_share);
        self.largest_length = self.largest_length.max(other.largest_length);
        self.largest_lift = self.largest_lift.max(other.largest_lift);
        self.shorter
            .iter_mut()
            .zip(&other.shorter)
            .for_each(|(sum, more)| sum.merge(more));
    }
}

/// Runs a plan; the sums are the same whatever the number of threads.
pub fn run_segments<F: Scalar>(plan: &SegmentPlan<'_>, observer: &dyn Observer) -> SegmentSums {
    let source = plan.source();
    let empty = || SegmentSums {
        blocked: vec![0; plan.ends.len()],
        shorter: vec![Lengths::default(); plan.ends.len()],
        ..SegmentSums::default()
    };
    let add = |sums: &mut SegmentSums, indices: Range<u64>| {
        let cases: Vec<Case<F>> = indices.map(|index| source.make(index).cases()[0]).collect();
        plan.add(&cases, sums);
    };
    engine::sum(0..source.count::<F>(), source.chunk(), observer, empty, add)
}

impl SegmentPlan<'_> {
    fn source(&self) -> Source {
        let scene = Scene {
            direction: DirectionLength::Target,
            interval: SceneInterval::Whole,
            ..self.scene.clone()
        };
        let kernel = Some(self.row.entry.info.name.to_owned());
        let parameters = Parameters {
            scene: Some(scene),
            kernel,
            ..Parameters::default()
        };
        Source::of_stratum(
            Stratum::Segment,
            self.mesh,
            parameters,
            self.seed,
            self.count,
        )
    }

    fn add<F: Scalar>(&self, cases: &[Case<F>], sums: &mut SegmentSums) {
        sums.segments += cases.len() as u64;
        let normals: Vec<DVec3> = cases.iter().map(normal_of).collect();
        for (place, end) in self.ends.iter().enumerate() {
            let of = |(case, normal): (&Case<F>, &DVec3)| end.of(case, *normal);
            let ended: Vec<Case<F>> = cases.iter().zip(&normals).map(of).collect();
            let hits = self
                .verdicts(&ended)
                .into_iter()
                .filter(|verdict| verdict.hit);
            sums.blocked[place] += hits.count() as u64;
            for (case, normal) in cases.iter().zip(&normals) {
                sums.shorter[place].add(end.shorter_by(way(case), *normal));
            }
        }
        if !self.row.entry.info.gives.t {
            return;
        }
        for ((case, normal), verdict) in cases.iter().zip(&normals).zip(self.verdicts(cases)) {
            if verdict.hit {
                let (share, way) = (1.0 - verdict.t.to_f64(), way(case));
                sums.largest_share = sums.largest_share.max(share);
                sums.largest_length = sums.largest_length.max(share * way.length());
                sums.largest_lift = sums.largest_lift.max(share * way.dot(*normal).abs());
            }
        }
    }

    /// The verdicts on segments. A kernel that reports t may leave the comparison with t_max to its caller, as those for
    /// rays and for lines do.
    fn verdicts<F: Scalar>(&self, cases: &[Case<F>]) -> Vec<Verdict<F>> {
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        if let Some(kernel) = F::subject(self.row.entry) {
            verdicts_of(kernel, cases, &self.row.epsilons::<F>(), &mut verdicts);
        }
        if self.row.entry.info.gives.t {
            for (case, verdict) in cases.iter().zip(&mut verdicts) {
                verdict.hit &= verdict.t <= case.ray.t_max;
            }
        }
        verdicts
    }
}

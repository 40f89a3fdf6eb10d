//! First rays, their hit points, and the directions of the rays that leave them.

use super::hit::HitPoint;
use crate::arith::{Float, Vector};
use crate::audit::Source;
use crate::case::{Case, Draw, Instance};
use crate::family::{any_direction, combination};
use crate::kernel::{Entry, Scalar, Verdict};
use crate::oracle::{self, Layers};
use crate::truth::{Facing, Truth};
use std::ops::Range;
use std::slice;

named! {
    pub names
    /// How a hit point is formed; the word of `--point`.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PointKind {
        /// a·(1-u-v) + b·u + c·v.
        Weights = "uv",
        /// o + t·d.
        Ray = "ray",
    }
}

impl PointKind {
    /// True if a kernel's hits have such points.
    pub fn is_given_by(self, entry: &Entry) -> bool {
        match self {
            PointKind::Weights => entry.info.gives.uv,
            PointKind::Ray => entry.info.gives.t,
        }
    }
}

/// A hit point that a new ray leaves.
#[derive(Clone, Debug)]
pub struct OffsetTrial<F: Float> {
    /// The index of the first ray in its family.
    pub index: u64,
    /// The data of the hit that a scheme may know.
    pub hit: HitPoint<F>,
    /// True if the new ray leaves to the side that (b - a) × (c - a) points to.
    pub is_front: bool,
    /// The triangle as the object has it; that of the hit is rounded to the world.
    pub object: [[F; 3]; 3],
    /// Where the triangle is put, if not where it is.
    pub instance: Option<Instance<F>>,
}

impl<F: Float> OffsetTrial<F> {
    /// The new ray from an origin, with the triangle as the object has it.
    pub fn case(&self, origin: [F; 3], t_min: F) -> Case<F> {
        Case::new(origin, self.hit.direction, self.object).on(t_min, F::infinity())
    }

    /// The truth of that ray, which is of the world.
    pub fn truth(&self, origin: [F; 3], t_min: F) -> Truth {
        truth_in(&self.case(origin, t_min), self.instance.as_ref())
    }
}

/// The hit points of one kind on some first rays, and the first rays without one.
#[derive(Clone, Debug)]
pub struct OffsetTrials<F: Float> {
    /// The hit points.
    pub trials: Vec<OffsetTrial<F>>,
    /// First rays on which the kernel reported no hit.
    pub missed: u64,
    /// Hits whose triangle has no area, or whose plane the first ray does not cross: no side is right.
    pub without_side: u64,
    /// Hits whose point is not finite.
    pub not_finite: u64,
}

impl<F: Scalar> OffsetTrials<F> {
    /// The trials of a kernel at some epsilons on the first rays of a source.
    pub fn on(
        entry: &Entry,
        epsilons: &[F],
        kind: PointKind,
        source: &Source,
        seed: u64,
        indices: Range<u64>,
    ) -> OffsetTrials<F> {
        let made = indices.map(|index| (index, source.make::<F>(index).cases()[0]));
        let made: Vec<_> = made.collect();
        OffsetTrials::of((entry, epsilons), kind, seed, &made, source.instance())
    }

    /// The trials of a kernel at some epsilons on given first rays, which are of the world if there is an instance.
    pub fn of(
        (entry, epsilons): (&Entry, &[F]),
        kind: PointKind,
        seed: u64,
        first_rays: &[(u64, Case<F>)],
        instance: Option<Instance<F>>,
    ) -> OffsetTrials<F> {
        let mut all = OffsetTrials {
            trials: Vec::new(),
            missed: 0,
            without_side: 0,
            not_finite: 0,
        };
        let Some(kernel) = F::subject(entry) else {
            return all;
        };
        let cases: Vec<Case<F>> = first_rays
            .iter()
            .map(|(_, case)| instance.map_or(*case, |it| it.in_object(case)))
            .collect();
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        kernel.run(&cases, epsilons, &mut verdicts);
        for (((index, in_world), case), verdict) in first_rays.iter().zip(&cases).zip(verdicts) {
            if !verdict.hit {
                all.missed += 1;
                continue;
            }
            let draw = &mut Draw::new("spawn", seed, *index);
            let Some((direction, is_front)) = leaving(in_world, instance.as_ref(), draw) else {
                all.without_side += 1;
                continue;
            };
            let object = [case.triangle.a, case.triangle.b, case.triangle.c].map(Into::into);
            let hit = hit_point((entry, kind), case, instance, &verdict, direction, is_front);
            if hit.point.iter().all(|x| x.is_finite()) {
                all.trials.push(OffsetTrial {
                    index: *index,
                    hit,
                    is_front,
                    object,
                    instance,
                });
            } else {
                all.not_finite += 1;
            }
        }
        all
    }
}

/// The truth of a ray, which is of the world if there is an instance.
fn truth_in<F: Float>(case: &Case<F>, instance: Option<&Instance<F>>) -> Truth {
    let Some(instance) = instance else {
        return oracle::truth(case);
    };
    let (mut truths, layers) = (Vec::new(), &mut Layers::default());
    oracle::truths_of_instance(slice::from_ref(case), instance, &mut truths, layers);
    truths[0]
}

/// A direction over the half-space from which a ray came, uniform, and whether that is the triangle's
/// front. None if the ray does not cross the triangle's plane.
fn leaving<F: Float>(
    case: &Case<F>,
    instance: Option<&Instance<F>>,
    draw: &mut Draw,
) -> Option<([F; 3], bool)> {
    let facing = |truth: Truth| truth.crossing().map(|crossing| crossing.facing);
    let came_from = facing(truth_in(case, instance))?;
    let [origin, _, a, b, c] = case.vectors();
    // Directions exactly in the plane are drawn again.
    for _ in 0..64 {
        let direction = any_direction(draw).to_array().map(F::from_f64);
        let leaving = facing(truth_in(&Case::new(origin, direction, [a, b, c]), instance));
        let turned = match leaving {
            // It leaves as the first ray arrived.
            Some(facing) if facing == came_from => direction.map(|x| -x),
            Some(_) => direction,
            None => continue,
        };
        return Some((turned, came_from == Facing::Front));
    }
    None
}

/// The hit as a scheme knows it; of an instance in the world, each number rounded.
fn hit_point<F: Float>(
    (entry, kind): (&Entry, PointKind),
    case: &Case<F>,
    instance: Option<Instance<F>>,
    verdict: &Verdict<F>,
    direction: [F; 3],
    is_front: bool,
) -> HitPoint<F> {
    let [.., a, b, c] = case.vectors();
    let vertices = [a, b, c];
    let gives = entry.info.gives;
    let weights = gives
        .uv
        .then(|| [F::one() - verdict.u - verdict.v, verdict.u, verdict.v]);
    let point = match (kind, weights) {
        (PointKind::Weights, Some(weights)) => combination(vertices, weights),
        _ => case
            .ray
            .origin
            .plus(&case.ray.direction.times(&verdict.t))
            .into(),
    };
    let triangle = case.triangle;
    let normal = triangle
        .b
        .minus(&triangle.a)
        .cross(&triangle.c.minus(&triangle.a));
    let in_world = |point| instance.map_or(point, |instance| instance.point_in_world(point));
    let turned = |it: Instance<F>| it.normal_in_world(normal.into()).into();
    let normal: [F; 3] = instance.map_or(normal, turned).normalize().into();
    HitPoint {
        point: in_world(point),
        normal: if is_front { normal } else { normal.map(|x| -x) },
        vertices: vertices.map(in_world),
        weights,
        t: verdict.t,
        direction,
    }
}

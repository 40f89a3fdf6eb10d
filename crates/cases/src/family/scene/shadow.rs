//! Rays from a kernel's own hit points, and segments that end at them.

use super::super::control::combination;
use super::super::ring::corners;
use super::super::{CaseGroup, Corners, toward, unit};
use super::Setup;
use super::aimed::{aim, interior_case};
use super::draw::{between, direction, point_of, rounded, wide};
use crate::arith::Vector;
use crate::case::{Case, DirectionLength, Draw};
use crate::kernel::{Entry, Gives, Scalar, Verdict, find, verdicts_of};
use std::slice;

/// The kernel at whose hit points shadow rays start, unless the parameters name another.
const DEFAULT_SHADOW_KERNEL: &str = "moller-trumbore";

pub fn shadow<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let HitPoint { point, triangle } = hit(setup, draw);
    let unit_way = aim(draw, setup.scene, triangle);
    let distance = between(draw, setup.scene.distance);
    let way = unit_way * distance;
    let direction = direction(setup.scene, way, unit_way);
    CaseGroup::One(Case::new(point, direction, triangle))
}

/// A segment from a rounded point to a hit point, as programs ask what stands between the two: a unit vector and the rounded distance,
/// or their difference and t_max = 1.
pub fn segment<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> CaseGroup<F> {
    let HitPoint { point, triangle } = hit(setup, draw);
    let unit_way = aim(draw, setup.scene, triangle);
    let drawn_length = between(draw, setup.scene.distance);
    // A segment without length has no direction.
    let length = drawn_length.max(setup.scene.edge[0]);
    let start = rounded::<F>(wide(point) - unit_way * length);
    let way = toward(start, point);
    let (direction, t_max) = match setup.scene.direction {
        DirectionLength::Target => (way, F::one()),
        DirectionLength::Unit | DirectionLength::Mixed => {
            let rounded_length = wide(way).length();
            (unit(way), F::from_f64(rounded_length))
        }
    };
    let case = Case::new(start, direction, triangle);
    CaseGroup::One(case.on(F::zero(), t_max))
}

/// A point on a triangle from which rays start.
struct HitPoint<F> {
    point: [F; 3],
    triangle: Corners<F>,
}

/// How many rays are tried for a hit.
const TRIES: usize = 64;

/// A hit of the kernel at whose hit points rays start; a triangle's middle if the kernel reports no point.
fn hit<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> HitPoint<F> {
    let name = setup.kernel.unwrap_or(DEFAULT_SHADOW_KERNEL);
    let kernel = find(name);
    for _ in 0..TRIES {
        let case = interior_case(setup, draw);
        let Some(kernel) = kernel else { break };
        if let Some(point) = hit_point(draw, &case, kernel) {
            return HitPoint {
                point,
                triangle: corners(&case),
            };
        }
    }
    let (triangle, _) = setup.triangles.triangle(draw);
    let middle = point_of(triangle, [1.0 / 3.0; 2]);
    HitPoint {
        point: rounded(middle),
        triangle,
    }
}

/// The point at which a kernel with every epsilon at zero hits, in one of the two ways in which renderers
/// form it.
pub fn hit_point<F: Scalar>(draw: &mut Draw, case: &Case<F>, kernel: &Entry) -> Option<[F; 3]> {
    let verdict = verdict_at_zero(case, kernel)?;
    if !verdict.hit {
        return None;
    }
    let Gives { t, uv, .. } = kernel.info.gives;
    let on_ray = t.then(|| point_on_ray(case, verdict.t));
    let by_weights = uv.then(|| point_by_weights(case, verdict.u, verdict.v));
    let point = if draw.coin() {
        by_weights.or(on_ray)
    } else {
        on_ray.or(by_weights)
    }?;
    let is_finite = point.iter().all(F::is_finite);
    is_finite.then_some(point)
}

/// The verdict of a kernel with every epsilon at zero; none if it does not compute in this scalar.
fn verdict_at_zero<F: Scalar>(case: &Case<F>, kernel: &Entry) -> Option<Verdict<F>> {
    let subject = F::subject(kernel)?;
    let zeros = vec![F::zero(); kernel.info.gates.len()];
    let mut verdicts = [Verdict::miss(None)];
    verdicts_of(subject, slice::from_ref(case), &zeros, &mut verdicts);
    let [verdict] = verdicts;
    Some(verdict)
}

fn point_on_ray<F: Scalar>(case: &Case<F>, t: F) -> [F; 3] {
    let ray = &case.ray;
    ray.origin.plus(&ray.direction.times(&t)).into()
}

fn point_by_weights<F: Scalar>(case: &Case<F>, u: F, v: F) -> [F; 3] {
    let weights = [F::one() - u - v, u, v];
    combination(corners(case), weights)
}

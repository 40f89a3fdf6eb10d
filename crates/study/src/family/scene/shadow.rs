//! Rays from a kernel's own hit points.

use super::super::{Made, control::combination};
use super::Setup;
use super::aimed::{aim, interior_case};
use super::draw::{between, direction, point_of, rounded};
use crate::arith::Vector;
use crate::case::{Case, Draw};
use crate::kernel::{Entry, Gives, Scalar, Verdict, find, verdicts_of};
use std::slice;

/// The kernel at whose hit points shadow rays start, unless the parameters name another.
const DEFAULT_SHADOW_KERNEL: &str = "moller-trumbore";

pub fn shadow<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let name = setup.kernel.unwrap_or(DEFAULT_SHADOW_KERNEL);
    let (point, triangle) = hit(setup, draw, find(name));
    let toward = aim(draw, setup.scene, triangle);
    let way = toward * between(draw, setup.scene.distance);
    Made::One(Case::new(point, direction(setup.scene, way, toward), triangle))
}

/// A hit of a kernel: its point, and the triangle. A triangle's middle if the kernel reports no point.
fn hit<F: Scalar>(
    setup: &Setup<'_, F>,
    draw: &mut Draw,
    kernel: Option<&Entry>,
) -> ([F; 3], [[F; 3]; 3]) {
    for _ in 0..64 {
        let case = interior_case(setup, draw);
        let Some(kernel) = kernel else { break };
        if let Some(point) = hit_point(draw, &case, kernel) {
            return (point, case.triangle.vertices().map(Into::into));
        }
    }
    let (triangle, _) = setup.triangles.triangle(draw);
    (rounded(point_of(triangle, [1.0 / 3.0; 2])), triangle)
}

/// The point at which a kernel with every epsilon at zero hits, in one of the two ways in which renderers
/// form it.
pub fn hit_point<F: Scalar>(draw: &mut Draw, case: &Case<F>, kernel: &Entry) -> Option<[F; 3]> {
    let mut verdict = [Verdict::miss(None)];
    let zeros = vec![F::zero(); kernel.info.gates.len()];
    verdicts_of(F::subject(kernel)?, slice::from_ref(case), &zeros, &mut verdict);
    let Verdict { hit: true, t, u, v, .. } = verdict[0] else { return None };
    let triangle = case.triangle.vertices().map(Into::into);
    let on_ray = |t: F| case.ray.origin.plus(&case.ray.direction.times(&t)).into();
    let by_weights = |(u, v): (F, F)| combination(triangle, [F::one() - u - v, u, v]);
    let Gives { t: gives_t, uv: gives_uv, .. } = kernel.info.gives;
    let points: [Option<[F; 3]>; 2] =
        [gives_t.then(|| on_ray(t)), gives_uv.then(|| by_weights((u, v)))];
    let first = usize::from(draw.coin());
    points[first].or(points[1 - first]).filter(|point| point.iter().all(F::is_finite))
}

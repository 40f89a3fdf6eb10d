//! Rays from a kernel's own hit points, and segments that end at them.

use super::super::{Made, control::combination, unit};
use super::Setup;
use super::aimed::{aim, interior_case};
use super::draw::{between, direction, point_of, rounded, wide};
use crate::arith::Vector;
use crate::case::{Case, DirectionLength, Draw};
use crate::kernel::{Entry, Gives, Scalar, Verdict, find, verdicts_of};
use std::slice;

/// The kernel at whose hit points shadow rays start, unless the parameters name another.
const DEFAULT_SHADOW_KERNEL: &str = "moller-trumbore";

pub fn shadow<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let (point, triangle) = hit(setup, draw);
    let toward = aim(draw, setup.scene, triangle);
    let way = toward * between(draw, setup.scene.distance);
    Made::One(Case::new(
        point,
        direction(setup.scene, way, toward),
        triangle,
    ))
}

/// From a rounded point to a hit point, as programs ask what stands between the two: a unit vector and the rounded distance,
/// or their difference and t_max = 1.
pub fn segment<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let (target, triangle) = hit(setup, draw);
    let toward = aim(draw, setup.scene, triangle);
    // A segment has a length: of none there is nothing to ask.
    let length = between(draw, setup.scene.distance).max(setup.scene.edge[0]);
    let start: [F; 3] = rounded(wide(target) - toward * length);
    let way: [F; 3] = std::array::from_fn(|i| target[i] - start[i]);
    let length = wide(way).length();
    let case = match setup.scene.direction {
        DirectionLength::Target => Case::new(start, way, triangle).on(F::zero(), F::one()),
        DirectionLength::Unit | DirectionLength::Mixed => {
            Case::new(start, unit(way), triangle).on(F::zero(), F::from_f64(length))
        }
    };
    Made::One(case)
}

/// A hit of the kernel at whose hit points rays start: its point, and the triangle. A triangle's middle if the kernel
/// reports no point.
fn hit<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> ([F; 3], [[F; 3]; 3]) {
    let kernel = find(setup.kernel.unwrap_or(DEFAULT_SHADOW_KERNEL));
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
    verdicts_of(
        F::subject(kernel)?,
        slice::from_ref(case),
        &zeros,
        &mut verdict,
    );
    let Verdict {
        hit: true, t, u, v, ..
    } = verdict[0]
    else {
        return None;
    };
    let triangle = case.triangle.vertices().map(Into::into);
    let on_ray = |t: F| case.ray.origin.plus(&case.ray.direction.times(&t)).into();
    let by_weights = |(u, v): (F, F)| combination(triangle, [F::one() - u - v, u, v]);
    let Gives {
        t: gives_t,
        uv: gives_uv,
        ..
    } = kernel.info.gives;
    let points: [Option<[F; 3]>; 2] = [
        gives_t.then(|| on_ray(t)),
        gives_uv.then(|| by_weights((u, v))),
    ];
    let first = usize::from(draw.coin());
    points[first]
        .or(points[1 - first])
        .filter(|point| point.iter().all(F::is_finite))
}

//! Rays from a kernel's own hit points.

use super::super::{Made, control::combination};
use super::Setup;
use super::aimed::interior_case;
use super::draw::{any_direction, between, direction, point_of, rounded};
use crate::arith::Vector;
use crate::case::{Case, Draw};
use crate::kernel::{Gated, Scalar, find};

/// The kernel at whose hit points shadow rays start, unless the parameters name another.
const DEFAULT_SHADOW_KERNEL: &str = "moller-trumbore";

pub fn shadow<F: Scalar>(setup: &Setup<'_, F>, draw: &mut Draw) -> Made<F> {
    let name = setup.kernel.unwrap_or(DEFAULT_SHADOW_KERNEL);
    let gated = find(name).and_then(F::subject).and_then(|subject| subject.gated());
    let (point, triangle) = hit(setup, draw, gated);
    let toward = any_direction(draw);
    let way = toward * between(draw, setup.scene.distance);
    Made::One(Case::new(point, direction(setup.scene, way, toward), triangle))
}

/// A hit of a kernel: its point, and the triangle. A triangle's middle if the kernel reports no point.
fn hit<F: Scalar>(
    setup: &Setup<'_, F>,
    draw: &mut Draw,
    gated: Option<&dyn Gated<F>>,
) -> ([F; 3], [[F; 3]; 3]) {
    for _ in 0..64 {
        let case = interior_case(setup, draw);
        let Some(kernel) = gated else { break };
        if let Some(point) = hit_point(draw, &case, kernel) {
            return (point, case.triangle.vertices().map(Into::into));
        }
    }
    let (triangle, _) = setup.triangles.triangle(draw);
    (rounded(point_of(triangle, [1.0 / 3.0; 2])), triangle)
}

/// The point at which a kernel with every epsilon at zero hits, in one of the two ways in which renderers
/// form it.
pub fn hit_point<F: Scalar>(
    draw: &mut Draw,
    case: &Case<F>,
    kernel: &dyn Gated<F>,
) -> Option<[F; 3]> {
    let measured = kernel.measure(case);
    let values = measured.values?;
    if !measured.margins.iter().all(|margin| F::zero() <= *margin) {
        return None;
    }
    let triangle = case.triangle.vertices().map(Into::into);
    let on_ray = |t: F| case.ray.origin.plus(&case.ray.direction.times(&t)).into();
    let by_weights = |(u, v): (F, F)| combination(triangle, [F::one() - u - v, u, v]);
    let points: [Option<[F; 3]>; 2] = [values.t.map(on_ray), values.uv.map(by_weights)];
    let first = usize::from(draw.coin());
    points[first].or(points[1 - first]).filter(|point| point.iter().all(F::is_finite))
}

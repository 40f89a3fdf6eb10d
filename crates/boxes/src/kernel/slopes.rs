//! `eisemann-slopes`: the line against the box's outline, without any t.
//!
//! Source: M. Eisemann, M. Magnor, T. Grosch and S. Müller, "Fast Ray/Axis-Aligned Bounding Box Overlap Tests using Ray
//! Slopes", Journal of Graphics Tools 12(4), 2007. A ray's class is the signs of its direction. Its origin must not be
//! beyond the far planes, and where it leaves a slab it must have entered each other one. Its slopes are products with a
//! reciprocal, as the source computes them for each ray.

use super::*;

pub struct EisemannSlopes;

const EDGE: usize = 0;
const END: usize = 1;
const PARALLEL: usize = 2;

impl Kernel<Boxes> for EisemannSlopes {
    const INFO: KernelInfo = info(
        "eisemann-slopes",
        "M. Eisemann, M. Magnor, T. Grosch and S. Müller, Fast Ray/Axis-Aligned Bounding Box Overlap Tests using Ray \
         Slopes, Journal of Graphics Tools 12(4), 2007",
        contract(Extent::Ray, Boundary::Closed),
        &[
            Gate::signed(Role::Edge, "slope*far - near + c < e", 1, 0),
            Gate::fixed(Role::T, "o beyond far"),
            Gate::fixed(Role::Parallel, "d == 0 && (o < min || o > max)"),
        ],
        PLAIN[2],
    );

    stores_box!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        bounds: &Bounds<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let is_parallel = |i: usize| ray.direction.at(i).is_zero();
        for i in 0..3 {
            let origin = ray.origin.at(i);
            let is_below = origin.is_less(&bounds.min.at(i));
            let is_above = bounds.max.at(i).is_less(&origin);
            if is_parallel(i) {
                sink.fixed(PARALLEL, !is_below && !is_above)?;
            } else if is_forward(ray, i) {
                sink.fixed(END, !is_above)?;
            } else {
                sink.fixed(END, !is_below)?;
            }
        }
        for leaves in 0..3 {
            for enters in 0..3 {
                if leaves == enters || is_parallel(leaves) || is_parallel(enters) {
                    continue;
                }
                let depth = depth(bounds, ray, leaves, enters);
                sink.one(EDGE, Refuse::Below, &depth)?;
            }
        }
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    }
}

/// How far the line is beyond the near plane of the slab `enters` where it leaves the slab `leaves`.
#[inline(always)]
fn depth<V: Vector>(bounds: &Bounds<V>, ray: &Ray<V>, leaves: usize, enters: usize) -> V::Real {
    let inverse = V::Real::one() / ray.direction.at(leaves);
    let slope = ray.direction.at(enters) * &inverse;
    // The gate's c.
    let offset = ray.origin.at(enters) - slope.clone() * ray.origin.at(leaves);
    let far = if is_forward(ray, leaves) {
        bounds.max.at(leaves)
    } else {
        bounds.min.at(leaves)
    };
    if is_forward(ray, enters) {
        return slope * far - bounds.min.at(enters) + offset;
    }
    -(slope * far - bounds.max.at(enters) + offset)
}

/// True if the ray goes up along an axis, so that it meets the plane at min first.
#[inline(always)]
fn is_forward<V: Vector>(ray: &Ray<V>, i: usize) -> bool {
    V::Real::zero().is_less(&ray.direction.at(i))
}

//! `plucker`: edge tests on Plücker coordinates, shifted so that the ray starts at the origin.
//!
//! Source: the modified Plücker intersector of Intel Embree (Apache License 2.0,
//! <https://github.com/RenderKit/embree>, kernels/geometry/triangle_intersector_pluecker.h), version 2.x.
//! Version 3.x adds an epsilon of one ulp times |U+V+W|. Davidovič et al., "3D Rasterization" (2011),
//! describe it; Kensler and Shirley (2006) describe the edge tests. There is no backface culling. t is
//! compared before the division, with the ends of the interval times |den|. The source multiplies an end
//! of 0 too: if |den| overflows, 0·inf is NaN, and the ray misses. Its SIMD min and max are written as
//! comparisons here: a NaN rejects. Its "stable normal" chooses per axis between two cross products of
//! edges; here the normal is cross(e1, e0), the line that it replaced.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
use super::{end_times, facing_of, gap};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Across, Boundary, Contract, Extent, Sides};

pub(super) struct Plucker;

const EDGE: usize = 0;
const T: usize = 1;
const PARALLEL: usize = 2;

impl Kernel for Plucker {
    const INFO: KernelInfo = KernelInfo {
        name: "plucker",
        source: "Intel Embree 2.x, modified Plücker intersector (for 3.x set edge=-EPSILON), \
                 https://github.com/RenderKit/embree, triangle_intersector_pluecker.h",
        contract: Contract::of_kernel(Extent::Interval, Sides::Both, Boundary::Free)
            .with_across(Across::AtLeastOne),
        gates: &[
            Gate::signed(
                Role::Edge,
                "!(min(U,V,W) >= e*|U+V+W| or max(U,V,W) <= -e*|U+V+W|)",
                0,
                0,
            ),
            Gate::signed(
                Role::T,
                "!(sT - t_min*|den| >= e), !(t_max*|den| - sT >= e), s = sign of den",
                3,
                0,
            ),
            Gate::signed(Role::Parallel, "abs(den) <= e, den = 2*N·d", 2, 1),
        ],
        epsilon_sets: &[EpsilonSet {
            name: "source",
            values: &["0", "0", "0"],
        }],
        gives: Gives {
            t: true,
            uv: true,
            facing: true,
        },
        polygons: false,
    };

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let direction = &ray.direction;
        let [v0, v1, v2] =
            [&triangle.a, &triangle.b, &triangle.c].map(|vertex| vertex.minus(&ray.origin));
        let (e0, e1, e2) = (v2.minus(&v0), v0.minus(&v1), v1.minus(&v2));
        // Around edges ca, ab and bc: the weights of b, c and a.
        let u = v2.plus(&v0).cross(&e0).dot(direction);
        let v = v0.plus(&v1).cross(&e1).dot(direction);
        let w = v1.plus(&v2).cross(&e2).dot(direction);
        let sum = (u.clone() + &v + &w).abs();
        let all_at_least = |bound: &V::Real| [&u, &v, &w].into_iter().all(|x| bound.is_at_most(x));
        let all_at_most = |bound: &V::Real| [&u, &v, &w].into_iter().all(|x| x.is_at_most(bound));
        let accepts = |epsilon: &V::Real| {
            let bound = end_times(epsilon, &sum);
            all_at_least(&bound) || all_at_most(&-bound)
        };
        sink.rounded(EDGE, accepts, || relative_margin(&[&u, &v, &w], &sum))?;
        let normal = e1.cross(&e0);
        let twice_normal = normal.plus(&normal);
        let den = twice_normal.dot(direction);
        let t = v0.dot(&twice_normal);
        let signed_t = if den.is_sign_negative() {
            -t.clone()
        } else {
            t.clone()
        };
        let abs_den = den.abs();
        // Multiplied whatever the ends are: `absDen*vfloat<M>(ray.tnear)`.
        let near = ray.t_min.clone() * &abs_den;
        let far = ray.t_max.clone() * &abs_den;
        sink.one(T, Refuse::UnlessAtLeast, &gap(&signed_t, &near))?;
        sink.one(T, Refuse::UnlessAtLeast, &gap(&far, &signed_t))?;
        sink.one(PARALLEL, Refuse::AtMost, &abs_den)?;
        let rcp_den = V::Real::one() / &den;
        Some(Hit {
            t: Some(t * &rcp_den),
            uv: Some((u * &rcp_den, v * &rcp_den)),
            facing: facing_of(&den),
        })
    }
}

/// The exact threshold of the edge test: the better of min(U,V,W) and min(-U,-V,-W), over |U+V+W|.
fn relative_margin<R: Real>(weights: &[&R; 3], sum: &R) -> R {
    if weights.iter().any(|x| x.is_nan()) {
        return -R::infinity();
    }
    let smallest = |[u, v, w]: [R; 3]| u.smaller(v).smaller(w);
    let front = smallest(weights.map(R::clone));
    let best = front.larger(smallest(weights.map(|x| -x.clone())));
    match (sum.is_zero(), best.is_sign_negative()) {
        (false, _) => best / sum,
        (true, false) => R::infinity(),
        (true, true) => -R::infinity(),
    }
}

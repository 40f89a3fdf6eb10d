//! `woop-watertight`: shear the ray onto an axis, then three 2D edge functions.
//!
//! Source: S. Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle Intersection", Journal of
//! Computer Graphics Techniques 2(1), 2013, <https://jcgt.org/published/0002/01/05/>, appendix A,
//! without backface culling. The appendix tests t in [0, hit.t] before it divides. Here the 0 is t_min;
//! at t_min = 0 the comparison is the same. The fallback computes in wider arithmetic: f32 in f64 as
//! in the appendix, and f64 by exact products, which is an addition of this project. The appendix does
//! not report which side was hit.
//!
//! The shear divides by d, so U, V and W have the dimension length², not length²·|d|.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink, end_times, gap};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Across, Boundary, Contract, Extent, Sides};

pub(super) struct WoopWatertight;

const EDGE: usize = 0;
const PARALLEL: usize = 1;
const T: usize = 2;

impl Kernel for WoopWatertight {
    const INFO: KernelInfo = KernelInfo {
        name: "woop-watertight",
        source: "S. Woop, C. Benthin and I. Wald, Watertight Ray/Triangle Intersection, 2013, \
                 appendix A, https://jcgt.org/published/0002/01/05/",
        contract: Contract::of_kernel(Extent::Interval, Sides::Both, Boundary::Free)
            .with_across(Across::AtLeastOne),
        gates: &[
            Gate::signed(
                Role::Edge,
                "one of U, V, W < e and one of -U, -V, -W < e, after the shear",
                2,
                0,
            ),
            Gate::signed(Role::Parallel, "abs(det) <= e, det = U+V+W", 2, 0),
            Gate::signed(
                Role::T,
                "sT - t_min*|det| < e, t_max*|det| - sT < e, s = sign of det",
                3,
                -1,
            ),
        ],
        epsilon_sets: &[EpsilonSet {
            name: "source",
            values: &["0", "0", "0"],
        }],
        gives: Gives {
            t: true,
            uv: true,
            facing: false,
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
        let zero = V::Real::zero();
        let direction = &ray.direction;
        let kz = direction.largest_axis();
        let (mut kx, mut ky) = ((kz + 1) % 3, (kz + 2) % 3);
        if direction.at(kz).is_less(&zero) {
            // Keeps the winding of the triangles.
            (kx, ky) = (ky, kx);
        }
        let sx = direction.at(kx) / direction.at(kz);
        let sy = direction.at(ky) / direction.at(kz);
        let sz = V::Real::one() / direction.at(kz);

        let [a, b, c] =
            [&triangle.a, &triangle.b, &triangle.c].map(|vertex| vertex.minus(&ray.origin));
        let sheared = |v: &V| {
            (
                v.at(kx) - sx.clone() * v.at(kz),
                v.at(ky) - sy.clone() * v.at(kz),
            )
        };
        let [(ax, ay), (bx, by), (cx, cy)] = [sheared(&a), sheared(&b), sheared(&c)];

        let mut u = cx.clone() * &by - cy.clone() * &bx;
        let mut v = ax.clone() * &cy - ay.clone() * &cx;
        let mut w = bx.clone() * &ay - by.clone() * &ax;
        if u.is_zero() || v.is_zero() || w.is_zero() {
            u = V::Real::difference_of_products(&cx, &by, &cy, &bx);
            v = V::Real::difference_of_products(&ax, &cy, &ay, &cx);
            w = V::Real::difference_of_products(&bx, &ay, &by, &ax);
        }
        let [minus_u, minus_v, minus_w] = [-u.clone(), -v.clone(), -w.clone()];
        let one_sign = [[&u, &v, &w], [&minus_u, &minus_v, &minus_w]];
        sink.gate(EDGE, Refuse::Below, one_sign)?;
        let det = u.clone() + &v + &w;
        sink.one(PARALLEL, Refuse::AtMost, &det.abs())?;
        let t = u.clone() * (sz.clone() * a.at(kz))
            + v.clone() * (sz.clone() * b.at(kz))
            + w.clone() * (sz * c.at(kz));
        let (signed_t, abs_det) = if det.is_sign_negative() {
            (-t.clone(), -det.clone())
        } else {
            (t.clone(), det.clone())
        };
        // The appendix compares with 0 where t_min stands here, and multiplies hit.t. So an end of 0 is not
        // multiplied, and the comparison stays the appendix's.
        let (near, far) = (
            end_times(&ray.t_min, &abs_det),
            ray.t_max.clone() * &abs_det,
        );
        sink.one(T, Refuse::Below, &gap(&signed_t, &near))?;
        sink.one(T, Refuse::Below, &gap(&far, &signed_t))?;
        let rcp_det = V::Real::one() / &det;
        Some(Hit {
            t: Some(t * &rcp_det),
            uv: Some((v * &rcp_det, w * &rcp_det)),
            facing: None,
        })
    }
}

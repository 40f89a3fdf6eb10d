//! `havel-herout`: three precomputed planes, and tests on sign bits.
//!
//! Source: J. Havel and A. Herout, "Yet Faster Ray-Triangle Intersection (Using SSE4)", IEEE
//! Transactions on Visualization and Computer Graphics 16(3), 2010, doi:10.1109/TVCG.2009.73: the
//! precomputation of section 2 and the SSE4 listing, in scalar form, with the summation order of `dpps`,
//! ((x + y) + (z + w)). The listing compares sign *bits*, so -0 and +0 differ, and the outcome on an edge
//! depends on the side. The listing tests t in [0, hit.t]; here the 0 is t_min. An infinite t_max times
//! det = 0 counts as zero, as it would be with any finite hit.t. The listing's approximate reciprocal is
//! a division here.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Role, Sink, end_times, facing_of};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Extent, Sides};

pub(super) struct HavelHerout;

const T: usize = 0;
const U: usize = 1;
/// V is the vector.
const V_: usize = 2;

/// The triangle's plane, n·p = d, and those that give the weights: u = n1·p + d1, v = n2·p + d2.
pub(super) struct Planes<V: Vector> {
    n: V,
    d: V::Real,
    n1: V,
    d1: V::Real,
    n2: V,
    d2: V::Real,
}

impl Kernel for HavelHerout {
    const INFO: KernelInfo = KernelInfo {
        name: "havel-herout",
        source: "J. Havel and A. Herout, Yet Faster Ray-Triangle Intersection (Using SSE4), 2010, SSE4 \
                 listing, doi:10.1109/TVCG.2009.73",
        contract: Contract::of_kernel(Extent::Interval, Sides::Both, Boundary::Free),
        gates: &[
            Gate::fixed(
                Role::T,
                "sign bits of dett - t_min*det and t_max*det - dett differ",
            ),
            Gate::fixed(Role::Edge, "sign bits of detu and det-detu differ").named("u"),
            Gate::fixed(Role::Edge, "sign bits of detv and det-(detu+detv) differ").named("v"),
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

    type Prepared<V: Vector> = Planes<V>;

    #[inline(always)]
    fn prepare<V: Vector>(Triangle { a, b, c }: &Triangle<V>) -> Planes<V> {
        let [ab, ac] = [b.minus(a), c.minus(a)];
        let n = ab.cross(&ac);
        let scale = V::Real::one() / n.dot(&n);
        let n1 = ac.cross(&n).times(&scale);
        let n2 = n.cross(&ab).times(&scale);
        Planes {
            d: n.dot(a),
            d1: -n1.dot(a),
            d2: -n2.dot(a),
            n,
            n1,
            n2,
        }
    }

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        Planes {
            n,
            d,
            n1,
            d1,
            n2,
            d2,
        }: &Planes<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let zero = V::Real::zero();
        let det = dpps(n, &ray.direction, zero.clone());
        let minus_n = n.times(&-V::Real::one());
        let dett = dpps(&minus_n, &ray.origin, d.clone());
        // Zero for det = 0 even if t_max is infinite.
        let far = if det.is_zero() {
            det.clone()
        } else {
            ray.t_max.clone() * &det
        };
        let same_signs = |x: &V::Real, y: &V::Real| x.is_sign_negative() == y.is_sign_negative();
        let from_near = dett.clone() - end_times(&ray.t_min, &det);
        sink.fixed(T, same_signs(&from_near, &(far - &dett)))?;
        let detp = ray.origin.times(&det).plus_scaled(&ray.direction, &dett);
        let detp_w = det.clone() + dett.clone() * &zero;
        let detu = dpps(&detp, n1, detp_w.clone() * d1);
        sink.fixed(U, same_signs(&detu, &(det.clone() - &detu)))?;
        let detv = dpps(&detp, n2, detp_w * d2);
        let rest = det.clone() - (detu.clone() + &detv);
        sink.fixed(V_, same_signs(&detv, &rest))?;
        let inv_det = V::Real::one() / &det;
        Some(Hit {
            t: Some(dett * &inv_det),
            uv: Some((detu * &inv_det, detv * &inv_det)),
            facing: facing_of(&-det),
        })
    }
}

/// Four products summed as the `dpps` instruction sums them; `w` is the fourth product.
#[inline(always)]
fn dpps<V: Vector>(a: &V, b: &V, w: V::Real) -> V::Real {
    let product = |axis: usize| a.at(axis) * b.at(axis);
    (product(0) + product(1)) + (product(2) + w)
}

//! `plane-unit-normal`: plane by unit normal, then three edge tests.
//!
//! Source: "Triangle Intersection", an unsigned blog post of 22 November 2020, listing
//! `TriangleFace::IntersectLocal`. Its text requires each edge value to be at least 0, so edges are hits.
//! Its code loses them if EDGE_EPSILON is positive. The kernel is judged by the text. The post gives no
//! values for its epsilons, so the default plan runs 0 and 1e-6.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
use crate::arith::Vector;
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Extent, Sides};

pub(super) struct PlaneUnitNormal;

const PARALLEL: usize = 0;
const T: usize = 1;
const EDGE: usize = 2;

impl Kernel for PlaneUnitNormal {
    const INFO: KernelInfo = KernelInfo {
        name: "plane-unit-normal",
        source: "Triangle Intersection, unsigned blog post, 22 November 2020, TriangleFace::IntersectLocal",
        contract: Contract::of_kernel(Extent::Ray, Sides::Both, Boundary::Closed)
            .with_flat(crate::contract::Demand::Miss, crate::contract::Demand::Free),
        gates: &[
            Gate::non_negative(Role::Parallel, "abs(n·d) < e, n of unit length", 0, 1),
            Gate::signed(Role::T, "t < e", 1, -1),
            Gate::signed(
                Role::Edge,
                "((b-a)×(q-a))·n < e, and cyclic, n of unit length",
                2,
                0,
            ),
        ],
        epsilon_sets: &[
            EpsilonSet {
                name: "zero",
                values: &["0", "0", "0"],
            },
            EpsilonSet {
                name: "1e-6",
                values: &["1e-6", "1e-6", "1e-6"],
            },
        ],
        gives: Gives {
            t: true,
            uv: false,
            facing: false,
        },
        polygons: false,
    };

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin: p,
            direction: d,
            ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        use crate::arith::Real;
        let n = b.minus(a).cross(&c.minus(a)).normalize();
        sink.one(PARALLEL, Refuse::Below, &n.dot(d).abs())?;
        let k = n.dot(a);
        let t = (k - n.dot(p)) / n.dot(d);
        sink.one(T, Refuse::Below, &t)?;
        let q = p.clone().plus_scaled(d, &t);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let value = to.minus(from).cross(&q.minus(from)).dot(&n);
            sink.one(EDGE, Refuse::Below, &value)?;
        }
        Some(Hit {
            t: Some(t),
            uv: None,
            facing: None,
        })
    }
}

//! `half-space`: plane, then three half-spaces of the triangle's own normal.
//!
//! Source: S. Marschner, "CS465 Notes: Simple ray-triangle intersection", Cornell University, 2003,
//! <http://www.cs.cornell.edu/courses/cs465/2003fa/homeworks/raytri.pdf>. Its text speaks of rays, but
//! its formulas test neither for a parallel ray nor for the sign of t. It remarks that no point can be
//! inside a triangle with clockwise vertices. That is mistaken: n is made from the same vertices, so it
//! turns with them.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
use crate::arith::Vector;
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Demand, Extent, Sides};

pub(super) struct HalfSpace;

const EDGE: usize = 0;

impl Kernel for HalfSpace {
    const INFO: KernelInfo = KernelInfo {
        name: "half-space",
        source: "S. Marschner, CS465 Notes: Simple ray-triangle intersection, Cornell University, 2003, \
                 http://www.cs.cornell.edu/courses/cs465/2003fa/homeworks/raytri.pdf",
        contract: Contract::of_kernel(Extent::Ray, Sides::Both, Boundary::Closed)
            .with_flat(Demand::Free, Demand::Free),
        gates: &[Gate::signed(
            Role::Edge,
            "!(((b-a)×(x-a))·n >= e), and cyclic, n = (b-a)×(c-a)",
            4,
            0,
        )],
        epsilon_sets: &[EpsilonSet {
            name: "source",
            values: &["0"],
        }],
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
            origin: o,
            direction: d,
            ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let n = b.minus(a).cross(&c.minus(a));
        let t = -(o.minus(a).dot(&n) / d.dot(&n));
        let x = o.clone().plus_scaled(d, &t);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let value = to.minus(from).cross(&x.minus(from)).dot(&n);
            sink.one(EDGE, Refuse::UnlessAtLeast, &value)?;
        }
        Some(Hit {
            t: Some(t),
            uv: None,
            facing: None,
        })
    }
}

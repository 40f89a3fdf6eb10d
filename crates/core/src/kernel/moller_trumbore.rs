//! `moller-trumbore`, `moller-trumbore-t` and `moller-trumbore-culling`.
//!
//! Source: T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of
//! Graphics Tools 2(1), 1997, doi:10.1080/10867651.1997.10487468, appendix: both branches of
//! `TEST_CULL`, EPSILON 0.000001. The paper returns t without a test, so the kernel is judged on the
//! whole line. The encyclopedia's listing, which most programs copy, is the branch without culling with 0.0000001 in the
//! place of 0.000001, and returns a hit only if t is above that number too.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink, facing_of};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Extent, Sides};

pub(super) struct MollerTrumbore;
pub(super) struct MollerTrumboreT;
pub(super) struct MollerTrumboreCulling;

const PARALLEL: usize = 0;
const EDGE: usize = 1;
const T: usize = 2;

const GIVES: Gives = Gives {
    t: true,
    uv: true,
    facing: true,
};
const SETS: &[EpsilonSet] = &[EpsilonSet {
    name: "source",
    values: &["1e-6", "0"],
}];

const DIVIDED: [Gate; 2] = [
    Gate::non_negative(Role::Parallel, "abs(det) < e", 2, 1).printed("det > -e && det < e"),
    Gate::signed(Role::Edge, "u < e, 1-u < e, v < e, 1-(u+v) < e", 0, 0),
];

/// The branch without culling; the third gate, if there is one, compares t.
#[inline(always)]
fn divided<V: Vector, S: Sink<V::Real>>(
    Triangle { a, b, c }: &Triangle<V>,
    Ray {
        origin, direction, ..
    }: &Ray<V>,
    tests_t: bool,
    sink: &mut S,
) -> Option<Hit<V::Real>> {
    let [edge1, edge2] = [b.minus(a), c.minus(a)];
    let pvec = direction.cross(&edge2);
    let det = edge1.dot(&pvec);
    sink.one(PARALLEL, Refuse::Below, &det.abs())?;
    let inv_det = V::Real::one() / &det;
    let tvec = origin.minus(a);
    let u = tvec.dot(&pvec) * &inv_det;
    sink.one(EDGE, Refuse::Below, &u)?;
    sink.one(EDGE, Refuse::Below, &(V::Real::one() - &u))?;
    let qvec = tvec.cross(&edge1);
    let v = direction.dot(&qvec) * &inv_det;
    sink.one(EDGE, Refuse::Below, &v)?;
    sink.one(EDGE, Refuse::Below, &(V::Real::one() - (u.clone() + &v)))?;
    let t = edge2.dot(&qvec) * &inv_det;
    if tests_t {
        sink.one(T, Refuse::UnlessAbove, &t)?;
    }
    Some(Hit {
        t: Some(t),
        uv: Some((u, v)),
        facing: facing_of(&det),
    })
}

impl Kernel for MollerTrumbore {
    const INFO: KernelInfo = KernelInfo {
        name: "moller-trumbore",
        source: "T. Möller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997, appendix, \
                 without culling, doi:10.1080/10867651.1997.10487468",
        contract: Contract::of_kernel(Extent::Line, Sides::Both, Boundary::Closed),
        gates: &DIVIDED,
        epsilon_sets: SETS,
        gives: GIVES,
        polygons: false,
    };

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        divided(triangle, ray, false, sink)
    }
}

impl Kernel for MollerTrumboreT {
    const INFO: KernelInfo = KernelInfo {
        name: "moller-trumbore-t",
        source: "Wikipedia, Möller–Trumbore intersection algorithm, the C++ implementation with \
                 EPSILON = 0.0000001 that was there until 2023, \
                 https://en.wikipedia.org/wiki/Möller–Trumbore_intersection_algorithm",
        // The listing calls t above epsilon a ray intersection, so one at t = 0 is none.
        contract: Contract {
            ends: Boundary::Open,
            ..Contract::of_kernel(Extent::Ray, Sides::Both, Boundary::Closed)
        },
        gates: &[
            DIVIDED[0],
            DIVIDED[1],
            Gate::signed(Role::T, "!(t > e)", 1, -1),
        ],
        epsilon_sets: &[EpsilonSet {
            name: "source",
            values: &["1e-7", "0", "1e-7"],
        }],
        gives: GIVES,
        polygons: false,
    };

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        divided(triangle, ray, true, sink)
    }
}

impl Kernel for MollerTrumboreCulling {
    const INFO: KernelInfo = KernelInfo {
        name: "moller-trumbore-culling",
        source: "T. Möller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997, appendix, \
                 TEST_CULL, doi:10.1080/10867651.1997.10487468",
        contract: Contract::of_kernel(Extent::Line, Sides::Front, Boundary::Closed),
        gates: &[
            Gate::signed(Role::Parallel, "det < e", 2, 1),
            Gate::signed(
                Role::Edge,
                "u < e, det-u < e, v < e, det-(u+v) < e, undivided",
                2,
                1,
            ),
        ],
        epsilon_sets: SETS,
        gives: GIVES,
        polygons: false,
    };

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin, direction, ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [edge1, edge2] = [b.minus(a), c.minus(a)];
        let pvec = direction.cross(&edge2);
        let det = edge1.dot(&pvec);
        sink.one(PARALLEL, Refuse::Below, &det)?;
        let tvec = origin.minus(a);
        let u = tvec.dot(&pvec);
        sink.one(EDGE, Refuse::Below, &u)?;
        sink.one(EDGE, Refuse::Below, &(det.clone() - &u))?;
        let qvec = tvec.cross(&edge1);
        let v = direction.dot(&qvec);
        sink.one(EDGE, Refuse::Below, &v)?;
        sink.one(EDGE, Refuse::Below, &(det.clone() - (u.clone() + &v)))?;
        let t = edge2.dot(&qvec);
        let inv_det = V::Real::one() / &det;
        Some(Hit {
            t: Some(t * &inv_det),
            uv: Some((u * &inv_det, v * &inv_det)),
            facing: facing_of(&det),
        })
    }
}

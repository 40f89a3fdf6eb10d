//! `plane-inside-out`, its precomputed and strict forms, and `convex-polygon`: plane by the
//! unnormalised normal, then an inside-outside test at each edge.
//!
//! Source: Scratchapixel, "Ray-Tracing: Rendering a Triangle", chapter "Ray-Triangle Intersection:
//! Geometric Solution", <https://www.scratchapixel.com/lessons/3d-basic-rendering/ray-tracing-rendering-a-triangle/ray-triangle-intersection-geometric-solution.html>.
//! The four kernels are its full listing, its last note (N and D stored per triangle), its earlier
//! pseudo-code (strict edges; N·R = 0 and t < 0 from its text) and its last section (any convex
//! polygon). It gives no value of kEpsilon, so the default plan runs 0 and 1e-6.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Extent, Sides};

pub(super) struct PlaneInsideOut;
pub(super) struct PlaneInsideOutPrecomputed;
pub(super) struct PlaneInsideOutStrict;
pub(super) struct ConvexPolygon;

const PARALLEL: usize = 0;
const T: usize = 1;
const EDGE: usize = 2;

const GATES: &[Gate] = &[
    Gate::non_negative(Role::Parallel, "abs(N·d) < e, N = (b-a)×(c-a)", 2, 1),
    Gate::signed(Role::T, "t < e", 1, -1),
    Gate::signed(Role::Edge, "N·((b-a)×(p-a)) < e, and cyclic", 4, 0),
];

const SETS: &[EpsilonSet] = &[
    EpsilonSet {
        name: "zero",
        values: &["0", "0", "0"],
    },
    EpsilonSet {
        name: "1e-6",
        values: &["1e-6", "0", "0"],
    },
];

/// The source, and which part of it.
macro_rules! scratchapixel {
    ($part:literal) => {
        concat!(
            "Scratchapixel, Ray-Tracing: Rendering a Triangle, geometric solution, ",
            $part,
            ", https://www.scratchapixel.com/lessons/3d-basic-rendering/ray-tracing-rendering-a-triangle/"
        )
    };
}

const fn info(name: &'static str, source: &'static str) -> KernelInfo {
    KernelInfo {
        name,
        source,
        contract: Contract::of_kernel(Extent::Ray, Sides::Both, Boundary::Closed),
        gates: GATES,
        epsilon_sets: SETS,
        gives: Gives {
            t: true,
            uv: false,
            facing: false,
        },
        polygons: false,
    }
}

/// The plane of the listing: N, and D = -N·v0.
#[inline(always)]
fn plane<V: Vector>(v0: &V, v1: &V, v2: &V) -> (V, V::Real) {
    let n = v1.minus(v0).cross(&v2.minus(v0));
    let d = -n.dot(v0);
    (n, d)
}

/// The listing's refusals of N·R and of an edge.
const BELOW: [Refuse; 2] = [Refuse::Below; 2];

/// The listing from its parallel test on, for any polygon.
#[inline(always)]
fn inside_out<V: Vector, S: Sink<V::Real>>(
    vertices: &[V],
    n: &V,
    d: &V::Real,
    ray: &Ray<V>,
    [parallel, edge]: [Refuse; 2],
    sink: &mut S,
) -> Option<Hit<V::Real>> {
    let n_dot_direction = n.dot(&ray.direction);
    sink.one(PARALLEL, parallel, &n_dot_direction.abs())?;
    let t = -(n.dot(&ray.origin) + d) / &n_dot_direction;
    sink.one(T, Refuse::Below, &t)?;
    let p = ray.origin.clone().plus_scaled(&ray.direction, &t);
    for (i, from) in vertices.iter().enumerate() {
        let to = vertices.get(i + 1).unwrap_or(&vertices[0]);
        let c = to.minus(from).cross(&p.minus(from));
        sink.one(EDGE, edge, &n.dot(&c))?;
    }
    Some(Hit::at(t))
}

impl Kernel for PlaneInsideOut {
    const INFO: KernelInfo = info("plane-inside-out", scratchapixel!("full listing"));

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let (n, d) = plane(&triangle.a, &triangle.b, &triangle.c);
        inside_out(&triangle.clone().vertices(), &n, &d, ray, BELOW, sink)
    }
}

/// The vertices with N and D beside them.
pub(super) struct WithPlane<V: Vector> {
    vertices: [V; 3],
    n: V,
    d: V::Real,
}

impl Kernel for PlaneInsideOutPrecomputed {
    const INFO: KernelInfo = info(
        "plane-inside-out-precomputed",
        scratchapixel!("last note: N and D stored per triangle"),
    );

    type Prepared<V: Vector> = WithPlane<V>;

    #[inline(always)]
    fn prepare<V: Vector>(triangle: &Triangle<V>) -> WithPlane<V> {
        let (n, d) = plane(&triangle.a, &triangle.b, &triangle.c);
        WithPlane {
            vertices: triangle.clone().vertices(),
            n,
            d,
        }
    }

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        WithPlane { vertices, n, d }: &WithPlane<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        inside_out(vertices, n, d, ray, BELOW, sink)
    }
}

impl Kernel for PlaneInsideOutStrict {
    const INFO: KernelInfo = KernelInfo {
        contract: Contract::of_kernel(Extent::Ray, Sides::Both, Boundary::Open),
        gates: &[
            // Signed, since `<=` refuses a zero at an epsilon of 0, and not at a negative one.
            Gate::signed(Role::Parallel, "abs(N·d) <= e, N = (b-a)×(c-a)", 2, 1),
            Gate::signed(Role::T, "t < e", 1, -1),
            Gate::signed(Role::Edge, "!(N·((b-a)×(p-a)) > e), and cyclic", 4, 0),
        ],
        epsilon_sets: &[EpsilonSet {
            name: "source",
            values: &["0", "0", "0"],
        }],
        ..info(
            "plane-inside-out-strict",
            scratchapixel!("pseudo-code with strict edges"),
        )
    };

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let (n, d) = plane(&triangle.a, &triangle.b, &triangle.c);
        let refuses = [Refuse::AtMost, Refuse::UnlessAbove];
        inside_out(&triangle.clone().vertices(), &n, &d, ray, refuses, sink)
    }
}

impl Kernel for ConvexPolygon {
    const INFO: KernelInfo = KernelInfo {
        polygons: true,
        ..info(
            "convex-polygon",
            scratchapixel!("last section: any convex polygon"),
        )
    };

    stores_triangle!();

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        Self::test_polygon(&triangle.clone().vertices(), ray, sink)
    }

    #[inline(always)]
    fn test_polygon<V: Vector, S: Sink<V::Real>>(
        vertices: &[V],
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let (n, d) = plane(&vertices[0], &vertices[1], &vertices[2]);
        inside_out(vertices, &n, &d, ray, BELOW, sink)
    }
}

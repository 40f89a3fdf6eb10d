//! `cramer`: the 3×3 linear system by Cramer's rule.
//!
//! Source: I. Dunn, "Lecture 9: Triangles", course CSC 473, California Polytechnic State University,
//! <https://iondune.github.io/csc473/lectures/09-triangles>, after Fundamentals of Computer Graphics:
//! the common subterms of "Implementation", and the tests in the order of the pseudo-code. The text calls
//! det = 0 the obvious test for no intersection, so that test comes first.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink, gap};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Extent, Sides};

pub(super) struct Cramer;

const PARALLEL: usize = 0;
const T: usize = 1;
const EDGE: usize = 2;

impl Kernel for Cramer {
    const INFO: KernelInfo = KernelInfo {
        name: "cramer",
        source: "I. Dunn, Lecture 9: Triangles, Cramer's rule with common subterms, CSC 473, Cal Poly, \
                 https://iondune.github.io/csc473/lectures/09-triangles",
        contract: Contract::of_kernel(Extent::Interval, Sides::Both, Boundary::Closed),
        gates: &[
            Gate::signed(Role::Parallel, "abs(det) <= e", 2, 1),
            Gate::signed(Role::T, "t - t_min < e, t_max - t < e", 1, -1),
            Gate::signed(
                Role::Edge,
                "gamma < e, 1-gamma < e, beta < e, (1-gamma)-beta < e",
                0,
                0,
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
        // The source's letters: columns (a b c) = A-B, (d e f) = A-C, (g h i) = direction,
        // (j k l) = A-origin.
        let [a, b, c] = coordinates(&triangle.a.minus(&triangle.b));
        let [d, e, f] = coordinates(&triangle.a.minus(&triangle.c));
        let [g, h, i] = coordinates(&ray.direction);
        let [j, k, l] = coordinates(&triangle.a.minus(&ray.origin));
        // x*y - z*w
        let minor =
            |x: &V::Real, y: &V::Real, z: &V::Real, w: &V::Real| x.clone() * y - z.clone() * w;

        let (ei_hf, gf_di, dh_eg) = (
            minor(&e, &i, &h, &f),
            minor(&g, &f, &d, &i),
            minor(&d, &h, &e, &g),
        );
        let det = a.clone() * &ei_hf + b.clone() * &gf_di + c.clone() * &dh_eg;
        sink.one(PARALLEL, Refuse::AtMost, &det.abs())?;
        let (ak_jb, jc_al, bl_kc) = (
            minor(&a, &k, &j, &b),
            minor(&j, &c, &a, &l),
            minor(&b, &l, &k, &c),
        );

        let t = (-f * &ak_jb - e * &jc_al - d * &bl_kc) / &det;
        sink.one(T, Refuse::Below, &gap(&t, &ray.t_min))?;
        sink.one(T, Refuse::Below, &gap(&ray.t_max, &t))?;
        let gamma = (i * &ak_jb + h * &jc_al + g * &bl_kc) / &det;
        let one_minus_gamma = V::Real::one() - &gamma;
        sink.one(EDGE, Refuse::Below, &gamma)?;
        sink.one(EDGE, Refuse::Below, &one_minus_gamma)?;
        let beta = (j * &ei_hf + k * &gf_di + l * &dh_eg) / &det;
        sink.one(EDGE, Refuse::Below, &beta)?;
        sink.one(EDGE, Refuse::Below, &(one_minus_gamma - &beta))?;
        Some(Hit {
            t: Some(t),
            uv: Some((beta, gamma)),
            facing: None,
        })
    }
}

#[inline(always)]
fn coordinates<V: Vector>(v: &V) -> [V::Real; 3] {
    [v.at(0), v.at(1), v.at(2)]
}

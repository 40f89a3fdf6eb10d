//! Möller and Trumbore's test in the order in which most crates write it: divided by the determinant
//! before the edges are compared, t last.

use hairline::internals::arith::{Real, Vector};
use hairline::internals::case::{Ray, Triangle};
use hairline::internals::kernel::{Gate, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
use std::marker::PhantomData;

/// In what the crates differ.
pub trait Style: 'static {
    /// Its gates are [`GATES`], or [`GATES_CULLING`].
    const INFO: KernelInfo;
    /// Whether a negative determinant is refused.
    const CULLS: bool;
    /// How u is compared with 0 and 1: `u < 0 || u > 1` lets a NaN pass, `!(0..=1).contains(&u)` does not.
    const U: Refuse;
    /// What is asked of t.
    const T: T;
}

/// What is asked of t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum T {
    /// `t > e`.
    Above,
    /// `t > e`, and an infinite t means a miss.
    AboveAndFinite,
    /// `(t_min..=t_max).contains(&t)`.
    InInterval,
}

const PARALLEL: usize = 0;
const EDGE: usize = 1;
const TIME: usize = 2;
const FINITE: usize = 3;

/// The gates of a test that takes both sides.
pub const GATES: &[Gate] = &[
    Gate::non_negative(Role::Parallel, "abs(det) < e", 2, 1),
    EDGE_GATE,
    Gate::signed(Role::T, "!(t > e)", 1, -1),
];

/// The gates of a test of both sides on an interval.
pub const GATES_INTERVAL: &[Gate] = &[
    Gate::non_negative(Role::Parallel, "abs(det) < e", 2, 1),
    EDGE_GATE,
    Gate::signed(Role::T, "!(t - t_min >= e), !(t_max - t >= e)", 1, -1),
];

/// The gates of a test that culls, and whose infinite t means a miss.
pub const GATES_CULLING: &[Gate] = &[
    Gate::signed(Role::Parallel, "det < e", 2, 1),
    EDGE_GATE,
    Gate::signed(Role::T, "!(t > e)", 1, -1),
    Gate::fixed(Role::Other, "t = inf").named("finite"),
];

const EDGE_GATE: Gate = Gate::signed(Role::Edge, "u < e, 1-u < e, v < e, 1-(u+v) < e", 0, 0);

/// The test in a style.
pub struct MollerTrumbore<S>(PhantomData<fn() -> S>);

impl<Y: Style> Kernel for MollerTrumbore<Y> {
    const INFO: KernelInfo = Y::INFO;

    type Prepared<V: Vector> = Triangle<V>;

    fn prepare<V: Vector>(triangle: &Triangle<V>) -> Triangle<V> {
        triangle.clone()
    }

    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin,
            direction,
            t_min,
            t_max,
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let one = V::Real::one;
        let [edge1, edge2] = [b.minus(a), c.minus(a)];
        let p = direction.cross(&edge2);
        let det = edge1.dot(&p);
        let size = if Y::CULLS { det.clone() } else { det.abs() };
        sink.one(PARALLEL, Refuse::Below, &size)?;
        let inverse = one() / &det;
        let s = origin.minus(a);
        let u = s.dot(&p) * &inverse;
        sink.one(EDGE, Y::U, &u)?;
        sink.one(EDGE, Y::U, &(one() - &u))?;
        let q = s.cross(&edge1);
        let v = direction.dot(&q) * &inverse;
        sink.one(EDGE, Refuse::Below, &v)?;
        sink.one(EDGE, Refuse::Below, &(one() - (u.clone() + &v)))?;
        let t = edge2.dot(&q) * &inverse;
        match Y::T {
            T::Above => sink.one(TIME, Refuse::UnlessAbove, &t)?,
            T::AboveAndFinite => {
                sink.one(TIME, Refuse::UnlessAbove, &t)?;
                sink.fixed(FINITE, t.is_finite() || t.is_nan())?;
            }
            T::InInterval => {
                sink.one(TIME, Refuse::UnlessAtLeast, &gap(&t, t_min))?;
                sink.one(TIME, Refuse::UnlessAtLeast, &gap(t_max, &t))?;
            }
        }
        Some(Hit {
            t: Some(t),
            uv: Some((u, v)),
            facing: None,
        })
    }
}

/// `a - b`, and zero where a = b even if both are infinite: its sign is that of the comparison.
fn gap<R: Real>(a: &R, b: &R) -> R {
    if a.is_at_most(b) && b.is_at_most(a) {
        R::zero()
    } else {
        a.clone() - b
    }
}

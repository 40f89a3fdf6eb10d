//! The first layer: all signs at once in `f64`, each with an error bound from its permanent, and one
//! branch for "all certain".
//!
//! With A = a-o, B = b-o, C = c-o the three cross products are shared: -U = d·(B×C), -V = d·(C×A),
//! -W = d·(A×B), D = -U-V-W and T = A·(B×C).
//!
//! Error bounds (u = 2^-53 is the unit roundoff). A term of U is a product d_i·(x·y) of one given
//! and two subtracted numbers. Its computed value passes through 2 subtractions, 1 product, 1
//! difference, 1 product and 2 sums: 7 roundings, so it carries a factor within (1+u)^±7. The
//! permanent P (the same sum over absolute values) is computed with as many roundings and is at
//! least (1-u)^7 times its exact value. Hence
//! |U_computed - U| ≤ ((1+u)^7 - 1)/(1-u)^7 · P_computed < 8u·P_computed.
//! T has a third subtracted factor: 8 roundings, below 16u·P. D by U+V+W has 2 further sums over the
//! sum of the three permanents: 9 roundings, below 16u·(P_U+P_V+P_W).
//!
//! Underflow: a product that underflows is off by at most 2^-1075. In U at most two such products
//! meet each d_i, and three more stand alone; so the values and the permanents are off by less than
//! 2^-1070·(|d|₁ + 1) in all, and with A for d the same holds for T. 2^-1000 times the same factor is
//! added to each bound, which also covers the rounding of the bounds themselves.
//!
//! Overflow, infinities and NaN need no test: they make a permanent infinite or NaN, and then nothing
//! is certain. A zero direction makes every weight zero, which is never certain either.

use super::determinants::Determinant;
use super::signs::Signs;
use crate::case::Case;
use crate::truth::Truth;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

const U: f64 = f64::EPSILON / 2.0;
/// More than underflow can add, relative to a vector's length: 2^-1000.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);

/// Cases that go through the filter together.
pub(super) const LANES: usize = 4;

/// One number of each of N cases. Plain loops over fixed arrays: compilers make vector instructions
/// of them (and calls of `map` and `from_fn`).
#[derive(Clone, Copy)]
pub(super) struct Lanes<const N: usize>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    pub fn of(x: f64) -> Self {
        Lanes([x; N])
    }

    #[inline(always)]
    fn abs(mut self) -> Self {
        for x in &mut self.0 {
            *x = x.abs();
        }
        self
    }
}

macro_rules! lane_by_lane {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for i in 0..N {
                    self.0[i] $operator other.0[i];
                }
                self
            }
        }
    };
}

lane_by_lane!(Add, add, +=);
lane_by_lane!(Sub, sub, -=);
lane_by_lane!(Mul, mul, *=);

type Vector<const N: usize> = [Lanes<N>; 3];

/// The computed predicates of some cases, with bounds of their errors.
pub(super) struct Computed<const N: usize> {
    /// -U, -V and -W.
    weights: [Lanes<N>; 3],
    weight_errors: [Lanes<N>; 3],
    t: Lanes<N>,
    t_error: Lanes<N>,
    /// D.
    d: Lanes<N>,
    d_error: Lanes<N>,
}

#[inline(always)]
fn compute<const N: usize>([o, direction, a, b, c]: [Vector<N>; 5]) -> Computed<N> {
    let from_origin = |p: Vector<N>| [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
    let (a, b, c) = (from_origin(a), from_origin(b), from_origin(c));
    let abs = |v: Vector<N>| [v[0].abs(), v[1].abs(), v[2].abs()];
    let (abs_a, abs_d) = (abs(a), abs(direction));
    let one = Lanes::of(1.0);
    let d_underflow = Lanes::of(UNDERFLOW) * (abs_d[0] + abs_d[1] + abs_d[2] + one);
    let a_underflow = Lanes::of(UNDERFLOW) * (abs_a[0] + abs_a[1] + abs_a[2] + one);
    let (bc, bc_permanent) = cross(&b, &c);
    let (ca, ca_permanent) = cross(&c, &a);
    let (ab, ab_permanent) = cross(&a, &b);
    let t = dot(&a, &bc);
    let t_error = Lanes::of(16.0 * U) * dot(&abs_a, &bc_permanent) + a_underflow;
    let weights = [dot(&direction, &bc), dot(&direction, &ca), dot(&direction, &ab)];
    let permanents =
        [dot(&abs_d, &bc_permanent), dot(&abs_d, &ca_permanent), dot(&abs_d, &ab_permanent)];
    let bound = |p: Lanes<N>| Lanes::of(8.0 * U) * p + d_underflow;
    let weight_errors = [bound(permanents[0]), bound(permanents[1]), bound(permanents[2])];
    let d = weights[0] + weights[1] + weights[2];
    let all = permanents[0] + permanents[1] + permanents[2];
    let d_error = Lanes::of(16.0 * U) * all + Lanes::of(4.0) * d_underflow;
    Computed { weights, weight_errors, t, t_error, d, d_error }
}

/// The truths of the cases of o, d, a, b, c, each if every sign that it depends on is certain. Plain loops: large
/// arrays do not go through `map` and `from_fn` without calls.
#[inline(always)]
pub(super) fn decide<const N: usize>(
    vectors: [Vector<N>; 5],
    interval: impl Fn(usize) -> (f64, f64),
    truths: &mut [Option<Truth>; N],
) {
    let computed = compute(vectors);
    for (k, truth) in truths.iter_mut().enumerate() {
        *truth = computed.truth(k, interval(k));
    }
}

/// The computed predicates of one case.
pub(super) fn compute_one(case: &Case<f64>) -> Computed<1> {
    compute(case.vectors().map(|v| v.map(|x| Lanes([x]))))
}

impl Computed<1> {
    /// The sign of a determinant, if it is certain.
    pub fn sign(&self, determinant: Determinant) -> Option<Ordering> {
        let (value, error) = match determinant {
            Determinant::Weight(k) => (-self.weights[k].0[0], self.weight_errors[k].0[0]),
            Determinant::D => (self.d.0[0], self.d_error.0[0]),
            Determinant::T => (self.t.0[0], self.t_error.0[0]),
        };
        (value.abs() > error).then(|| value.total_cmp(&0.0))
    }

    /// Whether t lies past an end of the interval, if that or its opposite is certain.
    pub fn is_past(&self, end: f64) -> Option<bool> {
        is_past(end, (self.t.0[0], self.t_error.0[0]), (self.d.0[0], self.d_error.0[0]))
    }
}

impl<const N: usize> Computed<N> {
    #[inline(always)]
    fn truth(&self, k: usize, (t_min, t_max): (f64, f64)) -> Option<Truth> {
        let at = |lanes: &[Lanes<N>; 3]| [lanes[0].0[k], lanes[1].0[k], lanes[2].0[k]];
        let ([u, v, w], [u_error, v_error, w_error]) = (at(&self.weights), at(&self.weight_errors));
        let (t, t_error) = (self.t.0[k], self.t_error.0[k]);
        let (d, d_error) = (self.d.0[k], self.d_error.0[k]);
        let certain = (u.abs() > u_error)
            & (v.abs() > v_error)
            & (w.abs() > w_error)
            & (t.abs() > t_error)
            // With three weights of one sign D has it too, whatever its own bound.
            & ((d.abs() > d_error) | (same_sign(u, v) & same_sign(v, w)))
            & (t_min <= t_max);
        if !certain {
            return None;
        }
        let front = d < 0.0;
        let positive_t = (t < 0.0) == front;
        let (past_min, before_max) = if t_min == 0.0 && t_max == f64::INFINITY {
            (positive_t, true)
        } else {
            let compare = |end| is_past(end, (t, t_error), (d, d_error));
            (compare(t_min)?, !compare(t_max)?)
        };
        let inside = [u, v, w].map(|x| (x < 0.0) == front);
        Some(Signs::certain(front, inside, positive_t, past_min, before_max))
    }
}

#[inline(always)]
fn same_sign(x: f64, y: f64) -> bool {
    (x > 0.0) == (y > 0.0)
}

/// Whether T/D > end, if that or its opposite is certain.
///
/// In T - end·D the product and the difference round once more each, by less than 3u·(|T| + |end·D|) in
/// all. The errors of T and D hold that already: they are 16u times permanents that are at least |T| and
/// |D|, where less than 10u is needed. The same goes for underflow. Only an overflow is not in them.
#[inline(never)]
fn is_past(end: f64, (t, t_error): (f64, f64), (d, d_error): (f64, f64)) -> Option<bool> {
    if end.is_infinite() {
        return Some(end < 0.0);
    }
    let error = t_error + end.abs() * d_error;
    let difference = t - end * d;
    (d.abs() > d_error && difference.abs() > error && difference.is_finite())
        .then_some((difference > 0.0) == (d > 0.0))
}

#[inline(always)]
fn dot<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> Lanes<N> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product and its permanents.
#[inline(always)]
fn cross<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> (Vector<N>, Vector<N>) {
    let (p0, q0) = (a[1] * b[2], a[2] * b[1]);
    let (p1, q1) = (a[2] * b[0], a[0] * b[2]);
    let (p2, q2) = (a[0] * b[1], a[1] * b[0]);
    ([p0 - q0, p1 - q1, p2 - q2], [p0.abs() + q0.abs(), p1.abs() + q1.abs(), p2.abs() + q2.abs()])
}

#[cfg(test)]
mod tests;

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

use super::signs::{DecidingSigns, Determinant};
use crate::truth::Truth;
use std::cmp::Ordering;

const U: f64 = f64::EPSILON / 2.0;
/// More than underflow can add, relative to a vector's length: 2^-1000.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);

type Floats = [f64; 3];

/// The computed predicates of a case, with bounds of their errors.
pub(super) struct Computed {
    /// -U, -V and -W.
    weights: [f64; 3],
    weight_errors: [f64; 3],
    t: f64,
    t_error: f64,
    /// D.
    d: f64,
    d_error: f64,
}

/// The predicates of o, d, a, b and c. The code has no branch, so a loop over cases becomes vector instructions.
#[inline(always)]
pub(super) fn compute([o, direction, a, b, c]: [Floats; 5]) -> Computed {
    let from_origin = |p: Floats| [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
    let (a, b, c) = (from_origin(a), from_origin(b), from_origin(c));
    let abs = |v: Floats| [v[0].abs(), v[1].abs(), v[2].abs()];
    let (abs_a, abs_d) = (abs(a), abs(direction));
    let d_underflow = UNDERFLOW * (abs_d[0] + abs_d[1] + abs_d[2] + 1.0);
    let a_underflow = UNDERFLOW * (abs_a[0] + abs_a[1] + abs_a[2] + 1.0);
    let (bc, bc_permanent) = cross(&b, &c);
    let (ca, ca_permanent) = cross(&c, &a);
    let (ab, ab_permanent) = cross(&a, &b);
    let t = dot(&a, &bc);
    let t_error = 16.0 * U * dot(&abs_a, &bc_permanent) + a_underflow;
    let weights = [
        dot(&direction, &bc),
        dot(&direction, &ca),
        dot(&direction, &ab),
    ];
    let permanents = [
        dot(&abs_d, &bc_permanent),
        dot(&abs_d, &ca_permanent),
        dot(&abs_d, &ab_permanent),
    ];
    let bound = |p: f64| 8.0 * U * p + d_underflow;
    let weight_errors = [
        bound(permanents[0]),
        bound(permanents[1]),
        bound(permanents[2]),
    ];
    let d = weights[0] + weights[1] + weights[2];
    let all = permanents[0] + permanents[1] + permanents[2];
    let d_error = 16.0 * U * all + 4.0 * d_underflow;
    Computed {
        weights,
        weight_errors,
        t,
        t_error,
        d,
        d_error,
    }
}

/// The signs that are known of a case. The bits are that t > 0, that the line meets the triangle, that D < 0, that the
/// case's interval is from 0 to infinity, and that all these signs are certain.
#[derive(Clone, Copy)]
pub(super) struct SignCode(u64);

const POSITIVE_T: u64 = 1;
const INSIDE: u64 = 2;
const FRONT: u64 = 4;
const RAY: u64 = 8;
const CERTAIN: u64 = 16;
const CERTAIN_RAY: u64 = CERTAIN | RAY;

impl SignCode {
    pub const NONE: SignCode = SignCode(0);

    /// The truth; `past` says whether t lies past each end of the interval, if that is certain.
    #[inline(always)]
    pub fn truth(self, past: impl FnOnce() -> Option<[bool; 2]>) -> Option<Truth> {
        match self.0 & CERTAIN_RAY {
            // A table, since these signs are as random as the cases.
            CERTAIN_RAY => Some(OF_A_RAY[self.0 as usize % OF_A_RAY.len()]),
            CERTAIN => past().map(|[past_min, past_max]| self.on(past_min, !past_max)),
            _ => None,
        }
    }

    /// The truth of a certain case.
    const fn on(self, past_min: bool, before_max: bool) -> Truth {
        let SignCode(code) = self;
        let (front, inside, positive) = (
            code & FRONT != 0,
            code & INSIDE != 0,
            code & POSITIVE_T != 0,
        );
        DecidingSigns::certain(front, inside, positive, past_min, before_max)
    }
}

/// The truths of certain cases whose interval is from 0 to infinity.
const OF_A_RAY: [Truth; 8] = {
    let mut truths = [Truth::Invalid; 8];
    let mut code = 0;
    while code < 8 {
        truths[code] = SignCode(code as u64).on(code as u64 & POSITIVE_T != 0, true);
        code += 1;
    }
    truths
};

impl Computed {
    /// The sign of a determinant, if it is certain.
    pub fn sign(&self, determinant: Determinant) -> Option<Ordering> {
        let (value, error) = match determinant {
            Determinant::Weight(k) => (-self.weights[k], self.weight_errors[k]),
            Determinant::D => (self.d, self.d_error),
            Determinant::T => (self.t, self.t_error),
        };
        (value.abs() > error).then(|| value.total_cmp(&0.0))
    }

    /// True if t lies past an end of the interval; none if neither that nor its opposite is certain.
    pub fn is_past(&self, end: f64) -> Option<bool> {
        is_past(end, (self.t, self.t_error), (self.d, self.d_error))
    }

    /// The same of both ends.
    pub fn past(&self, [t_min, t_max]: [f64; 2]) -> Option<[bool; 2]> {
        Some([self.is_past(t_min)?, self.is_past(t_max)?])
    }

    /// All signs at once, without a branch.
    #[inline(always)]
    pub fn code(&self, [t_min, t_max]: [f64; 2]) -> SignCode {
        let ([u, v, w], [u_error, v_error, w_error]) = (self.weights, self.weight_errors);
        let (t, d) = (self.t, self.d);
        let front = d < 0.0;
        // Weights of one sign have that of their sum: the line meets the triangle.
        let one_sign = ((u < 0.0) == (v < 0.0)) & ((v < 0.0) == (w < 0.0));
        let certain = (u.abs() > u_error)
            & (v.abs() > v_error)
            & (w.abs() > w_error)
            & (t.abs() > self.t_error)
            // With three weights of one sign D has it too, whatever its own bound.
            & ((d.abs() > self.d_error) | one_sign)
            & (t_min <= t_max);
        let ray = (t_min == 0.0) & (t_max == f64::INFINITY);
        let positive_t = (t < 0.0) == front;
        let bit = |is_set: bool, bit: u64| u64::from(is_set) * bit;
        SignCode(
            bit(certain, CERTAIN)
                | bit(ray, RAY)
                | bit(front, FRONT)
                | bit(one_sign, INSIDE)
                | bit(positive_t, POSITIVE_T),
        )
    }
}

/// True if T/D > end; none if neither that nor its opposite is certain.
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
fn dot(a: &Floats, b: &Floats) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product and its permanents.
#[inline(always)]
fn cross(a: &Floats, b: &Floats) -> (Floats, Floats) {
    let (p0, q0) = (a[1] * b[2], a[2] * b[1]);
    let (p1, q1) = (a[2] * b[0], a[0] * b[2]);
    let (p2, q2) = (a[0] * b[1], a[1] * b[0]);
    (
        [p0 - q0, p1 - q1, p2 - q2],
        [
            p0.abs() + q0.abs(),
            p1.abs() + q1.abs(),
            p2.abs() + q2.abs(),
        ],
    )
}

#[cfg(test)]
mod tests;

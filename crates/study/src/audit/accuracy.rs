//! How accurate the values of right hits are: t, the weights u and v, and the point o + t·d, in ulps.
//!
//! An ulp is that of the float nearest to the exact value. An exact u or v of 0 is measured in ulps of
//! 1, since weights add up to it; an exact t of 0 in the t that moves the point by one ulp of the
//! largest coordinate of the case's points; the point in ulps of that coordinate too, as it is formed
//! in the scalar, rounding and all.

use super::histogram::Histogram;
use crate::arith::{Bounded, Exact, Float, Real, Triple, Vector};
use crate::case::{Case, Ray, Triangle};
use crate::judge::{rounds_to_infinity, ulp_of_points};
use crate::kernel::{Gives, Verdict};
use crate::truth::{Crossing, Feature, Truth};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// Errors of hits in ulps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// The errors of t.
    pub t: Histogram,
    /// The larger errors of u and v.
    pub uv: Histogram,
    /// The errors of the point, in its worst coordinate.
    pub point: Histogram,
}

impl Accuracy {
    /// Counts a hit.
    pub fn add(&mut self, errors: &Errors) {
        let parts = [
            (&mut self.t, errors.t),
            (&mut self.uv, errors.uv),
            (&mut self.point, errors.point),
        ];
        for (histogram, error) in parts {
            if let Some(error) = error {
                histogram.add(error);
            }
        }
    }

    /// Adds more.
    pub fn merge(&mut self, other: &Accuracy) {
        self.t.merge(&other.t);
        self.uv.merge(&other.uv);
        self.point.merge(&other.point);
    }
}

/// The errors of one hit in ulps, of the values that the kernel gives; infinite where a value is not
/// finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The error of t.
    pub t: Option<f64>,
    /// The larger error of u and v.
    pub uv: Option<f64>,
    /// The error of the point, in its worst coordinate.
    pub point: Option<f64>,
}

impl Errors {
    /// The errors of a hit on a triangle that the line crosses inside or on its boundary.
    pub fn of<F: Float>(
        case: &Case<F>,
        crossing: &Crossing,
        gives: Gives,
        verdict: &Verdict<F>,
    ) -> Errors {
        let measure = Measure::new(case, crossing);
        measure
            .errors(gives, verdict, Bounded::within)
            .unwrap_or_else(|| {
                let float = |x: &Exact, _| Some(x.approximate());
                let exactly = measure.errors(gives, verdict, float);
                exactly.expect("always a number")
            })
    }
}

/// A case to measure hits on.
struct Measure<'a, F: Float> {
    case: &'a Case<F>,
    /// True for each of t, u and v that is exactly zero.
    zeros: [bool; 3],
    truth: Truth,
    /// The units in which errors of a t, u or v of zero are measured.
    units: [f64; 3],
}

impl<'a, F: Float> Measure<'a, F> {
    fn new(case: &'a Case<F>, crossing: &Crossing) -> Self {
        let u = matches!(
            crossing.feature,
            Feature::EdgeCa | Feature::VertexA | Feature::VertexC
        );
        let v = matches!(
            crossing.feature,
            Feature::EdgeAb | Feature::VertexA | Feature::VertexB
        );
        let longest = case.vectors()[1]
            .map(|x| x.to_f64().abs())
            .into_iter()
            .fold(0.0, f64::max);
        let t_unit = ulp_of_points(case).to_f64() / longest;
        let one = F::EPSILON.to_f64();
        Measure {
            case,
            zeros: [crossing.t_sign == Ordering::Equal, u, v],
            truth: Truth::Transversal(*crossing),
            units: [t_unit, one, one],
        }
    }

    /// In an arithmetic that does not round; `float` is a number as a float, if it is known to within
    /// a tolerance or to a millionth of itself.
    fn errors<R: Real>(
        &self,
        gives: Gives,
        verdict: &Verdict<F>,
        float: impl Fn(&R, f64) -> Option<f64>,
    ) -> Option<Errors> {
        let (ray, triangle) = self.case.lift(|x| R::number(x.to_f64()));
        let exact = values(&ray, &triangle);
        let error_of = |which: usize, found: F| -> Option<f64> {
            if which == 0 && rounds_to_infinity(self.case, &self.truth, found) {
                return Some(0.0);
            }
            if !found.is_finite() {
                return Some(f64::INFINITY);
            }
            if self.zeros[which] {
                return Some(found.to_f64().abs() / self.units[which]);
            }
            let ulp = self.ulp_at(&exact[which], &float)?;
            let off = R::number(found.to_f64()) - &exact[which];
            Some(float(&off, ulp * 1e-6)?.abs() / ulp)
        };
        let uv = |found: &Verdict<F>| Some(error_of(1, found.u)?.max(error_of(2, found.v)?));
        Some(Errors {
            t: if gives.t {
                Some(error_of(0, verdict.t)?)
            } else {
                None
            },
            uv: if gives.uv { Some(uv(verdict)?) } else { None },
            point: if gives.t {
                Some(self.point(verdict.t, &ray, &exact[0], float)?)
            } else {
                None
            },
        })
    }

    /// The ulp of the float nearest to a number. Near a power of two, where it doubles, a number that is known to
    /// a millionth of itself is not known well enough.
    fn ulp_at<R: Real>(&self, exact: &R, float: &impl Fn(&R, f64) -> Option<f64>) -> Option<f64> {
        let about = float(exact, 0.0)?;
        let [one, other] = [1.0 - 2e-6, 1.0 + 2e-6].map(|x| nearest::<F>(about * x));
        let ulps = [one, other].map(|x| x.ulp().to_f64());
        if ulps[0] == ulps[1] {
            return Some(ulps[0]);
        }
        let (low, high) = (ulps[0].min(ulps[1]), ulps[0].max(ulps[1]));
        // The power of two from which on, and half an ulp before which, the ulp is the larger one.
        let power = high / F::EPSILON.to_f64();
        let sign = if about < 0.0 { -1.0 } else { 1.0 };
        let beyond = sign * float(&(R::number(sign * power) * -R::one() + exact), 0.0)?;
        Some(if beyond < -low / 2.0 { low } else { high })
    }

    fn point<R: Real>(
        &self,
        t: F,
        ray: &Ray<Triple<R>>,
        exact_t: &R,
        float: impl Fn(&R, f64) -> Option<f64>,
    ) -> Option<f64> {
        let [o, d, ..] = self.case.vectors();
        let exact_t = if self.zeros[0] { &R::zero() } else { exact_t };
        let exact = ray.origin.plus(&ray.direction.times(exact_t));
        let ulp = ulp_of_points(self.case).to_f64();
        let mut worst = 0.0f64;
        for axis in 0..3 {
            let found = o[axis] + t * d[axis];
            if !found.is_finite() {
                return Some(f64::INFINITY);
            }
            let off = R::number(found.to_f64()) - &exact.at(axis);
            worst = worst.max(float(&off, ulp * 1e-6)?.abs() / ulp);
        }
        Some(worst)
    }
}

/// t where the line meets the plane.
pub fn t_of<V: Vector>(ray: &Ray<V>, Triangle { a, b, c }: &Triangle<V>) -> V::Real {
    let n = b.minus(a).cross(&c.minus(a));
    let capital_d = ray.direction.dot(&n);
    n.dot(&a.minus(&ray.origin)) / &capital_d
}

/// t and the weights of b and c where the line meets the plane.
pub fn values<V: Vector>(ray: &Ray<V>, Triangle { a, b, c }: &Triangle<V>) -> [V::Real; 3] {
    let n = b.minus(a).cross(&c.minus(a));
    let capital_d = ray.direction.dot(&n);
    let [ra, rb, rc] = [a, b, c].map(|vertex| vertex.minus(&ray.origin));
    let weight = |p: &V, q: &V| -ray.direction.dot(&p.cross(q)) / &capital_d;
    [n.dot(&ra) / &capital_d, weight(&ra, &rc), weight(&rb, &ra)]
}

/// The finite float nearest to a number.
fn nearest<F: Float>(value: f64) -> F {
    let largest = F::infinity().offset_ulps(-1);
    let found = F::from_f64(value).abs();
    if found.is_finite() { found } else { largest }
}

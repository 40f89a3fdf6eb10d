//! The verdict of a row on a case with its finding, and the scale of what a gate compares there.
//!
//! A margin is a power of length, times a power of |d| ([`Dimension`]). A gate's *scale* on a case is E^p·|d|^q, with the
//! dimension's powers p and q, E the largest difference between coordinates of the origin and the vertices on one axis, and
//! |d| the largest component of the direction.

use crate::arith::{Real, Vector};
use crate::audit::Row;
use crate::case::{Case, Ray, Triangle};
use crate::judge::{Finding, asked, judge};
use crate::kernel::{Dimension, Scalar, Verdict};
use crate::oracle;
use crate::truth::Truth;

/// The truth, the kernel's verdict, and what `judge` makes of the two. Cases are judged one by one:
/// nothing is demanded of a secondary ray on the triangle that it starts on.
pub fn verdict_and_finding<F: Scalar>(
    row: &Row,
    epsilons: &[F],
    case: &Case<F>,
) -> (Truth, Verdict<F>, Option<Finding>) {
    let mut verdict = [Verdict::miss(None)];
    // A kernel that does not run in this scalar misses, and finds nothing.
    if let Some(subject) = F::subject(row.entry) {
        subject.run(std::slice::from_ref(case), epsilons, &mut verdict);
    }
    let [verdict] = verdict;
    let truth = oracle::truth(case);
    let asked = asked(case, &truth, &row.contract, false);
    (truth, verdict, judge((&row.contract, asked), (case, &truth), row.entry.info.gives, &verdict))
}

/// A gate's scale on a case: E^p·|d|^q.
pub fn scale<V: Vector>(ray: &Ray<V>, triangle: &Triangle<V>, dimension: Dimension) -> V::Real {
    let larger = |x: V::Real, v: V| {
        [0, 1, 2]
            .into_iter()
            .map(|axis| v.at(axis).abs())
            .fold(x, |x, y| if x.is_less(&y) { y } else { x })
    };
    let points = [&ray.origin, &triangle.a, &triangle.b, &triangle.c];
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let differences = pairs.into_iter().map(|(i, j): (usize, usize)| points[i].minus(points[j]));
    let extent = differences.fold(V::Real::zero(), larger);
    let direction = larger(V::Real::zero(), ray.direction.clone());
    power(&extent, dimension.length) * power(&direction, dimension.direction)
}

fn power<R: Real>(base: &R, exponent: i8) -> R {
    let product = (0..exponent.unsigned_abs()).fold(R::one(), |product, _| product * base);
    if exponent < 0 { R::one() / product } else { product }
}

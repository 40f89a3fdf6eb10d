//! The promise of a strategy about its cases, decided on the cases alone, so that shrinking can keep it.

use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Ray, Triangle};
use crate::family::{Family, Grouping, find};
use crate::kernel::Scalar;
use crate::oracle;
use num_rational::BigRational;
use num_traits::{One, Signed};

/// A family, and what its truths alone do not say.
pub struct StrategyPromise {
    pub(super) family: &'static str,
    pub(super) shape: PromisedNumbers,
}

/// The promise of a strategy about the numbers of a case besides its truth.
#[derive(Clone, Copy)]
pub(super) enum PromisedNumbers {
    Any,
    /// So many weights are near zero: 1 by an edge, 2 by a vertex.
    Near(usize),
    OriginNear,
    Grazing,
    Sliver,
    /// The longest edge is within 2^±2 of this power of two.
    Size(i32),
    Far,
    AlongAxis,
    SharedEdge,
}

impl StrategyPromise {
    /// The family's name.
    pub fn name(&self) -> &'static str {
        self.family
    }

    /// The family.
    pub(super) fn family(&self) -> &'static Family {
        find(self.family).expect("a family of the table")
    }

    /// True if a ray has one triangle.
    pub(super) fn is_single(&self) -> bool {
        self.family().grouping == Grouping::Single
    }

    /// True if the triangles of one ray keep the promise.
    pub fn keeps<F: Scalar>(&self, cases: &[Case<F>]) -> bool {
        let truths: Vec<_> = cases.iter().map(oracle::truth).collect();
        self.family().keeps(&truths) && self.shape.holds(cases)
    }
}

impl PromisedNumbers {
    fn holds<F: Float>(self, cases: &[Case<F>]) -> bool {
        let case = &cases[0];
        match self {
            PromisedNumbers::Any => true,
            PromisedNumbers::Near(count) => is_near(case, count),
            PromisedNumbers::SharedEdge => share_an_edge(cases),
            PromisedNumbers::AlongAxis => {
                case.vectors()[1].iter().filter(|x| !x.is_zero()).count() == 1
            }
            _ => self.holds_in_f64(case.widen(), F::EPSILON.to_f64()),
        }
    }

    /// Rounding moves the limits a little, which no promise minds.
    fn holds_in_f64(self, Case { ray, triangle }: Case<f64>, ulp: f64) -> bool {
        let (
            Ray {
                origin, direction, ..
            },
            Triangle { a, b, c },
        ) = (ray, triangle);
        let edges = [b - a, c - b, a - c];
        let longest = edges
            .map(|edge| edge.length())
            .into_iter()
            .fold(0.0, f64::max);
        let normal = edges[0].cross(c - a);
        let area = normal.length();
        match self {
            // Points within 1 and 16 ulps a coordinate: the plane is within 30 ulps of 1.
            PromisedNumbers::OriginNear => {
                (a - origin).dot(normal).abs() <= 1024.0 * ulp * longest * area
            }
            PromisedNumbers::Grazing => {
                direction.dot(normal).abs() <= 0.5 * direction.length() * area
            }
            PromisedNumbers::Sliver => 8.0 * area <= longest * longest,
            PromisedNumbers::Size(power) => {
                let size = scale_by_power_of_two(longest, -power);
                (0.25..=4.0).contains(&size)
            }
            PromisedNumbers::Far => {
                let largest = [a, b, c]
                    .iter()
                    .map(|p| p.abs().max_element())
                    .fold(0.0, f64::max);
                8.0 * longest <= largest
            }
            _ => unreachable!("decided on the floats themselves"),
        }
    }
}

/// True if the smallest weights are at most 2^13 ulps of 1, exactly. The families `edge-near` and
/// `vertex-near` aim within √3·18 ulps of their point, at a sine of at least 1/8, at triangles at least
/// 0.058 high: 4,300 ulps.
fn is_near<F: Float>(case: &Case<F>, count: usize) -> bool {
    let exact = oracle::define(case).exact;
    let (Some(u), Some(v)) = (exact.u, exact.v) else {
        return false;
    };
    let most = BigRational::from_float(8192.0 * F::EPSILON.to_f64()).expect("finite");
    let weights = [BigRational::one() - &u - &v, u, v];
    weights.iter().filter(|weight| weight.abs() <= most).count() == count
}

/// True if both triangles have one ray and two vertices in common.
fn share_an_edge<F: Float>(cases: &[Case<F>]) -> bool {
    let [first, second] = cases else { return false };
    let of = |case: &Case<F>| {
        case.triangle
            .vertices()
            .map(|vertex| -> [F; 3] { vertex.into() })
    };
    let ray = |case: &Case<F>| {
        (
            [0, 1].map(|i| case.vectors()[i]),
            case.ray.t_min,
            case.ray.t_max,
        )
    };
    let theirs = of(second);
    ray(first) == ray(second)
        && of(first)
            .iter()
            .filter(|vertex| theirs.contains(vertex))
            .count()
            == 2
}

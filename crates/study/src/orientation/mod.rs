//! Floor 4: orientation predicates, which take points instead of rays and triangles.
//!
//! ```text
//! Points ──► Predicate ──► Answer (-, 0, +, NaN) ─┐
//!   │                                             ├─► judge ──► Finding ──► Counts
//!   └──────► exact determinant ──► its sign ──────┘
//! ```
//!
//! `orient2d(a, b, c)` is the sign of det(a-c, b-c): + where a, b, c run counter-clockwise.
//! `orient3d(a, b, c, d)` is the sign of det(a-d, b-d, c-d): + where d lies below the plane in which
//! a, b, c run counter-clockwise seen from above (Shewchuk 1997, "Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates", section 4.3).
//!
//! To add a predicate: write its `Formula` in `predicate.rs` and give it a row in
//! [`PREDICATES`]. To add a family: write its function in `families.rs` and give it a row in
//! [`FAMILIES`].

#![forbid(unsafe_code)]

mod audit;
mod exact;
mod families;
mod id;
mod known;
pub mod points_json;
mod predicate;
mod record;

pub use audit::{Cell, Counts, Plan, SetSummary, Sums, run};
pub use exact::{BigDyadic, ScaledPoints, defined_determinant};
pub use families::{FAMILIES, Family, find_family};
pub use id::PointsId;
pub use known::{KNOWN, Known, find_known};
pub use predicate::{PREDICATES, Predicate, Row, Scalar, default_rows};
pub use record::{
    AnswerPart, CasePart, ExamplePart, Provenance, Rate, Record, ResultPart, RowResult, SCHEMA,
    SetPart, TimingPart, build, show,
};

use crate::arith::{Float, scale_by_power_of_two};
use std::cmp::Ordering;

named! {
    pub names
    /// Points in the plane or in space.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Dimension {
        /// The plane: `orient2d` of three points.
        Two = "orient2d",
        /// Space: `orient3d` of four points.
        Three = "orient3d",
    }
}

impl Dimension {
    /// 2 or 3: how many coordinates a point has, and how many points there are beside the last.
    pub fn number(self) -> usize {
        match self {
            Dimension::Two => 2,
            Dimension::Three => 3,
        }
    }
}

/// Three points of the plane or four of space; the last one is where differences are taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Points<F> {
    dimension: Dimension,
    /// The points' coordinates; those that the dimension does not use are 0.
    coordinates: [[F; 3]; 4],
}

impl<F: Float> Points<F> {
    /// a, b, c of the plane.
    pub fn two(points: [[F; 2]; 3]) -> Points<F> {
        let [a, b, c] = points.map(|[x, y]| [x, y, F::zero()]);
        Points { dimension: Dimension::Two, coordinates: [a, b, c, [F::zero(); 3]] }
    }

    /// a, b, c, d of space.
    pub fn three(points: [[F; 3]; 4]) -> Points<F> {
        Points { dimension: Dimension::Three, coordinates: points }
    }

    /// Each coordinate that the dimension uses from its place: point, axis.
    fn each(dimension: Dimension, mut coordinate: impl FnMut(usize, usize) -> F) -> Points<F> {
        let mut coordinates = [[F::zero(); 3]; 4];
        let n = dimension.number();
        for (i, point) in coordinates.iter_mut().enumerate().take(n + 1) {
            for (axis, x) in point.iter_mut().enumerate().take(n) {
                *x = coordinate(i, axis);
            }
        }
        Points { dimension, coordinates }
    }

    /// The dimension.
    pub fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// The points, each with as many coordinates as the dimension has.
    pub fn iter(&self) -> impl Iterator<Item = &[F]> {
        let n = self.dimension.number();
        self.coordinates.iter().take(n + 1).map(move |point| &point[..n])
    }

    /// With two points exchanged: the determinant changes its sign.
    pub fn swapped(mut self, i: usize, j: usize) -> Points<F> {
        assert!(i.max(j) <= self.dimension.number(), "there is no such point");
        self.coordinates.swap(i, j);
        self
    }

    /// With one point changed; of points of the plane the third coordinate is not looked at.
    pub fn with_moved(mut self, point: usize, change: impl FnOnce([F; 3]) -> [F; 3]) -> Points<F> {
        assert!(point <= self.dimension.number(), "there is no such point");
        self.coordinates[point] = change(self.coordinates[point]);
        self
    }

    /// Each coordinate times 2^`exponent`, rounded where it does not fit.
    pub fn scaled(mut self, exponent: i32) -> Points<F> {
        for x in self.coordinates.as_flattened_mut() {
            *x = F::from_f64(scale_by_power_of_two(x.to_f64(), exponent));
        }
        self
    }

    /// True if every coordinate is finite.
    pub fn is_finite(&self) -> bool {
        self.coordinates.as_flattened().iter().all(|x| x.is_finite())
    }

    /// The points in `f64`, which holds every `f32` exactly.
    pub fn widen(&self) -> Points<f64> {
        Points {
            dimension: self.dimension,
            coordinates: self.coordinates.map(|point| point.map(F::to_f64)),
        }
    }
}

/// A predicate's answer about the sign of a determinant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Below 0.
    Minus,
    /// 0, or within the epsilon of it.
    Zero,
    /// Above 0.
    Plus,
    /// No sign at all.
    NaN,
}

impl Answer {
    /// The answer for a computed determinant: 0 where `abs(det) <= epsilon`, which a NaN never is.
    #[inline]
    pub fn of<F: Float>(determinant: F, epsilon: F) -> Answer {
        if determinant.abs() <= epsilon {
            Answer::Zero
        } else if determinant > F::zero() {
            Answer::Plus
        } else if determinant < F::zero() {
            Answer::Minus
        } else {
            Answer::NaN
        }
    }

    /// `-`, `0`, `+` or `NaN`.
    pub fn symbol(self) -> &'static str {
        match self {
            Answer::Minus => "-",
            Answer::Zero => "0",
            Answer::Plus => "+",
            Answer::NaN => "NaN",
        }
    }
}

impl From<Ordering> for Answer {
    /// The right answer for an exact sign.
    fn from(sign: Ordering) -> Answer {
        match sign {
            Ordering::Less => Answer::Minus,
            Ordering::Equal => Answer::Zero,
            Ordering::Greater => Answer::Plus,
        }
    }
}

named! {
    pub names
    /// How an answer is wrong.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Finding {
        /// The opposite sign, or no sign (NaN) whatever the truth.
        WrongSign = "wrong-sign",
        /// It said 0, and the determinant is not 0.
        FalseZero = "false-zero",
        /// It said - or +, and the determinant is 0.
        MissedZero = "missed-zero",
    }
}

/// Compares an answer with the exact sign; the only place that does.
#[inline]
pub fn judge(answer: Answer, exact: Ordering) -> Option<Finding> {
    match (answer, exact) {
        (Answer::NaN, _) | (Answer::Minus, Ordering::Greater) | (Answer::Plus, Ordering::Less) => {
            Some(Finding::WrongSign)
        }
        (Answer::Zero, Ordering::Less | Ordering::Greater) => Some(Finding::FalseZero),
        (Answer::Minus | Answer::Plus, Ordering::Equal) => Some(Finding::MissedZero),
        (Answer::Minus, Ordering::Less)
        | (Answer::Zero, Ordering::Equal)
        | (Answer::Plus, Ordering::Greater) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pair_of_answer_and_truth_has_its_finding() {
        let row = |answer| {
            [Ordering::Less, Ordering::Equal, Ordering::Greater]
                .map(|exact| judge(answer, exact).map(Finding::name))
        };
        assert_eq!(row(Answer::Minus), [None, Some("missed-zero"), Some("wrong-sign")]);
        assert_eq!(row(Answer::Zero), [Some("false-zero"), None, Some("false-zero")]);
        assert_eq!(row(Answer::Plus), [Some("wrong-sign"), Some("missed-zero"), None]);
        assert_eq!(row(Answer::NaN), [Some("wrong-sign"); 3]);
    }

    #[test]
    fn the_epsilon_itself_is_still_zero_and_a_nan_never_is() {
        assert_eq!(Answer::of(1e-6f64, 1e-6), Answer::Zero);
        assert_eq!(Answer::of(-1e-6f32, 1e-6), Answer::Zero);
        assert_eq!(Answer::of(1e-6f64.next_up(), 1e-6), Answer::Plus);
        assert_eq!(Answer::of(-f64::MIN_POSITIVE, 0.0), Answer::Minus);
        assert_eq!(Answer::of(-0.0f64, 0.0), Answer::Zero);
        assert_eq!(Answer::of(f64::NAN, f64::MAX), Answer::NaN);
        assert_eq!(Answer::of(f32::NEG_INFINITY, f32::MAX), Answer::Minus);
    }
}

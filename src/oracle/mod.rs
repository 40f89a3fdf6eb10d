//! Floor 2: what is true, exactly, for every input.
//!
//! The definition is [`define`], written with num-rational: slow and obvious. [`truth`] gives the
//! same answer faster, in layers that each decide or hand on: a floating-point filter, integers of
//! 128 bits, integers of any size. A `f32` case is asked in `f64`, which holds it exactly.
//!
//! Architecture invariant: nothing here knows a kernel, and no arithmetic is shared with them.

#![forbid(unsafe_code)]

mod contact;
mod filter;
mod integer;
mod rational;
mod signs;

pub use rational::{Definition, define};

use crate::arith::Float;
use crate::case::Case;
use crate::truth::Truth;

/// How often each layer decided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layers {
    /// Input that asks no question: NaN, infinities, a zero direction, an impossible interval.
    pub invalid: u64,
    /// The floating-point filter.
    pub filter: u64,
    /// Integers of 128 bits.
    pub small_integer: u64,
    /// Integers of any size.
    pub big_integer: u64,
}

impl Layers {
    /// Name and count of each layer, the fastest first.
    pub fn named(&self) -> [(&'static str, u64); 4] {
        [
            ("invalid", self.invalid),
            ("filter", self.filter),
            ("128-bit integers", self.small_integer),
            ("big integers", self.big_integer),
        ]
    }

    /// Adds another run's counts.
    pub fn merge(&mut self, other: &Layers) {
        self.invalid += other.invalid;
        self.filter += other.filter;
        self.small_integer += other.small_integer;
        self.big_integer += other.big_integer;
    }
}

/// The truth of a case.
///
/// ```
/// use hairline::case::Case;
/// use hairline::oracle;
/// use hairline::truth::{Feature, Truth};
///
/// // Straight down onto the middle of edge ab.
/// let triangle = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
/// let case = Case::<f32>::new([1.0, 0.0, 1.0], [0.0, 0.0, -1.0], triangle);
/// let Truth::Transversal(crossing) = oracle::truth(&case) else { panic!() };
/// assert_eq!(crossing.feature, Feature::EdgeAb);
/// ```
pub fn truth<F: Float>(case: &Case<F>) -> Truth {
    truth_counted(case, &mut Layers::default())
}

/// The truth of a case, and a count for the layer that decided it.
pub fn truth_counted<F: Float>(case: &Case<F>, layers: &mut Layers) -> Truth {
    let mut decided = [None];
    filter::decide(std::array::from_ref(case), &mut decided);
    layers.filter += 1;
    decided[0].unwrap_or_else(|| exactly(&case.widen(), layers))
}

/// The truths of many cases, in order; `truths` is cleared first.
pub fn truths<F: Float>(cases: &[Case<F>], truths: &mut Vec<Truth>, layers: &mut Layers) {
    truths.clear();
    let mut decided = [None; filter::LANES];
    let (groups, rest) = cases.as_chunks::<{ filter::LANES }>();
    for group in groups {
        filter::decide(group, &mut decided);
        for (decided, case) in std::iter::zip(&decided, group) {
            truths.push(decided.unwrap_or_else(|| exactly(&case.widen(), layers)));
        }
    }
    layers.filter += (cases.len() - rest.len()) as u64;
    truths.extend(rest.iter().map(|case| truth_counted(case, layers)));
}

/// The layers behind the filter.
#[inline(never)]
fn exactly(case: &Case<f64>, layers: &mut Layers) -> Truth {
    // Counted for the filter with its batch.
    layers.filter = layers.filter.wrapping_sub(1);
    if !is_valid(case) {
        layers.invalid += 1;
        return Truth::Invalid;
    }
    let scaled = integer::Scaled::new(case);
    if let Some(truth) = scaled.decide_small() {
        layers.small_integer += 1;
        return truth;
    }
    layers.big_integer += 1;
    scaled.decide_big()
}

/// Finite coordinates, a direction that is not zero, and an interval whose ends are in order.
fn is_valid(case: &Case<f64>) -> bool {
    let vectors = case.vectors();
    let finite = vectors.iter().flatten().all(|x| x.is_finite());
    let ordered = case.ray.t_min <= case.ray.t_max;
    finite && ordered && vectors[1] != [0.0; 3]
}

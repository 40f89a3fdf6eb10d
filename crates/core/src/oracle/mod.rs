//! Floor 2: what is true, exactly, for every input.
//!
//! The definition is [`define`], written with num-rational: slow and obvious. [`truth`] gives the
//! same answer faster, in layers that each decide or hand on: a floating-point filter for all signs
//! together; machine integers where the coordinates lie on a grid, a small one or a wide one; then, sign by sign,
//! double-doubles with a bound, the adaptive predicate of the crate `robust` where its conditions
//! hold, and the determinant multiplied out. Where a line meets a triangle without area, or one in whose plane it
//! lies, integers of any size find out. An `f32` case is decided in `f64`, which holds it exactly. It works over the
//! whole range of exponents.
//!
//! Architecture invariant: nothing here knows a kernel, and no arithmetic is shared with them.

#![forbid(unsafe_code)]

mod batch;
mod contact;
mod coplanar;
mod determinant;
mod filter;
mod fixed;
mod grid;
pub mod integer;
mod monomials;
mod once;
mod rational;
mod resolve;
mod scaled;
mod signs;
mod sum;
mod width;

pub use batch::{Batch, UnequalColumns};
pub use once::is_met_once;
pub use rational::{Definition, define, define_instance, define_points};

use crate::arith::Float;
use crate::case::{Case, Instance};
use crate::truth::{ExactValues, Truth};
use scaled::Scaled;
use serde::{Deserialize, Serialize};
use width::{Narrow, Wide};

named! {
    pub names
    /// A layer of the oracle, the fastest first.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Layer {
        /// Invalid input: NaN, infinities, a zero direction, an impossible interval.
        Invalid = "invalid",
        /// The floating-point filter, all signs at once.
        Filter = "filter",
        /// Machine integers on a small grid.
        Grid = "grid",
        /// Wider ones on a grid of 61 bits.
        WideGrid = "wide grid",
        /// The filter again, sign by sign, after each axis was scaled where that can help.
        ScaledFilter = "scaled filter",
        /// Double-doubles with a bound.
        DoubleDouble = "double-double",
        /// `robust`'s adaptive predicate.
        Robust = "robust",
        /// The determinant multiplied out, in floats with exponents of any size, then exactly.
        Monomials = "monomials",
        /// Integers of any size: where a line meets a triangle without area, or one in whose plane it lies.
        BigInteger = "big integers",
    }
}

/// The number of layers.
const LAYERS: usize = Layer::ALL.len();

/// How often each layer decided; a case counts for the last layer that it needed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Layers([u64; LAYERS]);

impl Layers {
    /// Name and count of each layer.
    pub fn named(&self) -> [(&'static str, u64); LAYERS] {
        Layer::ALL.map(|layer| (layer.name(), self.of(layer)))
    }

    /// The count of a layer.
    pub fn of(&self, layer: Layer) -> u64 {
        self.0[layer as usize]
    }

    /// Adds another run's counts.
    pub fn merge(&mut self, other: &Layers) {
        for (count, more) in self.0.iter_mut().zip(other.0) {
            *count += more;
        }
    }

    fn count(&mut self, layer: Layer, cases: usize) {
        self.0[layer as usize] += cases as u64;
    }
}

/// The truth of a case.
///
/// ```
/// use hairline_core::{Case, Feature, Truth, truth};
///
/// // Straight down onto the middle of edge ab.
/// let triangle = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
/// let case = Case::<f32>::new([1.0, 0.0, 1.0], [0.0, 0.0, -1.0], triangle);
/// let Truth::Transversal(crossing) = truth(&case) else { panic!() };
/// assert_eq!(crossing.feature, Feature::EdgeAb);
/// ```
pub fn truth<F: Float>(case: &Case<F>) -> Truth {
    truth_counted(case, &mut Layers::default())
}

/// The truth of a case, and a count for the layer that decided it.
pub fn truth_counted<F: Float>(case: &Case<F>, layers: &mut Layers) -> Truth {
    let (vectors, ends) = batch::widened(case);
    let computed = filter::compute(vectors);
    match computed.code(ends).truth(|| computed.past(ends)) {
        Some(truth) => {
            layers.count(Layer::Filter, 1);
            truth
        }
        None => behind_the_filter(case, layers),
    }
}

/// The exact values behind a case's truth, as [`define`] gives them; of a crossing some ten times as fast.
pub fn exact_values<F: Float>(case: &Case<F>, truth: &Truth) -> ExactValues {
    match truth {
        Truth::Transversal(_) => {
            let [t, u, v] = Scaled::new(&case.widen()).crossing().map(Some);
            ExactValues {
                t,
                u,
                v,
                contact_t: None,
            }
        }
        Truth::Coplanar(_) | Truth::Degenerate(_) => define(case).exact,
        Truth::Parallel | Truth::Invalid => ExactValues::default(),
    }
}

/// The truths of many cases, in order: somewhat faster a case than one by one. `truths` is cleared
/// first. Cases that lie as arrays of coordinates are a [`Batch`].
///
/// ```
/// use hairline_core::{Case, Layers, truths};
///
/// let triangle = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
/// let down_at = |x, y| Case::<f64>::new([x, y, 1.0], [0.0, 0.0, -1.0], triangle);
/// let (mut found, mut layers) = (Vec::new(), Layers::default());
/// truths(&[down_at(0.5, 0.5), down_at(3.0, 3.0)], &mut found, &mut layers);
/// let hits: Vec<_> = found.iter().map(|truth| truth.hits_closed()).collect();
/// assert_eq!(hits, [Some(true), Some(false)]);
/// ```
pub fn truths<F: Float>(cases: &[Case<F>], truths: &mut Vec<Truth>, layers: &mut Layers) {
    batch::decide_all(cases, truths, layers);
}

/// The truths of cases whose vectors lie as rows, as arrays of points of other languages do: o, d, a, b and c of each, and
/// the ends of its interval. An error if not all have the same length. `truths` is cleared first.
pub fn truths_of_rows<F: Float>(
    vectors: [&[[F; 3]]; 5],
    interval: [&[F]; 2],
    truths: &mut Vec<Truth>,
    layers: &mut Layers,
) -> Result<(), UnequalColumns> {
    let lengths = vectors
        .map(<[_]>::len)
        .into_iter()
        .chain(interval.map(<[_]>::len));
    UnequalColumns::check(&["o", "d", "a", "b", "c", "t_min", "t_max"], lengths)?;
    batch::decide_all(&batch::RowBatch { vectors, interval }, truths, layers);
    Ok(())
}

/// The truths of rays in the world and triangles that an instance puts there, as [`define_instance`] gives them: in
/// integers, some ten times as fast. `truths` is cleared first.
pub fn truths_of_instance<F: Float>(
    cases: &[Case<F>],
    instance: &Instance<F>,
    truths: &mut Vec<Truth>,
    layers: &mut Layers,
) {
    let matrix = instance.matrix().map(|row| row.map(F::to_f64));
    let is_finite = matrix.as_flattened().iter().all(|x| x.is_finite());
    truths.clear();
    truths.extend(cases.iter().map(Case::widen).map(|case| {
        let valid = is_finite && is_valid(&case);
        let scaled = if valid {
            Scaled::of_instance(&case, matrix)
        } else {
            None
        };
        layers.count(
            if scaled.is_some() {
                Layer::BigInteger
            } else {
                Layer::Invalid
            },
            1,
        );
        scaled.map_or(Truth::Invalid, |scaled| scaled.truth(&case))
    }));
}

/// The layers behind the filter.
#[inline(always)]
fn behind_the_filter<F: Float>(case: &Case<F>, layers: &mut Layers) -> Truth {
    let case = case.widen();
    // What is invalid is on no grid: it is asked for only then.
    let (truth, layer) = if let Some(truth) = grid::decide::<Narrow>(&case) {
        (truth, Layer::Grid)
    } else if let Some(truth) = on_wide_grid(&case) {
        (truth, Layer::WideGrid)
    } else if !is_valid(&case) {
        (Truth::Invalid, Layer::Invalid)
    } else {
        resolve::decide(&case)
    };
    layers.count(layer, 1);
    truth
}

#[inline(never)]
fn on_wide_grid(case: &Case<f64>) -> Option<Truth> {
    grid::decide::<Wide>(case)
}

/// Finite coordinates, a direction that is not zero, and an interval whose ends are in order.
#[inline(always)]
fn is_valid(case: &Case<f64>) -> bool {
    let vectors = case.vectors();
    // Zero unless a NaN or an infinity is among them, and without a branch for each.
    let mut nothing = 0.0;
    for x in vectors.as_flattened() {
        nothing += x * 0.0;
    }
    let ordered = case.ray.t_min <= case.ray.t_max;
    nothing == 0.0 && ordered && vectors[1] != [0.0; 3]
}

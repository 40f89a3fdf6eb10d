//! Floor 4, with the feature `proptest`: the families as proptest strategies, for tests of your own
//! kernel, and the assertions that judge it.
//!
//! ```
//! # extern crate hairline_explore as hairline;
//! use hairline::strategy::edge_exact;
//! use hairline::{Case, Contract};
//! use proptest::prelude::*;
//!
//! let contract: Contract = "closed-interval".parse().unwrap();
//!
//! // Stands for your kernel: t of a hit.
//! fn intersect(case: &Case<f32>) -> Option<f32> {
//!     # let exact = hairline_core::oracle::define(case);
//!     # let t = exact.exact.t.filter(|_| exact.truth.hits_closed() == Some(true))?;
//!     # num_traits::ToPrimitive::to_f32(&t)
//!     // …
//! }
//!
//! proptest!(|(case in edge_exact::<f32>())| {
//!     hairline::prop_assert_conforms!(intersect, contract, case);
//! });
//! ```
//!
//! A case shrinks by the same steps as `hairline fuzz shrink` takes, towards few bits and small integers, and
//! every step keeps the promise of its strategy, which the oracle checks exactly: a case of
//! [`edge_exact`] stays on an edge. Shrinking ends where no single step leads on, or at proptest's
//! `max_shrink_iters`, whose default of a few thousand rarely matters.
//!
//! To add a strategy: a row in `strategies!`.

mod conform;
mod promise;
mod tree;

pub use conform::{WrongAnswer, conforms, conforms_together};
pub use promise::StrategyPromise;
#[doc(hidden)]
pub use proptest::test_runner::TestCaseError;
pub use tree::{CaseTree, FamilyCases};

use crate::case::Case;
use crate::kernel::Scalar;
use promise::PromisedNumbers::*;
use proptest::strategy::Strategy;

/// Cases of the strategy of a name in [`STRATEGIES`], `-` written for `_`; none if there is no such.
pub fn named<F: Scalar>(name: &str) -> Option<FamilyCases<F>> {
    let promise = STRATEGIES.iter().find(|promise| promise.name() == name)?;
    Some(FamilyCases::new(vec![promise]))
}

/// Cases of any of the strategies but [`invalid`]; each keeps the promise of the one that it is from.
pub fn any_case<F: Scalar>() -> impl Strategy<Value = Case<F>> {
    let all = STRATEGIES
        .iter()
        .filter(|promise| promise.name() != "invalid" && promise.is_single());
    FamilyCases::new(all.collect()).prop_map(|cases: Vec<Case<F>>| cases[0])
}

/// Two triangles on one edge, both transversal, and one ray near or exactly through the edge. The edge
/// stays shared.
pub fn shared_edge<F: Scalar>() -> impl Strategy<Value = [Case<F>; 2]> {
    named("shared-edge")
        .expect("a row of the table")
        .prop_map(|cases| [cases[0], cases[1]])
}

macro_rules! strategies {
    ($($(#[$doc:meta])* $function:ident $name:literal $shape:expr;)*) => {
        /// One row a strategy, named as its family.
        pub static STRATEGIES: &[StrategyPromise] = &[
            $(StrategyPromise { family: $name, shape: $shape },)*
            StrategyPromise { family: "shared-edge", shape: SharedEdge },
        ];

        $(
            $(#[$doc])*
            pub fn $function<F: Scalar>() -> impl Strategy<Value = Case<F>> {
                named($name).expect("a row of the table").prop_map(|cases| cases[0])
            }
        )*
    };
}

strategies! {
    /// Transversal, within the interval, in the interior.
    interior "interior" Any;
    /// Transversal, in front of the origin, outside the triangle.
    outside "outside" Any;
    /// Transversal, within, exactly on an open edge.
    edge_exact "edge-exact" Any;
    /// Transversal, within, some ulps about an edge: in the triangle, on it and out of it.
    edge_near "edge-near" Near(1);
    /// Transversal, within, exactly on a vertex.
    vertex_exact "vertex-exact" Any;
    /// Transversal, within, some ulps about a vertex.
    vertex_near "vertex-near" Near(2);
    /// Parallel to the plane and off it, down to one ulp.
    parallel_off "parallel-off" Any;
    /// In the plane: through the interior, along an edge, through a vertex, or missing.
    coplanar "coplanar" Any;
    /// Transversal, at an angle to the plane whose sine is at most a half, and can be tiny.
    grazing "grazing" Grazing;
    /// Transversal, t = 0, on the face, an edge or a vertex.
    origin_on "origin-on" Any;
    /// Transversal, the origin some ulps before or behind the plane of the triangle.
    origin_near "origin-near" OriginNear;
    /// Transversal, in the closed triangle, at negative t.
    behind "behind" Any;
    /// Transversal, in the closed triangle, exactly at t_min or t_max.
    interval_ends "interval-ends" Any;
    /// Transversal, the longest edge at least eight times the height over it.
    sliver "sliver" Sliver;
    /// Transversal, the longest edge from 2^-42 to 2^-38.
    tiny "tiny" Size(-40);
    /// Transversal, the longest edge from 2^38 to 2^42.
    huge "huge" Size(40);
    /// Transversal, the longest edge at most an eighth of the largest coordinate of a vertex.
    far "far" Far;
    /// Transversal, along an axis.
    axis_aligned "axis-aligned" AlongAxis;
    /// The triangle is a segment or a point.
    degenerate "degenerate" Any;
    /// A NaN, an infinity, a zero direction or an impossible interval.
    invalid "invalid" Any;
}

/// Fails a proptest unless a kernel, `Fn(&Case<F>) -> Option<F>` with t of a hit, does on a case what a
/// contract demands.
#[macro_export]
macro_rules! prop_assert_conforms {
    ($kernel:expr, $contract:expr, $case:expr $(,)?) => {
        if let Err(disagreement) = $crate::strategy::conforms(&$kernel, &$contract, &$case) {
            return Err($crate::strategy::TestCaseError::fail(
                disagreement.to_string(),
            ));
        }
    };
}

/// Fails a proptest unless a kernel does on two triangles on one edge what a contract demands of each, and
/// what its [`Across`](crate::contract::Across) demands of both.
#[macro_export]
macro_rules! prop_assert_conforms_together {
    ($kernel:expr, $contract:expr, $cases:expr $(,)?) => {
        if let Err(disagreement) =
            $crate::strategy::conforms_together(&$kernel, &$contract, &$cases)
        {
            return Err($crate::strategy::TestCaseError::fail(
                disagreement.to_string(),
            ));
        }
    };
}

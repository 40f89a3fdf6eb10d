//! The data for a report's pictures: computed next to a run, on few cases, and no part of its
//! result.

use crate::audit::Trials;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The data for pictures; only where they were asked for.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Illustrations {
    /// Indices of each source that the responses are counted on, at most.
    pub indices: u64,
    /// The names of those sources.
    pub families: Vec<String>,
    /// One for each row, scalar and gate that takes an epsilon.
    pub responses: Vec<ResponsePart>,
    /// For each row and scalar: about an edge, about a vertex, grazing.
    pub maps: Vec<MapPart>,
    /// For each kernel and scalar whose formula can be recorded: what holds for every float.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub proofs: Vec<ProofPart>,
}

/// The proof about a kernel, for every float of the unit domain.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ProofPart {
    /// The kernel's name.
    pub kernel: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// Says in a sentence if, and how far, it is watertight.
    pub edges: String,
    /// By gate that compares a number.
    pub gates: BTreeMap<String, ProvedGate>,
}

/// How wrong what a gate compares can be, in units of 2^-24 in f32 and 2^-53 in f64.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ProvedGate {
    /// It is never wrong by more; none where none is proved.
    pub bound: Option<f64>,
    /// The largest error that is known.
    pub known: Option<f64>,
}

/// A picture of a kernel row's answers on the rays around one, float by float.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MapPart {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// `edge`, `vertex` or `grazing`.
    pub spot: String,
    /// Pixels of a panel, to the right and upwards.
    pub size: [u64; 2],
    /// The numbers that vary to the right, and upwards.
    pub axes: [String; 2],
    /// How many pixels are wrong.
    pub wrong: u64,
    /// The kernel's answers, each with its number of pixels.
    pub computed: Vec<(String, u64)>,
    /// The same of what is exactly true.
    pub exact: Vec<(String, u64)>,
    /// PNG in base64: computed to the left, exact to the right.
    pub png: String,
}

/// How wrong a kernel row is as one of its epsilons varies and the others stay.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ResponsePart {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// The gate's name.
    pub gate: String,
    /// The row's own epsilon, the shortest decimal of the scalar; `own` has its counts.
    pub epsilon: String,
    /// The counts of wrong answers at the row's own epsilon.
    pub own: [u64; 3],
    /// How many could be wrong: false misses, false hits that this gate is there to refuse, cracks.
    pub asked: [u64; 3],
    /// Sums over the rays of the squares of how many could be wrong on each; left out where each ray has
    /// one of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub asked_squared: Option<[u64; 3]>,
    /// True if they are a random sample.
    pub sample: bool,
    /// Epsilons in order, each with how many are wrong; constant before the first and after the last.
    /// What lies between two points lies between their counts.
    pub points: Vec<(String, [u64; 3])>,
    /// The fewest false misses, and the last epsilon with so few.
    pub misses: (u64, String),
    /// The fewest false hits that this gate is there to refuse, and the first epsilon with so few.
    pub hits: (u64, String),
}

impl ResponsePart {
    /// The share of a question that is wrong, with its 95 % interval if it is of a sample; none of
    /// nothing.
    pub fn share(&self, question: usize, counts: [u64; 3]) -> Option<(f64, Option<[f64; 2]>)> {
        let of = self.asked[question];
        let of_squared = self.asked_squared.map_or(of, |squared| squared[question]);
        let trials = Trials::alike_on_each_ray(counts[question].min(of), of, of_squared);
        let interval = || {
            let interval = trials.interval();
            [interval.low, interval.high]
        };
        trials.share().map(|share| (share, self.sample.then(interval)))
    }
}

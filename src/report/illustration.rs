//! The data for a report's pictures: computed next to a run, on few cases, and no part of its
//! result.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The data for pictures; only where they were asked for. Records of earlier versions have more of them.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Illustrations {
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

//! Proofs that a page shows beside a run: no part of its result.

use crate::arith::ScalarName;
use std::collections::BTreeMap;

/// The proofs about the kernels; only where they were asked for.
#[apply(part!)]
pub struct Illustrations {
    /// For each kernel and scalar whose formula can be recorded: what holds for every float.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub proofs: Vec<ProofPart>,
}

/// The proof about a kernel, for every float of the unit domain.
#[apply(part!)]
pub struct ProofPart {
    /// The kernel's name.
    pub kernel: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// Says in a sentence if, and how far, it is watertight.
    pub edges: String,
    /// By gate that compares a number.
    pub gates: BTreeMap<String, ProvedGate>,
}

/// How wrong what a gate compares can be, in units of 2^-24 in f32 and 2^-53 in f64.
#[apply(part!)]
pub struct ProvedGate {
    /// It is never wrong by more; none where none is proved.
    pub bound: Option<f64>,
    /// The largest error that is known.
    pub known: Option<f64>,
}

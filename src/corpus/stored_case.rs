//! A case from a corpus file, and what stands beside it.

#![forbid(unsafe_code)]

use super::Provenance;
use super::stored_truth::StoredTruth;
use crate::case::Case;

/// A case in the scalar that it was written for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyCase {
    /// In `f32`.
    F32(Case<f32>),
    /// In `f64`.
    F64(Case<f64>),
}

impl AnyCase {
    /// Whether it is of `f32`, and whether of `f64`.
    pub fn scalars(&self) -> [bool; 2] {
        match self {
            AnyCase::F32(_) => [true, false],
            AnyCase::F64(_) => [false, true],
        }
    }
}

impl From<Case<f32>> for AnyCase {
    fn from(case: Case<f32>) -> AnyCase {
        AnyCase::F32(case)
    }
}

impl From<Case<f64>> for AnyCase {
    fn from(case: Case<f64>) -> AnyCase {
        AnyCase::F64(case)
    }
}

/// A case from a corpus file, and what stands beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredCase {
    /// The case's name.
    pub name: Option<String>,
    /// The ray and the triangle.
    pub case: AnyCase,
    /// Whether the ray starts at a computed hit point on the triangle, as a shadow ray does: a hit there is a
    /// self-hit.
    pub is_secondary: bool,
    /// What the file says about it; not compared with anything yet.
    pub truth: Option<StoredTruth>,
    /// Counted from 1.
    pub line: usize,
    /// Why the case is in the file.
    pub why: Option<String>,
    /// Where it comes from.
    pub url: Option<String>,
    /// Which kernel shows what on it, if it was found by a campaign or by `fuzz triage`.
    pub found: Option<Provenance>,
}

impl StoredCase {
    /// A case with nothing beside it.
    pub fn of(case: impl Into<AnyCase>) -> StoredCase {
        let case = case.into();
        StoredCase {
            name: None,
            case,
            is_secondary: false,
            truth: None,
            line: 0,
            why: None,
            url: None,
            found: None,
        }
    }
}

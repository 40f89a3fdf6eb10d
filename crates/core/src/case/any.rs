//! Values that are of one of the two scalars.

use super::Case;
use crate::arith::Float;

/// Something in one of the two scalars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyScalar<A, B> {
    /// In `f32`.
    F32(A),
    /// In `f64`.
    F64(B),
}

impl<A, B> AnyScalar<A, B> {
    /// The scalar's name.
    pub fn scalar(&self) -> &'static str {
        match self {
            AnyScalar::F32(_) => f32::NAME,
            AnyScalar::F64(_) => f64::NAME,
        }
    }

    /// For `f32` and for `f64`, true if it is of that scalar.
    pub fn scalars(&self) -> [bool; 2] {
        [f32::NAME, f64::NAME].map(|name| name == self.scalar())
    }
}

/// A case in the scalar that it was written for.
pub type AnyCase = AnyScalar<Case<f32>, Case<f64>>;

impl<F: Float> From<Case<F>> for AnyCase {
    fn from(case: Case<F>) -> AnyCase {
        let bits = case.bits();
        match F::NAME == f32::NAME {
            true => AnyCase::F32(Case::from_bits(&bits)),
            false => AnyCase::F64(Case::from_bits(&bits)),
        }
    }
}

//! Values that are of one of the two scalars.

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

    /// Whether it is of `f32`, and whether of `f64`.
    pub fn scalars(&self) -> [bool; 2] {
        [f32::NAME, f64::NAME].map(|name| name == self.scalar())
    }
}

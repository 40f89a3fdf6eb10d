//! A mesh that a matrix puts into the world, and a face of it.

use hairline_core::case::Matrix;
use std::error::Error;
use std::fmt;

/// A mesh in the world: the vertex v of the mesh is there at M·v + m, where m is the last column of the 3x4 matrix.
///
/// The numbers of the matrix are taken as they are. Any matrix will do: one that mirrors leaves every face where it is, and one that
/// is singular makes faces flat, which are met like any other segment or point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance<F> {
    /// The mesh, by number.
    pub mesh: u32,
    /// Its rows; the last column is the translation.
    pub matrix: Matrix<F>,
}

/// A face of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlacedFace {
    /// The instance, by number.
    pub instance: u32,
    /// The face of its mesh, by number.
    pub face: u32,
}

/// The reason why an instance is no part of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InstanceError {
    /// The instance, by number.
    pub instance: u32,
    /// The reason.
    pub kind: WrongInstance,
}

/// The reasons of an [`InstanceError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrongInstance {
    /// It names a mesh that does not exist.
    NoSuchMesh,
    /// A number of the matrix is NaN or infinite.
    NotFinite,
    /// A coordinate in the world may be 2^1000 or larger.
    TooLarge,
    /// With its faces there are more than 2^32 - 2.
    TooManyFaces,
}

impl fmt::Display for InstanceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.instance;
        match self.kind {
            WrongInstance::NoSuchMesh => {
                write!(f, "instance {number} names a mesh that does not exist")
            }
            WrongInstance::NotFinite => {
                write!(f, "the matrix of instance {number} is not finite")
            }
            WrongInstance::TooLarge => {
                write!(f, "instance {number} reaches coordinates of 2^1000 or more")
            }
            WrongInstance::TooManyFaces => {
                write!(
                    f,
                    "with instance {number} there are more than 2^32 - 2 faces"
                )
            }
        }
    }
}

impl Error for InstanceError {}

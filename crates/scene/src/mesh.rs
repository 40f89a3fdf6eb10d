//! Triangles from vertices and faces.

use hairline_core::Float;
use std::error::Error;
use std::fmt;

/// Three vertices; seen from its front, a, b, c run counter-clockwise.
pub type Triangle<F> = [[F; 3]; 3];

/// The triangle of each face. An error if a face names a vertex that does not exist, or if there are too many faces.
///
/// A face may repeat another face, or have no area. A face with a NaN or an infinity is a triangle here too; rays never
/// meet it.
pub fn triangles<F: Float>(
    vertices: &[[F; 3]],
    faces: &[[u32; 3]],
) -> Result<Vec<Triangle<F>>, MeshError> {
    // Faces have u32 as their numbers, and the last one is kept free.
    if u32::MAX as usize <= faces.len() {
        return Err(MeshError::TooManyFaces);
    }
    let mut triangles = Vec::with_capacity(faces.len());
    for (face, corners) in faces.iter().enumerate() {
        let missing = corners.iter().find(|i| vertices.len() <= **i as usize);
        if let Some(vertex) = missing {
            return Err(MeshError::NoSuchVertex {
                face: face as u32,
                vertex: *vertex,
            });
        }
        triangles.push(corners.map(|i| vertices[i as usize]));
    }
    Ok(triangles)
}

/// True if all coordinates are finite.
pub(crate) fn is_finite(triangle: &Triangle<f64>) -> bool {
    triangle.as_flattened().iter().all(|x| x.is_finite())
}

/// The triangle in `f64`, which holds every `f32` exactly.
#[inline(always)]
pub(crate) fn widened<F: Float>(triangle: &Triangle<F>) -> Triangle<f64> {
    // A plain loop: arrays of arrays do not go through `map` without calls.
    let mut wide = [[0.0; 3]; 3];
    for i in 0..3 {
        for axis in 0..3 {
            wide[i][axis] = triangle[i][axis].to_f64();
        }
    }
    wide
}

/// The reason why vertices and faces are no mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshError {
    /// A face names a vertex that does not exist.
    NoSuchVertex {
        /// The face's place.
        face: u32,
        /// The vertex that it names.
        vertex: u32,
    },
    /// More than 2^32 - 2 faces.
    TooManyFaces,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MeshError::NoSuchVertex { face, vertex } => {
                write!(f, "face {face} names vertex {vertex}, which does not exist")
            }
            MeshError::TooManyFaces => f.write_str("a scene has at most 2^32 - 2 faces"),
        }
    }
}

impl Error for MeshError {}

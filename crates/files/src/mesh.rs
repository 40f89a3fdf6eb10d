//! Meshes from OBJ, PLY, STL and glTF files: triangles of `f32` and of `f64` positions.

mod builder;
#[cfg(feature = "formats")]
mod counted;
#[cfg(feature = "formats")]
mod formats;
#[cfg(feature = "formats")]
mod gltf;
#[cfg(feature = "formats")]
mod obj;
#[cfg(feature = "formats")]
mod ply;
#[cfg(feature = "formats")]
mod stl;
#[cfg(feature = "formats")]
mod text;

use crate::InputError;
use crate::arith::Float;
pub use builder::{FilePlace, Note};
#[cfg(feature = "formats")]
pub use formats::{ReadBeside, read};

/// A part of a mesh that a matrix puts into the world.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPart {
    /// The rows of the matrix; the last column is the translation.
    pub matrix: [[f64; 4]; 3],
    /// The number of its first vertex in the mesh.
    pub first: u32,
    /// Its vertices as the file has them, before the matrix.
    pub vertices: Vec<[f32; 3]>,
}

/// A mesh of triangles, as read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The file's name as given.
    pub name: String,
    /// For each vertex the `f32` nearest to each number of the file; infinite where the number is beyond
    /// the range of `f32`.
    pub positions_f32: Vec<[f32; 3]>,
    /// For each vertex the `f64` nearest to each number of the file, always finite.
    pub positions_f64: Vec<[f64; 3]>,
    /// For each triangle its three indices into the positions, in the order of the file; polygons
    /// are fans from their first vertex, or cut at their ears where that fan folds over.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the number of its face's line in the file, counted from 1; that of the face itself
    /// if the file has no lines.
    pub places: Vec<u32>,
    /// True if `places` are lines.
    pub has_lines: bool,
    /// The number of different names of groups and objects (`g`, `o`) that hold triangles in an OBJ file, of
    /// nodes that do in a glTF file; 0 in a PLY or STL file.
    pub groups: usize,
    /// The parts that a matrix other than the identity put into the world, in the order of their vertices: nodes of a glTF file.
    pub placed: Vec<PlacedPart>,
    /// Notes for the user, at most one of each kind.
    pub notes: Vec<Note>,
    /// The first 16 hexadecimal digits of the SHA-256 of the bits of all `f64` positions, all `f32`
    /// positions and all triangles' indices, little-endian.
    pub digest: String,
}

impl Mesh {
    /// The corners of a triangle in the scalar `F`, from the positions of that scalar.
    /// Panics if there is no such triangle.
    pub fn vertices<F: Float>(&self, triangle: usize) -> [[F; 3]; 3] {
        self.triangles[triangle].map(|vertex| self.position(vertex))
    }

    /// A vertex's position in the scalar `F`. Panics if there is no such vertex.
    pub fn position<F: Float>(&self, vertex: u32) -> [F; 3] {
        if F::DIGITS == f32::MANTISSA_DIGITS {
            self.positions_f32[vertex as usize].map(|x| F::from_f64(f64::from(x)))
        } else {
            self.positions_f64[vertex as usize].map(F::from_f64)
        }
    }

    /// The part that a triangle is of, and its corners there, before the matrix. None if no matrix moved it. Panics if there is no
    /// such triangle.
    pub fn before_matrix(&self, triangle: usize) -> Option<(&PlacedPart, [[f32; 3]; 3])> {
        let corners = self.triangles[triangle];
        let parts = self.placed.partition_point(|part| part.first <= corners[0]);
        let part = &self.placed[parts.checked_sub(1)?];
        let corner = |vertex: u32| part.vertices.get((vertex - part.first) as usize).copied();
        let [a, b, c] = corners.map(corner);
        Some((part, [a?, b?, c?]))
    }

    /// The note on the polygons of the file that are not in the mesh, if there are any.
    pub fn left_out(&self) -> Option<&Note> {
        self.notes
            .iter()
            .find(|note| note.message == builder::LEFT_OUT)
    }
}

#[cfg(test)]
mod tests;

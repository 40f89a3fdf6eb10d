//! Meshes from OBJ, PLY and glTF files: triangles of `f32` and of `f64` positions.

mod builder;
mod counted;
mod obj;

#[cfg(feature = "cli")]
mod formats;
#[cfg(feature = "cli")]
mod gltf;
#[cfg(feature = "cli")]
mod ply;

use super::InputError;
use super::shapes::Shape;
use crate::arith::Float;
pub use builder::{Note, Place};
use counted::Counted;
#[cfg(feature = "cli")]
pub use formats::{Beside, read};
use std::io::{self, BufRead, Write};

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
    /// are fans from their first vertex.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the number of its face's line in the file, counted from 1; that of the face itself
    /// if the file has no lines.
    pub places: Vec<u32>,
    /// Whether `places` are lines.
    pub has_lines: bool,
    /// The number of different names of groups and objects (`g`, `o`) that hold triangles in an OBJ file, of
    /// nodes that do in a glTF file; 0 in a PLY file.
    pub groups: usize,
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
}

/// How much is read before a file is an error.
#[derive(Clone, Copy)]
struct Limits {
    /// Bytes in a line, with what is joined to it by backslashes in an OBJ file; in the header of a PLY file.
    line: usize,
    /// Vertices, and triangles after polygons are cut up.
    elements: usize,
}

/// One MiB, and what 32-bit indices hold with room to spare.
const LIMITS: Limits = Limits { line: 1 << 20, elements: 100_000_000 };

/// Reads an OBJ file: `v`, `f`, `o` and `g` count; materials, normals and textures are ignored; anything
/// else gets a note. `name` is for messages and for [`Mesh::name`]; `progress` is called
/// about every MiB with the number of bytes read so far, and once at the end.
///
/// Polygons are cut into the fan from their first vertex. Those whose fan folds over itself or is
/// bent by a right angle or more, which many concave ones do, are left out with a note. Triangles
/// without area are kept with a note.
///
/// It is an error if the file cannot be read, is not UTF-8 or has a line above 1 MiB; if a number is
/// malformed or not finite in `f64`; if a face has fewer than three vertices, or one that the file does
/// not have; if there are no vertices or no triangles, or more than 100 million of either.
pub fn read_obj<R: BufRead>(
    reader: R,
    name: &str,
    progress: &mut dyn FnMut(u64),
) -> Result<Mesh, InputError> {
    read_within(reader, name, LIMITS, progress)
}

fn read_within<R: BufRead>(
    reader: R,
    name: &str,
    limits: Limits,
    progress: &mut dyn FnMut(u64),
) -> Result<Mesh, InputError> {
    let mut reader = Counted::new(reader, progress);
    let mesh = obj::read(&mut reader, name, limits)?;
    reader.finish();
    Ok(mesh)
}

/// Writes a shape as an OBJ file. Numbers have the fewest digits that read back as the same `f64`,
/// with an exponent below 1e-5 and from 1e16. Errors are those of `out`.
pub fn write_obj(mesh: &Shape, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "# {}\no {}", mesh.about, mesh.name)?;
    for position in &mesh.vertices {
        let [x, y, z] = position.map(number_text);
        writeln!(out, "v {x} {y} {z}")?;
    }
    for face in &mesh.faces {
        out.write_all(b"f")?;
        for vertex in face {
            write!(out, " {}", u64::from(*vertex) + 1)?;
        }
        writeln!(out)?;
    }
    Ok(())
}

pub(crate) fn number_text(value: f64) -> String {
    let plain = value == 0.0 || (1e-5..1e16).contains(&value.abs());
    if plain { format!("{value}") } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests;

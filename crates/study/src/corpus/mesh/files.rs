//! OBJ files: reading and writing.

use super::counted::{Counted, LIMITS, ReadLimits};
use super::{Mesh, obj};
use crate::corpus::InputError;
use crate::corpus::shapes::MadeMesh;
use std::io::{self, BufRead, Write};

/// Reads an OBJ file: `v`, `f`, `o` and `g` count; materials, normals and textures are ignored; anything
/// else gets a note. `name` is for messages and for [`Mesh::name`]; `progress` is called
/// about every MiB with the number of bytes read so far, and once at the end.
///
/// Polygons are cut into the fan from their first vertex. Where that fan folds over itself or is
/// bent by a right angle or more, as those of many concave ones do, one ear after the other is cut off. Those for which
/// this does not do either, because they cross themselves, are left out with a note. Triangles
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

pub(super) fn read_within<R: BufRead>(
    reader: R,
    name: &str,
    limits: ReadLimits,
    progress: &mut dyn FnMut(u64),
) -> Result<Mesh, InputError> {
    let mut reader = Counted::new(reader, progress);
    let mesh = obj::read(&mut reader, name, limits)?;
    reader.finish();
    Ok(mesh)
}

/// Writes a shape as an OBJ file. Numbers have the fewest digits that read back as the same `f64`,
/// with an exponent below 1e-5 and from 1e16. Errors are those of `out`.
pub fn write_obj(mesh: &MadeMesh, out: &mut impl Write) -> io::Result<()> {
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

/// A number as the OBJ format reads it, the shortest.
pub fn number_text(value: f64) -> String {
    let plain = value == 0.0 || (1e-5..1e16).contains(&value.abs());
    if plain { format!("{value}") } else { format!("{value:e}") }
}

//! Meshes from OBJ files: triangles of `f32` and of `f64` positions, each nearest to the text.
//!
//! The file's text is read here, so that errors carry their line and numbers keep their digits;
//! tobj then sorts faces into groups and polygons, on vertices that are placeholders for their index.

pub use super::obj::Note;
use super::obj::{self, LIMITS, Limits, Notes, Source};
use super::shapes::Shape;
use super::{InputError, fan};
use crate::arith::Float;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::io::{self, BufRead, Read, Write};

/// A mesh of triangles, as read from an OBJ file.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The file's name as given.
    pub name: String,
    /// For each vertex the `f32` nearest to each number's text; infinite where the text is beyond
    /// the range of `f32`.
    pub positions_f32: Vec<[f32; 3]>,
    /// For each vertex the `f64` nearest to each number's text, always finite.
    pub positions_f64: Vec<[f64; 3]>,
    /// For each triangle its three indices into the positions, in the order of the file; polygons
    /// are fans from their first vertex.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the line number of its face in the file, counted from 1.
    pub lines: Vec<u32>,
    /// The number of different names of groups and objects (`g`, `o`) that hold triangles.
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
    let mut source = obj::read(reader, name, limits, progress)?;
    let models = models_by_tobj(&source, name)?;
    source.text = Vec::new();
    let mut triangles = Vec::with_capacity(source.triangles);
    let mut lines = Vec::with_capacity(source.triangles);
    let mut groups = BTreeSet::new();
    let mut face_lines = source.face_lines.into_iter();
    let mut notes = source.notes;
    for model in models {
        let before = triangles.len();
        for (face, line) in faces(&model.mesh).zip(face_lines.by_ref()) {
            add_face(&face, line, &source.positions_f64, &mut triangles, &mut notes);
            lines.resize(triangles.len(), line);
        }
        if triangles.len() > before && model.name != UNNAMED {
            groups.insert(model.name);
        }
    }
    debug_assert_eq!(face_lines.len(), 0, "tobj gives back every face");
    if triangles.is_empty() {
        return Err(InputError::of(name, format!("the file has no triangles: {FOLDED}")));
    }
    let digest = digest(&source.positions_f64, &source.positions_f32, &triangles);
    Ok(Mesh {
        name: name.to_owned(),
        positions_f32: source.positions_f32,
        positions_f64: source.positions_f64,
        triangles,
        lines,
        groups: groups.len(),
        notes: notes.0,
        digest,
    })
}

/// What tobj calls faces that no `o` or `g` line names.
const UNNAMED: &str = "unnamed_object";
const FOLDED: &str = "polygons left out because their fan of triangles folds over";
const NO_AREA: &str = "triangles without area, kept";

/// Has tobj read the faces and groups, with vertices whose first coordinate is their index.
fn models_by_tobj(source: &Source, name: &str) -> Result<Vec<tobj::Model>, InputError> {
    let mut vertices = Vec::new();
    for index in 0..source.positions_f64.len() {
        writeln!(vertices, "v {index} 0 0").map_err(|e| InputError::of(name, e.to_string()))?;
    }
    let mut unread = source.text.as_slice();
    let mut reader = vertices.as_slice().chain(&mut unread);
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    // Neither triangulate nor single_index: polygons stay whole, vertices are what they were.
    match tobj::load_obj_buf(&mut reader, &tobj::LoadOptions::default(), no_materials) {
        Ok((models, _)) => Ok(models),
        Err(error) => {
            let read = &source.text[..source.text.len() - unread.len()];
            let faces = read.split(|byte| *byte == b'\n').filter(|l| l.starts_with(b"f")).count();
            let line = source.face_lines.get(faces.saturating_sub(1)).map(|line| *line as usize);
            Err(InputError { line, ..InputError::of(name, format!("tobj: {error}")) })
        }
    }
}

/// The vertices of each face, as indices into the file's vertices.
fn faces(mesh: &tobj::Mesh) -> impl Iterator<Item = Vec<u32>> {
    let mut rest = mesh.indices.as_slice();
    let mut arities = mesh.face_arities.iter();
    std::iter::from_fn(move || {
        // A mesh of triangles only has no arities.
        let arity = arities.next().map_or(3, |arity| *arity as usize);
        let (face, after) = rest.split_at_checked(arity)?;
        rest = after;
        Some(face.iter().map(|vertex| mesh.positions[*vertex as usize * 3] as u32).collect())
    })
}

/// Adds the fan of a face, or a note that it is left out.
fn add_face(
    face: &[u32],
    line: u32,
    positions: &[[f64; 3]],
    triangles: &mut Vec<[u32; 3]>,
    notes: &mut Notes,
) {
    if face.len() > 3 {
        let corners: Vec<[f64; 3]> = face.iter().map(|v| positions[*v as usize]).collect();
        if fan::folds(&corners) {
            notes.count(FOLDED, line as usize);
            return;
        }
    }
    for pair in face[1..].windows(2) {
        let triangle = [face[0], pair[0], pair[1]];
        if fan::is_without_area(triangle.map(|vertex| positions[vertex as usize])) {
            notes.count(NO_AREA, line as usize);
        }
        triangles.push(triangle);
    }
}

fn digest(wide: &[[f64; 3]], narrow: &[[f32; 3]], triangles: &[[u32; 3]]) -> String {
    let mut hash = Sha256::new();
    for coordinate in wide.as_flattened() {
        hash.update(coordinate.to_bits().to_le_bytes());
    }
    for coordinate in narrow.as_flattened() {
        hash.update(coordinate.to_bits().to_le_bytes());
    }
    for index in triangles.as_flattened() {
        hash.update(index.to_le_bytes());
    }
    hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
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

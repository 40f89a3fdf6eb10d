//! The builder that every reader of meshes fills: vertices, then faces as fans of triangles, and notes.

use super::{InputError, Mesh, PlacedPart};
use crate::{fan, polygon};
use hmac_sha256::Hash;
use std::fmt;

/// A place in a file, as a number counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilePlace {
    /// A line of a text.
    Line(usize),
    /// A vertex of a file without lines.
    Vertex(usize),
    /// A face of a file without lines.
    Face(usize),
}

impl FilePlace {
    /// The number.
    pub fn number(self) -> usize {
        let (FilePlace::Line(number) | FilePlace::Vertex(number) | FilePlace::Face(number)) = self;
        number
    }
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FilePlace::Line(number) => write!(f, "line {number}"),
            FilePlace::Vertex(number) => write!(f, "vertex {number}"),
            FilePlace::Face(number) => write!(f, "face {number}"),
        }
    }
}

/// Something in a file that was skipped, altered or suspect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Where it was found first.
    pub first: Option<FilePlace>,
    /// How often it was found.
    pub count: usize,
    /// The finding and what was done about it, without the count.
    pub message: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message, self.count)?;
        self.first
            .map_or(Ok(()), |first| write!(f, " (first at {first})"))
    }
}

/// A mesh that is being read.
#[derive(Default)]
pub(super) struct MeshBuilder {
    pub positions_f32: Vec<[f32; 3]>,
    pub positions_f64: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    places: Vec<u32>,
    pub placed: Vec<PlacedPart>,
    notes: Vec<Note>,
    /// True if faces are counted instead of lines.
    without_lines: bool,
}

const OVERFLOW: &str = "f32 overflow: vertices with an infinite coordinate in f32";
/// The note on faces that are not in the mesh.
pub(super) const LEFT_OUT: &str = "polygons left out, because they cross themselves or fold over";
const NO_AREA: &str = "triangles without area, kept";

impl MeshBuilder {
    /// For a file without lines.
    #[cfg(feature = "formats")]
    pub fn without_lines() -> MeshBuilder {
        MeshBuilder {
            without_lines: true,
            ..MeshBuilder::default()
        }
    }

    /// Counts one more note of a kind; the place is kept if it is the first.
    pub fn note(&mut self, message: &str, first: Option<FilePlace>) {
        match self.notes.iter_mut().find(|note| note.message == message) {
            Some(note) => note.count += 1,
            None => self.notes.push(Note {
                first,
                count: 1,
                message: message.to_owned(),
            }),
        }
    }

    /// Adds a vertex, which is finite in `f64`.
    pub fn vertex(&mut self, wide: [f64; 3], narrow: [f32; 3], place: FilePlace) {
        if narrow.iter().any(|coordinate| coordinate.is_infinite()) {
            self.note(OVERFLOW, Some(place));
        }
        self.positions_f32.push(narrow);
        self.positions_f64.push(wide);
    }

    pub fn vertices(&self) -> usize {
        self.positions_f64.len()
    }

    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Adds the triangles of a face, or counts it as left out. Its vertices exist; `number` counts lines or
    /// faces.
    pub fn face(&mut self, corners: &[u32], number: u32) {
        let count = number as usize;
        let place = if self.without_lines {
            FilePlace::Face(count)
        } else {
            FilePlace::Line(count)
        };
        if let Ok(triangle) = corners.try_into() {
            return self.triangle(triangle, number, place);
        }
        let positions: Vec<[f64; 3]> = corners
            .iter()
            .map(|vertex| self.positions_f64[*vertex as usize])
            .collect();
        match polygon::triangles(&positions) {
            Some(triangles) => triangles
                .into_iter()
                .for_each(|it| self.triangle(it.map(|corner| corners[corner]), number, place)),
            None => self.note(LEFT_OUT, Some(place)),
        }
    }

    fn triangle(&mut self, triangle: [u32; 3], number: u32, place: FilePlace) {
        if fan::is_without_area(triangle.map(|vertex| self.positions_f64[vertex as usize])) {
            self.note(NO_AREA, Some(place));
        }
        self.triangles.push(triangle);
        self.places.push(number);
    }

    /// The mesh; an error if it has no triangles.
    pub fn finish(self, name: &str, groups: usize) -> Result<Mesh, InputError> {
        if self.triangles.is_empty() {
            let notes: Vec<String> = self.notes.iter().map(Note::to_string).collect();
            let why = if notes.is_empty() { "" } else { ": " };
            let message = format!("the file has no triangles{why}{}", notes.join("; "));
            return Err(InputError::of(name, message));
        }
        Ok(Mesh {
            name: name.to_owned(),
            digest: digest(&self.positions_f64, &self.positions_f32, &self.triangles),
            positions_f32: self.positions_f32,
            positions_f64: self.positions_f64,
            triangles: self.triangles,
            places: self.places,
            has_lines: !self.without_lines,
            groups,
            placed: self.placed,
            notes: self.notes,
        })
    }
}

fn digest(wide: &[[f64; 3]], narrow: &[[f32; 3]], triangles: &[[u32; 3]]) -> String {
    let mut hash = Hash::new();
    wide.as_flattened()
        .iter()
        .for_each(|x| hash.update(x.to_le_bytes()));
    narrow
        .as_flattened()
        .iter()
        .for_each(|x| hash.update(x.to_le_bytes()));
    triangles
        .as_flattened()
        .iter()
        .for_each(|index| hash.update(index.to_le_bytes()));
    hash.finalize()
        .iter()
        .take(8)
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// As `8 vertices`.
pub(super) fn vertices_text(count: usize) -> String {
    format!("{count} {}", if count == 1 { "vertex" } else { "vertices" })
}

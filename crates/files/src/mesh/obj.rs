//! OBJ files: numbers from their text, indices checked, everything with its line.
//!
//! The file's text is read here, so that errors carry their line and numbers keep their digits; tobj then
//! sorts faces into groups and polygons, on vertices that are placeholders for their index.

use super::builder::{FilePlace, MeshBuilder, vertices_text};
use super::counted::ReadLimits;
use super::text::{Statements, coordinate};
use super::{InputError, Mesh};
use crate::json::{excerpt, quoted};
use std::collections::BTreeSet;
use std::io::{BufRead, Read, Write};
use std::num::IntErrorKind;

/// Reads a whole file. Errors carry the line.
pub(super) fn read(
    reader: impl BufRead,
    name: &str,
    limits: ReadLimits,
) -> Result<Mesh, InputError> {
    let mut source = ObjSource::of(reader, name, limits)?;
    let models = source.models_by_tobj(name)?;
    source.text = String::new();
    let mut mesh = source.mesh;
    let mut groups = BTreeSet::new();
    let mut face_lines = source.face_lines.into_iter();
    for model in models {
        let before = mesh.triangles();
        for (face, line) in faces(&model.mesh).zip(face_lines.by_ref()) {
            mesh.face(&face, line);
        }
        if mesh.triangles() > before && model.name != UNNAMED {
            groups.insert(model.name);
        }
    }
    debug_assert_eq!(face_lines.len(), 0, "tobj gives back every face");
    mesh.finish(name, groups.len())
}

/// The name that tobj gives to faces that no `o` or `g` line names.
const UNNAMED: &str = "unnamed_object";

/// The vertices of each face, as indices into the file's vertices.
fn faces(mesh: &tobj::Mesh) -> impl Iterator<Item = Vec<u32>> {
    let mut rest = mesh.indices.as_slice();
    let mut arities = mesh.face_arities.iter();
    std::iter::from_fn(move || {
        // A mesh of triangles only has no arities.
        let arity = arities.next().map_or(3, |arity| *arity as usize);
        let (face, after) = rest.split_at_checked(arity)?;
        rest = after;
        Some(
            face.iter()
                .map(|vertex| mesh.positions[*vertex as usize * 3] as u32)
                .collect(),
        )
    })
}

/// The contents of a file's lines.
#[derive(Default)]
pub(super) struct ObjSource {
    /// The vertices.
    pub mesh: MeshBuilder,
    /// The `f` lines with absolute vertex indices alone, and the `o` and `g` lines as `g` lines.
    pub text: String,
    /// For each `f` line its line number in the file.
    pub face_lines: Vec<u32>,
    /// Triangles that the faces make, if none is left out.
    triangles: usize,
    /// The largest index of a face, counted from 1, and the first line that names it.
    largest: (i64, usize),
}

impl ObjSource {
    fn of(reader: impl BufRead, name: &str, limits: ReadLimits) -> Result<ObjSource, InputError> {
        let mut source = ObjSource::default();
        let mut lines = Statements::new(reader, name, limits.line);
        while let Some(line) = lines.next_statement()? {
            source
                .statement(&lines.statement, line, limits.elements)
                .map_err(|message| InputError::at(name, line, message))?;
        }
        let vertices = source.mesh.vertices();
        if vertices == 0 {
            return Err(InputError::of(name, "the file has no vertices"));
        }
        if source.face_lines.is_empty() {
            return Err(InputError::of(name, "the file has no faces"));
        }
        let (largest, line) = source.largest;
        if largest > vertices as i64 {
            let count = vertices_text(vertices);
            let message = format!("face names vertex {largest} but the file has only {count}");
            return Err(InputError::at(name, line, message));
        }
        Ok(source)
    }

    /// Has tobj read the faces and groups, with vertices whose first coordinate is their index.
    pub(super) fn models_by_tobj(&self, name: &str) -> Result<Vec<tobj::Model>, InputError> {
        let mut vertices = Vec::new();
        for index in 0..self.mesh.vertices() {
            writeln!(vertices, "v {index} 0 0").map_err(|e| InputError::of(name, e.to_string()))?;
        }
        let mut unread = self.text.as_bytes();
        let mut reader = vertices.as_slice().chain(&mut unread);
        let no_materials = |_: &std::path::Path| Ok(Default::default());
        // Neither triangulate nor single_index: polygons stay whole, vertices are what they were.
        match tobj::load_obj_buf(&mut reader, &tobj::LoadOptions::default(), no_materials) {
            Ok((models, _)) => Ok(models),
            Err(error) => {
                let read = &self.text[..self.text.len() - unread.len()];
                let faces = read.lines().filter(|line| line.starts_with('f')).count();
                let line = self
                    .face_lines
                    .get(faces.saturating_sub(1))
                    .map(|line| *line as usize);
                Err(InputError {
                    line,
                    ..InputError::of(name, format!("tobj: {error}"))
                })
            }
        }
    }

    fn note(&mut self, message: &str, line: usize) {
        self.mesh.note(message, Some(FilePlace::Line(line)));
    }

    fn statement(&mut self, text: &str, line: usize, limit: usize) -> Result<(), String> {
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => return self.vertex(words, line, limit),
            Some("f") => return self.face(words, line, limit),
            Some("o" | "g") => {
                self.text.push('g');
                words.for_each(|word| self.text.extend([" ", word]));
                self.text.push('\n');
            }
            Some("l" | "p") => self.note("lines and points (l, p) skipped", line),
            None | Some("vt" | "vn" | "vp" | "s" | "usemtl" | "mtllib") => {}
            Some(_) => self.note("unknown statements skipped", line),
        }
        Ok(())
    }

    fn vertex<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        line: usize,
        limit: usize,
    ) -> Result<(), String> {
        if self.mesh.vertices() >= limit {
            return Err(format!("more than {limit} vertices"));
        }
        let (mut narrow, mut wide) = ([0.0f32; 3], [0.0f64; 3]);
        let (mut count, mut weight) = (0, 1.0);
        for word in words {
            let number = |_| format!("vertex has {}, which is not a number", quoted(word));
            match count {
                0..3 => (wide[count], narrow[count]) = coordinate(word)?,
                3 => weight = word.parse().map_err(number)?,
                _ => drop(word.parse::<f64>().map_err(number)?),
            }
            count += 1;
        }
        match count {
            0..3 => return Err(format!("vertex has {count} of 3 coordinates")),
            3..=8 => {}
            _ => {
                return Err(format!(
                    "vertex has {count} numbers; x y z w r g b a are the most"
                ));
            }
        }
        if count == 4 && weight != 1.0 {
            self.note("weights (w) other than 1 ignored", line);
        }
        self.mesh.vertex(wide, narrow, FilePlace::Line(line));
        Ok(())
    }

    fn face<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        line: usize,
        limit: usize,
    ) -> Result<(), String> {
        let vertices = self.mesh.vertices();
        let mut corners = 0;
        self.text.push('f');
        for word in words {
            let mut index = face_vertex(word)?;
            if index == 0 {
                return Err("face names vertex 0, but vertices count from 1".to_owned());
            }
            if index < 0 {
                let given = index;
                index += vertices as i64 + 1;
                if index < 1 {
                    let count = vertices_text(vertices);
                    let verb = if vertices == 1 { "precedes" } else { "precede" };
                    return Err(format!(
                        "face names vertex {given} but only {count} {verb} it"
                    ));
                }
            }
            if index > self.largest.0 {
                self.largest = (index, line);
            }
            self.text += &format!(" {index}");
            corners += 1;
        }
        self.text.push('\n');
        if corners < 3 {
            return Err(format!("face has {corners} of at least 3 vertices"));
        }
        self.triangles += corners - 2;
        if self.triangles > limit {
            return Err(format!("more than {limit} triangles"));
        }
        // `Lines` stops before a line number leaves 32 bits.
        self.face_lines.push(line as u32);
        Ok(())
    }
}

/// The vertex index of `v`, `v/vt`, `v//vn` or `v/vt/vn`; the others must be integers or missing.
fn face_vertex(word: &str) -> Result<i64, String> {
    let mut parts = word.split('/');
    let vertex = parts.next().unwrap_or_default();
    let mut rest = 0;
    let sound = parts.all(|part| {
        rest += 1;
        rest <= 2 && (part.is_empty() || part.parse::<i64>().is_ok())
    });
    match vertex.parse() {
        Ok(index) if sound => Ok(index),
        Err(error)
            if matches!(
                error.kind(),
                IntErrorKind::PosOverflow | IntErrorKind::NegOverflow
            ) =>
        {
            Err(format!(
                "face names vertex {}, which no file has",
                excerpt(vertex)
            ))
        }
        _ => Err(format!(
            "face has {} for v, v/vt, v//vn or v/vt/vn",
            quoted(word)
        )),
    }
}

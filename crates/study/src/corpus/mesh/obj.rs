//! OBJ files: numbers from their text, indices checked, everything with its line.

use super::builder::{Faces, FilePlace, MeshBuilder, vertices_text};
use super::counted::ReadLimits;
use super::text::{Statements, coordinate};
use super::{InputError, Mesh};
use crate::corpus::json::{excerpt, quoted};
use std::collections::BTreeSet;
use std::io::BufRead;
use std::num::IntErrorKind;

/// Reads a whole file. Errors carry the line.
pub(super) fn read(
    reader: impl BufRead,
    name: &str,
    limits: ReadLimits,
) -> Result<Mesh, InputError> {
    let ObjSource { mut mesh, faces, groups, group_of_face } = ObjSource::of(reader, name, limits)?;
    let mut filled = BTreeSet::new();
    for ((corners, line), group) in faces.each().zip(group_of_face) {
        let before = mesh.triangles();
        mesh.face(corners, line);
        if mesh.triangles() > before {
            filled.insert(&groups[group]);
        }
    }
    mesh.finish(name, filled.iter().filter(|group| !group.is_empty()).count())
}

/// The contents of a file's lines.
#[derive(Default)]
struct ObjSource {
    /// The vertices.
    mesh: MeshBuilder,
    faces: Faces,
    /// An empty name, and those in the `o` and `g` lines.
    groups: Vec<String>,
    /// For each face the place of its group among the names.
    group_of_face: Vec<usize>,
}

impl ObjSource {
    fn of(reader: impl BufRead, name: &str, limits: ReadLimits) -> Result<ObjSource, InputError> {
        let mut source = ObjSource { groups: vec![String::new()], ..ObjSource::default() };
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
        if source.group_of_face.is_empty() {
            return Err(InputError::of(name, "the file has no faces"));
        }
        if let Some((largest, line)) = source.faces.beyond(vertices) {
            let count = vertices_text(vertices);
            let largest = u64::from(largest) + 1;
            let message = format!("face names vertex {largest} but the file has only {count}");
            return Err(InputError::at(name, line, message));
        }
        Ok(source)
    }

    fn note(&mut self, message: &str, line: usize) {
        self.mesh.note(message, Some(FilePlace::Line(line)));
    }

    fn statement(&mut self, text: &str, line: usize, limit: usize) -> Result<(), String> {
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => return self.vertex(words, line, limit),
            Some("f") => return self.face(words, line, limit),
            Some("o" | "g") => self.groups.push(words.collect::<Vec<_>>().join(" ")),
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
            _ => return Err(format!("vertex has {count} numbers; x y z w r g b a are the most")),
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
        let mut corners = Vec::with_capacity(4);
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
                    return Err(format!("face names vertex {given} but only {count} {verb} it"));
                }
            }
            let corner = u32::try_from(index - 1);
            corners
                .push(corner.map_err(|_| format!("face names vertex {index}, which no file has"))?);
        }
        if corners.len() < 3 {
            return Err(format!("face has {} of at least 3 vertices", corners.len()));
        }
        // `Statements` stops before a line number leaves 32 bits.
        self.faces.add(&corners, line, limit)?;
        self.group_of_face.push(self.groups.len() - 1);
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
            if matches!(error.kind(), IntErrorKind::PosOverflow | IntErrorKind::NegOverflow) =>
        {
            Err(format!("face names vertex {}, which no file has", excerpt(vertex)))
        }
        _ => Err(format!("face has {} for v, v/vt, v//vn or v/vt/vn", quoted(word))),
    }
}

//! OBJ files: numbers from their text, indices checked, everything with its line.

use super::builder::{Builder, Faces, Place, quoted, shortened, vertices_text};
use super::{InputError, Limits, Mesh};
use std::collections::BTreeSet;
use std::io::{BufRead, Read};
use std::num::IntErrorKind;

/// Reads a whole file. Errors carry the line.
pub(super) fn read(reader: impl BufRead, name: &str, limits: Limits) -> Result<Mesh, InputError> {
    let Source { mut mesh, faces, groups } = Source::of(reader, name, limits)?;
    let mut starts = groups.into_iter().peekable();
    let (mut group, mut filled) = (String::new(), BTreeSet::new());
    for (i, (face, line)) in faces.iter().enumerate() {
        while let Some((_, name)) = starts.next_if(|(start, _)| *start <= i) {
            group = name;
        }
        let before = mesh.triangles();
        mesh.face(face, line);
        if mesh.triangles() > before && !group.is_empty() && !filled.contains(&group) {
            filled.insert(group.clone());
        }
    }
    mesh.finish(name, filled.len())
}

/// What a file's lines hold.
#[derive(Default)]
struct Source {
    /// The vertices.
    mesh: Builder,
    faces: Faces,
    /// For each `o` or `g` line how many faces stand before it, and the name, which may be empty.
    groups: Vec<(usize, String)>,
}

impl Source {
    fn of(reader: impl BufRead, name: &str, limits: Limits) -> Result<Source, InputError> {
        let mut source = Source::default();
        let mut lines = Lines::new(reader, name, limits.line);
        while let Some(line) = lines.next_statement()? {
            source
                .statement(&lines.statement, line, limits.elements)
                .map_err(|message| InputError::at(name, line, message))?;
        }
        let vertices = source.mesh.vertices();
        if vertices == 0 {
            return Err(InputError::of(name, "the file has no vertices"));
        }
        if source.faces.len() == 0 {
            return Err(InputError::of(name, "the file has no faces"));
        }
        if let Some((largest, line)) = source.faces.beyond(vertices) {
            let count = vertices_text(vertices);
            let message = format!("face names vertex {largest} but the file has only {count}");
            return Err(InputError::at(name, line as usize, message));
        }
        Ok(source)
    }

    fn note(&mut self, message: &str, line: usize) {
        self.mesh.note(message, Some(Place::Line(line)));
    }

    fn statement(&mut self, text: &str, line: usize, limit: usize) -> Result<(), String> {
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => return self.vertex(words, line, limit),
            Some("f") => return self.face(words, line, limit),
            Some("o" | "g") => {
                self.groups.push((self.faces.len(), words.collect::<Vec<_>>().join(" ")));
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
            let value: f64 = word.parse().map_err(number)?;
            if count < 3 {
                if !value.is_finite() {
                    let overflow = word.bytes().any(|byte| byte.is_ascii_digit());
                    let what = if overflow { "overflows f64" } else { "is not finite" };
                    return Err(format!("vertex has {}, which {what}", quoted(word)));
                }
                wide[count] = value;
                // From the text: a cast of the f64 would round twice.
                narrow[count] = word.parse().map_err(number)?;
            } else if count == 3 {
                weight = value;
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
        self.mesh.vertex(wide, narrow, Place::Line(line));
        Ok(())
    }

    fn face<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        line: usize,
        limit: usize,
    ) -> Result<(), String> {
        let vertices = self.mesh.vertices();
        let mut corners = Vec::new();
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
            corners.push(index - 1);
        }
        if corners.len() < 3 {
            return Err(format!("face has {} of at least 3 vertices", corners.len()));
        }
        // `Lines` stops before a line number leaves 32 bits.
        self.faces.add(&corners, line as u32, limit)
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
            Err(format!("face names vertex {}, which no file has", shortened(vertex)))
        }
        _ => Err(format!("face has {} for v, v/vt, v//vn or v/vt/vn", quoted(word))),
    }
}

/// Goes through a text statement by statement: a line, or lines joined by backslashes at their
/// ends, without comment.
struct Lines<'a, R> {
    reader: R,
    name: &'a str,
    limit: usize,
    /// Lines read so far.
    number: usize,
    raw: Vec<u8>,
    statement: String,
}

impl<'a, R: BufRead> Lines<'a, R> {
    fn new(reader: R, name: &'a str, limit: usize) -> Self {
        Lines { reader, name, limit, number: 0, raw: Vec::new(), statement: String::new() }
    }

    /// Reads the next statement, perhaps an empty one, and gives the number of its first line.
    fn next_statement(&mut self) -> Result<Option<usize>, InputError> {
        self.statement.clear();
        let first = self.number + 1;
        while self.read_line(first)? {
            let text = checked_line(&self.raw, self.number)
                .map_err(|message| InputError::at(self.name, self.number, message))?;
            let text = without_comment(text).trim_end();
            let joined = text.strip_suffix('\\');
            self.statement.push_str(joined.unwrap_or(text));
            if joined.is_none() {
                return Ok(Some(first));
            }
            self.statement.push(' ');
        }
        // The end of the file ends a line, and a backslash before it joins nothing.
        Ok((self.number >= first).then_some(first))
    }

    /// Reads one line into `raw`, no further than the limit; false at the end of the file.
    fn read_line(&mut self, first: usize) -> Result<bool, InputError> {
        self.raw.clear();
        let room = (self.limit + 1).saturating_sub(self.statement.len());
        let read = (&mut self.reader)
            .take(room as u64)
            .read_until(b'\n', &mut self.raw)
            .map_err(|error| InputError::reading(self.name, Some(self.number + 1), &error))?;
        if read == 0 {
            return Ok(false);
        }
        self.number += 1;
        if read >= room {
            let message = format!("a line of more than {} bytes", self.limit);
            return Err(InputError::at(self.name, first, message));
        }
        if self.number > u32::MAX as usize {
            return Err(InputError::at(self.name, self.number, "more lines than 32 bits count"));
        }
        Ok(true)
    }
}

/// A line as text, without its end and without the byte order mark of a file's first line.
fn checked_line(raw: &[u8], number: usize) -> Result<&str, &'static str> {
    let text = std::str::from_utf8(raw).map_err(|_| "not UTF-8 text")?;
    let text = text.strip_prefix('\u{feff}').filter(|_| number == 1).unwrap_or(text);
    let text = text.trim_end_matches(['\n', '\r']);
    if text.contains('\0') {
        return Err("a zero byte: not a text file");
    }
    if text.contains('\r') {
        return Err("a carriage return within a line: lines end in LF or CR LF");
    }
    Ok(text)
}

/// Up to a `#` that starts the line or follows a blank: `1.#INF` is not a one.
fn without_comment(text: &str) -> &str {
    let starts = |at: usize| at == 0 || text.as_bytes()[at - 1].is_ascii_whitespace();
    text.match_indices('#').find(|(at, _)| starts(*at)).map_or(text, |(at, _)| &text[..at])
}

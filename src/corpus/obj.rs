//! The lines of an OBJ file: numbers from their text, indices checked, everything with its line.
//!
//! tobj then reads a text of faces and groups with absolute indices only.

use super::InputError;
use std::fmt;
use std::io::{BufRead, Read, Write};
use std::num::IntErrorKind;

/// How much is read before a file is an error.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// Bytes in a line, with what is joined to it by backslashes.
    pub line: usize,
    /// Vertices, and triangles after polygons are cut up.
    pub elements: usize,
}

/// One MiB, and what 32-bit indices hold with room to spare.
pub(super) const LIMITS: Limits = Limits { line: 1 << 20, elements: 100_000_000 };

const MEBIBYTE: u64 = 1 << 20;

/// What a file's lines hold.
#[derive(Default)]
pub(super) struct Source {
    pub positions_f32: Vec<[f32; 3]>,
    pub positions_f64: Vec<[f64; 3]>,
    /// The `f` lines with absolute vertex indices alone, and the `o` and `g` lines as `g` lines.
    pub text: Vec<u8>,
    /// For each `f` line its line number in the file.
    pub face_lines: Vec<u32>,
    /// Triangles that the faces make, if none is left out.
    pub triangles: usize,
    /// What was skipped or altered.
    pub notes: Notes,
    /// The largest index of a face, counted from 1, and the first line that names it.
    pub largest: (i64, usize),
}

/// Something in a file that was skipped, altered or suspect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The first line it was found at, counted from 1.
    pub line: Option<usize>,
    /// How often it was found.
    pub count: usize,
    /// What was found and what was done with it, without the count.
    pub message: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message, self.count)?;
        self.line.map_or(Ok(()), |line| write!(f, " (first at line {line})"))
    }
}

/// Notes of one kind are one note.
#[derive(Default)]
pub(super) struct Notes(pub Vec<Note>);

impl Notes {
    /// Counts one more of a kind; `line` is kept if it is the first.
    pub fn count(&mut self, message: &str, line: usize) {
        match self.0.iter_mut().find(|note| note.message == message) {
            Some(note) => note.count += 1,
            None => {
                self.0.push(Note { line: Some(line), count: 1, message: message.to_owned() });
            }
        }
    }
}

/// Reads a whole file. Errors carry the line; `progress` is called about every MiB with the bytes
/// read so far, and at the end.
pub(super) fn read<R: BufRead>(
    reader: R,
    name: &str,
    limits: Limits,
    progress: &mut dyn FnMut(u64),
) -> Result<Source, InputError> {
    let mut source = Source::default();
    let mut lines = Lines::new(reader, name, limits.line, progress);
    while let Some(line) = lines.next_statement()? {
        source
            .statement(&lines.statement, line, limits.elements)
            .map_err(|message| InputError::at(name, line, message))?;
    }
    (lines.progress)(lines.bytes);
    let vertices = source.positions_f64.len();
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

impl Source {
    fn statement(&mut self, text: &str, line: usize, limit: usize) -> Result<(), String> {
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => return self.vertex(words, line, limit),
            Some("f") => return self.face(words, line, limit),
            Some("o" | "g") => {
                self.text.push(b'g');
                for word in words {
                    self.text.push(b' ');
                    self.text.extend_from_slice(word.as_bytes());
                }
                self.text.push(b'\n');
            }
            Some("l" | "p") => self.notes.count("lines and points (l, p) skipped", line),
            None | Some("vt" | "vn" | "vp" | "s" | "usemtl" | "mtllib") => {}
            Some(_) => self.notes.count("unknown statements skipped", line),
        }
        Ok(())
    }

    fn vertex<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        line: usize,
        limit: usize,
    ) -> Result<(), String> {
        if self.positions_f64.len() >= limit {
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
            self.notes.count("weights (w) other than 1 ignored", line);
        }
        if narrow.iter().any(|coordinate| coordinate.is_infinite()) {
            self.notes.count("f32 overflow: vertices with an infinite coordinate in f32", line);
        }
        self.positions_f32.push(narrow);
        self.positions_f64.push(wide);
        Ok(())
    }

    fn face<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        line: usize,
        limit: usize,
    ) -> Result<(), String> {
        let vertices = self.positions_f64.len();
        let mut corners = 0;
        self.text.push(b'f');
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
            if index > self.largest.0 {
                self.largest = (index, line);
            }
            write!(self.text, " {index}").map_err(|error| error.to_string())?;
            corners += 1;
        }
        self.text.push(b'\n');
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
            if matches!(error.kind(), IntErrorKind::PosOverflow | IntErrorKind::NegOverflow) =>
        {
            Err(format!("face names vertex {}, which no file has", shortened(vertex)))
        }
        _ => Err(format!("face has {} for v, v/vt, v//vn or v/vt/vn", quoted(word))),
    }
}

fn vertices_text(count: usize) -> String {
    format!("{count} {}", if count == 1 { "vertex" } else { "vertices" })
}

fn quoted(word: &str) -> String {
    format!("'{}'", shortened(word))
}

/// A word of the file that fits into a message and does no harm to a terminal.
fn shortened(word: &str) -> String {
    let shown: String = word.chars().take(40).flat_map(char::escape_debug).collect();
    if word.chars().nth(40).is_some() { shown + "..." } else { shown }
}

/// Goes through a text statement by statement: a line, or lines joined by backslashes at their
/// ends, without comment.
struct Lines<'a, R> {
    reader: R,
    name: &'a str,
    limit: usize,
    progress: &'a mut dyn FnMut(u64),
    /// Lines and bytes read so far, and when to report next.
    number: usize,
    bytes: u64,
    next_report: u64,
    raw: Vec<u8>,
    statement: String,
}

impl<'a, R: BufRead> Lines<'a, R> {
    fn new(reader: R, name: &'a str, limit: usize, progress: &'a mut dyn FnMut(u64)) -> Self {
        let (raw, statement) = (Vec::new(), String::new());
        let (number, bytes, next_report) = (0, 0, MEBIBYTE);
        Lines { reader, name, limit, progress, number, bytes, next_report, raw, statement }
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
        self.bytes += read as u64;
        if self.bytes >= self.next_report {
            (self.progress)(self.bytes);
            self.next_report = self.bytes + MEBIBYTE;
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

//! PLY files: ASCII, and binary of either byte order.
//!
//! The crate ply-rs-bw reads the header and single elements. Which elements are read, lines and limits are
//! decided here.

use super::builder::{FilePlace, MeshBuilder, vertices_text};
use super::counted::ReadLimits;
use super::{InputError, Mesh};
use crate::json::quoted;
use crate::printable::printable;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};
use std::borrow::Cow;
use std::io::{self, BufRead, ErrorKind, Read, Take};

/// Reads a file.
pub(super) fn read(
    reader: impl BufRead,
    name: &str,
    limits: ReadLimits,
) -> Result<Mesh, InputError> {
    let (text, reader) = plain_header(reader, limits.line as u64)
        .map_err(|error| InputError::reading(name, None, &error))?;
    let mut reader = Reader::new(text.as_slice().chain(reader).take(limits.line as u64));
    let header = match Parser::<Element>::new().read_header(&mut reader) {
        Ok(header) => header,
        Err(_) if reader.get_ref().limit() == 0 => {
            let message = format!("a header of more than {} bytes", limits.line);
            return Err(InputError::of(name, message));
        }
        Err(error) => {
            let line = error
                .line()
                .and_then(|line| Some((line, text.split(is_end).nth(line - 1)?)));
            let Some((line, words)) = line.filter(|(_, words)| !words.is_empty()) else {
                return Err(refused(name, error.line(), "header", &error));
            };
            let found = quoted(String::from_utf8_lossy(words).trim_end());
            let message = format!("header: expected {}, found {found}", expected(line, words));
            return Err(InputError::at(name, line, message));
        }
    };
    check_header(&header, limits).map_err(|message| InputError::of(name, message))?;
    let line = reader.line().saturating_sub(1);
    let has_lines = header.encoding == Encoding::Ascii;
    let mesh = if has_lines {
        MeshBuilder::default()
    } else {
        MeshBuilder::without_lines()
    };
    let faces = Faces::default();
    let reader = reader.into_inner();
    let mut file = File {
        reader,
        name,
        limits,
        encoding: header.encoding,
        line,
        mesh,
        faces,
    };
    for element in header.elements.values() {
        file.read(element)?;
    }
    file.finish()
}

/// The lines up to `end_header`, in which every byte that is not ASCII becomes a `?` (it stands in a comment or a name, and may be of
/// any encoding), and the rest of the file.
fn plain_header<R: BufRead>(mut reader: R, limit: u64) -> io::Result<(Vec<u8>, R)> {
    let (mut header, mut end) = (Vec::new(), None);
    let mut lines = (&mut reader).take(limit);
    while end.is_none() {
        let start = header.len();
        if lines.read_until(b'\n', &mut header)? == 0 {
            break;
        }
        let found = header[start..]
            .windows(END.len())
            .position(|bytes| bytes == END);
        end = found.map(|place| start + place);
    }
    let end = end.unwrap_or(header.len());
    header[..end]
        .iter_mut()
        .filter(|byte| !byte.is_ascii())
        .for_each(|byte| *byte = b'?');
    Ok((header, reader))
}

const END: &[u8] = b"end_header";

fn is_end(byte: &u8) -> bool {
    *byte == b'\n'
}

/// The form that a line of a header should have.
fn expected(line: usize, words: &[u8]) -> &'static str {
    match words
        .split(u8::is_ascii_whitespace)
        .next()
        .unwrap_or_default()
    {
        _ if line == 1 => "'ply'",
        b"format" => "one line 'format ascii 1.0', or binary_little_endian or binary_big_endian",
        b"element" => "'element NAME COUNT'",
        b"property" => {
            "'property TYPE NAME' or 'property list TYPE TYPE NAME' below an element, with a TYPE as float or int"
        }
        _ => "format, element, property, comment, obj_info or end_header",
    }
}

/// The names that writers give to a face's indices.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Checks that the file has vertices with x, y and z, and faces with indices, and not too many.
fn check_header(header: &Header, limits: ReadLimits) -> Result<(), String> {
    let element = |name: &str| match header.elements.get(name) {
        Some(element) if element.count > 0 => Ok(element),
        _ => Err(format!("the file has no elements '{name}'")),
    };
    let vertex = element("vertex")?;
    for axis in ["x", "y", "z"] {
        match vertex
            .properties
            .get(axis)
            .map(|property| &property.data_type)
        {
            Some(PropertyType::Scalar(_)) => {}
            _ => return Err(format!("element 'vertex' has no number '{axis}'")),
        }
    }
    let face = element("face")?;
    let is_float = |kind: &ScalarType| matches!(kind, ScalarType::Float | ScalarType::Double);
    match INDICES
        .iter()
        .find_map(|name| face.properties.get(*name))
        .map(|list| &list.data_type)
    {
        Some(PropertyType::List(count, index)) if !is_float(count) && !is_float(index) => {}
        _ => return Err("element 'face' has no list of integers 'vertex_indices'".to_owned()),
    }
    for (element, what) in [(vertex, "vertices"), (face, "triangles")] {
        if element.count > limits.elements {
            return Err(format!("more than {} {what}", limits.elements));
        }
    }
    Ok(())
}

/// The error for an input that the crate refuses: bad data, or a reader that fails.
fn refused(name: &str, line: Option<usize>, what: &str, error: &ParseError) -> InputError {
    match error.kind() {
        ErrorKind::InvalidInput | ErrorKind::InvalidData | ErrorKind::UnexpectedEof => {
            let text = error.to_string();
            // The first line of its messages says what is wrong; others repeat the text, and the parser's state.
            let reason = text.lines().next().unwrap_or_default();
            let (_, reason) = reason
                .strip_prefix("Line ")
                .and_then(|reason| reason.split_once(": "))
                .unwrap_or(("", reason));
            InputError {
                line,
                ..InputError::of(name, format!("{what}: {}", printable(reason)))
            }
        }
        kind => InputError::reading(name, line, &kind.into()),
    }
}

/// A file after its header.
struct File<'a, R> {
    reader: Take<R>,
    name: &'a str,
    limits: ReadLimits,
    encoding: Encoding,
    /// Lines read so far.
    line: usize,
    mesh: MeshBuilder,
    faces: Faces,
}

/// The faces of a file: they may stand before the vertices.
#[derive(Default)]
struct Faces {
    corners: Vec<u32>,
    /// How many corners a face has, and its line or number.
    sizes: Vec<(u32, u32)>,
    triangles: usize,
    /// The largest vertex, and the first face that names it.
    largest: (u32, usize),
}

impl<R: BufRead> File<'_, R> {
    /// Reads all elements of a kind.
    fn read(&mut self, kind: &ElementDef) -> Result<(), InputError> {
        if kind.properties.is_empty() || kind.count == 0 {
            return Ok(());
        }
        if !["vertex", "face"].contains(&kind.name.as_str()) {
            self.mesh
                .note("kinds of elements other than vertex and face skipped", None);
        }
        for number in 1..=kind.count {
            let what = format!("{} {number} of {}", shown(&kind.name), kind.count);
            let element = match self.encoding {
                Encoding::Ascii => self.ascii_element(kind, &what)?,
                _ => self.binary_element(kind, &what)?,
            };
            let (place, at) = match self.encoding {
                Encoding::Ascii => (FilePlace::Line(self.line), self.line),
                _ => (FilePlace::Vertex(number), number),
            };
            let added = match kind.name.as_str() {
                "vertex" => self.add_vertex(&element, place),
                "face" => self.add_face(&element, at),
                _ => Ok(()),
            };
            added.map_err(|message| self.bad(&format!("{what}: {message}")))?;
        }
        Ok(())
    }

    fn bad(&self, message: &str) -> InputError {
        let line = (self.encoding == Encoding::Ascii).then_some(self.line);
        InputError {
            line,
            ..InputError::of(self.name, message)
        }
    }

    fn binary_element(&mut self, kind: &ElementDef, what: &str) -> Result<Element, InputError> {
        let parser = Parser::<Element>::new();
        self.reader.set_limit(u64::MAX);
        let element = match self.encoding {
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut self.reader, kind),
            _ => parser.read_little_endian_element(&mut self.reader, kind),
        };
        element.map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => self.bad(&format!("the file ends in {what}")),
            _ => refused(self.name, None, what, &error),
        })
    }

    /// From the next line that is not blank.
    fn ascii_element(&mut self, kind: &ElementDef, what: &str) -> Result<Element, InputError> {
        let mut raw = Vec::new();
        while raw.trim_ascii().is_empty() {
            raw.clear();
            self.reader.set_limit(self.limits.line as u64 + 1);
            self.reader
                .read_until(b'\n', &mut raw)
                .map_err(|error| InputError::reading(self.name, Some(self.line + 1), &error))?;
            if raw.is_empty() {
                return Err(self.bad(&format!("the file ends before {what}")));
            }
            self.line += 1;
            if raw.len() > self.limits.line {
                return Err(self.bad(&format!("a line of more than {} bytes", self.limits.line)));
            }
            if self.line > u32::MAX as usize {
                return Err(self.bad("more lines than 32 bits count"));
            }
        }
        let line = str::from_utf8(&raw).map_err(|_| self.bad("not UTF-8 text"))?;
        let line = checked_words(line, kind).map_err(|m| self.bad(&format!("{what}: {m}")))?;
        let element = Parser::<Element>::new().read_ascii_element(&line, kind);
        element.map_err(|error| refused(self.name, Some(self.line), what, &error))
    }

    fn add_vertex(&mut self, element: &Element, place: FilePlace) -> Result<(), String> {
        let position = element.position;
        if let Some(number) = position.iter().find(|number| !number.is_finite()) {
            return Err(format!("{number} is not finite"));
        }
        self.mesh
            .vertex(position, position.map(|number| number as f32), place);
        Ok(())
    }

    fn add_face(&mut self, element: &Element, at: usize) -> Result<(), String> {
        let corners = &element.corners;
        if corners.len() < 3 {
            return Err(format!("{} of at least 3 vertices", corners.len()));
        }
        self.faces.triangles += corners.len() - 2;
        if self.faces.triangles > self.limits.elements {
            return Err(format!("more than {} triangles", self.limits.elements));
        }
        for corner in corners {
            let vertex = u32::try_from(*corner);
            let vertex = vertex.map_err(|_| format!("names vertex {corner}, which no file has"))?;
            if vertex >= self.faces.largest.0 {
                self.faces.largest = (vertex, at);
            }
            self.faces.corners.push(vertex);
        }
        self.faces.sizes.push((corners.len() as u32, at as u32));
        Ok(())
    }

    fn finish(mut self) -> Result<Mesh, InputError> {
        let (largest, at) = self.faces.largest;
        if largest as usize >= self.mesh.vertices() {
            let count = vertices_text(self.mesh.vertices());
            let has_lines = self.encoding == Encoding::Ascii;
            let face = if has_lines {
                "face".to_owned()
            } else {
                format!("face {at}")
            };
            let message = format!("{face} names vertex {largest}, counted from 0, of {count}");
            return Err(InputError {
                line: has_lines.then_some(at),
                ..self.bad(&message)
            });
        }
        let mut rest = self.faces.corners.as_slice();
        for (size, number) in &self.faces.sizes {
            let (corners, after) = rest.split_at(*size as usize);
            self.mesh.face(corners, *number);
            rest = after;
        }
        self.mesh.finish(self.name, 0)
    }
}

fn shown(name: &str) -> &str {
    name.get(..40).unwrap_or(name)
}

/// A line whose words are numbers, as many as the element has; with the digits beside a point that the crate
/// expects (`.5` becomes `0.5`).
fn checked_words(line: &str, kind: &ElementDef) -> Result<String, String> {
    let words: Vec<&str> = line.split_ascii_whitespace().collect();
    let mut expected = 0;
    for property in kind.properties.values() {
        if let PropertyType::List(..) = property.data_type {
            let count: u32 = match words.get(expected) {
                Some(word) => word
                    .parse()
                    .map_err(|_| format!("{} is no count", quoted(word)))?,
                None => 0,
            };
            expected += count as usize;
        }
        expected += 1;
    }
    let mut line = String::new();
    for word in &words {
        let number: f64 = word
            .parse()
            .map_err(|_| format!("{} is not a number", quoted(word)))?;
        if !number.is_finite() && !word.bytes().any(|byte| byte.is_ascii_digit()) {
            return Err(format!("{} is not finite", quoted(word)));
        }
        line += &with_digits(word);
        line.push(' ');
    }
    if words.len() != expected {
        return Err(format!("{} of {expected} numbers", words.len()));
    }
    Ok(line)
}

fn with_digits(word: &str) -> Cow<'_, str> {
    let is_digit = |c: char| c.is_ascii_digit();
    match word.split_once('.') {
        Some((before, after)) if !(before.ends_with(is_digit) && after.starts_with(is_digit)) => {
            let left = if before.ends_with(is_digit) { "" } else { "0" };
            let right = if after.starts_with(is_digit) { "" } else { "0" };
            Cow::Owned(format!("{before}{left}.{right}{after}"))
        }
        _ => Cow::Borrowed(word),
    }
}

/// An element of any kind: what a vertex or a face says of itself.
struct Element {
    position: [f64; 3],
    corners: Vec<i64>,
}

impl Element {
    fn coordinate(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ => return PropertyAccessResult::Ignored,
        };
        self.position[axis] = value;
        PropertyAccessResult::Set
    }

    fn list<T: Into<i64>>(&mut self, name: &str, values: Vec<T>) -> PropertyAccessResult {
        if !INDICES.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.corners = values.into_iter().map(T::into).collect();
        PropertyAccessResult::Set
    }
}

macro_rules! numbers {
    ($($set:ident $kind:ty),*) => {
        $(fn $set(&mut self, name: &str, value: $kind) -> PropertyAccessResult {
            self.coordinate(name, f64::from(value))
        })*
    };
}

macro_rules! lists {
    ($($set:ident $kind:ty),*) => {
        $(fn $set(&mut self, name: &str, values: Vec<$kind>) -> PropertyAccessResult {
            self.list(name, values)
        })*
    };
}

impl PropertyAccess for Element {
    fn new() -> Element {
        Element {
            position: [0.0; 3],
            corners: Vec::new(),
        }
    }

    numbers!(
        set_char i8, set_uchar u8, set_short i16, set_ushort u16, set_int i32, set_uint u32,
        set_float f32, set_double f64
    );
    lists!(
        set_list_char i8, set_list_uchar u8, set_list_short i16, set_list_ushort u16,
        set_list_int i32, set_list_uint u32
    );
}

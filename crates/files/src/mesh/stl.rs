//! STL files, ASCII and binary: triangles with corners of their own, which are joined where all their bits are equal.
//!
//! Read here rather than by a crate: those round the numbers of the ASCII form to `f32`, and take a binary file that begins
//! with `solid` for text.

use super::builder::{FilePlace, MeshBuilder};
use super::counted::ReadLimits;
use super::text::{Statements, coordinate};
use super::{InputError, Mesh};
use crate::json::quoted;
use std::collections::HashMap;
use std::io::{BufRead, ErrorKind, Read};

/// The bytes before the number of triangles in the binary form, and those of a triangle.
const HEADER: usize = 80;
const TRIANGLE: usize = 50;

/// Reads a file. Text begins with `solid` and has no zero byte; the binary form has one in its number of triangles, unless they
/// are more than 16 million.
pub(super) fn read(
    mut reader: impl BufRead,
    name: &str,
    limits: ReadLimits,
) -> Result<Mesh, InputError> {
    let mut head = Vec::new();
    let start = (&mut reader).take(HEADER as u64 + 4).read_to_end(&mut head);
    start.map_err(|error| InputError::reading(name, None, &error))?;
    if is_text(&head) {
        return read_text(head.as_slice().chain(reader), name, limits);
    }
    let Some(count) = head.get(HEADER..).and_then(|bytes| bytes.try_into().ok()) else {
        let message = "the file ends within the header of a binary STL, and is no text that begins with 'solid'";
        return Err(InputError::of(name, message));
    };
    read_binary(reader, name, limits, u32::from_le_bytes(count) as usize)
}

/// True if a file that begins so is an ASCII STL.
pub(super) fn is_text(head: &[u8]) -> bool {
    head.trim_ascii_start().starts_with(b"solid") && !head.contains(&0)
}

const JOINED: &str = "corners that equal an earlier one in every bit, joined with it";

/// The corners so far, by their bits in `f64`.
struct Joined {
    mesh: MeshBuilder,
    known: HashMap<[u64; 3], u32>,
}

impl Joined {
    fn corner(&mut self, wide: [f64; 3], narrow: [f32; 3], place: FilePlace) -> u32 {
        // Both zeros are one place.
        let key = wide.map(|x| (x + 0.0).to_bits());
        let next = self.mesh.vertices() as u32;
        let known = *self.known.entry(key).or_insert(next);
        match known == next {
            true => self.mesh.vertex(wide, narrow, place),
            false => self.mesh.note(JOINED, Some(place)),
        }
        known
    }

    fn finish(self, name: &str) -> Result<Mesh, InputError> {
        if self.mesh.triangles() == 0 {
            return Err(InputError::of(name, "the file has no facets"));
        }
        self.mesh.finish(name, 0)
    }
}

/// `facet`, `outer loop`, three times `vertex x y z`, `endloop`, `endfacet`, between `solid` and `endsolid`, once or more often.
fn read_text(reader: impl BufRead, name: &str, limits: ReadLimits) -> Result<Mesh, InputError> {
    let mut all = Joined {
        mesh: MeshBuilder::default(),
        known: HashMap::new(),
    };
    let mut lines = Statements::new(reader, name, limits.line);
    let mut corners: Vec<u32> = Vec::new();
    let mut facet = 0;
    while let Some(line) = lines.next_statement()? {
        let error = |message: String| InputError::at(name, line, message);
        let mut words = lines.statement.split_ascii_whitespace();
        let word = words.next().unwrap_or_default().to_ascii_lowercase();
        match word.as_str() {
            "vertex" => {
                let found: Result<Vec<(f64, f32)>, _> = words.map(coordinate).collect();
                let found = found.map_err(error)?;
                let Some((all_three, [])) = found.split_first_chunk::<3>() else {
                    return Err(error(format!(
                        "vertex has {} of 3 coordinates",
                        found.len()
                    )));
                };
                let (wide, narrow) = (all_three.map(|it| it.0), all_three.map(|it| it.1));
                corners.push(all.corner(wide, narrow, FilePlace::Line(line)));
            }
            "facet" => (corners, facet) = (Vec::new(), line),
            "endfacet" if corners.len() == 3 => {
                if all.mesh.triangles() >= limits.elements {
                    return Err(error(format!("more than {} triangles", limits.elements)));
                }
                all.mesh.face(&corners, facet as u32);
            }
            "endfacet" => {
                return Err(error(format!("facet has {} of 3 vertices", corners.len())));
            }
            "" | "solid" | "endsolid" | "outer" | "endloop" => {}
            other => {
                let expected = "expected a line of an STL file, such as 'vertex 0 1 0', found";
                return Err(error(format!("{expected} {}", quoted(other))));
            }
        }
    }
    all.finish(name)
}

/// For each triangle a normal, three corners and two bytes, little-endian.
fn read_binary(
    mut reader: impl BufRead,
    name: &str,
    limits: ReadLimits,
    count: usize,
) -> Result<Mesh, InputError> {
    if count > limits.elements {
        let message = format!(
            "more than {} triangles: the header says {count}",
            limits.elements
        );
        return Err(InputError::of(name, message));
    }
    let mut all = Joined {
        mesh: MeshBuilder::without_lines(),
        known: HashMap::new(),
    };
    for number in 1..=count {
        let mut bytes = [0; TRIANGLE];
        reader
            .read_exact(&mut bytes)
            .map_err(|error| match error.kind() {
                ErrorKind::UnexpectedEof => {
                    let message = format!(
                        "the file ends in triangle {number} of the {count} that its header says"
                    );
                    InputError::of(name, message)
                }
                _ => InputError::reading(name, None, &error),
            })?;
        let (_normal, numbers) = bytes.as_chunks::<4>().0.split_at(3);
        let mut corners = Vec::with_capacity(3);
        for corner in numbers.as_chunks::<3>().0 {
            let narrow = corner.map(f32::from_le_bytes);
            if let Some(x) = narrow.iter().find(|x| !x.is_finite()) {
                let message = format!("triangle {number} has {x}, which is not finite");
                return Err(InputError::of(name, message));
            }
            corners.push(all.corner(narrow.map(f64::from), narrow, FilePlace::Face(number)));
        }
        all.mesh.face(&corners, number as u32);
    }
    all.finish(name)
}

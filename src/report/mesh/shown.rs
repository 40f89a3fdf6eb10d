//! The rows of a mesh's page, each with as many marks as fit.

use super::drawing::{DrawnRow, MeshDrawing, MeshMark};
use super::record::*;

/// Bytes for all marks. A row that leaves some of its share leaves them to the next.
const MARKS: usize = 3_500_000;

/// A row in a scalar.
pub(super) struct ShownRow<'a> {
    pub scalar: &'a str,
    pub result: &'a MeshRowResult,
    pub drawn: &'a DrawnRow,
    /// Its marks as the script reads them, and how many there are.
    pub marks: String,
    pub marked: usize,
}

/// The rows with as many marks as fit.
pub(super) fn shown<'a>(record: &'a MeshRecord, drawing: &'a MeshDrawing) -> Vec<ShownRow<'a>> {
    let parts = &record.result.scalars;
    let results = parts.iter().flat_map(|part| part.results.iter().map(move |row| (part, row)));
    let mut left = MARKS;
    let mut rows = Vec::new();
    for (i, ((part, result), drawn)) in results.zip(&drawing.rows).enumerate() {
        let share = left / (drawing.rows.len() - i);
        let (mut marks, mut marked) = (String::new(), 0);
        for text in drawn.marks.iter().map(mark_text) {
            if share < marks.len() + text.len() {
                break;
            }
            marks += &text;
            marked += 1;
        }
        left -= marks.len();
        rows.push(ShownRow { scalar: &part.scalar, result, drawn, marks, marked });
    }
    rows
}

/// `what a b rays index line,line;`
fn mark_text(mark: &MeshMark) -> String {
    let MeshMark { wrong, ends: [a, b], rays, index, .. } = mark;
    format!("{} {a} {b} {rays} {index} {};", *wrong as usize, lines(mark, ","))
}

/// The lines of the faces around, the first eight.
pub(super) fn lines(mark: &MeshMark, comma: &str) -> String {
    let more = if mark.lines.len() > 8 { &["…".to_owned()][..] } else { &[] };
    let first = mark.lines.iter().take(8).map(u32::to_string);
    first.chain(more.iter().cloned()).collect::<Vec<_>>().join(comma)
}
